"""What the filter writes: arrays, structure, order, and that it depends on the input and the seed only."""

import re
import shutil
import subprocess
import time
from pathlib import Path

import numpy as np
import pytest
import support
from highorderparticles import vtkHighOrderParticleIsosurface
from paraview import simple
from paraview.vtk.util.numpy_support import vtk_to_numpy
from vtkmodules import vtkCommonDataModel
from vtkmodules.vtkCommonCore import VTK_DOUBLE, VTK_FLOAT, vtkFloatArray, vtkSMPTools
from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet, vtkDataObject, vtkMultiBlockDataSet, vtkUnstructuredGrid

BLOCK_NAME = vtkCompositeDataSet.NAME()

# What the filter's own table says: {name: number of components}.
OWN_ARRAYS = support.own_arrays(vtkDataObject.POINT)
REPORT = support.own_arrays(vtkDataObject.FIELD)
PROJECT = Path(__file__).resolve().parents[2]


@pytest.fixture
def cylinder(data):
    """480 hexahedra and 472 wedges of order 3."""
    return support.read(data("mfem_cylinder_hex_prism_p3.vtu"))


@pytest.fixture
def channel(data):
    """2,025 tetrahedra of order 3 with vector fields."""
    return support.read(data("ngsolve_cylinder_ns_tet_p3.vtu"))


# A quick surface of several elements, 222 particles.
CYLINDER = {"array": "pressure", "isovalues": -0.5, "Spacing": 13 / 60}


# Arrays


def test_the_outputs_own_arrays_are_those_of_the_table_in_its_order(channel):
    particles = support.run_quietly(channel, "pressure", 0.6)
    grid = support.output_of(channel)
    for table, attributes, of_input in [
        (OWN_ARRAYS, particles.GetPointData(), grid.GetPointData()),
        (REPORT, particles.GetFieldData(), grid.GetFieldData()),
    ]:
        names = [name for name in support.array_list(attributes) if not of_input.HasArray(name)]
        assert [(name, attributes.GetArray(name).GetNumberOfComponents()) for name in names] == list(table.items())
    for name in OWN_ARRAYS:
        array = particles.GetPointData().GetArray(name)
        kinds = {"Cell_Id": "vtkIdTypeArray", "vtkOriginalCellIds": "vtkIdTypeArray", "Normals": "vtkFloatArray"}
        assert array.GetClassName() == kinds.get(name, "vtkDoubleArray"), name
        assert array.GetNumberOfTuples() == particles.GetNumberOfPoints(), name
    assert all(particles.GetFieldData().GetArray(name).GetClassName() == "vtkIdTypeArray" for name in REPORT)
    assert support.array_names(particles.GetPointData()) - set(OWN_ARRAYS) == {"pressure", "velocity", "vorticity"}


def test_both_arrays_of_cell_ids_are_one_in_memory(channel):
    points = support.run_quietly(channel, "pressure", 0.6).GetPointData()
    listed, hidden = (vtk_to_numpy(points.GetArray(name)) for name in ("Cell_Id", "vtkOriginalCellIds"))
    assert np.array_equal(listed, hidden) and len(np.unique(listed)) > 1
    assert np.shares_memory(listed, hidden)


def test_cell_borders_lie_where_particles_of_other_cells_begin(channel):
    particles = support.run_quietly(channel, "pressure", 0.6)
    places, cells = support.points_of(particles), support.array_of(particles, "Cell_Id")
    borders = support.array_of(particles, "Cell_Borders").reshape(-1, 4, 4)
    foot, radius = borders[:, 0, :3], support.array_of(particles, "Radius")
    distance = np.linalg.norm(foot, axis=1)
    assert np.all(distance <= radius * 1.0001) and np.any(distance > 0) and np.any(distance == 0)
    assert np.all(np.abs(np.sum(foot * support.array_of(particles, "Normals"), axis=1)) < 1e-5)
    beside = np.nonzero((distance > 0) & (distance < 0.3 * radius))[0]
    for i in beside[:200]:
        near = np.nonzero(np.linalg.norm(places - places[i], axis=1) < radius[i])[0]
        beyond = (places[near] - places[i]) @ (foot[i] / distance[i]) - distance[i]
        assert np.all(cells[near[beyond > 0.1 * radius[i]]] != cells[i])


def test_every_array_of_the_table_is_explained():
    table = vtkHighOrderParticleIsosurface
    count = table.GetNumberOfOutputArrays()
    assert count == len(OWN_ARRAYS) + len(REPORT), "each name once"
    assert all(table.GetOutputArrayDescription(i).endswith(".") for i in range(count))
    for beyond in (-1, count):
        assert table.GetOutputArrayName(beyond) is None and table.GetOutputArrayDescription(beyond) is None
    assert [name for name in OWN_ARRAYS if not table.IsOwnPointArray(name)] == []
    assert not any(table.IsOwnPointArray(name) for name in REPORT)


@pytest.mark.parametrize("page", ["Documentation/user-guide.md", "Plugin/HighOrderParticleIsosurface.xml"])
def test_pages_for_users_name_every_point_array(page):
    text = (PROJECT / page).read_text()
    assert [name for name in OWN_ARRAYS if not re.search(rf"\b{name}\b", text)] == []


def test_the_class_comment_names_the_arrays_of_the_table():
    comment = (PROJECT / "Filters/vtkHighOrderParticleIsosurface.h").read_text().split("*/")[0]
    assert set(re.findall(r"`(\w+)`", comment)) == {*OWN_ARRAYS, *REPORT}


def test_arrays_hold_what_their_names_say(channel):
    particles = support.run_quietly(channel, "pressure", [0.3, 0.6], Spacing=0.03, AngularDensity=0)
    of = lambda name: support.array_of(particles, name)  # noqa: E731
    np.testing.assert_allclose(np.linalg.norm(of("Normals"), axis=1), 1, atol=2e-7)
    assert np.all(of("Radius") == 0.03)
    assert np.all((of("ParametricCoordinates") >= 0) & (of("ParametricCoordinates") <= 1))
    assert of("Residual").min() >= 0
    # No real surface has more Gauss curvature than the square of its mean curvature.
    assert np.all(of("Gauss_Curvature") <= of("Mean_Curvature") ** 2 * (1 + 1e-9) + 1e-9)
    for name in OWN_ARRAYS:
        assert np.all(np.isfinite(of(name))), name


def test_coordinates_are_double_whatever_the_input_has(data):
    reader = support.read(data("dealii_shell_p3_00.pvtu"))
    assert support.output_of(reader).GetPoints().GetDataType() == VTK_FLOAT
    particles = support.run_quietly(reader, "u", 0.4, Spacing=0.1)
    assert particles.GetPoints().GetDataType() == VTK_DOUBLE
    assert particles.GetPointData().GetArray("u").GetClassName() == "vtkDoubleArray"


def test_one_vertex_cell_a_particle(cylinder):
    particles = support.run_quietly(cylinder, **CYLINDER)
    count = particles.GetNumberOfPoints()
    assert count > 100
    assert particles.GetNumberOfCells() == particles.GetNumberOfVerts() == count
    assert [particles.GetCell(i).GetPointId(0) for i in range(count)] == list(range(count))
    assert all(particles.GetCell(i).GetNumberOfPoints() == 1 for i in range(count))


def test_active_normals_and_scalars(cylinder):
    """ParaView colours by the active scalars at first: not by an array that is constant on the surface."""
    attributes = support.run_quietly(cylinder, **CYLINDER).GetPointData()
    assert attributes.GetNormals().GetName() == "Normals"
    assert attributes.GetScalars() is None
    isovalues = [CYLINDER["isovalues"], CYLINDER["isovalues"] * 1.001]
    several = support.run_quietly(cylinder, **{**CYLINDER, "isovalues": isovalues}).GetPointData()
    assert several.GetScalars().GetName() == "pressure"


def test_report_is_in_the_field_data(cylinder):
    particles = support.run_quietly(cylinder, **CYLINDER)
    assert set(REPORT) <= support.array_names(particles.GetFieldData())
    assert support.reported(particles, "Evaluations") > particles.GetNumberOfPoints()
    assert support.reported(particles, "Iterations") > 0
    cells = support.output_of(cylinder).GetNumberOfCells()
    used = len(np.unique(support.array_of(particles, "vtkOriginalCellIds")))
    assert used <= cells - support.reported(particles, "ElementsDropped") < cells / 2


def test_field_data_of_the_input_stays(data):
    reader = support.read(data("mfem_hex1_p8.vtu"))
    grid = vtkUnstructuredGrid()
    grid.ShallowCopy(support.output_of(reader))
    time = vtkFloatArray()
    time.SetName("TimeValue")
    time.InsertNextValue(2.5)
    grid.GetFieldData().AddArray(time)
    particles = support.run_quietly(grid, "u", 0.2, Spacing=0.2)
    assert particles.GetFieldData().GetArray("TimeValue").GetValue(0) == 2.5


def test_integer_and_unsigned_arrays_are_evaluated_too(channel):
    grid = vtkUnstructuredGrid()
    grid.ShallowCopy(support.output_of(channel))
    x = support.points_of(grid)[:, 0]
    support.add_point_array(grid, "whole", np.full(len(x), 7, dtype=np.int32))
    support.add_point_array(grid, "small", np.full(len(x), 200, dtype=np.uint8))
    particles = support.run_quietly(grid, "pressure", 0.6, Spacing=0.04)
    np.testing.assert_allclose(support.array_of(particles, "whole"), 7, rtol=1e-13)
    np.testing.assert_allclose(support.array_of(particles, "small"), 200, rtol=1e-13)


def copy_with_arrays(channel, points=(), fields=()):
    """The channel with arrays of these names, of 99 throughout."""
    grid = vtkUnstructuredGrid()
    grid.ShallowCopy(support.output_of(channel))
    for name in points:
        support.add_point_array(grid, name, np.full(grid.GetNumberOfPoints(), 99.0))
    for name in fields:
        array = vtkFloatArray()
        array.SetName(name)
        array.InsertNextValue(99.0)
        grid.GetFieldData().AddArray(array)
    return grid


# A warning lists ten names at most.
@pytest.mark.parametrize("points", [list(OWN_ARRAYS)[:7], list(OWN_ARRAYS)[7:14], list(OWN_ARRAYS)[14:]])
def test_point_arrays_of_the_filters_names_give_way_and_are_named(channel, points):
    grid = copy_with_arrays(channel, points=points)
    particles, messages = support.run(grid, "pressure", 0.6, Spacing=0.04, AngularDensity=0)
    assert np.all(support.array_of(particles, "Radius") == 0.04)
    assert not any(np.all(support.array_of(particles, name) == 99) for name in points)
    assert len(messages.warnings) == 1 and messages.errors == []
    # Ids are never passed on.
    assert {name for name in OWN_ARRAYS if f"point array '{name}'" in messages.warnings[0]} == {
        *points
    } - {"vtkOriginalCellIds"}
    assert "Calculator" in messages.warnings[0]


def test_field_arrays_of_the_reports_names_give_way_and_are_named(channel):
    particles, messages = support.run(copy_with_arrays(channel, fields=REPORT), "pressure", 0.6, Spacing=0.04)
    assert support.reported(particles, "Iterations") != 99
    assert len(messages.warnings) == 1
    named = [name for name in REPORT if f"field array '{name}'" in messages.warnings[0]]
    assert len(named) == 10 and f"and {len(REPORT) - len(named)} more" in messages.warnings[0]


def test_a_contoured_array_with_the_name_of_the_isovalues_is_what_it_was(channel):
    grid = copy_with_arrays(channel)
    support.add_point_array(grid, "Isovalue", support.array_of(grid, "pressure"))
    particles = support.run_quietly(grid, "Isovalue", 0.6, Spacing=0.04)
    assert np.all(support.array_of(particles, "Isovalue") == 0.6)


def test_cell_arrays_of_the_filters_names_stay(channel):
    grid = copy_with_arrays(channel)
    support.add_cell_array(grid, "Radius", np.full(grid.GetNumberOfCells(), 99.0))
    particles = support.run_quietly(grid, "pressure", 0.6, Spacing=0.04)
    assert np.all(support.array_of(particles, "Radius", "cell") == 99)


def test_single_precision_values_are_contoured_as_double(channel):
    grid = vtkUnstructuredGrid()
    grid.ShallowCopy(support.output_of(channel))
    support.add_point_array(grid, "single", support.array_of(grid, "pressure").astype(np.float32))
    exact = support.run_quietly(grid, "pressure", 0.6, Spacing=0.04)
    single = support.run_quietly(grid, "single", 0.6, Spacing=0.04)
    assert abs(single.GetNumberOfPoints() / exact.GetNumberOfPoints() - 1) < 0.05
    assert support.array_of(single, "Residual").max() <= 1.001e-8 * support.diagonal(grid)


# Settings


def test_several_isovalues_are_the_single_ones_one_after_the_other(channel):
    values = [0.6, 0.4, 0.8]
    together = support.run_quietly(channel, "pressure", values, Spacing=0.04)
    assert list(dict.fromkeys(support.array_of(together, "Isovalue"))) == values
    for value in values:
        alone = support.run_quietly(channel, "pressure", value, Spacing=0.04).GetNumberOfPoints()
        assert np.sum(support.array_of(together, "Isovalue") == value) == pytest.approx(alone, rel=0.03)
    by_cell = support.array_of(together, "vtkOriginalCellIds").reshape(-1)
    for value in values:
        assert np.all(np.diff(by_cell[support.array_of(together, "Isovalue") == value]) >= 0)
    assert np.array_equal(support.array_of(together, "pressure"), support.array_of(together, "Isovalue"))


def test_automatic_spacing_is_one_hundredth_of_the_longest_side(cylinder):
    automatic = support.run_quietly(cylinder, "pressure", -0.5, Spacing=0, AngularDensity=0)
    assert np.all(support.array_of(automatic, "Radius") == pytest.approx(13 / 100))
    asked = support.run_quietly(cylinder, "pressure", -0.5, Spacing=13 / 100, AngularDensity=0)
    assert automatic.GetNumberOfPoints() == asked.GetNumberOfPoints()


def test_automatic_spacing_where_the_input_was_not_read_before(data):
    """ParaView's own domain would compute a spacing from empty bounds."""
    reader = simple.XMLUnstructuredGridReader(FileName=[data("mfem_cylinder_hex_prism_p3.vtu")])
    proxy = simple.HighOrderParticleIsosurface(Input=reader, ContourBy=["POINTS", "pressure"], Isosurfaces=[-0.5])
    assert proxy.Spacing == 0
    proxy.AngularDensity = 0
    messages = support.Messages(proxy.GetClientSideObject())
    assert np.all(support.array_of(support.output_of(proxy), "Radius") == pytest.approx(13 / 100))
    assert messages.errors + messages.warnings == []


def test_the_panel_shows_the_automatic_spacing_of_an_input_that_was_read(cylinder):
    assert simple.HighOrderParticleIsosurface(Input=cylinder).Spacing == pytest.approx(13 / 100)


def test_half_the_spacing_means_four_times_the_particles(channel):
    coarse, fine = (
        support.run_quietly(channel, "pressure", 0.6, Spacing=h, AngularDensity=0).GetNumberOfPoints()
        for h in (0.02, 0.01)
    )
    # A little less than four times: on boundary curves the number only doubles.
    assert 3.6 <= fine / coarse <= 4.1


def test_default_array_and_isovalue_come_from_the_input(channel):
    particles = support.output_of(simple.HighOrderParticleIsosurface(Input=channel))
    isovalue = support.array_of(particles, "Isovalue")
    # The middle, without what lies at either end of the range.
    low, high = np.quantile(support.array_of(support.output_of(channel), "pressure"), [0.01, 0.99])
    assert len(isovalue) > 0
    np.testing.assert_allclose(isovalue, (low + high) / 2, atol=0.005 * (high - low))  # three digits


@pytest.mark.parametrize("number", [37, 500, 1234])
def test_number_of_particles_is_kept_exactly(data, number):
    reader = support.read(data("mfem_amr_hanging_hex_p3.vtu"))
    particles, messages = support.run(reader, "u", 0.0, NumberOfParticles=number, AngularDensity=0)
    assert messages.errors == []
    # At a spacing of half the radius one particle or another may stand where the surface bends too much for it.
    assert messages.warnings == [] or number == 37 and "bends faster" in messages.warnings[0]
    assert particles.GetNumberOfPoints() == number
    # A sphere of radius 0.6: its area gives the spacing.
    expected = np.sqrt(4 * np.pi * 0.36 / number / (np.sqrt(3) / 2))
    np.testing.assert_allclose(support.array_of(particles, "Radius"), expected, rtol=0.1)
    # No particle is removed where they crowd: at hanging faces, and at a spacing of half the radius.
    assert support.nearest_neighbors(particles).min() > 0.45


@pytest.mark.parametrize("method", ["Fast", "Classic"])
def test_smallest_spacing_bounds_what_angular_density_does(data, method):
    reader = support.read(data("mfem_hex1_p8.vtu"))
    given = {"Spacing": 0.08, "AngularDensity": 15, "Method": method}
    free = support.run_quietly(reader, "u", 0.2, **given)
    smallest = 1.3 * support.array_of(free, "Radius").min()
    bounded = support.run_quietly(reader, "u", 0.2, SmallestSpacing=float(smallest), **given)
    np.testing.assert_allclose(support.array_of(bounded, "Radius").min(), smallest, rtol=1e-5)
    assert bounded.GetNumberOfPoints() < free.GetNumberOfPoints()
    # One below what is wanted anywhere bounds nothing.
    unbounded = support.run_quietly(reader, "u", 0.2, SmallestSpacing=1e-300, **given)
    np.testing.assert_array_equal(support.points_of(unbounded), support.points_of(free))


def test_angular_density_makes_particles_denser_where_the_surface_bends(data):
    reader = support.read(data("mfem_hex1_p8.vtu"))
    even = support.run_quietly(reader, "u", 0.2, Spacing=0.08, AngularDensity=0)
    adapted = support.run_quietly(reader, "u", 0.2, Spacing=0.08, AngularDensity=7)
    assert adapted.GetNumberOfPoints() > 1.2 * even.GetNumberOfPoints()
    mean, gauss = (support.array_of(adapted, f"{kind}_Curvature") for kind in ("Mean", "Gauss"))
    magnitude = np.sqrt(4 * mean**2 - 2 * gauss)  # of both principal curvatures
    wanted = 0.08 / (1 + 7 * magnitude * 0.08 / (2 * np.pi))
    # No larger than wanted, but for single precision and the last step; less beside places that want less.
    radius = support.array_of(adapted, "Radius")
    assert np.all(radius <= wanted * 1.002)
    assert np.median(radius / wanted) > 0.95
    classic = support.run_quietly(reader, "u", 0.2, Spacing=0.08, AngularDensity=7, Method="Classic")
    mean, gauss = (support.array_of(classic, f"{kind}_Curvature") for kind in ("Mean", "Gauss"))
    wanted = 0.08 / (1 + 7 * np.sqrt(4 * mean**2 - 2 * gauss) * 0.08 / (2 * np.pi))
    np.testing.assert_allclose(support.array_of(classic, "Radius"), wanted, rtol=1e-9)
    assert np.quantile(support.nearest_neighbors(adapted), 0.01) > 0.6


@pytest.mark.parametrize("tolerance", [1e-12, 1e-5])
def test_tolerance_holds_for_every_particle(channel, tolerance):
    particles = support.run_quietly(channel, "pressure", 0.6, Spacing=0.03, Tolerance=tolerance)
    assert support.array_of(particles, "Residual").max() <= tolerance * support.diagonal(support.output_of(channel))


def test_the_form_of_the_readme(cylinder):
    from paraview.simple import HighOrderParticleIsosurface

    particles = HighOrderParticleIsosurface(Input=cylinder, ContourBy=["POINTS", "pressure"], Isosurfaces=[-0.5])
    particles.UpdatePipeline()
    assert particles.GetDataInformation().GetNumberOfPoints() > 100
    assert particles.PointData["Mean_Curvature"].GetNumberOfComponents() == 1


# Reproducibility


def test_same_seed_same_bytes_other_seed_other_particles(cylinder):
    first, again, other = (support.run_quietly(cylinder, **CYLINDER, Seed=seed) for seed in (5, 5, 6))
    assert support.contents(first) == support.contents(again)
    assert support.contents(first)["points"] != support.contents(other)["points"]
    assert other.GetNumberOfPoints() == pytest.approx(first.GetNumberOfPoints(), rel=0.1)


@pytest.fixture
def smp():
    """vtkSMPTools; restores its back end and number of threads."""
    backend = vtkSMPTools.GetBackend()
    yield vtkSMPTools
    vtkSMPTools.SetBackend(backend)
    vtkSMPTools.Initialize(0)


def test_threads_change_nothing(cylinder, smp):
    outputs = []
    for backend, threads in [("Sequential", 1), ("STDThread", 1), ("STDThread", 2), ("STDThread", 3)]:
        assert smp.SetBackend(backend)
        smp.Initialize(threads)
        outputs.append(support.contents(support.run_quietly(cylinder, **CYLINDER)))
    assert all(output == outputs[0] for output in outputs[1:])


@pytest.mark.parametrize("backend", ["Sequential", "STDThread"])
def test_the_callers_threads_are_restored(cylinder, smp, backend):
    assert smp.SetBackend(backend)
    smp.Initialize(2)
    threads = smp.GetEstimatedNumberOfThreads()
    support.run_quietly(cylinder, **CYLINDER)
    assert smp.GetBackend() == backend
    assert smp.GetEstimatedNumberOfThreads() == threads


def test_progress_rises_to_one(channel):
    proxy, _ = support.make_filter(channel, "pressure", [0.2, 0.6], Spacing=0.01)
    algorithm = proxy.GetClientSideObject()
    seen = []
    algorithm.AddObserver("ProgressEvent", lambda caller, event: seen.append(caller.GetProgress()))
    proxy.UpdatePipeline()
    assert len(seen) > 4
    assert seen == sorted(seen)
    assert any(0 < p < 0.5 for p in seen) and any(0.5 < p < 1 for p in seen)
    assert 0 <= seen[0] and seen[-1] == 1


def test_the_number_of_particles_is_told_early(channel):
    """Noise makes many: while they are distributed, the text beside the progress says how many."""
    proxy, _ = support.make_filter(channel, "pressure", 0.2, Spacing=0.01)
    algorithm = proxy.GetClientSideObject()
    seen = []
    algorithm.AddObserver("ProgressEvent", lambda *_: seen.append((algorithm.GetProgress(), algorithm.GetProgressText())))
    particles = support.output_of(proxy)
    told = [(progress, text) for progress, text in seen if text and "particles" in text]
    assert told[0][0] < 0.5
    number = int(re.sub("[^0-9]", "", told[0][1]))
    assert told[0][1] == f"Distributing about {number:,} particles"
    assert abs(number / particles.GetNumberOfPoints() - 1) < 0.2


# While cells are converted, particles are relaxed, and arrays are written.
@pytest.mark.parametrize("share", [0.01, 0.2, 0.94])
@pytest.mark.parametrize("as_multiblock", [False, True])
def test_an_aborted_run_ends_early_and_leaves_a_valid_output(channel, as_multiblock, share):
    """Aborts from within a progress event, as the button of ParaView's newest versions does."""
    grid = support.output_of(channel)
    if as_multiblock:
        composite = vtkMultiBlockDataSet()
        composite.SetBlock(0, grid)
        grid = composite
    proxy, _ = support.make_filter(grid, "pressure", [0.4, 0.6], Spacing=0.004)
    algorithm = proxy.GetClientSideObject()
    stop = getattr(algorithm, "SetAbortExecuteAndUpdateTime", lambda: algorithm.SetAbortExecute(1))
    stopped = []

    def stop_there(caller, event):
        if caller.GetProgress() > share and not stopped:
            stop()
            stopped.append(time.monotonic())

    algorithm.AddObserver("ProgressEvent", stop_there)
    proxy.UpdatePipeline()
    assert len(stopped) == 1
    assert time.monotonic() - stopped[0] < 0.5
    output = algorithm.GetOutputDataObject(0)
    assert output.IsA("vtkMultiBlockDataSet" if as_multiblock else "vtkPolyData")
    for leaf in [block for _, _, block in support.leaves_of(output)] if as_multiblock else [output]:
        assert not leaf or leaf.GetNumberOfPoints() == leaf.GetNumberOfVerts() == 0

    begin = time.monotonic()
    algorithm.Update()  # as a view does that wants to draw
    assert time.monotonic() - begin < 0.2
    assert algorithm.GetOutputDataObject(0).GetNumberOfPoints() == 0
    proxy.Seed = 2  # a changed property is a new request
    again = support.output_of(proxy)
    assert again.GetNumberOfPoints() > 10_000
    whole = again.GetBlock(0) if as_multiblock else again
    assert set(support.array_of(whole, "Isovalue")) == {0.4, 0.6}


# Composites, ghosts, seams


def test_multiblock_keeps_its_structure(data):
    torus, bump = (
        support.output_of(support.read(data(f))) for f in ("mfem_torus_wedge_p4.vtu", "mfem_dg_advection_0.vtu")
    )
    for grid, name in ((torus, "f"), (bump, "rho")):
        support.add_point_array(grid, "F", support.array_of(grid, name))
    inner, outer = vtkMultiBlockDataSet(), vtkMultiBlockDataSet()
    inner.SetBlock(0, bump)
    inner.GetMetaData(0).Set(BLOCK_NAME, "bump")
    outer.SetNumberOfBlocks(3)  # the second stays empty
    outer.SetBlock(0, torus)
    outer.GetMetaData(0).Set(BLOCK_NAME, "torus")
    outer.SetBlock(2, inner)

    output = support.run_quietly(outer, "F", 0.3, Spacing=0.08)
    assert output.IsA("vtkMultiBlockDataSet")
    leaves = support.leaves_of(output)
    assert [(index, name) for index, name, _ in leaves] == [(i, name) for i, name, _ in support.leaves_of(outer)]
    assert [leaf is None for _, _, leaf in leaves] == [False, True, False]
    alone = [support.run_quietly(grid, "F", 0.3, Spacing=0.08, Tolerance=1e-12) for grid in (torus, bump)]
    for single, (_, _, leaf) in zip(alone, (leaves[0], leaves[2])):
        assert leaf.IsA("vtkPolyData") and set(REPORT) <= support.array_names(leaf.GetFieldData())
        assert leaf.GetNumberOfPoints() == pytest.approx(single.GetNumberOfPoints(), rel=0.05)


def test_partitioned_data_set_collection_keeps_its_structure(data):
    torus, ball = support.read(data("mfem_torus_wedge_p4.vtu")), support.read(data("mfem_hex1_p8.vtu"))
    torus = simple.Calculator(Input=torus, Function="f", ResultArrayName="u")
    group = simple.GroupDatasets(Input=[torus, ball], BlockNames=["torus", "one cell"])
    group.OutputType = "vtkPartitionedDataSetCollection"
    output = support.run_quietly(group, "u", 0.25, Spacing=0.1)
    assert output.IsA("vtkPartitionedDataSetCollection")
    assert output.GetNumberOfPartitionedDataSets() == 2
    assert [output.GetMetaData(i).Get(BLOCK_NAME) for i in range(2)] == ["torus", "one cell"]
    assert all(output.GetPartition(i, 0).GetNumberOfPoints() > 20 for i in range(2))


def half_ghosts(data):
    """A grid, and which of its cells are ghosts."""
    grid = support.output_of(support.read(data("mfem_amr_hanging_hex_p3.vtu")))
    ghost = support.middles_of(grid)[:, 0] > 0.1
    support.add_cell_array(grid, "vtkGhostType", ghost.astype(np.uint8))  # 1: DUPLICATECELL
    return grid, ghost


@pytest.mark.parametrize("method", ["Fast", "Classic"])
def test_ghost_cells_are_as_if_they_were_not_there(data, method):
    grid, ghost = half_ghosts(data)
    asked = {"Spacing": 0.06, "Method": method}
    half = support.run_quietly(grid, "u", 0.0, **asked)
    own = np.flatnonzero(~ghost)
    alone = support.run_quietly(support.cells_of(grid, own), "u", 0.0, **asked)
    assert alone.GetNumberOfPoints() > 100
    assert np.array_equal(support.points_of(half), support.points_of(alone))
    assert np.array_equal(
        support.array_of(half, "vtkOriginalCellIds"), own[support.array_of(alone, "vtkOriginalCellIds")])
    assert "vtkGhostType" not in support.array_names(half.GetPointData()) | support.array_names(half.GetCellData())


def test_a_given_number_is_that_of_particles_outside_ghost_cells(data):
    grid, _ = half_ghosts(data)
    particles = support.run_quietly(grid, "u", 0.0, NumberOfParticles=1000, AngularDensity=0)
    assert particles.GetNumberOfPoints() == 1000


@pytest.mark.parametrize("kind, owned", [(2, True), (4, True), (8, False), (16, True), (32, False)])
def test_of_all_that_ghost_types_say_only_some_make_ghosts(data, kind, owned):
    """High and low connectivity, refined, exterior and hidden cells."""
    grid = support.output_of(support.read(data("mfem_amr_hanging_hex_p3.vtu")))
    whole = support.run_quietly(grid, "u", 0.0, Spacing=0.06)
    support.add_cell_array(grid, "vtkGhostType", np.full(grid.GetNumberOfCells(), kind, np.uint8))
    particles, messages = support.run(grid, "u", 0.0, Spacing=0.06)
    assert particles.GetNumberOfPoints() == (whole.GetNumberOfPoints() if owned else 0)
    assert messages.errors == [] and len(messages.warnings) <= (0 if owned else 1)


def with_nodes_of_its_own(grid):
    """The same cells, each with its own nodes."""
    cells, order = [], []
    for id in range(grid.GetNumberOfCells()):
        cell = grid.GetCell(id)
        ids = [cell.GetPointId(n) for n in range(cell.GetNumberOfPoints())]
        cells.append((cell.GetCellType(), range(len(order), len(order) + len(ids))))
        order += ids
    copy = support.grid_of_cells(support.points_of(grid)[order], cells)
    return copy, order


def test_shared_and_duplicated_nodes_give_the_same_particles(data):
    shared = support.output_of(support.read(data("dolfinx_tet_p3.vtu")))
    duplicated, order = with_nodes_of_its_own(shared)
    support.add_point_array(duplicated, "u", support.array_of(shared, "u")[order])
    assert duplicated.GetNumberOfPoints() == 384 * 20
    a, b = (support.run(grid, "u", 0.5, Spacing=0.04)[0] for grid in (shared, duplicated))
    assert a.GetNumberOfPoints() > 300
    assert support.points_of(a).tobytes() == support.points_of(b).tobytes()


def test_single_precision_noise_between_duplicated_nodes_does_not_tear_the_surface(data):
    shared = support.output_of(support.read(data("dolfinx_tet_p3.vtu")))
    noisy, order = with_nodes_of_its_own(shared)
    support.add_point_array(noisy, "u", support.array_of(shared, "u")[order])
    points = support.points_of(noisy)
    noise = np.random.default_rng(1).uniform(-1, 1, points.shape) * 1.2e-7 * np.abs(points).max()
    for i, point in enumerate(points + noise):
        noisy.GetPoints().SetPoint(i, point)
    a, b = (support.run(grid, "u", 0.5, Spacing=0.04)[0] for grid in (shared, noisy))
    assert b.GetNumberOfPoints() == pytest.approx(a.GetNumberOfPoints(), rel=0.02)


# Kinds of cells


# Type, degrees if it is a Lagrange cell, points
KINDS = {
    "tetrahedron": ("vtkTetra", None, 4),
    "voxel": ("vtkVoxel", None, 8),
    "hexahedron": ("vtkHexahedron", None, 8),
    "wedge": ("vtkWedge", None, 6),
    "quadratic tetrahedron": ("vtkQuadraticTetra", None, 10),
    "triquadratic hexahedron": ("vtkTriQuadraticHexahedron", None, 27),
    "biquadratic-quadratic wedge": ("vtkBiQuadraticQuadraticWedge", None, 18),
    "Lagrange hexahedron of order 2": ("vtkLagrangeHexahedron", (2, 2, 2), 27),
    "Lagrange hexahedron of order 10": ("vtkLagrangeHexahedron", (10, 10, 10), 1331),
    "Lagrange hexahedron of degrees 4, 2, 3": ("vtkLagrangeHexahedron", (4, 2, 3), 60),
    "Lagrange wedge of order 3": ("vtkLagrangeWedge", (3, 3, 3), 40),
    "Lagrange wedge of degrees 3, 3, 2": ("vtkLagrangeWedge", (3, 3, 2), 30),
    "Lagrange wedge of degrees 2, 2, 5": ("vtkLagrangeWedge", (2, 2, 5), 36),
}


def nodes_of(kind):
    """Cell type and parametric coordinates of the nodes, in VTK's order."""
    class_name, degrees, count = KINDS[kind]
    cell = getattr(vtkCommonDataModel, class_name)()
    if degrees is None:
        return cell.GetCellType(), np.reshape(cell.GetParametricCoords(), (-1, 3))
    nodes = np.full((count, 3), np.nan)
    for i, j, k in np.ndindex(*(p + 1 for p in degrees)):
        if class_name == "vtkLagrangeHexahedron" or i + j <= degrees[0]:
            nodes[cell.PointIndexFromIJK(i, j, k, [*degrees, count])] = np.array([i, j, k]) / degrees
    assert not np.any(np.isnan(nodes))
    return cell.GetCellType(), nodes


def bend(u):
    """From parametric to world coordinates: curved, but the same along a shared face u_x = 0 or 1."""
    x, y, z = u.T
    return np.c_[x + 0.15 * y * z, 1.2 * y + 0.1 * z * (1 - z), z + 0.1 * y * y]


def one_cell(kind, place):
    """A grid of one cell, each node u of it at place(u); degrees are given where they differ."""
    cell_type, nodes = nodes_of(kind)
    grid = support.grid_of_cells(place(nodes), [(cell_type, range(len(nodes)))])
    give_degrees(grid, KINDS[kind][1])
    return grid


def give_degrees(grid, degrees):
    if degrees is not None and len(set(degrees)) > 1:
        table = np.array([degrees] * grid.GetNumberOfCells(), dtype=float)
        grid.GetCellData().SetHigherOrderDegrees(support.add_cell_array(grid, "HigherOrderDegrees", table))


PLANE = np.array([0.6, 0.48, 0.64])  # unit normal


@pytest.mark.parametrize("kind", KINDS)
def test_a_linear_function_on_a_bent_cell_has_a_plane(kind):
    """Cells are isoparametric: whatever their shape, they hold linear functions of x exactly."""
    box = kind == "voxel"  # which cannot bend
    grid = one_cell(kind, (lambda u: u) if box else bend)
    support.add_point_array(grid, "F", support.points_of(grid) @ PLANE)
    particles = support.run_quietly(grid, "F", 0.5, Spacing=0.05)
    points = support.points_of(particles)
    assert len(points) > 100
    np.testing.assert_allclose(points @ PLANE, 0.5, atol=1.001e-8 * support.diagonal(grid))
    np.testing.assert_allclose(support.array_of(particles, "Normals"), -np.tile(PLANE, (len(points), 1)), atol=1e-7)
    for name in ("Mean_Curvature", "Gauss_Curvature"):
        np.testing.assert_allclose(support.array_of(particles, name), 0, atol=1e-6)
    positions, _, _ = support.evaluate_by_vtk(grid, particles, ["F"])
    np.testing.assert_allclose(points, positions, atol=1e-12)
    nearest = support.nearest_neighbors(particles)
    assert nearest.min() > 0.5 and np.quantile(nearest, 0.05) > 0.7  # closer in acute corners


@pytest.mark.parametrize("kind", [kind for kind, (_, _, count) in KINDS.items() if count > 8])
def test_a_quadratic_function_on_a_straight_cell_has_a_sphere(kind):
    grid = one_cell(kind, lambda u: u)
    support.add_point_array(grid, "F", np.sum(support.points_of(grid) ** 2, axis=1))
    particles = support.run_quietly(grid, "F", 0.49, Spacing=0.05)
    points = support.points_of(particles)
    assert len(points) > 50
    np.testing.assert_allclose(np.linalg.norm(points, axis=1), 0.7, atol=2e-8)
    np.testing.assert_allclose(support.array_of(particles, "Normals"), -points / 0.7, atol=1e-7)
    np.testing.assert_allclose(support.array_of(particles, "Mean_Curvature"), -1 / 0.7, rtol=1e-6)
    np.testing.assert_allclose(support.array_of(particles, "Gauss_Curvature"), 1 / 0.49, rtol=1e-6)
    x, y, z = points.T / 0.7
    derivative = np.column_stack([x * x - 1, y * y - 1, z * z - 1, x * y, y * z, x * z]) / 0.7
    np.testing.assert_allclose(support.array_of(particles, "Shape_Operator"), derivative, atol=1e-6)


@pytest.mark.parametrize("kind", ["Lagrange hexahedron of degrees 4, 2, 3", "Lagrange wedge of degrees 3, 3, 2"])
def test_cells_of_uneven_degrees_join_where_they_meet(kind):
    """A row of three along z, each with nodes of its own: the plane runs through as one sheet."""
    cell_type, nodes = nodes_of(kind)
    points = np.concatenate([bend(nodes) + [0, 0.1 * layer, layer] for layer in range(3)])
    cells = [(cell_type, range(n * len(nodes), (n + 1) * len(nodes))) for n in range(3)]
    grid = support.grid_of_cells(points, cells)
    give_degrees(grid, KINDS[kind][1])
    support.add_point_array(grid, "F", points @ [1.0, 0.0, 0.0])
    particles = support.run_quietly(grid, "F", 0.4, Spacing=0.06)
    assert set(support.array_of(particles, "vtkOriginalCellIds")) == {0, 1, 2}
    np.testing.assert_allclose(support.points_of(particles)[:, 0], 0.4, atol=1e-7)
    # Boundary curves on the inner faces would double the particles there.
    assert support.nearest_neighbors(particles).min() > 0.6


@pytest.mark.parametrize(
    "cell_type",
    ["Tet", "Hex", "Wedge", "Quadratic Tet", "Lagrange Tetrahedron", "Lagrange Hexahedron", "Lagrange Wedge"],
)
def test_paraviews_own_source_of_cells(cell_type):
    """Cells of ParaView's own source; their field is roughly the distance to (2, 2, 2)."""
    grid = support.output_of(
        simple.UnstructuredCellTypes(CellType=cell_type, BlocksDimensions=[4, 4, 4], CellOrder=3)
    )
    particles, messages = support.run(grid, "DistanceToCenter", 1.2, Spacing=0.15)
    assert messages.errors == []
    assert not any("cell" in text for text in messages.warnings)
    points = support.points_of(particles)
    assert len(points) > 300
    positions, values, gradients = support.evaluate_by_vtk(grid, particles, ["DistanceToCenter"])
    np.testing.assert_allclose(points, positions, atol=1e-12)
    residual = np.abs(values["DistanceToCenter"] - 1.2) / np.linalg.norm(gradients, axis=1)
    assert residual.max() <= 1.001e-8 * support.diagonal(grid)
    # All around: six ends of the sphere, to the error of cells of size 1.
    for axis in np.vstack([np.eye(3), -np.eye(3)]):
        assert ((points - 2) @ axis).max() == pytest.approx(1.2, abs=0.2)


# Series, batch, ranks


def test_time_series(data, tmp_path):
    (tmp_path / "series.pvd").write_text(
        "<VTKFile type='Collection' version='0.1'><Collection>"
        + "".join(
            f"<DataSet timestep='{t}' part='0' file='{data(file)}'/>"
            for t, file in enumerate(["mfem_hex1_p8.vtu", "mfem_amr_hanging_hex_p3.vtu"])
        )
        + "</Collection></VTKFile>"
    )
    reader = simple.PVDReader(FileName=str(tmp_path / "series.pvd"), PointArrays=["u"])
    reader.UpdatePipeline(0.0)
    proxy, messages = support.make_filter(reader, "u", 0.2, Spacing=0.1)
    counts, cells = [], []
    for time in (0.0, 1.0, 0.0):
        proxy.UpdatePipeline(time)
        particles = proxy.GetClientSideObject().GetOutputDataObject(0)
        counts.append(particles.GetNumberOfPoints())
        cells.append(support.array_of(particles, "vtkOriginalCellIds").max())
    assert messages.errors == []
    assert counts[0] == counts[2] > 50 and counts[1] > 50
    assert cells[0] == cells[2] == 0 and cells[1] > 0


# Every rank runs it and writes how many particles it has, and how many cells.
SCRIPT = """
import sys
from paraview import servermanager, simple
plugin, path, folder = sys.argv[1:]
simple.LoadPlugin(plugin, remote=False, ns=globals())
reader = simple.XMLPartitionedUnstructuredGridReader(FileName=[path])
particles = HighOrderParticleIsosurface(Input=reader, ContourBy=['POINTS', 'u'], Isosurfaces=[0.4], Spacing=SPACING)
particles.UpdatePipeline()
mine = [p.GetClientSideObject().GetOutputDataObject(0) for p in (particles, reader)]
rank = servermanager.vtkProcessModule.GetProcessModule().GetPartitionId()
with open(f"{folder}/rank{rank}.txt", "w") as file:
    file.write(f"{mine[0].GetNumberOfPoints()} {mine[1].GetNumberOfCells()}")
"""


def run_batch(launcher, plugin, path, folder, spacing):
    """SCRIPT's particles and cells, (ranks, 2)."""
    script = folder / "script.py"
    script.write_text(SCRIPT.replace("SPACING", str(spacing)))
    command = [*launcher, str(script), str(plugin), path, str(folder)]
    done = subprocess.run(
        command, env=support.environment_of_ranks(), capture_output=True, text=True, timeout=200)
    said = done.stdout + done.stderr
    assert done.returncode == 0, said
    assert "ERR|" not in said and "WARN|" not in said, said
    return np.array([np.loadtxt(file, dtype=int) for file in sorted(folder.glob("rank*.txt"))])


def program(name):
    path = shutil.which(name)
    if path is None:
        pytest.skip(f"no {name} here")
    return path


# With Spacing 0 each rank has to find the spacing of the whole grid, not of its own pieces.
@pytest.mark.parametrize("spacing", [0.1, 0])
def test_pvbatch_alone_and_on_two_ranks(data, plugin, tmp_path, spacing):
    path = data("dealii_shell_p3_00.pvtu")
    here = support.run_quietly(support.read(path), "u", 0.4, Spacing=spacing).GetNumberOfPoints()
    pvbatch, mpirun = program("pvbatch"), program("mpirun")
    assert run_batch([pvbatch], plugin, path, tmp_path, spacing).tolist() == [[here, 236]]
    ranks = run_batch([mpirun, "-np", "2", "--oversubscribe", pvbatch, "--sym"], plugin, path, tmp_path, spacing)
    particles, cells = ranks.T
    assert cells.sum() == 236 and np.all(cells > 0) and np.all(particles > 0)
    # Without ghost cells the surface ends on both sides of the cut between pieces: a few more particles, no fewer.
    assert here <= particles.sum() <= 1.12 * here
