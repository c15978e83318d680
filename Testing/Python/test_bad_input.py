"""Input that is wrong, odd or empty: the filter says what is wrong and what to do, keeps what is right,
and never writes a NaN."""

import re
import time

import numpy as np
import pytest
import support
from paraview import simple
from paraview.vtk.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import (
    VTK_BEZIER_HEXAHEDRON,
    VTK_LAGRANGE_HEXAHEDRON,
    VTK_LAGRANGE_PYRAMID,
    VTK_LAGRANGE_QUADRILATERAL,
    VTK_LAGRANGE_TRIANGLE,
    VTK_POLY_LINE,
    VTK_QUAD,
    VTK_TRIANGLE,
    vtkLagrangeHexahedron,
    vtkMultiBlockDataSet,
    vtkUnstructuredGrid,
)

CELLS = 3  # of the block below, along each side
DEGREE = 2
METHODS = ["Fast", "Classic"]


def place(x):
    """Where the block below has the point that would be x if it were straight: a gentle bend."""
    return x + 0.08 * np.sin(np.roll(x, 1, axis=1))


def block(nodes_to_world=place, cells=CELLS, field=lambda x: np.linalg.norm(x - CELLS / 2, axis=1)):
    """cells³ Lagrange hexahedra of order 2, each with nodes of its own; F: distance from the middle.
    nodes_to_world gets the nodes of the straight block."""
    nodes = np.zeros(((DEGREE + 1) ** 3, 3))
    for i, j, k in np.ndindex(*[DEGREE + 1] * 3):
        nodes[vtkLagrangeHexahedron.PointIndexFromIJK(i, j, k, [DEGREE] * 3)] = np.array([i, j, k]) / DEGREE
    corners = np.array(list(np.ndindex(*[cells] * 3)), dtype=float)
    points = (corners[:, None] + nodes[None]).reshape(-1, 3)
    ids = np.arange(len(points)).reshape(len(corners), -1)
    grid = support.grid_of_cells(nodes_to_world(points), [(VTK_LAGRANGE_HEXAHEDRON, row) for row in ids])
    support.add_point_array(grid, "F", field(points))
    return grid


@pytest.fixture
def good():
    """F = 1 is nearly a sphere of radius 1 across all cells but none of the corners."""
    return block()


SPHERE = {"array": "F", "isovalues": 1.0, "Spacing": 0.15}
CENTER_CELL = 13
CORNER_CELL = 0


def values_of(grid, cell, name="F"):
    """The values of a cell's nodes; writes to it change the grid."""
    size = (DEGREE + 1) ** 3
    return support.array_of(grid, name)[cell * size : (cell + 1) * size]


def move_points(grid, cell, points):
    size = (DEGREE + 1) ** 3
    for n, point in enumerate(points):
        grid.GetPoints().SetPoint(cell * size + n, point)
    grid.GetPoints().Modified()


def cell_points(grid, cell):
    size = (DEGREE + 1) ** 3
    return support.points_of(grid)[cell * size : (cell + 1) * size]


def assert_clean(particles):
    """All numbers are finite."""
    assert np.all(np.isfinite(support.points_of(particles)))
    for name in support.array_names(particles.GetPointData()):
        assert np.all(np.isfinite(support.array_of(particles, name))), name


def assert_empty(particles):
    assert particles.IsA("vtkPolyData")
    assert particles.GetNumberOfPoints() == particles.GetNumberOfCells() == 0


def assert_one_error(messages, *words):
    assert len(messages.errors) == 1 and messages.warnings == []
    for word in words:
        assert word in messages.errors[0]


def expect_no_surface(data, array, isovalue, *words, **properties):
    """One line says that there is no surface; returns the output."""
    output, messages = support.run(data, array, isovalue, **properties)
    assert_one_warning(messages, "no surface", *words)
    return output


def assert_one_warning(messages, *words):
    assert messages.errors == [] and len(messages.warnings) == 1
    for word in words:
        assert word in messages.warnings[0]


def test_the_block_itself_is_fine(good):
    particles = support.run_quietly(good, **SPHERE)
    assert particles.GetNumberOfPoints() > 400
    assert CENTER_CELL not in support.array_of(particles, "vtkOriginalCellIds")
    assert support.reported(particles, "CellsSkipped") == 0
    assert_clean(particles)


# Arrays


def test_no_such_array(good):
    particles, messages = support.run(good, "Temperature", 1.0)
    assert_empty(particles)
    assert_one_error(messages, "no point array 'Temperature'", "ContourBy", "arrays: F")


def test_no_array_at_all():
    grid = block()
    grid.GetPointData().RemoveArray("F")
    particles, messages = support.run(grid, "", 1.0)
    assert_empty(particles)
    assert_one_error(messages, "no active point array (Scalars)", "ContourBy")


def test_a_cell_array_instead_of_a_point_array(good):
    support.add_cell_array(good, "attribute", np.arange(float(good.GetNumberOfCells())))
    particles, messages = support.run(good, ["CELLS", "attribute"], 1.5)
    assert_empty(particles)
    assert_one_error(messages, "cell array 'attribute'", "point array", "F")


def test_a_cell_array_asked_for_as_a_point_array(good):
    """ParaView itself averages a cell array to the points before any filter sees it. Here every cell has its own
    points, so that the array is constant in each cell and has no isosurface."""
    support.add_cell_array(good, "attribute", np.arange(float(good.GetNumberOfCells())))
    expect_no_surface(good, "attribute", 1.5)


def test_a_block_without_the_array_leaves_the_others_right(good):
    bare = block()
    bare.GetPointData().RemoveArray("F")
    composite = vtkMultiBlockDataSet()
    composite.SetBlock(0, bare)
    composite.SetBlock(1, good)
    output, messages = support.run(composite, **SPHERE)
    assert_one_warning(messages, "block 1", "point array 'F'")
    assert output.GetBlock(0).GetNumberOfPoints() == 0
    assert output.GetBlock(1).GetNumberOfPoints() > 400


SHORT = 100  # of 729 points; cell arrays have one tuple of 27


def test_an_array_to_contour_by_that_is_too_short(good):
    support.add_point_array(good, "F", support.array_of(good, "F")[:SHORT])
    particles, messages = support.run(good, **SPHERE)
    assert_empty(particles)
    assert_one_error(messages, f"point array 'F' ({SHORT} tuples for {good.GetNumberOfPoints()} points)")


def test_a_block_whose_array_is_too_short_leaves_the_others_right(good):
    bad = block()
    support.add_point_array(bad, "F", support.array_of(bad, "F")[:SHORT])
    composite = vtkMultiBlockDataSet()
    composite.SetBlock(0, bad)
    composite.SetBlock(1, good)
    output, messages = support.run(composite, **SPHERE)
    assert_one_error(messages, f"point array 'F' of block 1 ({SHORT} tuples")
    assert_empty(output.GetBlock(0))
    assert np.array_equal(support.points_of(output.GetBlock(1)), support.points_of(support.run_quietly(good, **SPHERE)))


def expect_ignored(grid, array, points=True):
    """An array that is too short changes nothing but for one warning."""
    bare = vtkUnstructuredGrid()
    bare.DeepCopy(grid)
    for attributes in (bare.GetPointData(), bare.GetCellData()):
        attributes.RemoveArray(array.GetName())
    (grid.GetPointData() if points else grid.GetCellData()).AddArray(array)
    particles, messages = support.run(grid, **SPHERE)
    wanted = f"{grid.GetNumberOfPoints()} points" if points else f"{grid.GetNumberOfCells()} cells"
    assert_one_warning(messages, f"'{array.GetName()}' ({array.GetNumberOfTuples()} tuple", f"for {wanted})")
    assert support.contents(particles) == support.contents(support.run_quietly(bare, **SPHERE))
    assert not particles.GetCellData().HasArray(array.GetName())


def short_array(name, tuples, components=1, kind=float):
    array = numpy_to_vtk(np.ones((tuples, components), dtype=kind), deep=True)
    array.SetName(name)
    return array


@pytest.mark.parametrize("tuples", [0, 1, SHORT])
def test_another_point_array_that_is_too_short_is_ignored(good, tuples):
    expect_ignored(good, short_array("other", tuples))


def test_a_cell_array_that_is_too_short_is_ignored(good):
    expect_ignored(good, short_array("other", 26, 3), points=False)


def test_ghost_marks_that_are_too_few_are_ignored(good):
    expect_ignored(good, short_array("vtkGhostType", 1, kind=np.uint8), points=False)


def test_degrees_that_are_too_few_are_ignored(good):
    degrees = short_array("HigherOrderDegrees", 1, 3)
    good.GetCellData().SetHigherOrderDegrees(degrees)
    expect_ignored(good, degrees, points=False)


def test_weights_that_are_too_few_are_ignored(good):
    good.GetCellTypesArray().Fill(VTK_BEZIER_HEXAHEDRON)
    weights = short_array("RationalWeights", SHORT)
    good.GetPointData().SetRationalWeights(weights)
    expect_ignored(good, weights)


# Isovalues and settings


@pytest.mark.parametrize("isovalue", [-9.0, 99.0, 1e300])
def test_an_isovalue_outside_the_range_is_no_error(good, isovalue):
    low, high = np.sort(support.array_of(good, "F"))[[0, -1]]
    line = f"Isovalue {isovalue:g}: no surface. 'F' goes from {low:g} to {high:g}."
    particles = expect_no_surface(good, "F", isovalue, line)
    assert_empty(particles)
    assert support.reported(particles, "ElementsDropped") == CELLS**3


def test_an_array_without_a_number_has_no_range(good):
    support.add_point_array(good, "F", np.full(good.GetNumberOfPoints(), np.nan))
    particles, messages = support.run(good, "F", 1.0)
    assert_empty(particles)
    assert any("Isovalue 1: no surface. 'F' has no finite value." in text for text in messages.warnings)


def test_isovalues_outside_the_range_beside_one_inside(good):
    alone = support.run_quietly(good, **SPHERE)
    both = expect_no_surface(good, "F", [99.0, 1.0, -7.0], "Isovalues 99, -7: no", Spacing=SPHERE["Spacing"])
    assert np.array_equal(support.points_of(both), support.points_of(alone))


def test_blocks_of_which_only_one_has_surface_give_no_message(good):
    far = block()
    support.add_point_array(far, "F", support.array_of(good, "F") + 50.0)
    composite = vtkMultiBlockDataSet()
    for b, grid in enumerate((far, good)):
        composite.SetBlock(b, grid)
    support.run_quietly(composite, "F", 1.0, Spacing=0.2)
    expect_no_surface(composite, "F", 99.0, "Isovalue 99: no surface. 'F' goes from")


def test_an_isovalue_at_the_end_of_the_range(good):
    """The smallest nodal value: a surface no larger than a point, if any."""
    particles, messages = support.run(good, "F", 0.0, Spacing=0.15)
    assert messages.errors == []
    assert_clean(particles)


@pytest.mark.parametrize("properties", [{"Spacing": 0.1}, {"NumberOfParticles": 200}])
def test_a_magnitude_is_never_negative(good, properties):
    """Squares of magnitudes are contoured, which do not know the sign."""
    support.add_point_array(good, "V", support.points_of(good) - CELLS / 2)
    alone = support.run_quietly(good, "V", [0.5], Component=3, **properties)
    assert alone.GetNumberOfPoints() > 100
    for isovalues in ([-0.5, 0.5], [0.5, -0.5]):
        words = "Isovalue -0.5: no", "The magnitude of 'V'"
        both = expect_no_surface(good, "V", isovalues, *words, Component=3, **properties)
        assert np.array_equal(support.points_of(both), support.points_of(alone))
        assert np.all(support.array_of(both, "Isovalue") == 0.5)
    assert_empty(expect_no_surface(good, "V", -0.5, Component=3, **properties))


@pytest.mark.parametrize("isovalue", [np.nan, np.inf, -np.inf])
def test_an_isovalue_that_is_no_number(good, isovalue):
    proxy, messages = support.make_filter(good, "F", 1.0, Spacing=0.15)
    proxy.Isosurfaces = [1.0, float(isovalue)]
    assert_empty(support.output_of(proxy))
    assert_one_error(messages, "isovalue is NaN or infinite")


@pytest.mark.parametrize("properties", [{"Spacing": 0.1}, {"NumberOfParticles": 200}])
def test_an_isovalue_that_is_given_twice_counts_once(good, properties):
    once = support.run_quietly(good, "F", [0.9, 1.0], **properties)
    twice = support.run_quietly(good, "F", [0.9, 1.0, 0.9], **properties)
    assert np.array_equal(support.points_of(twice), support.points_of(once))


def test_no_isovalue(good):
    proxy, messages = support.make_filter(good, "F", 1.0)
    proxy.Isosurfaces = []
    assert_empty(support.output_of(proxy))
    assert_one_warning(messages, "no isovalue", "Isosurfaces")


def test_no_isovalue_and_nothing_to_choose_one_of():
    for grid in (block(field=lambda x: x[:, 0]), vtkUnstructuredGrid()):
        grid.GetPointData().Initialize()
        proxy = simple.HighOrderParticleIsosurface(Input=support.source_of(grid))
        messages = support.Messages(proxy.GetClientSideObject())
        assert_empty(support.output_of(proxy))
        assert_one_warning(messages, "no isovalue", "no cells with a point array")


@pytest.mark.parametrize("name", ["vtkdata_notch_quadratic_hex20_wedge15.vtu", "vtkdata_pyramid_quadratic.vtu"])
def test_an_input_that_was_not_read_yet_gives_no_defaults(data, name):
    """The first file has active scalars: the isovalue 0, VTK's default, would find a surface in them."""
    reader = simple.XMLUnstructuredGridReader(FileName=[data(name)])
    proxy = simple.HighOrderParticleIsosurface(Input=reader)
    messages = support.Messages(proxy.GetClientSideObject())
    assert_empty(support.output_of(proxy))
    assert_one_warning(messages, "no isovalue", "ContourBy", "updated before")


@pytest.mark.parametrize("spacing", [0.0, -1.0])
def test_a_spacing_that_is_not_positive_is_the_automatic_one(good, spacing):
    particles = support.run_quietly(good, "F", 0.3, Spacing=spacing, AngularDensity=0)
    expected = support.longest_side(good) / 100
    np.testing.assert_allclose(support.array_of(particles, "Radius"), expected)


@pytest.mark.parametrize("spacing", [np.nan, np.inf])
def test_a_spacing_that_is_no_number(good, spacing):
    particles, messages = support.run(good, "F", 1.0, Spacing=float(spacing))
    assert_empty(particles)
    assert_one_error(messages, "Spacing is NaN or infinite", "0 for the automatic")


@pytest.mark.parametrize("property", ["AngularDensity", "SmallestSpacing", "Tolerance"])
def test_a_property_that_is_no_number(good, property):
    particles, messages = support.run(good, "F", 1.0, **{property: float("nan")})
    assert_empty(particles)
    assert_one_error(messages, property, "NaN")


@pytest.mark.parametrize("spacing", [1e-6, 1e-300])
def test_an_absurdly_small_spacing_is_refused_at_once(good, spacing):
    begin = time.monotonic()
    particles, messages = support.run(good, "F", 1.0, Spacing=spacing)
    assert time.monotonic() - begin < 60
    assert_empty(particles)
    assert_one_error(messages, "particles", "limit", "larger Spacing")
    assert "nan" not in messages.errors[0] and len(messages.errors[0]) < 400


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("spacing", [50.0, 1e30, 1e300])
def test_a_spacing_larger_than_the_surface_leaves_a_few_particles(good, spacing, method):
    # By the default angular density some ten stand around, down to the smallest spacing. With none, Fast gives a closed
    # component about a dozen, and never fewer than six.
    for density, most in ((10, 100), (0, 24 if method == "Fast" else 12)):
        particles, messages = support.run(good, "F", 1.0, Spacing=spacing, Method=method, AngularDensity=density)
        assert messages.errors == []
        assert (6 if method == "Fast" else 1) <= particles.GetNumberOfPoints() <= most
        assert_clean(particles)


def test_too_many_particles_are_refused(good):
    particles, messages = support.run(good, "F", 1.0, Spacing=0.3, NumberOfParticles=2 * 10**9)
    assert_empty(particles)
    wanted = "there are to be 2000000000 particles"
    assert_one_error(messages, wanted, "limit", "smaller NumberOfParticles")


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("number", [1, 2, 3])
def test_very_few_particles(good, number, method):
    particles, messages = support.run(good, "F", 1.0, NumberOfParticles=number, Method=method)
    assert messages.errors == []
    assert particles.GetNumberOfPoints() == number
    assert_clean(particles)


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("number", [3, 12, 500])
def test_more_particles_than_a_tiny_surface_has_room_for_at_first(number, method):
    """A corner cut off a cube, a five-hundredth of its side: the first spacing is larger than that."""
    grid = block(lambda x: x, 1, lambda x: x.sum(axis=1))
    for seed in range(1, 6):
        particles = support.run_quietly(
            grid, "F", 0.003, NumberOfParticles=number, Method=method, Seed=seed)
        assert 1 <= particles.GetNumberOfPoints() <= number
        assert_clean(particles)


@pytest.mark.parametrize("given, advice", [
    ({"Spacing": 0.5}, "Choose a Spacing of "),
    ({"NumberOfParticles": 4}, "Choose a NumberOfParticles of "),
])
def test_too_few_particles_are_told_what_there_is_to_change(good, given, advice):
    particles, messages = support.run(good, "F", 0.2, AngularDensity=0, **given)
    assert particles.GetNumberOfPoints() > 0
    assert_one_warning(messages, "bends faster than their spacing", advice)


@pytest.mark.parametrize("spacing", [0.15, 0.2, 0.3, 0.5])
def test_the_spacing_advised_is_smaller(good, spacing):
    """Also where one particle is more than the share that may be left."""
    _, messages = support.run(good, "F", 0.2, AngularDensity=0, Spacing=spacing)
    for message in messages.warnings:
        advised = re.search(r"Choose a Spacing of ([0-9.e+-]+),", message)
        assert advised and float(advised[1]) < spacing


# NaN and infinity


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf, 1e80])
def test_elements_with_values_that_are_not_finite_are_left_out(good, bad):
    whole = support.run_quietly(good, **SPHERE)
    for cell in (4, 22):
        values_of(good, cell)[10] = bad
    particles, messages = support.run(good, **SPHERE)
    assert_one_warning(messages, "2 cells skipped", "NaN or infinite", "first: cell 4")
    assert support.reported(particles, "CellsSkipped") == 2
    assert_rest_is_right(particles, whole, {4, 22})


@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_elements_with_coordinates_that_are_not_finite_are_left_out(good, bad):
    whole = support.run_quietly(good, **SPHERE)
    points = cell_points(good, 4)
    points[7, 1] = bad
    move_points(good, 4, points)
    # The bounds of the grid are not finite either.
    particles, messages = support.run(good, **SPHERE)
    assert_one_warning(messages, "1 cell skipped", "NaN or infinite", "first: cell 4")
    assert_rest_is_right(particles, whole, {4})


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_automatic_spacing_in_spite_of_coordinates_that_are_not_finite(bad):
    grid = block()
    longest = support.longest_side(grid)
    points = cell_points(grid, 4)
    points[7, 1] = bad
    move_points(grid, 4, points)
    particles, messages = support.run(grid, "F", 0.3, AngularDensity=0)
    assert messages.errors == []
    assert particles.GetNumberOfPoints() > 100
    np.testing.assert_allclose(support.array_of(particles, "Radius"), longest / 100, rtol=0.1)
    assert support.array_of(particles, "Residual").max() <= 1.1e-8 * support.diagonal(block())


@pytest.mark.parametrize("far", [1e100, 1e160, 1e308])
def test_cells_that_vanish_beside_a_point_far_off_are_told(far):
    grid = block()
    points = cell_points(grid, 4)
    points[7, 1] = far
    move_points(grid, 4, points)
    particles, messages = support.run(grid, "F", 0.3)
    assert messages.errors == []
    assert "smaller than 1e-15 of the bounds" in messages.warnings[0]
    assert_clean(particles)


def test_bounds_that_overflow_are_refused():
    grid = block()
    points = cell_points(grid, 4)
    points[7, 1], points[6, 1] = 1.7e308, -1.7e308
    move_points(grid, 4, points)
    particles, messages = support.run(grid, "F", 0.3, Spacing=0.1)
    assert particles.GetNumberOfPoints() == 0
    assert_one_error(messages, "too long to compute with", "Transform")


def assert_rest_is_right(particles, whole, left_out):
    """The whole surface except its parts in cells that are left out."""
    assert_clean(particles)
    owners, before = (support.array_of(p, "vtkOriginalCellIds") for p in (particles, whole))
    assert not left_out & set(owners)
    assert set(owners) >= set(before) - left_out - {CENTER_CELL}
    expected = np.sum(~np.isin(before, list(left_out)))
    # The boundary curves of the holes need a few particles more.
    assert 0.97 * expected <= len(owners) <= 1.15 * expected
    assert support.array_of(particles, "Residual").max() <= 1.1e-8 * 6


def test_another_array_with_nan_does_not_matter(good):
    support.add_point_array(good, "other", np.full(good.GetNumberOfPoints(), np.nan))
    particles = support.run_quietly(good, **SPHERE)
    assert particles.GetNumberOfPoints() > 400
    assert np.all(np.isfinite(support.points_of(particles)))


def test_a_constant_field_equal_to_the_isovalue():
    """The surface would be the whole volume: no particle can stand on it, and nothing takes long."""
    grid = block(field=lambda x: np.ones(len(x)))
    begin = time.monotonic()
    particles, messages = support.run(grid, **SPHERE)
    assert time.monotonic() - begin < 2
    assert_one_warning(messages, f"{CELLS**3} cells skipped: the field is the isovalue throughout")
    assert_empty(particles)


def test_a_field_that_is_the_isovalue_but_for_rounding():
    """What rounding leaves of a constant field is no surface, also where the field changes elsewhere."""
    noise = 4 * np.finfo(float).eps * np.random.default_rng(1).normal(size=1000)
    for wall in (0.0, 1.0):
        grid = block(field=lambda x: np.where(x[:, 0] < 0.01, 2.0 + wall, 2.0 + noise[: len(x)]))
        particles, messages = support.run(grid, "F", 2.0)
        skipped = CELLS**3 if wall == 0.0 else (CELLS - 1) * CELLS**2
        assert_one_warning(messages, f"{skipped} cells skipped: the field is the isovalue throughout, to rounding")
        assert support.reported(particles, "CellsSkipped") == skipped


def test_a_constant_vector_is_no_reason_to_complain(good):
    """A free stream: for smaller magnitudes there is no surface, for its own magnitude the surface is everywhere."""
    support.add_point_array(good, "V", np.tile([3.0, 0.0, 4.0], (good.GetNumberOfPoints(), 1)))
    for isovalue in (0.0, 0.5, 4.9, 5.1):
        particles = expect_no_surface(good, "V", isovalue, "goes from 5 to 5", Component=3)
        assert_empty(particles)
        assert support.reported(particles, "CellsSkipped") == 0
        assert support.reported(particles, "ElementsDropped") == CELLS**3
    particles, messages = support.run(good, "V", 5.0, Component=3)
    assert_one_warning(messages, f"{CELLS**3} cells skipped: the field is the isovalue throughout")
    assert_empty(particles)


def test_a_field_that_is_the_isovalue_on_one_side():
    """max(x - 1.5, 0), node by node: flat and equal to the isovalue over half of the block."""
    grid = block(field=lambda x: np.maximum(x[:, 0] - 1.5, 0.0))
    particles, messages = support.run(grid, "F", 0.0, Spacing=0.15)
    assert messages.errors == []
    assert_clean(particles)


# Cells


def test_an_empty_grid():
    assert_empty(expect_no_surface(vtkUnstructuredGrid(), "F", 1.0, "the input has no cells"))


def test_points_without_cells():
    grid = support.grid_of_cells(np.eye(3), [])
    support.add_point_array(grid, "F", np.arange(3.0))
    assert_empty(expect_no_surface(grid, "F", 1.0, "the input has no cells"))


def test_an_empty_composite():
    composite = vtkMultiBlockDataSet()
    composite.SetNumberOfBlocks(2)
    output = expect_no_surface(composite, "F", 1.0, "the input has no cells")
    assert output.IsA("vtkMultiBlockDataSet") and output.GetNumberOfBlocks() == 2


def test_one_element_only():
    particles = support.run_quietly(block(cells=1), "F", 2.0, Spacing=0.1)
    assert particles.GetNumberOfPoints() > 50
    assert_clean(particles)


def flat_cells():
    points = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
    grid = support.grid_of_cells(points, [(VTK_TRIANGLE, [0, 1, 2]), (VTK_QUAD, range(4)), (VTK_QUAD, range(4))])
    support.add_point_array(grid, "F", np.arange(4.0))
    return grid


def test_flat_cells_are_counted_in_one_warning():
    particles, messages = support.run(flat_cells(), "F", 1.5)
    assert_empty(particles)
    assert_one_warning(messages, "1 cell of type vtkTriangle skipped", "2 cells of type vtkQuad", "3-D")
    assert support.reported(particles, "CellsSkipped") == 3


@pytest.mark.parametrize(
    "cell_type, points, name",
    [
        (VTK_LAGRANGE_TRIANGLE, 3, "vtkLagrangeTriangle"),
        (VTK_LAGRANGE_QUADRILATERAL, 4, "vtkLagrangeQuadrilateral"),
        (VTK_POLY_LINE, 4, "vtkPolyLine"),
        (VTK_LAGRANGE_PYRAMID, 14, "vtkLagrangePyramid"),  # VTK has no such class
    ],
)
def test_other_cells_beside_good_ones(good, cell_type, points, name):
    whole = support.run_quietly(good, **SPHERE)
    for cell in range(5):
        good.InsertNextCell(cell_type, points, [27 * cell + n for n in range(points)])
    particles, messages = support.run(good, **SPHERE)
    assert_one_warning(messages, f"5 cells of type {name} skipped", "not a supported 3-D cell", "first: cell 27")
    assert np.array_equal(support.points_of(particles), support.points_of(whole))


@pytest.mark.parametrize("cell_type", [51, *range(60, 68), 74, 200, 255])
def test_types_of_which_vtk_can_make_no_cell(good, cell_type):
    whole = support.run_quietly(good, **SPHERE)
    good.InsertNextCell(cell_type, 4, range(4))
    particles, messages = support.run(good, **SPHERE)
    assert_one_warning(messages, "1 cell of type ", "not a supported 3-D cell", "first: cell 27")
    assert np.array_equal(support.points_of(particles), support.points_of(whole))


def test_point_counts_that_fit_no_degree(good):
    whole = support.run_quietly(good, **SPHERE)
    good.InsertNextCell(VTK_LAGRANGE_HEXAHEDRON, 26, list(range(26)))
    particles, messages = support.run(good, **SPHERE)
    assert_one_warning(messages, "1 cell of type vtkLagrangeHexahedron skipped", "fits no degree")
    assert np.array_equal(support.points_of(particles), support.points_of(whole))


@pytest.mark.parametrize("degrees", [(3, 2, 2), (0, 0, 0), (26, 0, 0), (-2, -2, 2), (np.nan, 2, 2), (1e30, 2, 2)])
def test_degrees_that_contradict_the_point_count(good, degrees):
    """(0, 0, 0) leaves the degrees to the number of points, which is right."""
    table = np.full((CELLS**3, 3), 2.0)
    table[4] = degrees
    good.GetCellData().SetHigherOrderDegrees(support.add_cell_array(good, "HigherOrderDegrees", table))
    particles, messages = support.run(good, **SPHERE)
    if not any(degrees):
        assert messages.warnings == []
    else:
        assert_one_warning(messages, "1 cell of type vtkLagrangeHexahedron skipped", "fits no degree", "first: cell 4")
        assert 4 not in support.array_of(particles, "vtkOriginalCellIds")
    assert particles.GetNumberOfPoints() > 300
    assert_clean(particles)


@pytest.mark.parametrize("id", [-1, 10**6])
def test_point_ids_outside_the_grid(good, id):
    whole = support.run_quietly(good, **SPHERE)
    connectivity = good.GetCells().GetConnectivityArray()
    connectivity.SetTuple1(4 * 27 + 5, id)
    particles, messages = support.run(good, **SPHERE)
    assert_one_warning(messages, "1 cell skipped", "point ids outside the grid", "first: cell 4")
    assert_rest_is_right(particles, whole, {4})


@pytest.mark.parametrize("id", [-1, 10**6])
def test_point_ids_outside_the_grid_in_the_first_cell(good, id):
    """The parametric coordinates of a cell's nodes, from which the filter learns their order."""
    good.GetCells().GetConnectivityArray().SetTuple1(5, id)
    particles, messages = support.run(good, **SPHERE)
    assert_one_warning(messages, "1 cell skipped", "point ids outside the grid", "first: cell 0")
    assert particles.GetNumberOfPoints() > 400


AVERAGES = {"Quantity": "Gradient Magnitude", "Derivatives": "Averaged At Nodes"}


def test_averages_leave_out_point_counts_that_fit_no_degree(good):
    """VTK's own cell would end the program."""
    good.InsertNextCell(VTK_LAGRANGE_HEXAHEDRON, 26, list(range(26)))
    particles, messages = support.run(good, **{**SPHERE, **AVERAGES, "isovalues": 0.9})
    assert_one_warning(messages, "1 cell of type vtkLagrangeHexahedron skipped", "fits no degree")
    assert particles.GetNumberOfPoints() > 0
    assert_clean(particles)


@pytest.mark.parametrize("id", [-1, 10**6])
def test_averages_leave_out_point_ids_outside_the_grid(good, id):
    good.GetCells().GetConnectivityArray().SetTuple1(4 * 27 + 5, id)
    particles, messages = support.run(good, **{**SPHERE, **AVERAGES, "isovalues": 0.9})
    assert_one_warning(messages, "1 cell skipped", "point ids outside the grid", "first: cell 4")
    assert particles.GetNumberOfPoints() > 0
    assert_clean(particles)


# Shapes


def flat(points):
    return points * [1, 1, 0] + [0, 0, points[:, 2].mean()]


def point(points):
    return np.tile(points.mean(axis=0), (len(points), 1))


@pytest.mark.parametrize("collapse", [flat, point])
def test_elements_without_volume_are_left_out(good, collapse):
    whole = support.run_quietly(good, **SPHERE)
    move_points(good, 4, collapse(cell_points(good, 4)))
    particles, messages = support.run(good, **SPHERE)
    assert_one_warning(messages, "1 cell skipped: without volume", "first: cell 4")
    assert_rest_is_right(particles, whole, {4})


def test_a_grid_without_any_volume():
    particles, messages = support.run(block(flat), **SPHERE)
    assert_empty(particles)
    assert_one_warning(messages, "cells skipped: without volume")


def test_a_collapsed_edge_is_no_obstacle():
    """Hexahedra around an axis have an edge of length zero there."""

    def wrap(x):
        angle = x[:, 1] / CELLS * np.pi / 2
        return np.c_[x[:, 0] * np.cos(angle), x[:, 0] * np.sin(angle), x[:, 2]]

    particles, messages = support.run(block(wrap, field=lambda x: x[:, 2]), "F", 1.5, Spacing=0.15)
    assert messages.errors == []
    assert_clean(particles)
    area = np.pi / 4 * CELLS**2
    expected = support.hexagonal_count(area, 0.15, boundary=CELLS * (2 + np.pi / 2))
    assert particles.GetNumberOfPoints() == pytest.approx(expected, rel=0.06)


def test_left_handed_everywhere_is_a_mirror_image(good):
    whole = support.run_quietly(good, **SPHERE)
    mirrored = block(lambda x: place(x) * [-1, 1, 1])
    particles = support.run_quietly(mirrored, **SPHERE)
    assert particles.GetNumberOfPoints() == pytest.approx(whole.GetNumberOfPoints(), rel=0.02)
    inward = (np.array([-1, 1, 1]) * 1.5 - support.points_of(particles)) / 1.0
    assert np.all(np.sum(inward * support.array_of(particles, "Normals"), axis=1) > 0)
    assert support.array_of(particles, "Mean_Curvature").mean() == pytest.approx(
        support.array_of(whole, "Mean_Curvature").mean(), rel=0.01
    )


def test_partly_inverted_elements_are_kept_and_counted(good):
    points = cell_points(good, 4)
    middle = points.mean(axis=0)
    points[0] = middle + 0.8 * (middle - points[0])  # a corner pulled through the cell
    move_points(good, 4, points)
    particles, messages = support.run(good, **SPHERE)
    assert_one_warning(messages, "1 cell kept, but partly inverted", "first: cell 4")
    assert support.reported(particles, "CellsSkipped") == 0
    assert particles.GetNumberOfPoints() > 400
    assert_clean(particles)


@pytest.mark.parametrize("scale", [1e-12, 1e-3, 1e6, 1e12])
def test_the_size_of_the_data_does_not_matter(good, scale):
    """No constant may depend on the size of the grid: the particles are the same, scaled."""
    whole = support.run_quietly(good, **SPHERE)
    scaled = block(lambda x: place(x) * scale)
    particles = support.run_quietly(scaled, "F", 1.0, Spacing=0.15 * scale)
    assert particles.GetNumberOfPoints() == pytest.approx(whole.GetNumberOfPoints(), rel=0.03)
    assert support.nearest_neighbors(particles).min() > 0.7


@pytest.mark.parametrize("scale", [1e-30, 1e-9, 1e9, 1e30])
def test_the_size_of_the_values_does_not_matter(good, scale):
    whole = support.run_quietly(good, **SPHERE)
    scaled = block(field=lambda x: scale * np.linalg.norm(x - CELLS / 2, axis=1))
    particles = support.run_quietly(scaled, "F", scale, Spacing=0.15)
    assert particles.GetNumberOfPoints() == pytest.approx(whole.GetNumberOfPoints(), rel=0.03)


def test_data_far_from_the_origin(good):
    whole = support.run_quietly(good, **SPHERE)
    far = block(lambda x: place(x) + 1e4)
    particles = support.run_quietly(far, **SPHERE)
    assert particles.GetNumberOfPoints() == pytest.approx(whole.GetNumberOfPoints(), rel=0.05)


def test_an_input_that_is_put_right_is_computed_anew(good):
    proxy, messages = support.make_filter(good, "nothing", 1.0, Spacing=0.15)
    assert_empty(support.output_of(proxy))
    assert len(messages.errors) == 1
    proxy.ContourBy = ["POINTS", "F"]
    assert support.output_of(proxy).GetNumberOfPoints() > 400
    assert len(messages.errors) == 1
