"""The example scripts run as they stand, by themselves, and their pictures show a surface."""

import os
import subprocess
from pathlib import Path

import numpy as np
import pytest
from pictures import background_share, read_png

EXAMPLES = Path(__file__).parent / "examples"


def run(name, argument):
    """What the script prints."""
    command = [os.environ["HOP_PVPYTHON"], str(EXAMPLES / name), str(argument)]
    result = subprocess.run(command, capture_output=True, text=True, timeout=300)
    assert result.returncode == 0, result.stdout + result.stderr
    assert "ERR|" not in result.stderr and "Warning" not in result.stderr, result.stderr
    return result.stdout


def test_every_example_is_tested():
    assert {path.name for path in EXAMPLES.glob("*.py")} == {
        "picture.py", "time_series.py", "compare_with_contour.py"}


def test_picture(tmp_path):
    said = run("picture.py", tmp_path / "picture.png")
    assert int(said.split()[0]) > 10000
    pixels = read_png(tmp_path / "picture.png")
    assert pixels.shape == (700, 1000, 3)
    assert 0.6 < background_share(pixels) < 0.9


def test_time_series(tmp_path):
    said = run("time_series.py", tmp_path)
    assert [line.split(":")[0] for line in said.splitlines()] == ["time 0", "time 0.3", "time 0.6"]
    frames = [read_png(path) for path in sorted(tmp_path.glob("*.png"))]
    assert len(frames) == 3
    for frame in frames:
        assert 0.8 < background_share(frame) < 0.98
    # The bump moves, the outline and the legend stay.
    for before, after in zip(frames, frames[1:]):
        assert 0.005 < np.any(before != after, axis=2).mean() < 0.1


def test_comparison_with_contour(tmp_path):
    said = run("compare_with_contour.py", tmp_path / "comparison.png")
    errors = [float(line.split()[-1]) for line in said.splitlines()[:2]]
    assert errors[0] == pytest.approx(2.2e-2, rel=0.5), "Contour"
    assert errors[1] < 5e-4, "the particles: what the file itself is off"
    pixels = read_png(tmp_path / "comparison.png")
    for half in np.array_split(pixels, 2, axis=1):
        assert 0.5 < background_share(half) < 0.9
