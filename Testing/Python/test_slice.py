"""High-Order Particle Slice: planes, spheres, cylinders and boxes."""

import cells
import numpy as np
import pytest
import support
from highorderparticles import vtkHighOrderParticleSlice
from paraview import simple
from vtkmodules.vtkCommonDataModel import (
    VTK_HEXAHEDRON,
    vtkBox,
    vtkCylinder,
    vtkMultiBlockDataSet,
    vtkPlane,
    vtkQuadric,
    vtkSphere,
)
from vtkmodules.vtkCommonTransforms import vtkPerspectiveTransform, vtkTransform

NORMAL = np.array([0.6, 0.64, 0.48])
FILES = [
    "mfem_hex1_p8.vtu",
    "mfem_torus_wedge_p4.vtu",
    "dolfinx_tet_p3.vtu",
    "yeti_pipe_bezier_rational_p333.vtu",
    "vtkdata_pyramid_quadratic.vtu",
]


def plane(origin=(0.0, 0.0, 0.0), normal=NORMAL):
    function = vtkPlane()
    function.SetOrigin(origin)
    function.SetNormal(normal)
    return function


def sphere(center=(0.0, 0.0, 0.0), radius=0.5):
    function = vtkSphere()
    function.SetCenter(center)
    function.SetRadius(radius)
    return function


def cylinder(center=(0.0, 0.0, 0.0), axis=NORMAL, radius=0.5):
    function = vtkCylinder()
    function.SetCenter(center)
    function.SetAxis(axis)
    function.SetRadius(radius)
    return function


TURNED = np.array([[0.6, 0.64, 0.48], [-0.8, 0.48, 0.36], [0.0, -0.6, 0.8]])  # axes of a box, one a row


def turned_box(center, half):
    """A box whose sides are `half` to both sides of its center, along the axes TURNED."""
    function = vtkBox()
    function.SetBounds(*np.stack([-np.asarray(half), half], axis=1).ravel())
    transform = vtkTransform()
    transform.SetMatrix([*TURNED[0], 0, *TURNED[1], 0, *TURNED[2], 0, 0, 0, 0, 1])
    transform.Translate(*-np.asarray(center, dtype=float))
    function.SetTransform(transform)
    return function


def make_slice(grid, function, offsets=(0.0,), **properties):
    """The filter, not yet run, and what it says."""
    cut = vtkHighOrderParticleSlice()
    cut.SetPassDiagnostics(True)
    cut.SetInputDataObject(grid)
    cut.SetCutFunction(function)
    cut.SetNumberOfContours(len(offsets))
    for i, offset in enumerate(offsets):
        cut.SetValue(i, offset)
    for name, value in properties.items():
        getattr(cut, f"Set{name}")(value)
    return cut, support.Messages(cut)


def slice_of(grid, function, offsets=(0.0,), **properties):
    cut, messages = make_slice(grid, function, offsets, **properties)
    cut.Update()
    assert messages.errors + messages.warnings == []
    return cut.GetOutputDataObject(0)


def box(blocks=4, bent=True):
    """Cubic cells with the cube of side `blocks` as bounds, and a field that they hold exactly."""
    grid = cells.straight_grid("LAGRANGE_HEXAHEDRON", order=3, blocks=blocks)
    if bent:
        cells.bend(grid)
    x = support.points_of(grid)
    support.add_point_array(grid, "f", x @ [1.0, -2.0, 0.5] + 3.0)
    return grid


def middle_of(grid):
    bounds = np.reshape(grid.GetBounds(), (3, 2))
    return bounds.mean(axis=1), (bounds[:, 1] - bounds[:, 0]).max(), np.linalg.norm(bounds[:, 1] - bounds[:, 0])


def distances(name, points, center):
    """From the plane, the center or the axis; half the side of the box around the point."""
    x = points - center
    along = x @ NORMAL
    return {
        "plane": along,
        "sphere": np.linalg.norm(x, axis=1),
        "cylinder": np.linalg.norm(x - np.outer(along, NORMAL), axis=1),
        "box": np.abs(x @ TURNED.T).max(axis=1),
    }[name]


@pytest.mark.parametrize("name", ["plane", "sphere", "cylinder", "box"])
@pytest.mark.parametrize("file", FILES)
def test_particles_stand_on_the_slice_and_in_their_cells(data, file, name):
    grid = support.output_of(support.read(data(file)))
    center, side, diagonal = middle_of(grid)
    level = 0.0 if name == "plane" else 0.31 * side
    function = {"plane": plane(center), "sphere": sphere(center, level), "cylinder": cylinder(center, radius=level), "box": turned_box(center, [level] * 3)}[name]
    particles = slice_of(grid, function, Spacing=0.03 * side)
    assert particles.GetNumberOfPoints() > 50
    points = support.points_of(particles)
    assert np.abs(distances(name, points, center) - level).max() < 2e-10 * diagonal
    inputs = grid.GetPointData()
    arrays = [inputs.GetArrayName(a) for a in range(inputs.GetNumberOfArrays()) if inputs.GetArray(a).GetNumberOfComponents() < 4]
    arrays = [a for a in arrays if support.array_names(particles.GetPointData()) >= {a}]
    assert arrays
    positions, values, _ = support.evaluate_by_vtk(grid, particles, arrays[:2])
    np.testing.assert_allclose(points, positions, atol=1e-6 * diagonal)  # some files hold floats
    for array, expected in values.items():
        given = support.array_of(particles, array)
        np.testing.assert_allclose(given, expected, atol=1e-6 * max(1e-300, np.abs(expected).max()))


@pytest.mark.parametrize(
    "function, mean, gauss",
    [(plane((2, 2, 2)), 0.0, 0.0), (sphere((2, 2, 2), 1.5), -1 / 1.5, 1 / 1.5**2), (cylinder((2, 2, 2), radius=1.5), -0.5 / 1.5, 0.0)],
    ids=["plane", "sphere", "cylinder"],
)
def test_curvature_and_fields_are_exact(function, mean, gauss):
    particles = slice_of(box(), function)
    assert particles.GetNumberOfPoints() > 3000
    np.testing.assert_allclose(support.array_of(particles, "Mean_Curvature"), mean, atol=1e-7)
    np.testing.assert_allclose(support.array_of(particles, "Gauss_Curvature"), gauss, atol=1e-7)
    x = support.points_of(particles)
    np.testing.assert_allclose(support.array_of(particles, "f"), x @ [1.0, -2.0, 0.5] + 3.0, atol=1e-11)


def test_offsets_are_slices_of_their_own():
    """Also where a transform turns the function, and for offsets that leave the grid."""
    turn = vtkTransform()
    turn.RotateX(30)
    function = plane((2, 2, 2), (0, 0, 1))
    function.SetTransform(turn)
    grid = box(bent=False)
    cut, messages = make_slice(grid, function, [-0.5, 0.0, 0.25, 9.0])
    cut.Update()
    assert len(messages.warnings) == 1 and "9: no surface" in messages.warnings[0] and "distance from the plane" in messages.warnings[0]
    particles = cut.GetOutputDataObject(0)
    isovalues = support.array_of(particles, "Isovalue")
    assert sorted(set(isovalues)) == [-0.5, 0.0, 0.25]
    found = [function.FunctionValue(x) for x in support.points_of(particles)]
    np.testing.assert_allclose(found, isovalues, atol=1e-9)


def test_offsets_of_a_sphere_change_its_radius():
    particles = slice_of(box(), sphere((2, 2, 2), 1.0), [-0.25, 0.5])
    radii = np.linalg.norm(support.points_of(particles) - 2.0, axis=1)
    np.testing.assert_allclose(radii, support.array_of(particles, "Isovalue"), atol=1e-9)
    assert sorted(set(radii.round(6))) == [0.75, 1.5]


HALF = np.array([0.9, 1.2, 1.0])


def faces_of(particles, half=HALF, center=(2, 2, 2)):
    """Of each face of a box its axis and end, and its particles in the box's axes."""
    y = (support.points_of(particles) - center) @ TURNED.T
    normals = support.array_of(particles, "Normals") @ TURNED.T
    for axis in range(3):
        for end in (-1, 1):
            yield axis, end, y[end * normals[:, axis] < -0.99], half


@pytest.mark.parametrize("bent", [False, True])
@pytest.mark.parametrize("angular_density", [0.0, 10.0])
def test_a_box_is_covered_up_to_its_edges_and_corners(bent, angular_density):
    """No place of a face is farther from a particle than the corners of hexagonal packing, but for a little disorder; edges
    and corners have particles of their own on both sides."""
    spacing = 0.1
    particles = slice_of(box(bent=bent), turned_box((2, 2, 2), HALF), Spacing=spacing, AngularDensity=angular_density)
    for axis, end, y, half in faces_of(particles):
        np.testing.assert_allclose(y[:, axis], end * half[axis], atol=1e-9)
        u, v = np.delete(np.arange(3), axis)
        assert (np.abs(y[:, [u, v]]) <= half[[u, v]] + 1e-9).all()
        lattice = np.stack(np.meshgrid(*[np.linspace(-half[a], half[a], 60) for a in (u, v)]), axis=-1).reshape(-1, 2)
        nearest = np.linalg.norm(lattice[:, None] - y[None, :, [u, v]], axis=2).min(axis=1)
        assert nearest.max() < 0.85 * spacing
        on_edges = (np.abs(np.abs(y) - half) < 1e-9).sum(axis=1)
        assert (on_edges == 3).sum() == 4
        assert (on_edges == 2).sum() == pytest.approx(4 * (half[u] + half[v]) / spacing - 4, abs=2)
        pairs = np.linalg.norm(y[:, None] - y[None], axis=2) + np.eye(len(y))
        assert pairs.min() > 0.6 * spacing


@pytest.mark.parametrize("output_type", ["TRIANGLES", "CURVED_TRIANGLES"])
def test_a_box_as_a_mesh_has_its_area_and_no_holes(output_type):
    """Also of a box that leaves the grid: there the faces end where the grid does."""
    types = {"TRIANGLES": 1, "CURVED_TRIANGLES": 2}
    mesh = slice_of(box(), turned_box((2, 2, 2), HALF), Spacing=0.1, OutputType=types[output_type])
    a, b, c = 2 * HALF
    assert support.array_of(mesh, "Area").sum() == pytest.approx(2 * (a * b + b * c + c * a), rel=1e-6)
    half = np.array([1.0, 1.0, 2.8])  # of the planes z' = -2.8 and 2.8 nothing is in the grid
    grid = box(bent=False)
    mesh = slice_of(grid, turned_box((2, 2, 2), half), Spacing=0.1, OutputType=types[output_type])
    # The same area by a lattice on the box.
    expected = 0.0
    steps = [np.linspace(-1, 1, 801)[:-1] + 1 / 800] * 2
    for axis in range(3):
        u, v = np.delete(np.arange(3), axis)
        y = np.zeros((800 * 800, 3))
        y[:, [u, v]] = np.stack(np.meshgrid(*steps), axis=-1).reshape(-1, 2) * half[[u, v]]
        for end in (-1, 1):
            y[:, axis] = end * half[axis]
            x = y @ TURNED + 2.0
            expected += 4 * half[u] * half[v] * ((x > 0) & (x < 4)).all(axis=1).mean()
    assert support.array_of(mesh, "Area").sum() == pytest.approx(expected, rel=1e-3)


def test_offsets_move_the_faces_of_a_box():
    """Outwards, with sharp edges; where a box has turned inside out there is none."""
    cut, messages = make_slice(box(), turned_box((2, 2, 2), HALF), [-0.95, -0.3, 0.1], Spacing=0.1)
    cut.Update()
    particles = cut.GetOutputDataObject(0)
    offsets = support.array_of(particles, "Isovalue")
    assert sorted(set(offsets)) == [-0.3, 0.1]
    beyond = np.abs((support.points_of(particles) - 2) @ TURNED.T) - HALF - offsets[:, None]
    np.testing.assert_allclose(beyond.max(axis=1), 0.0, atol=1e-9)
    assert messages.errors + messages.warnings == []


def test_a_box_outside_of_the_grid_is_told_once():
    cut, messages = make_slice(box(2), turned_box((20, 20, 20), HALF))
    cut.Update()
    assert messages.errors == [] and len(messages.warnings) == 1 and "no face of the box" in messages.warnings[0]


@pytest.mark.parametrize("properties, word", [({"Method": vtkHighOrderParticleSlice.CLASSIC}, "Fast"), ({"NumberOfParticles": 100}, "NumberOfParticles")])
def test_what_a_box_does_not_take_is_told(properties, word):
    cut, messages = make_slice(box(2), turned_box((1, 1, 1), [0.5] * 3), **properties)
    cut.Update()
    assert cut.GetOutputDataObject(0).GetNumberOfPoints() == 0
    assert len(messages.errors) == 1 and word in messages.errors[0]


def test_boxes_do_not_depend_on_threads_and_keep_blocks():
    blocks = vtkMultiBlockDataSet()
    for b in range(2):
        grid = cells.bend(cells.straight_grid("LAGRANGE_WEDGE", order=3, blocks=2))
        cells.set_points(grid, support.points_of(grid) + [2.0 * b, 0, 0])
        blocks.SetBlock(b, grid)
    outputs = []
    for threads in (1, 2):
        with support.threads(threads):
            output = slice_of(blocks, turned_box((2, 1, 1), [0.7, 0.4, 0.5]), Spacing=0.05)
        outputs.append([support.contents(leaf) for _, _, leaf in support.leaves_of(output)])
        assert min(leaf.GetNumberOfPoints() for _, _, leaf in support.leaves_of(output)) > 300
    assert outputs[0] == outputs[1] and len(outputs[0]) == 2


def test_an_aborted_box_has_no_particles():
    cut, _ = make_slice(box(), turned_box((2, 2, 2), HALF), Spacing=0.1)
    cut.AddObserver("ProgressEvent", lambda *_: 0.4 < cut.GetProgress() < 1 and cut.SetAbortExecute(1))
    cut.Update()
    assert cut.GetAbortExecute() and cut.GetOutput().GetNumberOfPoints() == 0, "three of six faces were done"


@pytest.mark.parametrize("name", ["Plane", "Sphere", "Cylinder"])
def test_proxies_of_paraview_are_followed(name):
    """Their planes have an offset, their cylinders an axis of any direction: both are in no property of VTK's classes."""
    cut = simple.HighOrderParticleSlice(Input=support.source_of(box()))
    cut.SliceType = name
    if name == "Plane":
        cut.SliceType.Origin, cut.SliceType.Normal, cut.SliceType.Offset = [2, 2, 2], list(NORMAL), 0.5
    elif name == "Sphere":
        cut.SliceType.Center, cut.SliceType.Radius = [2, 2, 1.5], 1.25
    else:
        cut.SliceType.Center, cut.SliceType.Radius, cut.SliceType.Axis = [2, 2, 1.5], 1.25, list(NORMAL)
    points = support.points_of(support.output_of(cut))
    assert len(points) > 1000
    center = np.array([2, 2, 2]) + 0.5 * NORMAL if name == "Plane" else np.array([2, 2, 1.5])
    level = 0.0 if name == "Plane" else 1.25
    np.testing.assert_allclose(distances(name.lower(), points, center), level, atol=2e-9)


def test_the_box_of_paraview_is_followed():
    """With its place, rotation and lengths."""
    cut = simple.HighOrderParticleSlice(Input=support.source_of(box()))
    cut.SliceType = "Box"
    cut.SliceType.Position, cut.SliceType.Rotation, cut.SliceType.Length = [1.2, 1.1, 0.9], [20, 0, 10], [1.5, 2.0, 1.0]
    points = support.points_of(support.output_of(cut))
    assert len(points) > 1000
    turn = vtkTransform()
    turn.Translate(1.2, 1.1, 0.9)
    turn.RotateZ(10)
    turn.RotateX(20)
    turn.Scale(1.5, 2.0, 1.0)
    y = np.array([turn.GetInverse().TransformPoint(x) for x in points])
    np.testing.assert_allclose(np.abs(y - 0.5).max(axis=1), 0.5, atol=2e-9)
    for axis in range(3):
        np.testing.assert_allclose([y[:, axis].min(), y[:, axis].max()], [0, 1], atol=2e-9)


def test_a_plane_in_faces_of_cells_is_one_sheet():
    grid = box(bent=False)
    particles = slice_of(grid, plane((0, 0, 2), (0, 0, 1)), AngularDensity=0.0)
    between = slice_of(grid, plane((0, 0, 2.3), (0, 0, 1)), AngularDensity=0.0)
    assert particles.GetNumberOfPoints() == pytest.approx(between.GetNumberOfPoints(), rel=0.01)
    # No second layer, neither whole nor in part.
    assert support.nearest_neighbors(particles).min() > 0.5


def test_blocks_and_linear_cells():
    blocks = vtkMultiBlockDataSet()
    for b in range(2):
        grid = cells.straight_grid("HEXAHEDRON", blocks=2)
        cells.set_points(grid, support.points_of(grid) + [2.0 * b, 0, 0])
        assert grid.GetCellType(0) == VTK_HEXAHEDRON
        blocks.SetBlock(b, grid)
    output = slice_of(blocks, plane((2, 1, 1), (0, 0, 1)), Spacing=0.1)
    counts = [leaf.GetNumberOfPoints() for _, _, leaf in support.leaves_of(output)]
    assert len(counts) == 2 and min(counts) > 300 and abs(counts[0] - counts[1]) < 60


def test_a_moving_plane_keeps_particles_and_forgets_none():
    grid = box()
    function = plane((2, 2, 2))
    cut, messages = make_slice(grid, function)
    cut.Update()
    first = support.contents(cut.GetOutputDataObject(0))
    function.SetOrigin(2.01, 2, 2)
    cut.Update()
    moved = cut.GetOutputDataObject(0)
    x = support.points_of(moved)
    np.testing.assert_allclose((x - [2.01, 2, 2]) @ NORMAL, 0.0, atol=1e-9)
    fresh = slice_of(grid, plane((2.01, 2, 2)))
    assert moved.GetNumberOfPoints() == pytest.approx(fresh.GetNumberOfPoints(), rel=0.03)
    assert support.contents(fresh) == support.contents(slice_of(grid, plane((2.01, 2, 2))))
    assert support.contents(slice_of(grid, plane((2, 2, 2)))) == first
    assert messages.errors + messages.warnings == []


def test_active_scalars_stay_active():
    grid = box()
    grid.GetPointData().SetActiveScalars("f")
    assert slice_of(grid, plane((2, 2, 2))).GetPointData().GetScalars().GetName() == "f"


def quadric():
    return vtkQuadric()


def bent_plane():
    function = plane()
    function.SetTransform(vtkPerspectiveTransform())
    return function


@pytest.mark.parametrize(
    "make, words",
    [
        (lambda: None, "no SliceType"),
        (quadric, "vtkQuadric"),
        (bent_plane, "not linear"),
        (lambda: plane(normal=(0, 0, 0)), "length zero"),
        (lambda: sphere(radius=float("nan")), "not finite"),
        (lambda: cylinder(center=(float("inf"), 0, 0)), "not finite"),
    ],
    ids=["none", "quadric", "perspective", "no normal", "radius nan", "center inf"],
)
def test_functions_that_cannot_be_sliced_along_are_named(make, words):
    cut, messages = make_slice(box(2), make())
    cut.Update()
    assert cut.GetOutputDataObject(0).GetNumberOfPoints() == 0
    assert len(messages.errors) == 1 and words in messages.errors[0], messages.errors


def test_no_offset_is_a_warning():
    cut, messages = make_slice(box(2), plane(), [])
    cut.Update()
    assert messages.errors == [] and len(messages.warnings) == 1 and "SliceOffsetValues" in messages.warnings[0]


def test_properties_are_those_of_the_isosurface(data):
    source = support.read(data("mfem_hex1_p8.vtu"))
    isosurface, cut = simple.HighOrderParticleIsosurface(Input=source), simple.HighOrderParticleSlice(Input=source)
    contoured = {"ContourBy", "Component", "Quantity", "Expression", "Derivatives", "Isosurfaces", "PassDerivatives"}
    assert set(cut.ListProperties()) - {"InputBounds"} == set(isosurface.ListProperties()) - contoured | {"SliceType", "SliceOffsetValues"}
