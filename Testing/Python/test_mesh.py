"""Triangles and curved triangles: closed, on the surface, and at home in ParaView's other filters and files."""

import os
import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
import support
from cells import bend, ids_of, set_points, straight_grid
from paraview import simple
from paraview.vtk.util.numpy_support import vtk_to_numpy
from pictures import background_share, read_png
from support import add_cell_array, add_point_array, array_names, array_of, leaves_of, output_of, points_of
from test_blocks import multiblock
from vtkmodules.vtkCommonCore import reference
from vtkmodules.vtkCommonDataModel import VTK_LAGRANGE_TRIANGLE
from vtkmodules.vtkFiltersCore import vtkAppendFilter, vtkCleanPolyData, vtkExtractCells, vtkFeatureEdges

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


def mesh_of(grid, kind, isovalues=-RADIUS**2, **properties):
    return support.run_quietly(grid, "u", isovalues, OutputType=kind, **{"Spacing": SPACING, **properties})


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
    for name in ("MeshOpenLoops", "MeshUnusedParticles", "MeshTurnedTriangles", "MeshStraightNodes"):
        assert support.reported(mesh, name) == 0
    assert support.reported(mesh, "MeshOpenLength") == 0.0


@pytest.mark.parametrize("file, array, value, components", [
    ("mfem_hex1_p8.vtu", "u", 0.2, 1),
    ("mfem_amr_hanging_hex_p3.vtu", "u", 0.01, 1),
    ("ngsolve_cylinder_ns_tet_p3.vtu", "pressure", 0.507, 2),
    ("ngsolve_cylinder_ns_tet_p3.vtu", "pressure", 0.2, 2),  # creases meet beside corners of the mesh
    ("dolfinx_tet_p3.vtu", "u", -0.6689, 2),  # ends at sharp edges of the mesh
])
def test_topology_is_proven(data, plugin, file, array, value, components):
    mesh = support.run_quietly(support.read(data(file)), array, value, OutputType="Triangles")
    assert support.reported(mesh, "TopologyProven") == 1
    assert support.reported(mesh, "MeshComponents") == components
    assert support.reported(mesh, "ComponentsUnproven") == 0
    assert support.reported(mesh, "MeshOpenLoops") == support.reported(mesh, "MeshUnusedParticles") == 0


def test_a_mesh_with_creases_has_a_given_number_of_points(data, plugin):
    # Those of the two sides of a crease are one.
    number = 2000
    grid = support.read(data("ngsolve_cylinder_ns_tet_p3.vtu"))
    mesh = support.run_quietly(grid, "pressure", 0.6, OutputType="Triangles", NumberOfParticles=number)
    assert mesh.GetNumberOfPoints() == number
    assert support.reported(mesh, "MeshOpenLoops") == support.reported(mesh, "MeshUnusedParticles") == 0
    assert support.reported(mesh, "TopologyProven") == 1


@pytest.mark.parametrize("file, array, value", [
    # Strips of surface that end in tips, narrower than the spacing.
    ("mfem_hex1_p8.vtu", "u", 0.13626864788926252),
    ("mfem_torus_wedge_p4.vtu", "f", -0.241909),
    ("mfem_torus_wedge_p4.vtu", "radius", 1.3272727),
    # Boundary curves along a reentrant edge with hanging nodes.
    ("mfem_amr_hanging_hex_p3.vtu", "u", 0.27358236626267485),
    ("mfem_amr_hanging_hex_p3.vtu", "u", 0.818394996659306),
    # Jumps that fade, with sides that reach over each other.
    ("mfem_dg_advection_0.vtu", "rho", 0.0902468),
    ("mfem_dg_advection_0.vtu", "rho", 0.361018),
    ("mfem_dg_advection_2.vtu", "rho", 0.2404164),
    # Sides that reach over each other so far that no triangle between them suits its corners.
    ("mfem_dg_advection_4.vtu", "rho", 0.0563662),
    # Saddles of the field on outer faces, at which boundary curves all but cross.
    ("mfem_torus_wedge_p4.vtu", "radius", 0.8),
    # Boundary curves that touch in a particle.
    ("mfem_dg_advection_0.vtu", "rho", 0.53777069),
    ("mfem_dg_advection_2.vtu", "rho", 0.3),
    # A component smaller than a spacing.
    ("ngsolve_cylinder_ns_tet_p3.vtu", "pressure", 0.22765081),
    # A crease that turns back beside another part of itself; a closed crease; a corner beside another particle.
    ("dolfinx_tet_p3.vtu", "u", 0.11485),
    ("dolfinx_tet_p3.vtu", "u", -0.10525738),
    ("dolfinx_tet_p3.vtu", "u", 0.28722799),
    # Strips along a wall, narrower than particles can tell.
    ("mfem_cylinder_hex_prism_p3.vtu", "pressure", -0.507506735),
])
def test_all_open_edges_are_boundary_curves(data, plugin, file, array, value):
    assert_closed(support.run(support.read(data(file)), array, value, OutputType="Triangles")[0])


@pytest.mark.parametrize("value, seed", [
    (2.5949207e-08, 1),  # a boundary curve that passes a corner between two cells, and was traced twice there
    (-1.72853781e-08, 1),  # a particle inside the surface beside a boundary curve
    (-1.72853781e-08, 2),
])
def test_boundaries_of_a_plate_of_some_particles_are_closed(data, plugin, value, seed):
    grid = support.read(data("vtkdata_notch_quadratic_hex20_wedge15.vtu"))
    assert_closed(support.run_quietly(grid, "Nodal Displacement", value, Component=1, OutputType="Triangles", Seed=seed))


@pytest.mark.parametrize("file", sorted(path.name for path in Path(os.environ["HOP_DATA"]).glob("*.*vtu")))
def test_surfaces_that_the_panel_chooses_are_closed(data, plugin, file):
    proxy = simple.HighOrderParticleIsosurface(Input=support.read(data(file)), OutputType="Triangles")
    mesh = output_of(proxy)
    simple.Delete(proxy)
    assert_closed(mesh, least_triangles=100)


def assert_closed(mesh, least_triangles=900):
    assert mesh.GetNumberOfCells() > least_triangles
    assert support.reported(mesh, "MeshOpenLoops") == support.reported(mesh, "MeshUnusedParticles") == 0
    edges = np.sort(corners_of(mesh)[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    assert np.unique(edges, axis=0, return_counts=True)[1].max() == 2


@dataclass(frozen=True)
class SolverSurface:
    """An isosurface of a continuous field in a solver's file."""

    file: str
    array: str
    isovalue: float
    # Of its triangles at a quarter of the default spacing, world units squared (mesh_table finer=4).
    area: float
    component: int = None
    # Largest relative error of the area.
    error: float = 2e-3
    # Median of the smallest angles away from edges, degrees.
    median: float = 50
    # Folds above so many degrees count as creases.
    crease: float = 10

    def __str__(self):
        return f"{self.file.split('.')[0]}-{self.array}"


SOLVER_SURFACES = [
    SolverSurface("mfem_hex1_p8.vtu", "u", 0.2, 1.7362),
    SolverSurface("mfem_torus_wedge_p4.vtu", "f", 0.3, 1.46398),
    SolverSurface("mfem_cylinder_hex_prism_p3.vtu", "phi", 0.3, 21.1824),
    SolverSurface("mfem_amr_hanging_hex_p3.vtu", "u", 0.0, 4.20138),
    SolverSurface("dolfinx_tet_p3.vtu", "u", 0.5, 3.21145),
    SolverSurface("dealii_shell_p3_00.pvtu", "u", 0.4, 5.64913),
    # Creases are little farther apart than particles: next to lesser ones 1% of the angles are below 19 degrees.
    SolverSurface("ngsolve_cylinder_ns_tet_p3.vtu", "pressure", 0.6, 0.10648, crease=6),
    SolverSurface("ngsolve_cylinder_ns_tet_p3.vtu", "velocity", 0.1, 2.02304, component=0),
    SolverSurface("yeti_pipe_bezier_rational_p333.vtu", "disp", -1e-4, 5.40986, component=0),
    SolverSurface("yeti_pipe_bezier_rational_p423.vtu", "disp", -1e-4, 5.39307, component=0),
    SolverSurface("vtkdata_pyramid_quadratic.vtu", "Polynomial", 4.01, 7.46918),
    # A plate 2.5 spacings thick: 52 triangles are away from edges. The area is the limit of those at 1/8 and 1/16 of the
    # spacing.
    SolverSurface("vtkdata_notch_quadratic_hex20_wedge15.vtu", "Nodal Displacement", 1.68e-6, 3.6463e-4, component=0,
                  error=4e-3, median=48),
]


def smallest_angles(mesh):
    """Of each triangle, degrees."""
    corners = points_of(mesh)[corners_of(mesh)]
    sides = np.roll(corners, -1, axis=1) - corners
    sides /= np.linalg.norm(sides, axis=2, keepdims=True)
    return np.degrees(np.arccos(-np.einsum("tix,tix->ti", sides, np.roll(sides, 1, axis=1)).clip(-1, 1))).min(axis=1)


def away_from_edges(mesh, angle):
    """Whether a triangle has no corner where the surface ends, or folds by more than an angle, degrees."""
    edges = vtkFeatureEdges()
    edges.SetInputData(mesh)
    edges.SetFeatureAngle(angle)
    edges.Update()
    at_edges = set(map(bytes, points_of(edges.GetOutput())))
    apart = np.array([bytes(point) not in at_edges for point in points_of(mesh)])
    return apart[corners_of(mesh)].all(axis=1)


@pytest.mark.parametrize("case", SOLVER_SURFACES, ids=str)
def test_meshes_of_solvers_are_closed_well_shaped_and_of_the_right_area(data, plugin, case):
    component = {} if case.component is None else {"Component": case.component}
    mesh = support.run_quietly(support.read(data(case.file)), case.array, case.isovalue, OutputType="Triangles", **component)
    assert support.reported(mesh, "MeshOpenLoops") == support.reported(mesh, "MeshUnusedParticles") == 0
    a, b, c = np.moveaxis(points_of(mesh)[corners_of(mesh)], 1, 0)
    assert np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2 == pytest.approx(case.area, rel=case.error)
    assert array_of(mesh, "Area").sum() == pytest.approx(case.area, rel=case.error)
    angles = smallest_angles(mesh)[away_from_edges(mesh, case.crease)]
    assert np.median(angles) >= case.median and np.quantile(angles, 0.01) >= 30


# Fields of the unit cube that are zero in nodes, and on whole edges of elements; whether the surface is closed.
THROUGH_NODES = {
    "a sphere": (lambda x: np.linalg.norm(x - 0.5, axis=1) - 0.25, True),
    "a cylinder": (lambda x: np.hypot(x[:, 0] - 0.5, x[:, 1] - 0.5) - 0.25, False),
    "an octahedron": (lambda x: np.abs(x - 0.5).sum(axis=1) - 0.5, True),
    "a diagonal plane": (lambda x: x[:, 0] - x[:, 1], False),
    "a plane through three edges": (lambda x: x[:, 0] + x[:, 1] - x[:, 2], False),
    "a parabola": (lambda x: x[:, 0] ** 2 - x[:, 1], False),
    "a torus": (lambda x: np.hypot(np.hypot(x[:, 0] - 0.5, x[:, 1] - 0.5) - 0.25, x[:, 2] - 0.5) - 0.125, True),
    "waves": (lambda x: x[:, 2] - 0.5 - 0.25 * np.sin(2 * np.pi * x[:, 0]) * np.sin(2 * np.pi * x[:, 1]), False),
}


@pytest.mark.parametrize("spacing", [0.02, 0.1])
@pytest.mark.parametrize("surface", THROUGH_NODES)
@pytest.mark.parametrize("name, order, blocks", [
    ("TETRA", None, 8), ("HEXAHEDRON", None, 8), ("LAGRANGE_TETRAHEDRON", 2, 4), ("LAGRANGE_WEDGE", 2, 4),
])  # fmt: skip
def test_surfaces_through_nodes_and_edges_are_closed(plugin, name, order, blocks, surface, spacing):
    """Boundary curves and creases along edges of the mesh are undecided: the field is lifted there, and particles are put
    back. Spacings of an element want a larger lift."""
    field, is_closed = THROUGH_NODES[surface]
    grid = straight_grid(name, order=order, blocks=blocks)
    x = points_of(grid) / blocks
    set_points(grid, x)
    add_point_array(grid, "u", field(x))
    mesh, messages = support.run(grid, "u", 0.0, OutputType="Triangles", Spacing=spacing)
    assert not any("holes" in text or "corners of no triangle" in text for text in messages.warnings)
    assert (support.reported(mesh, "MeshOpenLoops"), support.reported(mesh, "MeshUnusedParticles")) == (0, 0)
    assert array_of(mesh, "Residual").max() < 1e-9
    points, ends = points_of(mesh), edges_with_one_triangle(mesh)
    # Where the surface ends in an edge of the domain, a particle may stand beside it.
    on_faces = np.minimum(np.abs(points), np.abs(points - 1.0)) < 0.05 * spacing
    assert (on_faces[ends[:, 0]] & on_faces[ends[:, 1]]).any(axis=1).all()
    assert (len(ends) == 0) == is_closed
    assert smallest_angles(mesh).min() > 1.0
    assert open_edges_of(cleaned(mesh)) == len(ends)
    a, b, c = np.moveaxis(points[corners_of(mesh)], 1, 0)
    assert array_of(mesh, "Area").sum() == pytest.approx(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2, rel=0.02)


def test_a_gyroid_through_the_corners_of_elements_is_proven(plugin):
    # Along edges that bend the field Newton's method goes beyond the corner that has the isovalue.
    grid = straight_grid("LAGRANGE_TETRAHEDRON", order=2, blocks=8)
    angles = 4 * np.pi * points_of(grid) / 8
    add_point_array(grid, "u", (np.sin(angles) * np.cos(angles[:, [1, 2, 0]])).sum(axis=1))
    mesh = support.run(grid, "u", 0.0, OutputType="Triangles", Spacing=0.32)[0]
    assert_closed(mesh)
    assert support.reported(mesh, "TopologyProven") == 1


@pytest.mark.parametrize("file, array, component, value, spacing", [
    ("vtkdata_pyramid_quadratic.vtu", "Polynomial", 0, 4.0, 0.02),
    ("vtkdata_pyramid_quadratic.vtu", "DistanceToCenter", 0, 0.75**0.5, 0.02),
    ("vtkdata_notch_quadratic_hex20_wedge15.vtu", "Nodal Displacement", 1, 0.0, None),
    ("mfem_torus_wedge_p4.vtu", "radius", 0, 0.8, None),
])  # fmt: skip
def test_meshes_at_critical_values_are_closed(data, plugin, file, array, component, value, spacing):
    """Where the topology of the surface changes, the mesh is that of a value beside it, put back."""
    chosen = {"Spacing": spacing} if spacing else {}
    mesh, _ = support.run(
        support.read(data(file)), array, value, Component=component, OutputType="Triangles", **chosen)
    assert (support.reported(mesh, "MeshOpenLoops"), support.reported(mesh, "MeshUnusedParticles")) == (0, 0)
    assert support.reported(mesh, "MeshTurnedTriangles") == 0
    assert array_of(mesh, "Residual").max() < 1e-9 * support.diagonal(mesh)
    edges_with_one_triangle(mesh)


CROSSING = {
    "planes": lambda x: (x[:, 0] - 0.5) * (x[:, 1] - 0.5),
    "the tips of a cone": lambda x: (x[:, 0] - 0.5) ** 2 + (x[:, 1] - 0.5) ** 2 - (x[:, 2] - 0.5) ** 2,
    "a cube": lambda x: np.abs(x - 0.5).max(axis=1) - 0.25,
}


@pytest.mark.parametrize("surface", CROSSING)
@pytest.mark.parametrize("name", ["LAGRANGE_TETRAHEDRON", "LAGRANGE_WEDGE"])
def test_sheets_that_cross_are_closed_apart(plugin, name, surface):
    grid = straight_grid(name, order=2, blocks=4)
    x = points_of(grid) / 4
    set_points(grid, x)
    add_point_array(grid, "u", CROSSING[surface](x))
    mesh, _ = support.run(grid, "u", 0.0, OutputType="Triangles", Spacing=0.02)
    assert (support.reported(mesh, "MeshOpenLoops"), support.reported(mesh, "MeshUnusedParticles")) == (0, 0)
    assert np.abs(CROSSING[surface](points_of(mesh))).max() < 1e-6
    edges_with_one_triangle(mesh)


@pytest.mark.parametrize("place", [0.0, 0.5])
def test_a_field_that_touches_the_isovalue_gets_no_second_sheet(plugin, place):
    """In faces of elements, at the end of the domain and inside."""
    grid = straight_grid("TETRA", blocks=8)
    add_point_array(grid, "u", -((points_of(grid)[:, 2] / 8 - place) ** 2))
    particles, mesh = (support.run(grid, "u", 0.0, OutputType=kind)[0] for kind in ("Particles", "Triangles"))
    assert 0 < mesh.GetNumberOfPoints() < 1.5 * particles.GetNumberOfPoints()


def edges_with_one_triangle(mesh):
    """Pairs of points."""
    triangles = corners_of(mesh)
    edges = np.sort(np.concatenate([triangles[:, [i, (i + 1) % 3]] for i in range(3)]), axis=1)
    unique, counts = np.unique(edges, axis=0, return_counts=True)
    assert counts.max() <= 2
    return unique[counts == 1]


JUMPING = {
    "sphere": (lambda x: np.linalg.norm(x, axis=1), 0.71),
    "gyroid": (lambda x: sum(np.sin(3 * x[:, i]) * np.cos(3 * x[:, (i + 1) % 3]) for i in range(3)), 0.13),
    "wave": (lambda x: x[:, 2] + 0.05 * np.sin(3 * x[:, 0]), 0.24),
}


def with_jumps(cell, function, size, seed):
    """A grid of cells without a node in common, each with a constant of its own beside the function, and some noise."""
    whole = straight_grid(f"LAGRANGE_{cell}", order=3, blocks=4)
    lower, upper = (np.array(corner) for corner in support.bounds_of(whole))
    set_points(whole, 2.0 * (points_of(whole) - lower) / (upper - lower) - 1.0)
    whole = bend(whole, 0.03)
    add_point_array(whole, "u", points_of(whole))
    join = vtkAppendFilter()
    for i in range(whole.GetNumberOfCells()):
        join.AddInputData(support.cells_of(whole, [i]))
    join.Update()
    grid = join.GetOutput()
    values = function(points_of(grid))
    dice = np.random.default_rng(seed)
    for i in range(grid.GetNumberOfCells()):
        nodes = ids_of(grid, i)
        values[nodes] += 0.3 * size * dice.normal(size=len(nodes)) + size * dice.normal()
    add_point_array(grid, "v", values)
    return grid


@pytest.mark.parametrize("cell, surface, seed", [
    ("WEDGE", "gyroid", 1), ("WEDGE", "gyroid", 4), ("WEDGE", "wave", 2),
    ("TETRAHEDRON", "sphere", 1), ("TETRAHEDRON", "sphere", 7), ("TETRAHEDRON", "sphere", 8),
    ("TETRAHEDRON", "sphere", 2), ("TETRAHEDRON", "sphere", 12), ("TETRAHEDRON", "gyroid", 7), ("TETRAHEDRON", "gyroid", 8),
])
def test_pieces_of_a_field_that_jumps_everywhere_are_closed(plugin, cell, surface, seed):
    """By some tenths of the spacing: at some faces the surface goes on, at others it ends, and curves pass both."""
    function, isovalue = JUMPING[surface]
    grid = with_jumps(cell, function, 0.03, seed)
    mesh = support.run(grid, "v", isovalue, OutputType="Triangles", Spacing=0.06)[0]
    assert mesh.GetNumberOfCells() > 1000
    assert support.reported(mesh, "MeshOpenLoops") == 0


@pytest.mark.parametrize("size, seed", [(0.002, 3), (0.002, 11), (0.005, 2), (0.005, 16)])
def test_facets_with_small_jumps_are_closed(plugin, size, seed):
    """By less than 0.2 spacings, which the surface passes; but its two sides at a crease are in different places."""
    function, isovalue = JUMPING["gyroid"]
    mesh = support.run(with_jumps("TETRAHEDRON", function, size, seed), "v", isovalue, OutputType="Triangles",
                       Spacing=0.06)[0]
    assert mesh.GetNumberOfCells() > 10000
    assert support.reported(mesh, "MeshOpenLoops") == 0
    assert support.reported(mesh, "MeshUnusedParticles") == 0


def test_sharp_bends_of_a_small_mesh_are_closed(plugin):
    """Two sheets that all but cross bend within a hundredth of the spacing: most particles of the first mesh are at
    faults, but there are few."""
    grid = straight_grid("LAGRANGE_HEXAHEDRON", order=2)
    x = points_of(grid)
    add_point_array(grid, "v", (2.0 * x[:, 0] - 1.0) * (2.0 * x[:, 2] - 1.0))
    mesh = support.run(grid, "v", 3e-6, OutputType="Triangles", Spacing=0.15)[0]
    assert_closed(mesh)
    assert support.reported(mesh, "TopologyProven") == 1
    assert list(components_of(mesh)["Proven"]) == [1, 1]


@pytest.mark.parametrize("spacing", [0.02, 0.01])
def test_singular_surfaces_are_closed(data, plugin, spacing):
    """Cones meet in corners of the cells, where pyramids have their apexes: the mesh is that of a value beside, whose
    particles come as far as to the apexes, and at the smaller spacing are closer to each other than that is long."""
    grid = support.read(data("vtkdata_pyramid_quadratic.vtu"))
    middle = np.mean(grid.PointData["DistanceToCenter"].GetRange(0))
    mesh = support.run(grid, "DistanceToCenter", middle, OutputType="Triangles", Spacing=spacing)[0]
    assert support.reported(mesh, "SingularPoints") > 0
    assert_closed(mesh)
    assert support.reported(mesh, "TopologyProven") == 1


def test_topology_of_a_field_with_jumps_is_not_proven(data, plugin):
    grid = support.read(data("mfem_dg_advection_0.vtu"))
    mesh = support.make_filter(grid, "rho", 0.293, OutputType="Triangles")[0]
    mesh.UpdatePipeline()
    report = support.output_of(mesh)
    assert support.reported(report, "TopologyProven") == 0
    assert support.reported(report, "ComponentsUnproven") > 0


@pytest.mark.parametrize("value, components", [(1.75, 13), (2.75, 13), (3.75, 5), (4.75, 1)])
def test_components_of_a_singular_surface_are_named(data, plugin, value, components):
    """Extremes on edges of the cells, or a tangency: the mesh is closed, but nothing is proven."""
    grid = support.read(data("vtkdata_pyramid_quadratic.vtu"))
    mesh = support.run(grid, "Polynomial", value, OutputType="Triangles")[0]
    assert_closed(mesh)
    assert support.reported(mesh, "TopologyProven") == 0
    assert support.reported(mesh, "ComponentsUnproven") == components
    parts = components_of(mesh)
    assert list(parts["Proven"]) == [0] * components
    assert len(np.unique(parts["Point"], axis=0)) == components
    apart = np.linalg.norm(points_of(mesh)[:, None] - parts["Point"], axis=2).min(axis=0)
    assert apart.max() < 0.02  # each names a place on the surface


def components_of(mesh):
    """The arrays with one entry a component, by the rest of their names."""
    fields = mesh.GetFieldData()
    names = [name for name in map(fields.GetArrayName, range(fields.GetNumberOfArrays())) if name.startswith("Component")]
    return {name[len("Component"):]: vtk_to_numpy(fields.GetArray(name)) for name in names if name != "ComponentsUnproven"}


def test_components_are_listed(grid):
    values = [-0.25, -(RADIUS**2)]
    parts = components_of(mesh_of(grid, "Triangles", Spacing=0.1, isovalues=values))
    assert list(parts["Isovalue"]) == values
    assert (parts["EulerCharacteristic"] == 2).all() and (parts["BoundaryLoops"] == 0).all()
    # A corner of the middle cells is the center of both spheres, and the surface passes no corner.
    assert list(parts["Proven"]) == [1, 1]
    for cell, point, value in zip(parts["CellId"], parts["Point"], values):
        lower, upper = np.reshape(grid.GetCell(cell).GetBounds(), (3, 2)).T
        assert (point >= lower - 1e-9).all() and (point <= upper + 1e-9).all()
        assert np.linalg.norm(point - CENTER) == pytest.approx(np.sqrt(-value), abs=1e-9)


def test_particles_have_no_list_of_components(grid):
    assert components_of(mesh_of(grid, "Particles")) == {}


def small_facets(place, blocks, field):
    """Linear tetrahedra of a field that bends within them: facets smaller than a spacing between sharp creases."""
    grid = straight_grid("TETRA", blocks=blocks)
    lower, upper = support.bounds_of(grid)
    set_points(grid, place((points_of(grid) - lower) / (upper - lower)))
    x = points_of(grid)
    x = (x - x.min(0)) / np.ptp(x, axis=0).max()
    add_point_array(grid, "u", field(x))
    return grid


def front(x):
    return np.tanh(8.0 * (x[:, 0] - 0.5 + 0.2 * np.sin(4.0 * x[:, 1]) * np.cos(4.0 * x[:, 2]))) + 0.2 * x[:, 2]


def crossing_waves(x):
    sines = np.sin(5.0 * x)
    return sines[:, 0] * sines[:, 1] + sines[:, 1] * sines[:, 2] + np.cos(4.0 * x[:, 0]) * x[:, 2]


SMALL_FACETS = {
    "edges shared by sheets":
        (lambda x: x * [1.0, 0.14826285, 0.46106801] + 0.2 * np.sin(3.0 * x[:, [0]]) * [0, 1, 0], 4, front, 0.703009),
    "edges without length":
        (lambda x: x + 0.06 * np.sin(2.0 * np.pi * x[:, [1, 2, 0]] * [0.81173921, 0.89183585, 0.47769017] +
                                     [1.5430688, 4.29223756, 3.67198381]), 3, crossing_waves, -0.521295),
}


@pytest.mark.parametrize("case, factor", [("edges shared by sheets", 1.0), ("edges without length", 1.0),
                                          ("edges without length", 2.0)])
def test_meshes_of_facets_smaller_than_a_spacing_are_closed(case, factor):
    place, blocks, field, isovalue = SMALL_FACETS[case]
    grid = small_facets(place, blocks, field)
    proxy, messages = support.make_filter(grid, "u", isovalue, OutputType="Triangles", PassDiagnostics=1)
    proxy.Spacing *= factor
    proxy.UpdatePipeline()
    mesh = support.output_of(proxy)
    assert support.reported(mesh, "MeshOpenLoops") == support.reported(mesh, "MeshUnusedParticles") == 0
    assert not messages.warnings


def test_triangles_that_close_holes_turned_away_are_told(data, plugin):
    # The surface bends by more than a right angle within such a spacing.
    mesh, messages = support.run(
        support.read(data("dolfinx_tet_p3.vtu")), "u", 0.1, Spacing=0.1, OutputType="Triangles")
    turned = support.reported(mesh, "MeshTurnedTriangles")
    assert turned > 0
    assert f"{turned} triangles are turned away from the surface at a corner" in messages.warnings[0]


def test_a_warning_says_where_the_mesh_has_a_hole(data, plugin):
    """Far too few particles for such a surface."""
    grid = output_of(support.read(data("dolfinx_tet_p3.vtu")))
    mesh, messages = support.run(grid, "u", 0.1, OutputType="Triangles", NumberOfParticles=600)
    assert support.reported(mesh, "MeshOpenLoops") > 0
    text = next(text for text in messages.warnings if "the longest" in text)
    cell, *place = re.search(r"the longest, \S+, in cell (\d+), at \((\S+), (\S+), (\S+)\)", text).groups()
    apart = points_of(mesh) - np.array(place, dtype=float)
    nearest = np.linalg.norm(apart, axis=1).argmin()
    assert np.linalg.norm(apart[nearest]) < 1e-4
    assert array_of(mesh, "Cell_Id")[np.linalg.norm(apart, axis=1) < 1e-4].tolist().count(int(cell)) > 0
    parts = components_of(mesh)
    assert (parts["Proven"] == 0).sum() == support.reported(mesh, "ComponentsUnproven")
    first = parts["CellId"][parts["Proven"] == 0][0]
    assert f"the first passes a point in cell {first}, at" in text


def test_particles_without_a_triangle_are_told(grid):
    mesh, messages = support.run(grid, "u", -RADIUS**2, OutputType="Triangles", NumberOfParticles=1)
    assert mesh.GetNumberOfPoints() == 0 and support.reported(mesh, "MeshUnusedParticles") == 1
    assert any("1 particles are corners of no triangle" in text for text in messages.warnings)


def test_points_on_creases_carry_the_normals_of_both_sides(data, plugin):
    """For splats: a point has one normal, the mean."""
    creased = support.run_quietly(support.read(data("dolfinx_tet_p3.vtu")), "u", 0.5, OutputType="Triangles")
    columns = array_of(creased, "__vtkValidMask__Creases")
    sides = columns[:, :6].reshape(-1, 2, 3)
    on_crease = (sides != 0).any(axis=(1, 2))
    assert 0.05 < on_crease.mean() < 0.5 and (columns[~on_crease] == 0).all()
    np.testing.assert_allclose(np.linalg.norm(sides[on_crease], axis=2), 1, rtol=1e-6)
    mean = sides[on_crease].sum(axis=1)
    mean /= np.linalg.norm(mean, axis=1, keepdims=True)
    # Of more than two sides where creases meet.
    agrees = np.abs(mean - array_of(creased, "Normals")[on_crease]).max(axis=1) < 1e-5
    assert agrees.mean() > 0.9
    angles = np.degrees(np.arccos(np.clip((sides[on_crease][:, 0] * sides[on_crease][:, 1]).sum(axis=1), -1, 1)))
    assert np.median(angles) > 10 and angles.max() < 180
    smooth = support.run_quietly(support.read(data("mfem_hex1_p8.vtu")), "u", 0.2, OutputType="Triangles")
    assert not smooth.GetPointData().HasArray("__vtkValidMask__Creases")


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


def flux_of(mesh):
    """The integral of velocity . normal over the cells, by their own shape functions."""
    cells = mesh.GetPolys() if mesh.IsA("vtkPolyData") else mesh.GetCells()
    nodes = vtk_to_numpy(cells.GetConnectivityArray()).reshape(mesh.GetNumberOfCells(), -1)
    cell, count = mesh.GetCell(0), nodes.shape[1]
    row, slopes, flux = [0.0] * count, [0.0] * (2 * count), 0.0
    # Gauss points of a square, folded into the triangle: exact to degree 10.
    points, weights = np.polynomial.legendre.leggauss(6)
    for r, wr in zip((points + 1) / 2, weights / 2):
        for q, wq in zip((points + 1) / 2, weights / 2):
            place = [r, (1 - r) * q, 0.0]
            cell.InterpolateFunctions(place, row)
            cell.InterpolateDerivs(place, slopes)
            velocity = np.einsum("n,cnx->cx", row, array_of(mesh, "velocity")[nodes])
            across, along = (np.einsum("n,cnx->cx", slopes[i * count:(i + 1) * count], points_of(mesh)[nodes]) for i in (0, 1))
            flux += wr * wq * (1 - r) * np.einsum("cx,cx->", velocity, np.cross(across, along))
    return flux


@pytest.mark.parametrize("order, rate", [(1, 2), (2, 3), (3, 4), (4, 5)])
def test_flux_converges_at_the_order_of_the_mesh(grid, order, rate):
    kind = "Triangles" if order == 1 else "Curved Triangles"
    errors = [abs(flux_of(mesh_of(grid, kind, Spacing=spacing, AngularDensity=0, Order=max(2, order))) - FLUX)
              for spacing in (3 * SPACING, 1.5 * SPACING)]
    # Meshes are no refinements of each other: a little below the rate.
    assert errors[0] > 2 ** (rate - 0.4) * errors[1] > 0
    assert errors[1] < [0.03, 1e-3, 3e-4, 1e-5][order - 1] * FLUX


def test_the_same_for_any_number_of_threads(grid):
    for kind in ("Triangles", "Curved Triangles"):
        results = []
        for threads in (1, 2):
            with support.threads(threads):
                mesh = mesh_of(grid, kind)
            results.append((support.contents(mesh), corners_of(mesh).tobytes()))
        assert results[0] == results[1]


def test_a_warm_start_has_a_mesh_too(grid):
    proxy = mesh_proxy(grid, "Triangles")
    output_of(proxy)
    proxy.Isosurfaces = [-(RADIUS * 0.98) ** 2]
    moved = output_of(proxy)
    assert open_edges_of(moved) == 0
    assert np.abs(np.linalg.norm(points_of(moved) - CENTER, axis=1) - RADIUS * 0.98).max() < 1e-9


@pytest.mark.parametrize("warm", [0, 1])
def test_every_step_of_a_series_has_a_mesh_of_its_own(data, plugin, warm):
    series = simple.PVDReader(FileName=data("mfem_dg_advection.pvd"))
    series.UpdatePipelineInformation()
    proxy = support.make_filter(series, "rho", 0.3, OutputType="Triangles", Spacing=0.06, WarmStart=warm)[0]
    times = list(series.TimestepValues)
    for time, number in zip(times + times[:1], (0, 2, 4, 0)):
        proxy.UpdatePipeline(time)
        mesh = proxy.GetClientSideObject().GetOutputDataObject(0)
        assert corners_of(mesh).max() < mesh.GetNumberOfPoints() and mesh.GetNumberOfCells() > 600
        assert np.abs(array_of(mesh, "Residual")).max() < 1e-8
        if not warm:
            alone = support.run(support.read(data(f"mfem_dg_advection_{number}.vtu")), "rho", 0.3,
                                OutputType="Triangles", Spacing=0.06)[0]
            assert support.contents(mesh) == support.contents(alone)
            assert (corners_of(mesh) == corners_of(alone)).all()


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


@pytest.mark.parametrize("kind", ["Triangles", "Curved Triangles"])
def test_derived_fields_have_closed_meshes(grid, kind):
    # |grad u| is twice the distance from the middle.
    mesh = mesh_of(grid, kind, 2 * RADIUS, Quantity="Gradient Magnitude")
    assert np.abs(np.linalg.norm(points_of(mesh) - CENTER, axis=1) - RADIUS).max() < 1e-9
    corners = corners_of(mesh)
    assert len(corners) == 2 * (len(np.unique(corners)) - 2)
    assert support.reported(mesh, "MeshOpenLoops") == support.reported(mesh, "MeshUnusedParticles") == 0


@pytest.mark.parametrize("origin, normal", [
    ([2, 2, 2], [0, 0, 1]),  # in faces of elements
    ([2, 2, 1], [0, 0, 1]),
    ([2, 2, 2], [1, 1, 1]),  # through corners
])
def test_slices_in_faces_and_through_corners_are_proven(grid, origin, normal):
    cut = simple.HighOrderParticleSlice(Input=support.source_of(grid), OutputType="Triangles", Spacing=SPACING)
    cut.SliceType.Origin, cut.SliceType.Normal = origin, normal
    mesh = output_of(cut)
    assert support.reported(mesh, "TopologyProven") == 1
    parts = components_of(mesh)
    assert list(parts["EulerCharacteristic"]) == [1] and list(parts["BoundaryLoops"]) == [1]


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


@pytest.mark.parametrize("kind", ["Triangles", "Curved Triangles"])
def test_three_blocks_are_closed_together(grid, kind):
    count = grid.GetNumberOfCells()
    # Each block borders on both others.
    owners = [range(count // 2), range(count // 2, 3 * count // 4), range(3 * count // 4, count)]
    parts = mesh_of(multiblock(*[part_of(grid, cells) for cells in owners]), kind)
    append = vtkAppendFilter()
    append.MergePointsOn()
    for _, _, leaf in leaves_of(parts):
        assert leaf.GetNumberOfCells() > 0
        assert support.reported(leaf, "MeshOpenLoops") == 0
        assert list(components_of(leaf)["EulerCharacteristic"]) == [2]
        append.AddInputData(leaf)
    append.Update()
    whole = mesh_of(grid, kind)
    # Points on borders are in both blocks, the same to the last bit.
    assert append.GetOutput().GetNumberOfPoints() == whole.GetNumberOfPoints()
    edges = np.sort(corners_of(append.GetOutput())[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    assert (np.unique(edges, axis=0, return_counts=True)[1] == 2).all()


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


def test_feature_edges_are_where_the_surface_ends(grid):
    """The sphere through the middles of the outer faces would end there: one of radius 2.1 has six circles."""
    radius = 2.1
    proxy = support.make_filter(grid, "u", -radius**2, OutputType="Triangles", Spacing=SPACING)[0]
    edges = simple.FeatureEdges(Input=proxy, NonManifoldEdges=1, ManifoldEdges=0, FeatureEdges=0, BoundaryEdges=1)
    length = array_of(output_of(simple.IntegrateVariables(Input=edges)), "Length", "cell")[0]
    assert length == pytest.approx(6 * 2 * np.pi * np.sqrt(radius**2 - 4), rel=2e-2)
    parts = components_of(output_of(proxy))
    assert list(parts["EulerCharacteristic"]) == [-4] and list(parts["BoundaryLoops"]) == [6]


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


# Splats of a mesh


def splats_of(source, path):
    view = simple.CreateView("RenderView")
    view.ViewSize = [500, 400]
    view.OrientationAxesVisibility = 0
    shown = simple.Show(source, view)
    shown.SetRepresentationType("Surface Splats")
    shown.ColorArrayName = ["POINTS", ""]
    view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [3, -5, 2], [0, 0, 0], [0, 0, 1]
    simple.ResetCamera(view)
    simple.SaveScreenshot(str(path), view)
    simple.Delete(view)
    return read_png(path)


@pytest.mark.parametrize("file, array, value", [
    ("mfem_hex1_p8.vtu", "u", 0.2),
    ("mfem_dg_advection_2.vtu", "rho", 0.3),
    ("trixi_adv_sphere_hex_p3.vtu", "scalar", 1.28),
    ("dolfinx_tet_p3.vtu", "u", 0.5),
])
def test_splats_of_a_mesh_look_like_those_of_particles(data, plugin, tmp_path, file, array, value):
    reader = support.read(data(file))
    particles, mesh = (
        splats_of(support.make_filter(reader, array, value, OutputType=kind)[0], tmp_path / f"{kind}.png").astype(float)
        for kind in ("Particles", "Triangles"))
    assert background_share(particles.astype(int)) < 0.98
    error = ((particles - mesh) ** 2).mean()
    assert error == 0 or 10 * np.log10(255**2 / error) >= 50  # a mesh has points on creases, particles have none there
