"""The warning of a surface that bends faster than its particles can follow: what it advises works and costs what it
says, or it says why there is no such advice."""

import re

import cells
import numpy as np
import pytest
import support

FIELDS = {
    "tube": lambda x, y, z: (x - 0.1) ** 2 + (y + 0.07) ** 2,
    "saddles": lambda x, y, z: x * y * z,
    "torus": lambda x, y, z: (x**2 + y**2 + z**2 + 0.36 - 0.001) ** 2 - 1.44 * (x**2 + y**2),
    "needles": lambda x, y, z: (x**2 + y**2 - 0.001) * ((x - 0.5) ** 2 + (z - 0.1) ** 2 - 0.001),
    "sheet and tube": lambda x, y, z: (x - 0.8) * ((x + 0.1) ** 2 + y**2 - 0.0004),
}
BENDS = "bends faster than their spacing"


def field(name):
    grid = cells.straight_grid("LAGRANGE_HEXAHEDRON", 4, 6)
    points = support.points_of(grid)
    points = 2 * points / points.max() - 1
    cells.set_points(grid, points)
    support.add_point_array(grid, "f", FIELDS[name](*points.T))
    return grid


def run(grid, isovalue, **properties):
    """Particles, and the warning of undersampling or an empty text."""
    particles, messages = support.run(grid, "f", isovalue, **properties)
    assert messages.errors == []
    return particles, "".join(text for text in messages.warnings if BENDS in text)


@pytest.mark.parametrize("name, isovalue, spacing, density", [
    ("tube", 0.0004, 0.055, 0),
    ("tube", 0.0004, 0.05, 0),
    ("torus", 0.0, 0.08, 0),
    ("needles", 0.0, 0.09, 0),
    ("sheet and tube", 0.0, 0.05, 0),
    ("sheet and tube", 0.0, 0.1, 3),
])
def test_the_advice_works_and_takes_what_it_says(name, isovalue, spacing, density):
    grid = field(name)
    before, warning = run(grid, isovalue, Spacing=spacing, AngularDensity=density)
    advice = re.search(r"Choose a Spacing of (\S+), which takes about (\d+) particles", warning)
    assert advice, warning or "no warning"
    assert "AngularDensity" not in warning, "a larger one takes particles to where they are too few, and more of them"
    advised, promised = float(advice[1]), int(advice[2])
    assert advised < spacing and promised <= 10 * before.GetNumberOfPoints()
    after, warning = run(grid, isovalue, Spacing=advised, AngularDensity=density)
    assert warning == ""
    assert after.GetNumberOfPoints() == pytest.approx(promised, rel=0.3)


@pytest.mark.parametrize("method", ["Fast", "Classic"])
def test_a_thin_tube_has_the_particles_of_equation_6_or_a_warning(method):
    grid, radius, spacing = field("tube"), 0.02, 0.8
    particles, warning = run(grid, radius**2, Spacing=spacing, AngularDensity=10, Method=method)
    assert warning == ""
    h = spacing / (1 + 10 * spacing / (2 * np.pi * radius))
    wanted = 2 * 2 * np.pi * radius * 2 / (np.sqrt(3) * h**2)
    assert particles.GetNumberOfPoints() == pytest.approx(wanted, rel=0.15)
    for density in (0, 4):
        _, warning = run(grid, radius**2, Spacing=spacing, AngularDensity=density, Method=method)
        assert "(100%)" in warning


def test_a_given_number_is_advised_as_a_number():
    grid = field("tube")
    _, warning = run(grid, 0.0004, NumberOfParticles=120, AngularDensity=0)
    advice = re.search(r"Choose a NumberOfParticles of (\d+)\.", warning)
    assert advice, warning
    assert 120 < int(advice[1]) <= 1200
    after, warning = run(grid, 0.0004, NumberOfParticles=int(advice[1]), AngularDensity=0)
    assert warning == ""


def test_a_place_too_thin_is_named():
    """To follow a tube of radius 0.001 takes a thousand times the particles of the flat sheet beside it."""
    grid = field("tube")
    particles, warning = run(grid, 0.001**2, Spacing=0.1, AngularDensity=0)
    assert "Choose" not in warning and "singular" not in warning
    place = re.search(r"most at \((\S+), (\S+), (\S+)\) in cell (\d+)\. It bends with a radius of about (\S+) there",
                      warning)  # fmt: skip
    assert place, warning
    assert float(place[5]) == pytest.approx(0.001, rel=0.01)
    at = np.array([float(place[n]) for n in (1, 2, 3)])
    points, in_cells = support.points_of(particles), support.array_of(particles, "vtkOriginalCellIds")
    nearest = np.linalg.norm(points - at, axis=1).argmin()
    assert np.linalg.norm(points[nearest] - at) < 1e-4
    assert in_cells[nearest] == int(place[4])


def test_sheets_that_cross_are_called_singular():
    """Particles on the very lines where the gradient vanishes bend without bound."""
    _, warning = run(field("saddles"), 0.0, Spacing=0.1, AngularDensity=10)
    assert "most at (" in warning and ") in cell " in warning
    assert "The place is singular" in warning and "Choose" not in warning


def test_hundredths_are_not_worth_a_warning():
    particles, warning = run(field("saddles"), 0.0001, Spacing=0.0325, AngularDensity=0)
    assert 0.01 < support.reported(particles, "ParticlesUndersampled") / particles.GetNumberOfPoints() < 0.02
    assert warning == ""
