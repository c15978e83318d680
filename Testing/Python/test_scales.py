"""Units do not matter; lengths and values of very different size in one grid."""

import os
from pathlib import Path

import cells
import numpy as np
import pytest
import support
from highorderparticles import vtkHighOrderParticleSlice
from vtkmodules.vtkCommonDataModel import (
    VTK_HEXAHEDRON,
    VTK_LAGRANGE_HEXAHEDRON,
    VTK_LAGRANGE_WEDGE,
    VTK_WEDGE,
    vtkPlane,
    vtkSphere,
)
from vtkmodules.vtkFiltersSources import vtkCellTypeSource


def box_of_cells(cell_type, blocks, order=1):
    """Unit cubes, one or two cells each."""
    source = vtkCellTypeSource()
    source.SetCellType(cell_type)
    source.SetCellOrder(order)
    source.SetBlocksDimensions(*blocks)
    source.Update()
    return source.GetOutput()


@pytest.mark.parametrize("cell_type", [VTK_LAGRANGE_HEXAHEDRON, VTK_LAGRANGE_WEDGE])
@pytest.mark.parametrize("amplitude", [1e-1, 1e-2, 1e-3])
def test_small_changes_of_a_large_value(cell_type, amplitude):
    """Values like pressures in pascals."""
    grid = box_of_cells(cell_type, (4, 4, 4), 2)
    x = support.points_of(grid) - 2.0
    change = np.sum(x**2, axis=1) - 2.0
    support.add_point_array(grid, "alone", change)
    support.add_point_array(grid, "beside", 101325.0 + amplitude * change)
    alone, beside = (
        support.run_quietly(grid, name, value, Spacing=0.1) for name, value in (("alone", 0.0), ("beside", 101325.0))
    )
    assert support.reported(beside, "ParticlesRejected") == 0
    assert beside.GetNumberOfPoints() == pytest.approx(alone.GetNumberOfPoints(), rel=0.005)
    radius = np.linalg.norm(support.points_of(beside) - 2.0, axis=1)
    # The values themselves are rounded to 1.5e-11.
    np.testing.assert_allclose(radius, np.sqrt(2.0), atol=3e-11 / amplitude)


@pytest.mark.parametrize("cell_type", [VTK_HEXAHEDRON, VTK_WEDGE])
@pytest.mark.parametrize("layers", [1, 2])
@pytest.mark.parametrize("thickness", [0.03, 0.1])
def test_plates_thinner_than_the_spacing(cell_type, layers, thickness):
    """The two sides of a thin cell are not neighbours of each other. The surface is a strip across twelve cells."""
    grid = box_of_cells(cell_type, (12, 12, layers))
    x = support.points_of(grid) * [1.0, 1.0, thickness / layers]
    cells.set_points(grid, x)
    support.add_point_array(grid, "F", x[:, 1] - 0.3 * x[:, 0] - 4.2)
    spacing = 0.12
    particles = support.run_quietly(grid, "F", 0.0, Spacing=spacing)
    along = np.sort(np.r_[0.0, support.points_of(particles)[:, 0], 12.0]) * np.hypot(1.0, 0.3)
    assert np.max(np.diff(along)) < 1.5 * spacing
    rows = 1 if thickness < 0.4 * spacing else 2
    assert particles.GetNumberOfPoints() == pytest.approx(rows * along[-1] / spacing, rel=0.1)


# Units


def real_files():
    """Every file of solvers in the repository that is a grid by itself."""
    return sorted(path.name for path in Path(os.environ["HOP_DATA"]).glob("*.vtu") if "_00." not in path.name)


def contoured(grid):
    """Name of a point array of a grid, the component to contour, and an isovalue at two thirds of its range."""
    arrays = [grid.GetPointData().GetArray(a) for a in range(grid.GetPointData().GetNumberOfArrays())]
    array = next(a for a in arrays if a.GetName() != "RationalWeights")
    count = array.GetNumberOfComponents()
    low, high = array.GetRange(0 if count == 1 else -1)
    return array.GetName(), 0 if count == 1 else count, low + 2 / 3 * (high - low)


def in_other_units(grid, name, length, value):
    """A copy of a grid with coordinates and the values of one array times a number."""
    scaled = grid.NewInstance()
    scaled.ShallowCopy(grid)
    cells.set_points(scaled, length * support.points_of(grid))
    support.add_point_array(scaled, name, value * support.array_of(grid, name).astype(float))
    return scaled


# By how many lengths an array of the output is multiplied where the input's coordinates are multiplied by a length.
LENGTHS = {
    "Radius": 1, "Area": 2, "Mean_Curvature": -1, "Gauss_Curvature": -2, "Shape_Operator": -1, "Residual": 1,
    "Clip_Distance": 1, "Clip_Curvature": -1,
    "Original_Placement": np.array(3 * [1] + 3 * [0]), "Cell_Borders": np.array(4 * [1, 1, 1, -1]),
}  # fmt: skip
# Powers of two round nothing: 6e-151 to 2e150.
SMALL, LARGE = 2.0**-500, 2.0**500


@pytest.mark.parametrize("file", real_files())
def test_particles_of_real_files_do_not_depend_on_units(data, file):
    grid = support.read(data(file)).GetClientSideObject().GetOutputDataObject(0)
    name, component, isovalue = contoured(grid)

    def particles_in(length, value):
        particles, messages = support.run(
            in_other_units(grid, name, length, value), name, value * isovalue, Component=component)
        assert messages.errors == []
        return particles

    plain = particles_in(1.0, 1.0)
    assert plain.GetNumberOfPoints() > 0
    for length, value in [(SMALL, LARGE), (LARGE, SMALL), (SMALL, SMALL)]:
        particles = particles_in(length, value)
        assert particles.GetNumberOfPoints() == plain.GetNumberOfPoints()
        np.testing.assert_array_equal(support.points_of(particles) / length, support.points_of(plain))
        for array in support.own_arrays(0):
            # The hidden array's columns are arrays, too.
            if array in ("Jump", "Isovalue", "__vtkValidMask__Splats"):
                continue
            unit = float(length) ** LENGTHS.get(array, 0)
            # Equal but for numbers below the smallest normal double, 2e-308, which have fewer bits.
            difference = np.abs(support.array_of(particles, array) / unit - support.array_of(plain, array))
            assert np.all(difference <= 5e-324 / unit), array


def corners_of(mesh):
    cells_of_mesh = mesh.GetPolys() if mesh.IsA("vtkPolyData") else mesh.GetCells()
    return support.vtk_to_numpy(cells_of_mesh.GetConnectivityArray())


@pytest.mark.parametrize("kind", ["Triangles", "Curved Triangles"])
@pytest.mark.parametrize("file", ["mfem_torus_wedge_p4.vtu", "dolfinx_tet_p3.vtu", "yeti_pipe_bezier_rational_p423.vtu"])
def test_meshes_do_not_depend_on_units(data, file, kind):
    grid = support.output_of(support.read(data(file)))
    name, component, isovalue = contoured(grid)

    def mesh_in(length, value):
        scaled = in_other_units(grid, name, length, value)
        spacing = 0.03 * length * support.longest_side(grid)
        mesh, messages = support.run(
            scaled, name, value * isovalue, Component=component, OutputType=kind, Spacing=spacing)
        assert messages.errors == []
        return mesh

    plain = mesh_in(1.0, 1.0)
    assert plain.GetNumberOfCells() > 100
    for length, value in [(SMALL, LARGE), (LARGE, SMALL)]:
        mesh = mesh_in(length, value)
        np.testing.assert_array_equal(support.points_of(mesh) / length, support.points_of(plain))
        np.testing.assert_array_equal(corners_of(mesh), corners_of(plain))
        for array in ("Area", "Mean_Curvature", "Normals", "Residual"):
            unit = float(length) ** LENGTHS.get(array, 0)
            difference = np.abs(support.array_of(mesh, array) / unit - support.array_of(plain, array))
            assert np.all(difference <= 5e-324 / unit), array


@pytest.mark.parametrize("kind", ["plane", "sphere"])
@pytest.mark.parametrize("file", ["mfem_hex1_p8.vtu", "vtkdata_pyramid_quadratic.vtu"])
def test_slices_do_not_depend_on_units(data, file, kind):
    grid = support.output_of(support.read(data(file)))
    side, middle = support.longest_side(grid), np.reshape(grid.GetBounds(), (3, 2)).mean(axis=1)

    def slice_in(length):
        cut = vtkHighOrderParticleSlice()
        scaled = grid.NewInstance()
        scaled.ShallowCopy(grid)
        cells.set_points(scaled, length * support.points_of(grid))
        function = vtkPlane() if kind == "plane" else vtkSphere()
        if kind == "plane":
            function.SetOrigin(length * middle)
            function.SetNormal(0.6, 0.64, 0.48)
        else:
            function.SetCenter(length * middle)
            function.SetRadius(length * 0.3 * side)
        cut.SetInputDataObject(scaled)
        cut.SetCutFunction(function)
        cut.SetSpacing(length * 0.03 * side)
        cut.SetValue(0, 0.0)
        cut.Update()
        return support.points_of(cut.GetOutputDataObject(0))

    plain = slice_in(1.0)
    assert len(plain) > 100
    for length in (SMALL, LARGE):
        np.testing.assert_array_equal(slice_in(length) / length, plain)


@pytest.mark.parametrize("factor", [2.0**-700, 2.0**700])
def test_only_ratios_of_weights_count(data, factor):
    grid = support.read(data("yeti_pipe_bezier_rational_p333.vtu")).GetClientSideObject().GetOutputDataObject(0)
    name, component, isovalue = contoured(grid)
    scaled = grid.NewInstance()
    scaled.ShallowCopy(grid)
    support.add_point_array(scaled, "RationalWeights", factor * support.array_of(grid, "RationalWeights"))
    scaled.GetPointData().SetRationalWeights(scaled.GetPointData().GetArray("RationalWeights"))
    plain, particles = (
        support.run(some, name, isovalue, Component=component, NumberOfParticles=200)[0] for some in (grid, scaled)
    )
    assert plain.GetNumberOfPoints() > 0
    np.testing.assert_array_equal(support.points_of(particles), support.points_of(plain))
