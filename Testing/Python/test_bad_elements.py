"""Cells that contradict themselves: left out with one clear warning that names the first and counts
them, while the rest of the grid comes out as if they were not there."""

import time

import cells
import numpy as np
import pytest
import support
from paraview import simple
from paraview.vtk.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import reference

SPACING = 0.08
ISOVALUE = 0.09


@pytest.fixture(autouse=True)
def fresh_session():
    yield
    for proxy in list(simple.GetSources().values()):
        simple.Delete(proxy)


def ball(points):
    return ((points - 0.43) ** 2).sum(axis=1)


def row_of_cells(name="LAGRANGE_HEXAHEDRON", degrees=(2, 2, 2), count=4):
    """Cells side by side that share no points, each with its own ball."""
    parts = []
    for n in range(count):
        grid = cells.anisotropic_grid(name, degrees)
        support.add_point_array(grid, "f", ball(support.points_of(grid)))
        cells.set_points(grid, support.points_of(grid) + [1.5 * n, 0, 0])
        parts.append(grid)
    whole = cells.append(parts)
    cells.set_degrees(whole, [degrees] * count)
    return whole


def expect_skipped(grid, bad, reason, isovalue=ISOVALUE):
    """One warning names the cells `bad`; all other cells give what they give in a sound grid."""
    # No pole of a ball touches the side of a box that halving makes.
    particles, messages = support.run(grid, "f", isovalue, Spacing=SPACING)
    assert messages.errors == []
    assert len(messages.warnings) == 1
    text = messages.warnings[0]
    assert f"{len(bad)} cell" in text and f"first: cell {min(bad)})" in text and reason in text
    assert support.reported(particles, "CellsSkipped") == len(bad)
    found = set(support.array_of(particles, "vtkOriginalCellIds"))
    assert found == set(range(grid.GetNumberOfCells())) - set(bad)
    points = support.points_of(particles)
    assert np.isfinite(points).all()
    return particles


def on_their_balls(particles):
    points = support.points_of(particles)
    centers = np.c_[1.5 * support.array_of(particles, "vtkOriginalCellIds"), np.zeros((len(points), 2))] + 0.43
    np.testing.assert_allclose(np.linalg.norm(points - centers, axis=1), 0.3, atol=1e-8, rtol=0)


@pytest.mark.parametrize("wrong", [(3, 2, 2), (0, 2, 2), (-1, 2, 2), (11, 2, 2), (1, 1, 1)])
def test_degrees_that_contradict_the_number_of_points(wrong):
    grid = row_of_cells()
    cells.set_degrees(grid, [(2, 2, 2), wrong, wrong, (2, 2, 2)])
    on_their_balls(expect_skipped(grid, [1, 2], "fits no degree"))


@pytest.mark.parametrize("weight", [0.0, -1.0, np.nan, np.inf])
def test_weights_that_are_not_positive(weight):
    grid = row_of_cells("BEZIER_HEXAHEDRON")
    weights = np.ones(grid.GetNumberOfPoints())
    weights[2 * 27 + 5] = weight
    array = numpy_to_vtk(weights, deep=True)
    array.SetName("RationalWeights")
    grid.GetPointData().AddArray(array)
    grid.GetPointData().SetRationalWeights(array)
    expect_skipped(grid, [2], "not positive", isovalue=0.5)


@pytest.mark.parametrize("name, degrees", [("LAGRANGE_HEXAHEDRON", (16, 16, 16)), ("LAGRANGE_HEXAHEDRON", (1, 16, 2)),
                                           ("BEZIER_HEXAHEDRON", (16, 2, 1)), ("LAGRANGE_WEDGE", (11, 11, 2)),
                                           ("BEZIER_WEDGE", (2, 2, 11))])  # fmt: skip
def test_orders_above_the_limit(name, degrees):
    good = row_of_cells(count=1)
    high = cells.anisotropic_grid(name, degrees)
    support.add_point_array(high, "f", ball(support.points_of(high)))
    cells.set_points(high, support.points_of(high) + [1.5, 0, 0])
    grid = cells.append([good, high])
    cells.set_degrees(grid, [(2, 2, 2), degrees])
    on_their_balls(expect_skipped(grid, [1], "up to 10 (hexahedra: 15)"))


@pytest.mark.parametrize("missing", [1, 20])
def test_cells_with_too_few_points(missing):
    whole = row_of_cells()
    parts = [(whole.GetCellType(c), cells.ids_of(whole, c)) for c in range(4)]
    parts[3] = (parts[3][0], parts[3][1][:-missing])
    grid = support.grid_of_cells(support.points_of(whole), parts)
    support.add_point_array(grid, "f", support.array_of(whole, "f"))
    on_their_balls(expect_skipped(grid, [3], "fits no degree"))


@pytest.mark.parametrize("poison", [np.nan, np.inf])
def test_values_that_are_not_finite(poison):
    grid = row_of_cells()
    values = support.array_of(grid, "f").copy()
    values[27 + 3] = poison
    grid.GetPointData().RemoveArray("f")
    support.add_point_array(grid, "f", values)
    on_their_balls(expect_skipped(grid, [1], "NaN or infinite"))


# Every type of cell: three cubes side by side, of which the middle one has something wrong


TYPES = [*cells.OF_THE_SOURCE, *cells.BY_HAND, *cells.ARBITRARY_ORDER]
PLANE = 0.71
ORDER = 3  # where the type leaves it open


def cubes(name, change=lambda points: points):
    """Three cubes of cells of one type that share no points; `change` moves those of the middle one."""
    parts = []
    for n in range(3):
        grid = cells.straight_grid(name, ORDER if name in cells.ARBITRARY_ORDER else None)
        points = support.points_of(grid)
        support.add_point_array(grid, "f", points @ [1.0, 0.31, 0.23])  # every type holds it exactly
        cells.set_points(grid, (change(points) if n == 1 else points) + [1.5 * n, 0, 0])
        parts.append(grid)
    return cells.append(parts), parts[0].GetNumberOfCells()


def run_and_check(grid, kept, folded=()):
    """Particles lie on the polynomials of the cells `kept`, and of no others. Returns the particles and the messages
    about cells. Where a cell folds over, its map does not move (det J = 0): the world gradient is infinite, and the
    field at places on the surface may be off."""
    particles, messages = support.run(grid, "f", PLANE, Spacing=SPACING)
    assert messages.errors == []
    points = support.points_of(particles)
    found = set(support.array_of(particles, "vtkOriginalCellIds"))
    assert found <= kept and len(found) > len(kept) / 2
    assert np.isfinite(points).all() and np.isfinite(support.array_of(particles, "Normals")).all()
    positions, values, _ = support.evaluate_by_vtk(grid, particles, ["f"])
    np.testing.assert_allclose(points, positions, atol=1e-9, rtol=0)
    smooth = ~np.isin(support.array_of(particles, "vtkOriginalCellIds"), folded)
    np.testing.assert_allclose(values["f"][smooth], PLANE, atol=1e-8, rtol=0)
    np.testing.assert_allclose(values["f"], PLANE, atol=2e-3, rtol=0)
    assert support.array_of(particles, "Residual").max() < 1e-9
    return particles, [text for text in messages.warnings if "Not every cell" in text]


def expect_one_warning(warnings, reason, count, first):
    assert len(warnings) == 1
    assert reason in warnings[0] and f"{count} cell" in warnings[0] and f"first: cell {first})" in warnings[0]


def holds_surface(grid, cell):
    values = support.array_of(grid, "f")[cells.ids_of(grid, cell)]
    return values.min() <= PLANE <= values.max()


def with_cell(grid, changed, change):
    """The same grid with other point ids in one cell."""
    parts = [(grid.GetCellType(c), cells.ids_of(grid, c)) for c in range(grid.GetNumberOfCells())]
    parts[changed] = (parts[changed][0], change(list(parts[changed][1])))
    result = support.grid_of_cells(support.points_of(grid), parts)
    support.add_point_array(result, "f", support.array_of(grid, "f"))
    return result


@pytest.mark.parametrize("id", [-1, 10**9])
@pytest.mark.parametrize("name", TYPES)
def test_point_ids_outside_the_grid(name, id):
    grid, each = cubes(name)
    grid = with_cell(grid, each, lambda ids: [*ids[:-2], id, ids[-1]])
    _, warnings = run_and_check(grid, set(range(3 * each)) - {each})
    expect_one_warning(warnings, "point ids outside the grid", 1, each)


@pytest.mark.parametrize("name", TYPES)
def test_one_point_too_few(name):
    grid, each = cubes(name)
    grid = with_cell(grid, each, lambda ids: ids[:-1])
    _, warnings = run_and_check(grid, set(range(3 * each)) - {each})
    expect_one_warning(warnings, "fits no degree", 1, each)


@pytest.mark.parametrize("name", ["BEZIER_TETRAHEDRON", "BEZIER_HEXAHEDRON", "BEZIER_WEDGE"])
@pytest.mark.parametrize("weight", [0.0, -1.0, np.nan])
def test_weights_of_every_type(name, weight):
    grid, each = cubes(name)
    weights = np.ones(grid.GetNumberOfPoints())
    inside = cells.ids_of(grid, each)[-1]  # no other cell's
    weights[inside] = weight
    bad = {c for c in range(3 * each) if inside in cells.ids_of(grid, c)}
    array = numpy_to_vtk(weights, deep=True)
    array.SetName("RationalWeights")
    grid.GetPointData().AddArray(array)
    grid.GetPointData().SetRationalWeights(array)
    _, warnings = run_and_check(grid, set(range(3 * each)) - bad)
    expect_one_warning(warnings, "not positive", len(bad), min(bad))


@pytest.mark.parametrize("name", cells.ARBITRARY_ORDER)
def test_degrees_that_contradict_any_type(name):
    grid, each = cubes(name)
    degrees = [(ORDER,) * 3] * (3 * each)
    degrees[each] = (ORDER + 1, ORDER, ORDER)
    cells.set_degrees(grid, degrees)
    _, warnings = run_and_check(grid, set(range(3 * each)) - {each})
    expect_one_warning(warnings, "fits no degree", 1, each)


@pytest.mark.parametrize("name", TYPES)
def test_flat_cells_of_every_type(name):
    grid, each = cubes(name, lambda points: points * [1, 1, 0] + [0, 0, 0.5])
    _, warnings = run_and_check(grid, set(range(3 * each)) - set(range(each, 2 * each)))
    # Cells without surface are not judged.
    flat = [c for c in range(each, 2 * each) if holds_surface(grid, c)]
    expect_one_warning(warnings, "without volume", len(flat), flat[0])


@pytest.mark.parametrize("name", TYPES)
def test_left_handed_cells_of_every_type_are_harmless(name):
    grid, each = cubes(name, lambda points: points * [-1, 1, 1] + [1, 0, 0])
    particles, warnings = run_and_check(grid, set(range(3 * each)))
    assert warnings == []
    counts = np.bincount(support.array_of(particles, "vtkOriginalCellIds") // each)
    assert counts[1] == pytest.approx(counts[0], rel=0.15)


def fold(points):
    """Reverses x in a part of the cube."""
    x, y, z = points.T
    return np.c_[x - 1.6 * x * y * z, y, z]


@pytest.mark.parametrize("name", [name for name in TYPES if name not in ("TETRA", "VOXEL")])
def test_partly_inverted_cells_of_every_type(name):
    grid, each = cubes(name, fold)
    _, warnings = run_and_check(grid, set(range(3 * each)), folded=range(each, 2 * each))
    assert len(warnings) == 1 and "partly inverted" in warnings[0]


@pytest.mark.parametrize("degree", [3, 5])
def test_a_small_inverted_part_is_noticed(degree):
    """det J = |u - (0.2, 0.2, 0.2)|^2 - 0.01^2: below zero in a ball that no regular sampling hits."""

    def dent(u):
        d = u - 0.2
        return np.c_[d[:, 0] * (d[:, 0] ** 2 / 3 + d[:, 1] ** 2 + d[:, 2] ** 2 - 1e-4), u[:, 1:]]

    grid = cells.anisotropic_grid("LAGRANGE_HEXAHEDRON", (degree,) * 3)
    support.add_point_array(grid, "f", support.points_of(grid)[:, 2])
    cells.set_points(grid, dent(support.points_of(grid)))
    particles, messages = support.run(grid, "f", 0.21, Spacing=0.05)
    assert messages.errors == []
    assert any("1 cell kept, but partly inverted" in text for text in messages.warnings)
    np.testing.assert_allclose(support.points_of(particles)[:, 2], 0.21, atol=1e-9)


def test_cells_without_volume():
    grid = row_of_cells()
    points = support.points_of(grid).copy()
    points[54:81, 2] = 0.5
    cells.set_points(grid, points)
    on_their_balls(expect_skipped(grid, [2], "without volume"))


# Nodes in the order of another program


def places_as_gmsh_numbers_them(corners, edges, middles=()):
    """Nodes of degree 2 at the corners, in the middles of edges, and at `middles`."""
    corners = np.array(corners, dtype=float)
    return np.r_[corners, [(corners[a] + corners[b]) / 2 for a, b in edges], np.reshape(middles, (-1, 3))]


CUBE = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
EDGES_OF_CUBE = [(0, 1), (0, 3), (0, 4), (1, 2), (1, 5), (2, 3), (2, 6), (3, 7), (4, 5), (4, 7), (5, 6), (6, 7)]
FACES_OF_CUBE = [(.5, .5, 0), (.5, 0, .5), (0, .5, .5), (1, .5, .5), (.5, 1, .5), (.5, .5, 1)]  # fmt: skip
TETRAHEDRON = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
PRISM = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (0, 1, 1)]
GMSH = {
    "QUADRATIC_TETRA": places_as_gmsh_numbers_them(TETRAHEDRON, [(0, 1), (1, 2), (2, 0), (3, 0), (2, 3), (1, 3)]),
    "QUADRATIC_HEXAHEDRON": places_as_gmsh_numbers_them(CUBE, EDGES_OF_CUBE),
    "TRIQUADRATIC_HEXAHEDRON": places_as_gmsh_numbers_them(CUBE, EDGES_OF_CUBE, FACES_OF_CUBE + [(.5, .5, .5)]),
    "QUADRATIC_WEDGE": places_as_gmsh_numbers_them(
        PRISM, [(0, 1), (0, 2), (0, 3), (1, 2), (1, 4), (2, 5), (3, 4), (3, 5), (4, 5)]),
}  # fmt: skip


def grid_in_order(name, order=None, nodes=None, share=1.0, blocks=4, bent=0.0):
    """A box of cells, of which a share lists its nodes as `nodes` maps VTK's list, with the field f."""
    grid = cells.straight_grid(name, order, blocks)
    points = support.points_of(grid)
    points = 2 * points / points.max() - 1
    points += bent * np.sin(3 * points[:, [1, 2, 0]])
    dice = np.random.default_rng(1)
    parts = []
    for cell in range(grid.GetNumberOfCells()):
        ids = cells.ids_of(grid, cell)
        parts.append((grid.GetCellType(cell), nodes(ids) if dice.random() < share else ids))
    changed = support.grid_of_cells(points, parts)
    support.add_point_array(changed, "f", (points**2).sum(axis=1))
    return changed


def expect_misordered(grid, remedy, count, isovalue=0.36, trouble="partly inverted, but sound with "):
    started = time.process_time()
    particles, messages = support.run(grid, "f", isovalue, Spacing=SPACING)
    assert time.process_time() - started < 3, "such files took a quarter of a minute"
    assert messages.errors == []
    (warning,) = [text for text in messages.warnings if "Not every cell" in text]
    assert f"{count} cells of type vtk" in warning and f"skipped: {trouble}{remedy}" in warning
    assert "in another order than VTK's" in warning and "check what wrote it" in warning
    assert support.reported(particles, "CellsSkipped") == count
    return particles


def swapped(a, b):
    def swap(ids):
        ids = list(ids)
        ids[a], ids[b] = ids[b], ids[a]
        return ids

    return swap


def parametric_nodes(name, order=None):
    """Where VTK has the nodes of a cell."""
    grid = cells.straight_grid(name, order)
    cell = grid.GetCell(0)
    places = []
    # A cell's array of coordinates reaches Python without its length: asked for by evaluating the nodes instead.
    for n in range(cell.GetNumberOfPoints()):
        place = [0.0, 0.0, 0.0]
        cell.EvaluatePosition(cell.GetPoints().GetPoint(n), [0.0] * 3, reference(0), place, reference(0.0), [0.0] * 64)
        places.append(place)
    return np.array(places)


@pytest.mark.parametrize("bent", [0.0, 0.08])
@pytest.mark.parametrize("name", GMSH)
def test_nodes_in_the_order_of_gmsh(name, bent):
    places = parametric_nodes(name)
    listed = [int(np.linalg.norm(places - at, axis=1).argmin()) for at in GMSH[name]]
    assert sorted(listed) == list(range(len(places))), "no order of these nodes"
    grid = grid_in_order(name, None, lambda ids: [ids[n] for n in listed], bent=bent)
    expected = "nodes 8 and 9 exchanged" if name == "QUADRATIC_TETRA" else "their nodes in the order 0 1 2 3"
    particles = expect_misordered(grid, expected, grid.GetNumberOfCells())
    assert particles.GetNumberOfPoints() == 0


@pytest.mark.parametrize("share", [1.0, 0.6])
@pytest.mark.parametrize("edges", [[0, 3, 2, 1, 4, 5], [0, 2, 5, 3, 4, 1], [1, 4, 2, 3, 0, 5]], ids=str)
def test_orders_that_fold_no_cell(edges, share):
    """Of 719 wrong orders of the nodes on edges, eleven keep the Jacobian's sign; such cells took 25 million evaluations."""
    name = "QUADRATIC_TETRA"
    grid = grid_in_order(name, None, lambda ids: ids[:4] + [ids[4 + e] for e in edges], share=share, bent=0.05)
    bad = np.flatnonzero(np.random.default_rng(1).random(grid.GetNumberOfCells()) < share)
    expected = "nodes 5 and 7 exchanged" if edges[1] == 3 else "their nodes in the order 0 1 2 3"
    particles = expect_misordered(grid, expected, len(bad), trouble="bent, but much straighter with ")
    if share < 1:
        assert not np.isin(support.array_of(particles, "vtkOriginalCellIds"), bad).any()


def test_sound_cells_beside_misordered_ones_keep_their_particles():
    grid = grid_in_order("QUADRATIC_TETRA", None, swapped(8, 9), share=0.4)
    sound = support.run_quietly(grid_in_order("QUADRATIC_TETRA", None, list), "f", 0.36, Spacing=SPACING)
    bad = np.flatnonzero(np.random.default_rng(1).random(grid.GetNumberOfCells()) < 0.4)
    particles = expect_misordered(grid, "nodes 8 and 9 exchanged", len(bad))
    found = support.array_of(particles, "vtkOriginalCellIds")
    assert not np.isin(found, bad).any()
    assert 0.5 < particles.GetNumberOfPoints() / sound.GetNumberOfPoints() < 0.8
    np.testing.assert_allclose(np.linalg.norm(support.points_of(particles), axis=1), 0.6, atol=1e-8)


@pytest.mark.parametrize("degree", [2, 3])
def test_edges_numbered_as_before_vtk_9_1(degree):
    """Two vertical edges of Lagrange hexahedra changed places then."""
    n = degree - 1
    start = 8 + 10 * n

    def exchange(ids):
        return ids[:start] + ids[start + n : start + 2 * n] + ids[start : start + n] + ids[start + 2 * n :]

    grid = grid_in_order("LAGRANGE_HEXAHEDRON", degree, exchange, blocks=3)
    remedy = "nodes 18 and 19 exchanged" if degree == 2 else "4 of their 64 nodes in other places"
    expect_misordered(grid, remedy, 27)


@pytest.mark.parametrize("name, degree", [("HEXAHEDRON", None), ("LAGRANGE_HEXAHEDRON", 2), ("LAGRANGE_WEDGE", 3)])
def test_lexicographic_nodes(name, degree):
    places = parametric_nodes(name, degree)
    listed = np.lexsort(np.round(places, 9).T)
    grid = grid_in_order(name, degree, lambda ids: [ids[n] for n in listed])
    expect_misordered(grid, "", grid.GetNumberOfCells())


def test_orders_that_differ_from_cell_to_cell():
    """Of cubic tetrahedra, edges that run one way or the other."""
    dice = np.random.default_rng(3)

    def turn(ids):
        ids = list(ids)
        for edge in range(6):
            if dice.random() < 0.5:
                a = 4 + 2 * edge
                ids[a], ids[a + 1] = ids[a + 1], ids[a]
        return ids

    grid = grid_in_order("LAGRANGE_TETRAHEDRON", 3, turn, blocks=3)
    particles, messages = support.run(grid, "f", 0.36, Spacing=SPACING)
    assert len(messages.warnings) == 1
    assert "their nodes in other orders, which differ from cell to cell" in messages.warnings[0]
    # One in 64 cells has all edges the right way round.
    assert grid.GetNumberOfCells() * 0.95 < support.reported(particles, "CellsSkipped") < grid.GetNumberOfCells()


def test_an_order_that_is_not_recognised_is_suspected_where_most_cells_are_folded():
    nodes = np.random.default_rng(1).permutation(40)
    grid = grid_in_order("LAGRANGE_WEDGE", 3, lambda ids: [ids[n] for n in nodes])
    particles, messages = support.run(grid, "f", 0.36, Spacing=SPACING)
    (warning,) = messages.warnings
    assert "128 cells of type vtkLagrangeWedge skipped: partly inverted, as most cells of the type are" in warning
    assert "in another order than VTK's" in warning
    assert support.reported(particles, "CellsSkipped") == 128


def test_no_wrong_order_is_suspected_in_a_mesh_with_bad_cells():
    """A node of some cells is moved far enough to fold them."""
    for name, order in (("QUADRATIC_TETRA", None), ("LAGRANGE_HEXAHEDRON", 3), ("HEXAHEDRON", None)):
        grid = grid_in_order(name, order, list)
        dice = np.random.default_rng(2)
        points = support.points_of(grid).copy()
        some = dice.choice(len(points), grid.GetNumberOfCells() // 8, replace=False)
        points[some] += dice.normal(0.0, 0.3, (len(some), 3))
        cells.set_points(grid, points)
        _, messages = support.run(grid, "f", 0.36, Spacing=SPACING)
        (warning,) = [text for text in messages.warnings if "Not every cell" in text]
        assert "kept, but partly inverted" in warning and "order" not in warning
