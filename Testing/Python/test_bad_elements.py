"""Cells that contradict themselves: left out with one clear warning that names the first and counts
them, while the rest of the grid comes out as if they were not there."""

import cells
import numpy as np
import pytest
import support
from paraview import simple
from paraview.vtk.util.numpy_support import numpy_to_vtk

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
    """Cells side by side, none touching another, each with its own ball."""
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
    """The cells `bad` are named in one warning; all others give what they give in a healthy grid."""
    # Poles of the balls touch no side of a box that halving makes.
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


def test_orders_above_the_limit():
    good = row_of_cells(count=1)
    high = cells.anisotropic_grid("LAGRANGE_HEXAHEDRON", (11, 11, 11))
    support.add_point_array(high, "f", ball(support.points_of(high)))
    cells.set_points(high, support.points_of(high) + [1.5, 0, 0])
    on_their_balls(expect_skipped(cells.append([good, high]), [1], "up to 10"))


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


def test_cells_without_volume():
    grid = row_of_cells()
    points = support.points_of(grid).copy()
    points[54:81, 2] = 0.5
    cells.set_points(grid, points)
    on_their_balls(expect_skipped(grid, [2], "without volume"))
