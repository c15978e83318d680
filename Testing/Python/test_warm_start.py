"""Particles go on from run to run where only an isovalue or the time step changed."""

import numpy as np
import pytest
from paraview import simple
from support import (
    array_of, contents, make_filter, nearest_neighbors, output_of, points_of, read, reported, run_quietly)
from vtkmodules.vtkCommonDataModel import vtkStaticPointLocator

SPACING = 0.05


@pytest.fixture
def hexahedron(data):
    return read(data("mfem_hex1_p8.vtu"))


def stayed(before, after, distance):
    """Share of the earlier particles that have a later particle within the distance."""
    locator = vtkStaticPointLocator()
    locator.SetDataSet(after)
    locator.BuildLocator()
    found = [locator.FindClosestPoint(point) for point in points_of(before)]
    return np.mean(np.linalg.norm(points_of(before) - points_of(after)[found], axis=1) < distance)


def expect_as_good(particles, scratch):
    count, wanted = particles.GetNumberOfPoints(), scratch.GetNumberOfPoints()
    assert count == pytest.approx(wanted, rel=0.03)
    assert array_of(particles, "Residual").max() <= 1e-9
    # The distance of the nearest pair alone, 0.60 to 0.80 at any isovalue, is chance in runs from scratch as well.
    assert nearest_neighbors(particles).min() > 0.55
    for quantile in (0.02, 0.1, 0.5):
        asked, other = (np.quantile(nearest_neighbors(some), quantile) for some in (particles, scratch))
        assert asked > 0.97 * other, f"quantile {quantile}"


def test_an_isovalue_is_followed(hexahedron):
    surface, messages = make_filter(hexahedron, "u", 0.2, Spacing=SPACING)
    before, shares = None, []
    for isovalue in (0.2, 0.21, 0.23, 0.26, 0.24, 0.2):
        surface.Isosurfaces = [isovalue]
        particles = output_of(surface).NewInstance()
        particles.DeepCopy(output_of(surface))
        scratch = run_quietly(hexahedron, "u", isovalue, Spacing=SPACING, WarmStart=False)
        expect_as_good(particles, scratch)
        if before is not None:
            shares.append([stayed(before, after, 0.25 * SPACING) for after in (particles, scratch)])
        before = particles
    # The surface itself moves, in some steps by more than this distance.
    followed, by_chance = np.mean(shares, axis=0)
    assert followed > 1.5 * by_chance
    assert messages.errors + messages.warnings == []


def test_time_steps_are_followed(data):
    series = simple.PVDReader(FileName=data("mfem_dg_advection.pvd"))
    series.UpdatePipelineInformation()
    between = simple.TemporalInterpolator(Input=series)
    first, second = series.TimestepValues[:2]
    surface, messages = make_filter(between, "rho", 0.3, Spacing=0.06)
    for share in (0.0, 0.02, 0.04):
        surface.UpdatePipeline(first + share * (second - first))
        particles = surface.GetClientSideObject().GetOutputDataObject(0)
        grid = between.GetClientSideObject().GetOutputDataObject(0)
        alone = run_quietly(grid, "rho", 0.3, Spacing=0.06)
        expect_as_good(particles, alone)
        assert (contents(particles) == contents(alone)) == (share == 0.0)
    assert messages.errors + messages.warnings == []


def test_a_surface_that_has_gone_far_is_begun_anew(data):
    series = simple.PVDReader(FileName=data("mfem_dg_advection.pvd"))
    series.UpdatePipelineInformation()
    surface, messages = make_filter(series, "rho", 0.3, Spacing=0.06)
    for time, step in zip(series.TimestepValues, (0, 2, 4)):
        surface.UpdatePipeline(time)
        particles = surface.GetClientSideObject().GetOutputDataObject(0)
        alone = run_quietly(read(data(f"mfem_dg_advection_{step}.vtu")), "rho", 0.3, Spacing=0.06)
        assert contents(particles) == contents(alone)
    assert messages.errors + messages.warnings == []


def test_what_did_not_change_gives_the_same_again(hexahedron):
    surface, _ = make_filter(hexahedron, "u", 0.2, Spacing=SPACING)
    first = contents(output_of(surface))
    surface.GetClientSideObject().Modified()
    surface.GetClientSideObject().Update()
    assert contents(output_of(surface)) == first
    surface.Spacing = 2 * SPACING
    assert len(contents(output_of(surface))["points"]) < len(first["points"])
    surface.Spacing = SPACING
    assert contents(output_of(surface)) == first


def test_switched_off_the_output_depends_on_the_input_only(hexahedron):
    surface, _ = make_filter(hexahedron, "u", 0.2, Spacing=SPACING, WarmStart=False)
    first = contents(output_of(surface))
    surface.Isosurfaces = [0.21]
    assert contents(output_of(surface)) != first
    surface.Isosurfaces = [0.2]
    assert contents(output_of(surface)) == first


def test_several_isovalues_go_on_each_by_itself(hexahedron):
    surface, messages = make_filter(hexahedron, "u", [0.2, 0.4], Spacing=SPACING)
    output_of(surface)
    surface.Isosurfaces = [0.21, 0.4]
    particles = output_of(surface)
    expect_as_good(particles, run_quietly(hexahedron, "u", [0.21, 0.4], Spacing=SPACING))
    # The isosurface that did not change is the same again.
    alone = run_quietly(hexahedron, "u", 0.4, Spacing=SPACING)
    at_second = array_of(particles, "Isovalue") == 0.4
    assert np.array_equal(points_of(particles)[at_second], points_of(alone))
    assert messages.errors + messages.warnings == []


def test_a_fixed_number_is_kept(hexahedron):
    surface, messages = make_filter(hexahedron, "u", 0.2, NumberOfParticles=1500)
    for isovalue in (0.2, 0.22, 0.25):
        surface.Isosurfaces = [isovalue]
        assert output_of(surface).GetNumberOfPoints() == 1500
    assert messages.errors == []


def test_another_method_starts_anew(hexahedron):
    surface, _ = make_filter(hexahedron, "u", 0.2, Spacing=2 * SPACING)
    first = contents(output_of(surface))
    surface.Method = "Classic"
    surface.Isosurfaces = [0.21]
    classic = run_quietly(hexahedron, "u", 0.21, Spacing=2 * SPACING, Method="Classic")
    assert contents(output_of(surface)) == contents(classic)
    assert reported(output_of(surface), "Evaluations") > 0
    assert first != contents(output_of(surface))
