"""Isosurfaces of derived fields in time series and composites, in runs that go on from the last one, and in runs that
cannot be."""

import time

import cells
import numpy as np
import pytest
import support
from paraview import simple
from test_blocks import multiblock, together
from test_derived import derived, gradients_at
from test_series_and_pieces import FILES
from vtkmodules.vtkCommonDataModel import vtkUnstructuredGrid

# Of cells of order 3 with a smooth vector u and a scalar p.
Q = {"array": "u", "isovalues": 0.3, "Quantity": "Q Criterion", "Spacing": 0.1, "AngularDensity": 0}
FORMULA = {**Q, "array": "p", "isovalues": 1.3, "Quantity": "Expression", "Expression": "q_criterion(u) + p"}


def with_arrays(grid):
    x = support.points_of(grid)
    support.add_point_array(grid, "u", np.sin(2.0 * x[:, [1, 2, 0]]) + 0.3 * x[:, [2, 0, 1]] ** 2)
    support.add_point_array(grid, "p", np.cos(x).sum(axis=1) / 3.0)
    return grid


@pytest.fixture(scope="module")
def whole():
    grid = cells.straight_grid("LAGRANGE_HEXAHEDRON", order=3, blocks=2)
    lower, upper = support.bounds_of(grid)
    x = 2.0 * (support.points_of(grid) - lower) / (upper - lower) - 1.0
    cells.set_points(grid, x + 0.05 * np.sin(2.0 * x[:, [1, 2, 0]]))
    support.add_point_array(grid, "u", x)
    return with_arrays(support.cells_of(grid, range(grid.GetNumberOfCells())))


@pytest.fixture(scope="module")
def halves(whole):
    return [with_arrays(support.cells_of(whole, ids)) for ids in (range(4), range(4, 8))]


def copy_of(grid, without=()):
    copy = vtkUnstructuredGrid()
    copy.DeepCopy(grid)
    for name in without:
        copy.GetPointData().RemoveArray(name)
    return copy


def test_every_step_of_a_series_has_its_own_quantity(data):
    series = simple.PVDReader(FileName=data("mfem_dg_advection.pvd"))
    series.UpdatePipelineInformation()
    properties = {"Quantity": "Gradient Magnitude", "Spacing": 0.1, "AngularDensity": 0}
    surface, messages = support.make_filter(series, "rho", 0.8, WarmStart=False, **properties)
    times = list(series.TimestepValues)
    outputs = []
    for time, file in zip(times + times[:1], FILES + FILES[:1]):  # and back to the start
        surface.UpdatePipeline(time)
        step = surface.GetClientSideObject().GetOutputDataObject(0)
        alone = support.run(support.read(data(file)), "rho", 0.8, **properties)[0]
        assert step.GetNumberOfPoints() > 50
        outputs.append(support.contents(step))
        assert outputs[-1] == support.contents(alone)
    assert outputs[0] == outputs[3] != outputs[1]
    assert messages.errors == []


@pytest.mark.parametrize("properties", [Q, FORMULA], ids=["Q Criterion", "Expression"])
def test_blocks_are_one_mesh(whole, halves, properties):
    alone = support.run(whole, **properties)[0]
    output = together(support.run(multiblock(*halves), **properties)[0])
    assert alone.GetNumberOfPoints() > 200
    assert np.array_equal(support.points_of(output), support.points_of(alone))


@pytest.mark.parametrize("properties", [Q, FORMULA], ids=["Q Criterion", "Expression"])
@pytest.mark.parametrize("place", [0, 1])
def test_a_block_without_the_array_leaves_the_other_right(halves, properties, place):
    """Also where it is the first one."""
    blocks = list(halves)
    blocks[place] = copy_of(blocks[place], without=["u"])
    alone = support.run(halves[1 - place], **properties)[0]
    output, messages = support.run(multiblock(*blocks, names=["first", "second"]), **properties)
    assert messages.errors == []
    assert any("Without particles are" in text and ("first", "second")[place] in text for text in messages.warnings)
    assert alone.GetNumberOfPoints() > 100
    # Its bounds are those of both, by which lengths are rounded.
    points, expected = support.points_of(together(output)), support.points_of(alone)
    assert points.shape == expected.shape
    assert np.abs(points - expected).max() < 1e-7


def test_no_block_with_all_arrays_is_told(halves):
    blocks = [copy_of(halves[0], without=["u"]), copy_of(halves[1], without=["p"])]
    output, messages = support.run(multiblock(*blocks), **FORMULA)
    assert together(output).GetNumberOfPoints() == 0
    assert any("Without particles are" in text for text in messages.warnings)


def test_particles_follow_an_isovalue_of_the_quantity(whole):
    """A tenth of the spacing away most of them go on, and stand on the surface."""
    surface, messages = support.make_filter(whole, **Q, WarmStart=True)
    before = support.points_of(support.output_of(surface))
    surface.Isosurfaces = [0.31]
    particles = support.output_of(surface)
    after = support.points_of(particles)
    scratch = support.run(whole, **{**Q, "isovalues": 0.31})[0]
    nearest = [np.linalg.norm(after - x, axis=1).min() for x in before]
    by_chance = [np.linalg.norm(support.points_of(scratch) - x, axis=1).min() for x in before]
    assert np.median(nearest) < 0.5 * np.median(by_chance)
    ids, places = (support.array_of(particles, name) for name in ("vtkOriginalCellIds", "ParametricCoordinates"))
    values = derived("Q Criterion", gradients_at(whole, "u", ids, places))
    assert np.abs(values - 0.31).max() < 1e-8
    assert messages.errors == []


# Property by property: what the field is, and another field with another isovalue.
OTHER_FIELDS = {
    "quantity": ({"Quantity": "Vorticity Magnitude"}, {"Quantity": "Gradient Magnitude"}),
    "derivatives": ({"Quantity": "Gradient Magnitude"}, {"Derivatives": "Averaged At Nodes"}),
    "averages": ({}, {"Quantity": "Gradient Magnitude", "Derivatives": "Averaged At Nodes"}),
    "formula": ({"Quantity": "Expression", "Expression": "mag(u)"}, {"Expression": "mag(u) + p"}),
}


@pytest.mark.parametrize("change", OTHER_FIELDS)
def test_another_field_starts_anew(whole, change):
    first, second = OTHER_FIELDS[change]
    array = "p" if change == "averages" else "u"
    some = {"Spacing": 0.2, "AngularDensity": 0}
    values = (0.8, 0.4) if change == "averages" else (1.5, 1.6)
    surface, _ = support.make_filter(whole, array, values[0], WarmStart=True, **some, **first)
    assert support.output_of(surface).GetNumberOfPoints() > 20
    for name, value in second.items():
        setattr(surface, name, value)
    surface.Isosurfaces = [values[1]]
    output = support.output_of(surface)
    assert output.GetNumberOfPoints() > 20
    scratch = support.run(whole, array, values[1], **some, **{**first, **second})[0]
    assert support.contents(output) == support.contents(scratch)


WRONG = {
    "a scalar": ("p", {"Quantity": "Q Criterion"}, "three components"),
    "no formula": ("u", {"Quantity": "Expression", "Expression": ""}, "Expression is empty"),
    "half a formula": ("u", {"Quantity": "Expression", "Expression": "2 * (q_criterion(u)"}, "cannot be contoured"),
    "another array's name": ("u", {"Quantity": "Expression", "Expression": "curl(w)"}, "no point array 'w'"),
}


@pytest.mark.parametrize("what", WRONG)
def test_what_is_wrong_is_told_before_any_work_and_can_be_mended(whole, what):
    array, properties, word = WRONG[what]
    surface, messages = support.make_filter(whole, **{**Q, "array": array, **properties})
    algorithm = surface.GetClientSideObject()
    progress = []
    algorithm.AddObserver("ProgressEvent", lambda *_: progress.append(algorithm.GetProgress()))
    assert support.output_of(surface).GetNumberOfPoints() == 0
    assert len(messages.errors) == 1 and word in messages.errors[0]
    assert not set(progress) - {0.0, 1.0}, "no cell was looked at"
    surface.ContourBy = ["POINTS", "u"]
    surface.Quantity = "Q Criterion"
    assert support.output_of(surface).GetNumberOfPoints() > 200
    assert len(messages.errors) == 1


def test_a_run_that_is_stopped_ends_while_cells_are_derived():
    """And not after all of them: here they take most of the time."""
    grid = with_arrays(cells.bend(cells.straight_grid("LAGRANGE_HEXAHEDRON", order=3, blocks=6), 0.02))
    surface, _ = support.make_filter(grid, **{**Q, "Quantity": "Lambda 2", "isovalues": -0.3, "Spacing": 1.0})
    algorithm = surface.GetClientSideObject()
    stop = getattr(algorithm, "SetAbortExecuteAndUpdateTime", lambda: algorithm.SetAbortExecute(1))
    stopped = []

    def stop_at_once(*_):
        if not stopped:
            stop()
            stopped.append((algorithm.GetProgress(), time.monotonic()))

    algorithm.AddObserver("ProgressEvent", stop_at_once)
    begin = time.monotonic()
    assert support.output_of(surface).GetNumberOfPoints() == 0
    assert stopped[0][0] < 0.03, "while cells are judged and derived"
    assert time.monotonic() - stopped[0][1] < 0.3
    ended = time.monotonic() - begin
    surface.Seed = 2
    begin = time.monotonic()
    assert support.output_of(surface).GetNumberOfPoints() > 100
    assert ended < 0.5 * (time.monotonic() - begin)


def test_one_cell_that_takes_long_can_be_stopped():
    """The parts of a noisy cell take hundreds of times as long as a smooth cell."""
    grid = cells.straight_grid("LAGRANGE_HEXAHEDRON", order=5, blocks=1)
    noise = np.random.default_rng(3).normal(size=(grid.GetNumberOfPoints(), 3))
    support.add_point_array(grid, "u", noise)
    surface, _ = support.make_filter(grid, **{**Q, "Quantity": "Lambda 2", "isovalues": -0.5, "Spacing": 10.0})
    algorithm = surface.GetClientSideObject()
    heard = []
    algorithm.AddObserver("ProgressEvent", lambda *_: heard.append((algorithm.GetProgress(), time.monotonic())))
    support.output_of(surface)
    times = [at for progress, at in heard if progress < 0.03]
    times += [next(at for progress, at in heard if progress >= 0.03)]
    assert times[-1] - times[0] > 0.2, "cells are derived for a time that can be measured"
    assert np.diff(times).max() < 0.4 * (times[-1] - times[0])


@pytest.mark.parametrize("output_type", ["Particles", "Triangles", "Curved Triangles"])
@pytest.mark.parametrize("quantity, isovalue", [("Q Criterion", 0.3), ("Lambda 2", -0.3)])
def test_derivatives_are_passed_in_every_type_of_output(whole, halves, quantity, isovalue, output_type):
    """Those of each point's own cell, also of nodes between corners."""
    properties = {**Q, "Quantity": quantity, "isovalues": isovalue, "PassDerivatives": 1, "OutputType": output_type}
    alone = support.run(whole, **properties)[0]
    ids, places = (support.array_of(alone, name) for name in ("vtkOriginalCellIds", "ParametricCoordinates"))
    expected = gradients_at(whole, "u", ids, places)
    size = np.abs(expected).max()
    gradients = support.array_of(alone, "Gradient").reshape(-1, 3, 3)
    assert len(ids) > 200
    assert np.abs(gradients - expected).max() < 1e-9 * size
    vorticity = np.linalg.norm(support.array_of(alone, "Vorticity"), axis=1)
    assert np.abs(vorticity - derived("Vorticity Magnitude", expected)).max() < 1e-9 * size
    criterion = support.array_of(alone, "Q_Criterion")
    assert np.abs(criterion - derived("Q Criterion", expected)).max() < 1e-9 * size**2
    # In blocks, too: of the cell that a row names, or, at copies of corners from the other block, of the corner's cell.
    at = {}
    for x, g in zip(support.points_of(alone), gradients):
        at.setdefault(x.tobytes(), []).append(g)
    output = support.run(multiblock(*halves), **properties)[0]
    for half, (_, _, block) in zip(halves, support.leaves_of(output)):
        ids, places = (support.array_of(block, name) for name in ("vtkOriginalCellIds", "ParametricCoordinates"))
        named = gradients_at(half, "u", ids, places)
        gradients = support.array_of(block, "Gradient").reshape(-1, 3, 3)
        assert len(ids) > 80
        for x, g, own in zip(support.points_of(block), gradients, named):
            assert min(np.abs(g - other).max() for other in (own, *at.get(x.tobytes(), []))) < 1e-9 * size
