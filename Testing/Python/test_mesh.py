"""Triangles and curved triangles: closed, on the surface, and at home in ParaView's other filters and files."""

import numpy as np
import pytest
import support
from cells import straight_grid
from paraview import simple
from paraview.vtk.util.numpy_support import vtk_to_numpy
from support import add_cell_array, add_point_array, array_names, array_of, leaves_of, output_of, points_of
from test_blocks import multiblock
from vtkmodules.vtkCommonCore import reference
from vtkmodules.vtkCommonDataModel import VTK_LAGRANGE_TRIANGLE
from vtkmodules.vtkFiltersCore import vtkCleanPolyData, vtkExtractCells, vtkFeatureEdges

CENTER = np.array([2.0, 2.0, 2.0])
RADIUS = 1.5
AREA = 4 * np.pi * RADIUS**2
FLUX = 3 * AREA * RADIUS / 3  # of the field x - CENTER, outward
SPACING = 0.2
KINDS = ("Particles", "Triangles", "Curved Triangles")


def sphere_grid():
    """Quadratic hexahedra that hold a sphere exactly; values fall outwards, so that Normals point outwards."""
    grid = straight_grid("LAGRANGE_HEXAHEDRON", order=2, blocks=4)
    x = points_of(grid) - CENTER
    add_point_array(grid, "u", -(x**2).sum(axis=1))
    add_point_array(grid, "velocity", x)
    add_cell_array(grid, "number", np.arange(grid.GetNumberOfCells(), dtype=float))
    return grid


def part_of(grid, cells):
    """Some cells with all their arrays."""
    extract = vtkExtractCells()
    extract.SetInputData(grid)
    for cell in cells:
        extract.AddCellRange(cell, cell)
    extract.Update()
    part = extract.GetOutput()
    part.GetPointData().RemoveArray("vtkOriginalPointIds")
    part.GetCellData().RemoveArray("vtkOriginalCellIds")
    return part


@pytest.fixture(scope="module")
def grid(plugin):
    return sphere_grid()


def mesh_proxy(grid, kind, **properties):
    return support.make_filter(grid, "u", -RADIUS**2, OutputType=kind, **{"Spacing": SPACING, **properties})[0]


def mesh_of(grid, kind, **properties):
    return support.run_quietly(grid, "u", -RADIUS**2, OutputType=kind, **{"Spacing": SPACING, **properties})


def corners_of(mesh):
    """Three points a triangle, whatever its order."""
    cells = mesh.GetPolys() if mesh.IsA("vtkPolyData") else mesh.GetCells()
    connectivity = vtk_to_numpy(cells.GetConnectivityArray())
    return connectivity.reshape(cells.GetNumberOfCells(), -1)[:, :3]


def open_edges_of(polydata):
    """Number of edges with one triangle, or with more than two."""
    edges = vtkFeatureEdges()
    edges.SetInputData(polydata)
    edges.FeatureEdgesOff()
    edges.ManifoldEdgesOff()
    edges.Update()
    return edges.GetOutput().GetNumberOfCells()


def cleaned(polydata):
    clean = vtkCleanPolyData()
    clean.SetInputData(polydata)
    clean.SetTolerance(0.0)
    clean.Update()
    return clean.GetOutput()


# The meshes themselves


def test_triangles_are_closed_oriented_and_on_the_surface(grid):
    particles, mesh = mesh_of(grid, "Particles"), mesh_of(grid, "Triangles")
    points, triangles = points_of(mesh), corners_of(mesh)
    assert mesh.IsA("vtkPolyData") and mesh.GetNumberOfVerts() == 0
    assert np.abs(np.linalg.norm(points - CENTER, axis=1) - RADIUS).max() < 1e-9
    assert open_edges_of(mesh) == 0
    assert len(triangles) == 2 * (len(points) - 2)
    a, b, c = (points[triangles[:, i]] for i in range(3))
    assert (np.einsum("ij,ij->i", np.cross(b - a, c - a), a + b + c - 3 * CENTER) > 0).all()
    # The same particles with the same arrays, and the same order.
    assert support.contents(particles) == support.contents(mesh)
    for name in ("MeshOpenLoops", "MeshUnusedParticles", "MeshStraightNodes"):
        assert support.reported(mesh, name) == 0
    assert support.reported(mesh, "MeshOpenLength") == 0.0


@pytest.mark.parametrize("file, array, value, components", [
    ("mfem_hex1_p8.vtu", "u", 0.2, 1),
    ("mfem_amr_hanging_hex_p3.vtu", "u", 0.01, 1),
    ("ngsolve_cylinder_ns_tet_p3.vtu", "pressure", 0.507, 2),
])
def test_topology_is_proven(data, plugin, file, array, value, components):
    mesh = support.run_quietly(support.read(data(file)), array, value, OutputType="Triangles")
    assert support.reported(mesh, "TopologyProven") == 1
    assert support.reported(mesh, "MeshComponents") == components
    assert support.reported(mesh, "ComponentsUnproven") == 0


def test_topology_of_a_field_with_jumps_is_not_proven(data, plugin):
    grid = support.read(data("mfem_dg_advection_0.vtu"))
    mesh = support.make_filter(grid, "rho", 0.293, OutputType="Triangles")[0]
    mesh.UpdatePipeline()
    report = support.output_of(mesh)
    assert support.reported(report, "TopologyProven") == 0
    assert support.reported(report, "ComponentsUnproven") > 0


def test_particles_without_a_triangle_are_told(grid):
    mesh, messages = support.run(grid, "u", -RADIUS**2, OutputType="Triangles", NumberOfParticles=1)
    assert mesh.GetNumberOfPoints() == 0 and support.reported(mesh, "MeshUnusedParticles") == 1
    assert any("1 particles are corners of no triangle" in text for text in messages.warnings)


def test_triangles_have_the_cell_arrays_of_their_first_corner(grid):
    mesh = mesh_of(grid, "Triangles")
    cells = array_of(mesh, "Cell_Id")[corners_of(mesh)[:, 0]]
    assert (array_of(mesh, "Cell_Id", "cell") == cells).all()
    assert (array_of(mesh, "number", "cell") == cells).all()


@pytest.mark.parametrize("order", [2, 3, 4])
def test_nodes_of_curved_triangles_are_on_the_surface(grid, order):
    flat = mesh_of(grid, "Triangles")
    mesh = mesh_of(grid, "Curved Triangles", Order=order)
    assert mesh.IsA("vtkUnstructuredGrid")
    count = mesh.GetNumberOfCells()
    assert count == flat.GetNumberOfCells()
    assert {mesh.GetCellType(c) for c in range(count)} == {VTK_LAGRANGE_TRIANGLE}
    inside = (order - 1) * (order - 2) // 2
    assert mesh.GetNumberOfPoints() == flat.GetNumberOfPoints() + 3 * count // 2 * (order - 1) + count * inside
    points = points_of(mesh) - CENTER
    assert np.abs(np.linalg.norm(points, axis=1) - RADIUS).max() < 1e-9
    assert np.abs(array_of(mesh, "Normals") - points / RADIUS).max() < 1e-6
    assert np.abs(array_of(mesh, "velocity") - points).max() < 1e-9
    # VTK's own cell agrees about the order of the nodes: the middle of an edge is near the sphere, not inside it.
    cell = mesh.GetCell(0)
    place, weights = [0.0] * 3, [0.0] * cell.GetNumberOfPoints()
    for where in ([0.5, 0.0, 0.0], [0.5, 0.5, 0.0], [0.0, 0.5, 0.0], [0.3, 0.3, 0.0], [0.6, 0.2, 0.0]):
        cell.EvaluateLocation(reference(0), where, place, weights)
        assert abs(np.linalg.norm(np.array(place) - CENTER) - RADIUS) < 2e-5


def test_areas_of_particles_add_up(grid):
    for kind in KINDS:
        assert array_of(mesh_of(grid, kind), "Area").sum() == pytest.approx(AREA, rel=2e-3)


def integrated(proxy):
    """Area and flux as Integrate Variables sees them."""
    flux = simple.Calculator(Input=proxy, ResultArrayName="flux", Function="dot(velocity,Normals)")
    result = output_of(simple.IntegrateVariables(Input=flux))
    return array_of(result, "Area", "cell")[0], array_of(result, "flux")[0]


@pytest.mark.parametrize("kind, rate", [("Triangles", 3.4), ("Curved Triangles", 3.4)])
def test_integrals_converge(grid, kind, rate):
    errors = []
    for spacing in (2 * SPACING, SPACING):
        area, flux = integrated(mesh_proxy(grid, kind, Spacing=spacing, AngularDensity=0, Order=2))
        errors.append((abs(area - AREA), abs(flux - FLUX)))
    for coarse, fine in zip(*errors):
        assert coarse > rate * fine > 0
    assert errors[1][0] < (2e-2 if kind == "Triangles" else 5e-3) * AREA


def test_the_same_for_any_number_of_threads(grid):
    from vtkmodules.vtkCommonCore import vtkSMPTools

    for kind in ("Triangles", "Curved Triangles"):
        results = []
        for threads in (1, 2):
            vtkSMPTools.Initialize(threads)
            mesh = mesh_of(grid, kind)
            results.append((support.contents(mesh), corners_of(mesh).tobytes()))
        vtkSMPTools.Initialize(0)
        assert results[0] == results[1]


def test_a_warm_start_has_a_mesh_too(grid):
    proxy = mesh_proxy(grid, "Triangles")
    output_of(proxy)
    proxy.Isosurfaces = [-(RADIUS * 0.98) ** 2]
    moved = output_of(proxy)
    assert open_edges_of(moved) == 0
    assert np.abs(np.linalg.norm(points_of(moved) - CENTER, axis=1) - RADIUS * 0.98).max() < 1e-9


def test_the_type_can_be_changed_back_and_forth(grid):
    proxy = mesh_proxy(grid, "Particles")
    before = support.contents(output_of(proxy))
    for kind, name in (("Curved Triangles", "vtkUnstructuredGrid"), ("Triangles", "vtkPolyData"), ("Particles", "vtkPolyData")):
        proxy.OutputType = kind
        assert output_of(proxy).IsA(name)
    assert support.contents(output_of(proxy)) == before


@pytest.mark.parametrize("kind", KINDS)
def test_no_surface_is_an_empty_mesh(grid, kind):
    output, messages = support.run(grid, "u", 1000.0, OutputType=kind)
    assert output.GetNumberOfPoints() == 0 and output.GetNumberOfCells() == 0
    assert messages.errors == [] and len(messages.warnings) == 1


def test_several_isovalues_are_meshes_of_their_own(grid):
    values = [-1.0, -(RADIUS**2)]
    for kind in ("Triangles", "Curved Triangles"):
        mesh = support.run_quietly(grid, "u", values, OutputType=kind, Spacing=SPACING)
        isovalues = array_of(mesh, "Isovalue")[corners_of(mesh)]
        assert set(isovalues[:, 0]) == set(values)
        assert (isovalues == isovalues[:, :1]).all()
        assert len(corners_of(mesh)) == 2 * (len(np.unique(corners_of(mesh))) - 4)


def test_slices_are_meshes_too(grid):
    simple_slice = simple.HighOrderParticleSlice(Input=support.source_of(grid), OutputType="Triangles", Spacing=SPACING)
    simple_slice.SliceType.Origin, simple_slice.SliceType.Normal = [2.0, 2.0, 2.2], [0.0, 0.0, 1.0]
    area = array_of(output_of(simple.IntegrateVariables(Input=simple_slice)), "Area", "cell")[0]
    assert area == pytest.approx(16.0, rel=1e-9)


# Composites and ranks


@pytest.mark.parametrize("kind", ["Triangles", "Curved Triangles"])
def test_blocks_have_their_parts_of_one_mesh(grid, kind):
    half = grid.GetNumberOfCells() // 2
    halves = [part_of(grid, range(half)), part_of(grid, range(half, 2 * half))]
    add_point_array(halves[1], "only here", points_of(halves[1])[:, 0])
    whole = mesh_of(grid, kind)
    parts = mesh_of(multiblock(*halves, names=("left", "right")), kind)
    assert parts.IsA("vtkMultiBlockDataSet")
    leaves = [leaf for _, _, leaf in leaves_of(parts)]
    assert sum(leaf.GetNumberOfCells() for leaf in leaves) == whole.GetNumberOfCells()
    assert "only here" in array_names(leaves[1].GetPointData()) - array_names(leaves[0].GetPointData())
    places = [set(map(bytes, points_of(leaf))) for leaf in leaves]
    assert places[0] & places[1] and places[0] | places[1] == set(map(bytes, points_of(whole)))
    for half, leaf in zip(halves, leaves):
        assert 0 <= array_of(leaf, "Cell_Id").min() and array_of(leaf, "Cell_Id").max() < half.GetNumberOfCells()
        assert np.abs(array_of(leaf, "velocity") - (points_of(leaf) - CENTER)).max() < 1e-9
        assert (array_of(leaf, "number", "cell") >= 0).all()
    # Where the other block has no such array, the value of a point of the same triangle does.
    shift = np.abs(array_of(leaves[1], "only here") - points_of(leaves[1])[:, 0])
    assert shift.max() < 2 * SPACING and (shift < 1e-9).mean() > 0.5


# ParaView's display, filters and files


def shown_as(source):
    view = simple.CreateView("RenderView")
    kind = simple.Show(source, view).Representation
    simple.Delete(view)
    return kind


def test_meshes_are_shown_as_surfaces(grid):
    expected = {"Particles": "Surface Splats", "Triangles": "Surface", "Curved Triangles": "Surface"}
    assert {kind: shown_as(mesh_proxy(grid, kind)) for kind in KINDS} == expected
    assert shown_as(simple.Clip(Input=mesh_proxy(grid, "Triangles"))) == "Surface"


def test_a_slice_through_a_mesh_is_a_circle(grid):
    cut = simple.Slice(Input=mesh_proxy(grid, "Triangles"))
    cut.SliceType.Origin, cut.SliceType.Normal = [2.0, 2.0, 2.5], [0.0, 0.0, 1.0]
    length = array_of(output_of(simple.IntegrateVariables(Input=cut)), "Length", "cell")[0]
    assert length == pytest.approx(2 * np.pi * np.sqrt(RADIUS**2 - 0.25), rel=2e-3)


def test_a_clipped_mesh_has_half_of_the_area(grid):
    half = simple.Clip(Input=mesh_proxy(grid, "Triangles"))
    half.ClipType.Origin, half.ClipType.Normal = [2.0, 2.0, 2.0], [1.0, 0.0, 0.0]
    area = array_of(output_of(simple.IntegrateVariables(Input=half)), "Area", "cell")[0]
    assert area == pytest.approx(AREA / 2, rel=1e-2)


def test_components_are_told_apart(grid):
    values = [-1.0, -(RADIUS**2)]
    both = support.make_filter(grid, "u", values, OutputType="Triangles", Spacing=SPACING)[0]
    regions = array_of(output_of(simple.Connectivity(Input=both)), "RegionId")
    assert set(regions) == {0, 1}


@pytest.mark.parametrize("extension", ["stl", "ply", "obj", "vtp", "vtk"])
def test_meshes_survive_files(grid, extension, tmp_path, capfd):
    proxy = mesh_proxy(grid, "Triangles")
    mesh = output_of(proxy)
    path = str(tmp_path / f"mesh.{extension}")
    simple.SaveData(path, proxy=proxy, **(support.READABLE if extension == "vtp" else {}))
    assert "WARN" not in "".join(capfd.readouterr())
    back = output_of(simple.OpenDataFile(path))
    assert back.GetNumberOfCells() == mesh.GetNumberOfCells()
    assert open_edges_of(cleaned(back)) == 0
    assert np.abs(np.sort(points_of(cleaned(back)), axis=0) - np.sort(points_of(mesh), axis=0)).max() < 1e-5
    if extension in ("vtp", "vtk"):
        assert array_names(mesh.GetPointData()) <= array_names(back.GetPointData()) | {"vtkOriginalCellIds"}


def test_curved_meshes_survive_files(grid, tmp_path):
    proxy = mesh_proxy(grid, "Curved Triangles", Order=3)
    mesh = output_of(proxy)
    path = str(tmp_path / "mesh.vtu")
    simple.SaveData(path, proxy=proxy, **support.READABLE)
    back = output_of(simple.OpenDataFile(path))
    assert points_of(back).tobytes() == points_of(mesh).tobytes()
    assert (corners_of(back) == corners_of(mesh)).all()
    assert back.GetCellType(0) == VTK_LAGRANGE_TRIANGLE


def test_scenes_have_triangles(grid, tmp_path, capfd):
    view = simple.CreateView("RenderView")
    simple.Show(mesh_proxy(grid, "Triangles"), view)
    simple.Render(view)
    path = tmp_path / "scene.gltf"
    simple.ExportView(str(path), view=view)
    assert "WARN" not in "".join(capfd.readouterr())
    assert '"mode":4' in path.read_text().replace(" ", "")
