"""Every 3-D cell type that VTK can hold, evaluated as what it is: particles on grids of each type and
order lie where VTK's own cell says, and there the cell's own field has the isovalue."""

import cells
import numpy as np
import pytest
import support
from paraview import simple
from paraview.vtk.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import (
    vtkCharArray, vtkDoubleArray, vtkFloatArray, vtkIdTypeArray, vtkIntArray, vtkLongArray, vtkLongLongArray,
    vtkShortArray, vtkSignedCharArray, vtkUnsignedCharArray, vtkUnsignedIntArray, vtkUnsignedLongArray,
    vtkUnsignedLongLongArray, vtkUnsignedShortArray,
)  # fmt: skip

TESTED = {}


@pytest.fixture(autouse=True)
def fresh_session():
    """Deletes only what a test made: ParaView aborts when its session is reset after each of so many tests."""
    yield
    for proxy in list(simple.GetSources().values()):
        simple.Delete(proxy)


@pytest.fixture(scope="module", autouse=True)
def table(request):
    """What was tested, printed at the end."""
    yield
    with request.config.pluginmanager.getplugin("capturemanager").global_and_fixture_disabled():
        print("\n\n| cell type | orders tested | particles |\n|---|---|---|")
        for name, runs in TESTED.items():
            print(f"| {name} | {', '.join(str(order) for order, _ in runs)} | {sum(count for _, count in runs)} |")


def wave(points):
    """A field without symmetry, from -1 to 1."""
    return np.sin(2.2 * points[:, 0] + 0.7) * np.cos(1.9 * points[:, 1]) + 0.5 * np.sin(2.6 * points[:, 2] - 1.0)


def with_wave(grid):
    support.add_point_array(grid, "f", wave(support.points_of(grid)))
    return grid


def middle_of(grid, name="f"):
    """An isovalue that differs from all nodal values."""
    values = support.array_of(grid, name)
    return 0.47 * values.min() + 0.53 * values.max()


def check(grid, label, order, isovalue=None, **properties):
    """Runs the filter and holds every particle against VTK's cells; returns the particles."""
    isovalue = middle_of(grid) if isovalue is None else isovalue
    spacing = support.longest_side(grid) / 14
    particles = support.run_quietly(grid, "f", isovalue, Spacing=spacing, **properties)
    assert particles.GetNumberOfPoints() > 10
    positions, values, _ = support.evaluate_by_vtk(grid, particles, ["f"])
    np.testing.assert_allclose(support.points_of(particles), positions, atol=1e-9, rtol=0)
    np.testing.assert_allclose(values["f"], isovalue, atol=1e-7, rtol=0)
    TESTED.setdefault(label, []).append((order, particles.GetNumberOfPoints()))
    return particles


# Types and orders


@pytest.mark.parametrize("blocks", [1, 2])
@pytest.mark.parametrize("name", [*cells.OF_THE_SOURCE, *cells.BY_HAND])
def test_cells_of_a_fixed_order(name, blocks):
    grid = cells.straight_grid(name, blocks=blocks)
    if name != "VOXEL":
        cells.bend(grid)
    check(with_wave(grid), f"{name} ({grid.GetCell(0).GetNumberOfPoints()} points)", "mesh" if blocks > 1 else "cube")


# VTK's own Bezier tetrahedra take time exponential in their order: too slow to ask beyond 7.
@pytest.mark.parametrize(
    "name, order",
    [(n, p) for n in cells.ARBITRARY_ORDER for p in range(1, 8 if n == "BEZIER_TETRAHEDRON" else 11)],
)
def test_cells_of_every_order(name, order):
    check(with_wave(cells.bend(cells.straight_grid(name, order))), name, order)


@pytest.mark.parametrize("order", range(11, 16))
@pytest.mark.parametrize("name", ["LAGRANGE_HEXAHEDRON", "BEZIER_HEXAHEDRON"])
def test_hexahedra_of_high_order(name, order):
    check(with_wave(cells.bend(cells.anisotropic_grid(name, (order,) * 3))), name, order)


@pytest.mark.parametrize("order", [2, 7, 8, 9, 10])
def test_bezier_tetrahedra_of_every_order(order):
    """|x - c|^2 in Bezier form, by its polar form: with p the order, P a control point's place and a_i its
    barycentric indices, the coefficient is (p^2 |P - c|^2 - sum a_i |corner_i - c|^2) / (p (p - 1))."""
    grid = cells.straight_grid("BEZIER_TETRAHEDRON", order)
    center, radius = np.array([0.45, 0.4, 0.55]), 0.3
    points = support.points_of(grid) - center
    control = np.zeros(len(points))
    for cell in range(grid.GetNumberOfCells()):
        ids = cells.ids_of(grid, cell)
        corners = points[ids[:4]]
        indices = np.rint(order * np.linalg.solve(np.c_[corners, np.ones(4)].T, np.c_[points[ids], np.ones(len(ids))].T))
        places = indices.T @ corners / order
        control[ids] = order * (places**2).sum(axis=1) - (indices.T @ (corners**2).sum(axis=1)) / order
        points[ids] = places  # VTK's source rounds to single precision
    cells.set_points(grid, points + center)
    support.add_point_array(grid, "f", control / (order - 1))
    particles = support.run_quietly(grid, "f", radius**2, Spacing=0.07)
    distances = np.linalg.norm(support.points_of(particles) - center, axis=1)
    assert len(distances) > 180
    np.testing.assert_allclose(distances, radius, atol=1e-9, rtol=0)
    TESTED.setdefault("BEZIER_TETRAHEDRON, a sphere", []).append((order, len(distances)))


@pytest.mark.parametrize("name", ["LAGRANGE_TETRAHEDRON", "LAGRANGE_WEDGE"])
def test_enriched_quadratic_cells(name):
    grid = with_wave(cells.bend(cells.straight_grid(name, 2, enriched=True)))
    points = grid.GetCell(0).GetNumberOfPoints()
    assert points == {"LAGRANGE_TETRAHEDRON": 15, "LAGRANGE_WEDGE": 21}[name]
    check(grid, f"{name} ({points} points)", 2)


@pytest.mark.parametrize("degrees", [(4, 2, 3), (1, 5, 2), (2, 1, 7), (10, 2, 3)])
@pytest.mark.parametrize("name", ["LAGRANGE_HEXAHEDRON", "BEZIER_HEXAHEDRON"])
def test_hexahedra_of_different_degrees(name, degrees):
    check(with_wave(cells.bend(cells.anisotropic_grid(name, degrees))), name, degrees)


@pytest.mark.parametrize("degrees", [(4, 4, 1), (2, 2, 5), (1, 1, 3), (3, 3, 2)])
@pytest.mark.parametrize("name", ["LAGRANGE_WEDGE", "BEZIER_WEDGE"])
def test_wedges_of_different_degrees(name, degrees):
    check(with_wave(cells.bend(cells.anisotropic_grid(name, degrees))), name, degrees)


# Mixtures


def beside(grid, shift):
    cells.set_points(grid, support.points_of(grid) + shift)
    return grid


def test_all_types_in_one_grid():
    names = [*cells.OF_THE_SOURCE, *cells.BY_HAND, *cells.ARBITRARY_ORDER]
    parts = []
    for n, name in enumerate(names):
        grid = with_wave(cells.straight_grid(name, order=3 if name in cells.ARBITRARY_ORDER else None))
        parts.append(beside(grid, [1.5 * n, 0, 0]))
    whole = cells.append(parts)
    spacing = 0.15
    isovalue = 0.1
    particles = support.run_quietly(whole, "f", isovalue, Spacing=spacing)
    positions, values, _ = support.evaluate_by_vtk(whole, particles, ["f"])
    np.testing.assert_allclose(support.points_of(particles), positions, atol=1e-9, rtol=0)
    np.testing.assert_allclose(values["f"], isovalue, atol=1e-7, rtol=0)
    types = [whole.GetCellType(int(cell)) for cell in support.array_of(particles, "vtkOriginalCellIds")]
    assert {cells.type_number(name) for name in names} == set(types)


def test_mixed_orders_in_one_grid():
    parts = [
        beside(with_wave(cells.bend(cells.straight_grid("LAGRANGE_HEXAHEDRON", order))), [1.5 * order, 0, 0])
        for order in range(1, 8)
    ]
    whole = cells.append(parts)
    particles = support.run_quietly(whole, "f", 0.1, Spacing=0.1)
    positions, values, _ = support.evaluate_by_vtk(whole, particles, ["f"])
    np.testing.assert_allclose(support.points_of(particles), positions, atol=1e-9, rtol=0)
    np.testing.assert_allclose(values["f"], 0.1, atol=1e-7, rtol=0)
    assert set(support.array_of(particles, "vtkOriginalCellIds")) == set(range(7))


# Types of numbers


@pytest.mark.parametrize("kind", [np.float32, np.float64])
def test_points_of_either_precision(kind):
    grid = cells.bend(cells.straight_grid("LAGRANGE_HEXAHEDRON", 3))
    cells.set_points(grid, support.points_of(grid), kind)
    check(with_wave(grid), f"points of {kind.__name__}", 3)


@pytest.mark.parametrize("kind", [
    vtkCharArray, vtkSignedCharArray, vtkUnsignedCharArray, vtkShortArray, vtkUnsignedShortArray, vtkIntArray,
    vtkUnsignedIntArray, vtkLongArray, vtkUnsignedLongArray, vtkLongLongArray, vtkUnsignedLongLongArray,
    vtkIdTypeArray, vtkFloatArray, vtkDoubleArray,
], ids=lambda kind: kind.__name__)  # fmt: skip
def test_arrays_of_every_type_of_number(kind):
    grid = cells.bend(cells.straight_grid("LAGRANGE_HEXAHEDRON", 3))
    values = np.round(50 + 40 * wave(support.points_of(grid)))
    array = kind()
    array.SetName("f")
    array.SetNumberOfTuples(len(values))
    for i, value in enumerate(values):
        array.SetTuple1(i, value)
    grid.GetPointData().AddArray(array)
    particles = support.run_quietly(grid, "f", 61.5, Spacing=support.longest_side(grid) / 14)
    as_double = cells.straight_grid("LAGRANGE_HEXAHEDRON", 3)
    as_double.SetPoints(grid.GetPoints())
    support.add_point_array(as_double, "f", values)
    expected = support.run_quietly(as_double, "f", 61.5, Spacing=support.longest_side(grid) / 14)
    assert particles.GetNumberOfPoints() > 10
    assert support.contents(particles) == support.contents(expected)


# Components and magnitude


def vector_grid(name, order):
    """A straight grid with v, linear in x, so that every element holds it exactly."""
    grid = cells.straight_grid(name, order)
    x = support.points_of(grid) - 0.45
    support.add_point_array(grid, "v", np.c_[x[:, 0] + 0.2 * x[:, 1], 1.3 * x[:, 1], 0.8 * x[:, 2] - 0.1 * x[:, 0]])
    return grid


def analytic_vector(points):
    x = points - 0.45
    return np.c_[x[:, 0] + 0.2 * x[:, 1], 1.3 * x[:, 1], 0.8 * x[:, 2] - 0.1 * x[:, 0]]


@pytest.mark.parametrize("name, order", [("LAGRANGE_HEXAHEDRON", 2), ("LAGRANGE_TETRAHEDRON", 3), ("BEZIER_WEDGE", 2),
                                         ("LAGRANGE_HEXAHEDRON", 10), ("PYRAMID", None)])  # fmt: skip
@pytest.mark.parametrize("component", range(5))
def test_components_and_magnitude_of_a_vector(name, order, component):
    grid = vector_grid(name, order)
    isovalue = 0.31 if component >= 3 else 0.05
    particles = support.run_quietly(grid, "v", isovalue, Component=component, Spacing=0.08)
    assert particles.GetNumberOfPoints() > 50
    v = analytic_vector(support.points_of(particles))
    # The number of components, or more, stands for the magnitude.
    chosen = np.linalg.norm(v, axis=1) if component >= 3 else v[:, component]
    np.testing.assert_allclose(chosen, isovalue, atol=1e-8, rtol=0)
    np.testing.assert_allclose(support.array_of(particles, "v"), v, atol=1e-10, rtol=0)


def test_normals_of_a_magnitude_point_down_its_gradient():
    grid = vector_grid("LAGRANGE_HEXAHEDRON", 2)
    particles = support.run_quietly(grid, "v", 0.31, Component=3, Spacing=0.08)
    h = 1e-6
    points = support.points_of(particles)
    slopes = np.stack(
        [
            np.linalg.norm(analytic_vector(points + step), axis=1)
            - np.linalg.norm(analytic_vector(points - step), axis=1)
            for step in h * np.eye(3)
        ],
        axis=1,
    )
    expected = -slopes / np.linalg.norm(slopes, axis=1)[:, None]
    np.testing.assert_allclose(support.array_of(particles, "Normals"), expected, atol=1e-6)


# Nodes at Gauss-Lobatto-Legendre points


def lobatto_points(degree):
    """Ends and extrema of the Legendre polynomial, on [0, 1]."""
    inner = np.polynomial.legendre.Legendre.basis(degree).deriv().roots()
    return (np.concatenate([[-1.0], np.sort(inner.real), [1.0]]) + 1.0) / 2.0


@pytest.mark.parametrize("order", [2, 3, 4, 5, 7, 8, 10])
def test_gauss_lobatto_nodes(order):
    grid = cells.anisotropic_grid("LAGRANGE_HEXAHEDRON", (order,) * 3)
    steps = np.rint(support.points_of(grid) * order).astype(int)
    points = lobatto_points(order)[steps]
    cells.set_points(grid, points)
    support.add_point_array(grid, "f", ((points - 0.4) ** 2).sum(axis=1))
    particles = support.run_quietly(grid, "f", 0.09, Spacing=0.06, NodeSpacing="Gauss-Lobatto-Legendre")
    assert particles.GetNumberOfPoints() > 200
    radius = np.linalg.norm(support.points_of(particles) - 0.4, axis=1)
    np.testing.assert_allclose(radius, 0.3, atol=1e-9, rtol=0)
    # With the true places of the nodes, positions are the parametric coordinates.
    np.testing.assert_allclose(
        support.array_of(particles, "ParametricCoordinates"), support.points_of(particles), atol=1e-9
    )
    TESTED.setdefault("LAGRANGE_HEXAHEDRON, Gauss-Lobatto-Legendre", []).append((order, len(radius)))


def test_a_file_with_gauss_lobatto_nodes(data):
    """A spectral element solver's shell: with the right places of the nodes cells meet, with wrong places the field is
    another one."""
    reader = support.read(data("trixi_adv_sphere_hex_p3.vtu"))
    spacing = support.longest_side(support.output_of(reader)) / 40
    uniform, _ = support.run(reader, "scalar", 1.28, Spacing=spacing)
    lobatto, messages = support.run(reader, "scalar", 1.28, Spacing=spacing, NodeSpacing="Gauss-Lobatto-Legendre")
    assert messages.errors == []
    assert lobatto.GetNumberOfPoints() > 100
    assert support.points_of(lobatto).shape != support.points_of(uniform).shape or not np.allclose(
        support.points_of(lobatto), support.points_of(uniform)
    )


# Bezier cells


def bezier_sphere():
    """x^2 + y^2 + z^2 on [0, 1]^3: exact control values of one quadratic hexahedron."""
    grid = cells.anisotropic_grid("BEZIER_HEXAHEDRON", (2, 2, 2))
    support.add_point_array(grid, "f", np.where(support.points_of(grid) == 1, 1.0, 0.0).sum(axis=1))
    return grid


def test_a_bezier_sphere_is_a_sphere():
    particles = support.run_quietly(bezier_sphere(), "f", 0.49, Spacing=0.05)
    radius = np.linalg.norm(support.points_of(particles), axis=1)
    assert len(radius) > 200
    np.testing.assert_allclose(radius, 0.7, atol=1e-9, rtol=0)
    # Stock Contour, for comparison, reads control values as if they were values.
    stock = support.stock_contour(bezier_sphere(), "f", 0.49)
    assert np.abs(np.linalg.norm(support.points_of(stock), axis=1) - 0.7).max() > 0.1


def set_weights(grid, weights):
    array = numpy_to_vtk(np.ascontiguousarray(weights), deep=True)
    array.SetName("RationalWeights")
    grid.GetPointData().AddArray(array)
    grid.GetPointData().SetRationalWeights(array)


def quarter_pipe():
    """Radius 1 to 2 along u, a quarter turn along v: exactly round, by the weights 1, sqrt(1/2), 1."""
    grid = cells.anisotropic_grid("BEZIER_HEXAHEDRON", (1, 2, 1))
    u, v, w = support.points_of(grid).T
    circle = np.array([[1, 0], [1, 1], [0, 1]])[np.rint(2 * v).astype(int)]
    cells.set_points(grid, np.c_[(1 + u)[:, None] * circle, w])
    set_weights(grid, np.where(v == 0.5, np.sqrt(0.5), 1.0))
    support.add_point_array(grid, "f", 1 + u)
    support.add_point_array(grid, "v", np.c_[0.6 * (1 + u), 0.8 * (1 + u)])
    return grid


@pytest.mark.parametrize("array, component", [("f", 0), ("v", 2)])
def test_a_rational_quarter_pipe_is_round(array, component):
    particles = support.run_quietly(quarter_pipe(), array, 1.37, Spacing=0.06, Component=component)
    points = support.points_of(particles)
    radius = np.linalg.norm(points[:, :2], axis=1)
    assert len(radius) > 200
    np.testing.assert_allclose(radius, 1.37, atol=1e-9, rtol=0)
    inward = -np.c_[points[:, :2] / radius[:, None], np.zeros(len(points))]
    np.testing.assert_allclose(support.array_of(particles, "Normals"), inward, atol=1e-7)
    np.testing.assert_allclose(np.abs(support.array_of(particles, "Mean_Curvature")), 0.5 / 1.37, atol=1e-6)
    np.testing.assert_allclose(support.array_of(particles, "Gauss_Curvature"), 0.0, atol=1e-6)
    positions, _, _ = support.evaluate_by_vtk(quarter_pipe(), particles, ["f"])
    np.testing.assert_allclose(points, positions, atol=1e-9)


@pytest.mark.parametrize("file", ["yeti_pipe_bezier_rational_p333.vtu", "yeti_pipe_bezier_rational_p423.vtu"])
def test_rational_cells_of_a_file(data, file):
    reader = support.read(data(file))
    grid = support.output_of(reader)
    # The pipe's own geometry is round: the distance from its axis is what the rational cells say.
    particles, messages = support.run(reader, "disp", -1e-4, Component=0, Spacing=support.longest_side(grid) / 50)
    assert messages.errors == []
    assert particles.GetNumberOfPoints() > 100
    positions, values, _ = support.evaluate_by_vtk(grid, particles, ["disp"])
    scale = np.abs(support.array_of(grid, "disp")).max()
    np.testing.assert_allclose(support.points_of(particles), positions, atol=1e-9 * support.diagonal(grid))
    np.testing.assert_allclose(values["disp"][:, 0], -1e-4, atol=1e-7 * scale, rtol=0)
    np.testing.assert_allclose(support.array_of(particles, "disp"), values["disp"], atol=1e-9 * scale)
    TESTED.setdefault("BEZIER_HEXAHEDRON, rational", []).append((file[-8:-4], particles.GetNumberOfPoints()))


@pytest.mark.parametrize("shape", ["HEXAHEDRON", "TETRAHEDRON", "WEDGE"])
@pytest.mark.parametrize("order", [1, 2, 3, 4])
def test_the_same_polynomial_as_lagrange_and_as_bezier(shape, order):
    """Control points from nodal ones by solving for them. Both are one surface, with the same particles,
    to rounding. (Classic decides by comparisons that a rounding error can turn: there only the surface is
    the same.)"""
    spacing = 0.12
    lagrange = with_wave(cells.bend(cells.straight_grid("LAGRANGE_" + shape, order)))
    bezier = cells.straight_grid("BEZIER_" + shape, order)
    parametric = support.points_of(bezier).copy()
    lagrange_nodes = np.c_[support.points_of(lagrange), support.array_of(lagrange, "f")]
    control = np.full_like(lagrange_nodes, np.nan)
    straight = cells.straight_grid("LAGRANGE_" + shape, order)
    for cell in range(bezier.GetNumberOfCells()):
        ids, other = cells.ids_of(bezier, cell), cells.ids_of(lagrange, cell)
        control[ids] = np.linalg.solve(
            shape_functions(bezier, cell, order, support.points_of(straight)[other]), lagrange_nodes[other]
        )
    assert not np.isnan(control).any() and len(parametric) == len(control)
    cells.set_points(bezier, control[:, :3])
    support.add_point_array(bezier, "f", control[:, 3])
    isovalue = middle_of(lagrange)
    runs = [support.run_quietly(grid, "f", isovalue, Spacing=spacing) for grid in (lagrange, bezier)]
    assert min(run.GetNumberOfPoints() for run in runs) > 10
    assert runs[0].GetNumberOfPoints() == runs[1].GetNumberOfPoints()
    between = np.linalg.norm(support.points_of(runs[0])[:, None] - support.points_of(runs[1])[None], axis=2)
    assert between.min(axis=1).max() < 1e-7 * spacing
    for grid, run in [(lagrange, runs[1]), (bezier, runs[0])]:  # each on the other's surface
        positions, values, _ = support.evaluate_by_vtk(grid, run, ["f"])
        np.testing.assert_allclose(support.points_of(run), positions, atol=1e-12, rtol=0)
        np.testing.assert_allclose(values["f"], isovalue, atol=1e-9, rtol=0)


@pytest.mark.parametrize("degree", [1, 2])
def test_a_polynomial_without_rounding_as_lagrange_and_as_bezier(degree):
    """Where neither form rounds, the particles are the same, bit for bit."""
    lagrange = cells.anisotropic_grid("LAGRANGE_HEXAHEDRON", (degree,) * 3)
    points = support.points_of(lagrange)
    support.add_point_array(lagrange, "f", (points**degree).sum(axis=1))
    bezier = cells.anisotropic_grid("BEZIER_HEXAHEDRON", (degree,) * 3)
    support.add_point_array(bezier, "f", np.where(support.points_of(bezier) == 1, 1.0, 0.0).sum(axis=1))
    runs = [support.run_quietly(grid, "f", 0.7, Spacing=0.05) for grid in (lagrange, bezier)]
    assert runs[0].GetNumberOfPoints() > 100
    assert support.contents(runs[0]) == support.contents(runs[1])


def shape_functions(grid, cell, order, places):
    """Values of a straight cell's shape functions at its nodes' places of the world, one row a place."""
    made = grid.GetCell(cell)
    rows = []
    corners = support.points_of(grid)[cells.ids_of(grid, cell)]
    count = {4: 4, 5: 6, 6: 8}[made.GetNumberOfFaces()]
    origin = corners[0]
    axes = corners[[1, 2, 3]] if count == 4 else corners[[1, 2, 3]] if count == 6 else corners[[1, 3, 4]]
    inverse = np.linalg.inv((axes - origin).T)
    for place in places:
        weights = np.zeros(made.GetNumberOfPoints() + 64)
        # VTK's source rounds to single precision.
        made.InterpolateFunctions(np.rint(order * inverse @ (place - origin)) / order, weights)
        rows.append(weights[: made.GetNumberOfPoints()])
    return np.array(rows)


# What stock filters lose


def test_an_island_between_the_nodes_is_found():
    """Nodal values below 0.74, the polynomial up to 1.17: Contour gives nothing."""
    grid = cells.anisotropic_grid("LAGRANGE_HEXAHEDRON", (4, 4, 4))
    peak = np.exp(-60 * ((support.points_of(grid) - 0.375) ** 2).sum(axis=1))
    nodal = 0.42 * 1.73 * peak / peak.max()
    support.add_point_array(grid, "f", nodal)
    isovalue = 0.95
    assert nodal.max() < 0.74
    assert support.stock_contour(grid, "f", isovalue).GetNumberOfPoints() == 0
    particles = support.run_quietly(grid, "f", isovalue, Spacing=0.02)
    assert particles.GetNumberOfPoints() > 30
    _, values, _ = support.evaluate_by_vtk(grid, particles, ["f"])
    np.testing.assert_allclose(values["f"], isovalue, atol=1e-7)


# Thin cells far from the origin


@pytest.mark.parametrize("axis", range(3))
def test_plates_far_from_the_origin_keep_their_thickness(axis):
    """Single precision could not tell their two sides apart, but double precision does."""
    counts = []
    for offset in (0.0, 5e6):
        grid = cells.straight_grid("LAGRANGE_HEXAHEDRON", 2)
        scale = np.ones(3)
        scale[axis] = 0.004
        flat = support.points_of(grid) * scale
        across, along = flat[:, axis - 1], flat[:, axis - 2]
        support.add_point_array(grid, "f", np.hypot(across - 0.1, along - 0.2))
        shift = np.full(3, offset)
        shift[axis] = 0.0
        cells.set_points(grid, flat + shift)
        counts.append(support.run_quietly(grid, "f", 0.7, Spacing=0.001).GetNumberOfPoints())
    assert counts[0] > 200
    assert counts[1] == pytest.approx(counts[0], rel=0.02)


# Surfaces in faces of elements


@pytest.mark.parametrize("degree", [2, 3, 5, 6])
def test_a_surface_in_the_faces_at_the_end_of_the_mesh_is_covered_up_to_its_edges(degree):
    """The conversion to Bernstein coefficients leaves rounding errors in the faces, which must not become boundary
    curves."""
    nodes = support.points_of(cells.anisotropic_grid("LAGRANGE_HEXAHEDRON", (degree,) * 3))
    corners = np.array(list(np.ndindex(3, 3, 3)), dtype=float)
    points = (corners[:, None] + nodes[None]).reshape(-1, 3)
    ids = np.arange(len(points)).reshape(len(corners), -1)
    kind = cells.type_number("LAGRANGE_HEXAHEDRON")
    grid = support.grid_of_cells(points, [(kind, row) for row in ids])
    support.add_point_array(grid, "f", points[:, 0])
    particles = support.run_quietly(grid, "f", 3.0, Spacing=0.05)
    x = support.points_of(particles)
    np.testing.assert_allclose(x[:, 0], 3.0, atol=1e-9)
    assert len(x) == pytest.approx(support.hexagonal_count(9.0, 0.05, 12.0), rel=0.02)
    assert np.quantile(support.nearest_neighbors(particles), 0.05) > 0.7
    inside = np.minimum(x[:, 1:], 3.0 - x[:, 1:]).min(axis=1) > 0.1
    assert not np.any(support.array_of(particles, "Clip_Angle")[inside] > 179.0)
