"""ParaView's own window: the filter is chosen from the menu and its surface appears.

The display is an X server whose screen is a file, so that the whole window can be looked at. What was
seen stays in gui.png in the build folder's Testing/.
"""

import json
import os
import shutil
import struct
import subprocess
import time
from pathlib import Path

import numpy as np
import pytest
from paraview import simple
from pictures import write_png

WIDTH, HEIGHT = 1280, 800
PARAVIEW = Path(os.environ["HOP_PVPYTHON"]).parent / "paraview"


@pytest.fixture
def screen(tmp_path):
    """A display of our own: (its name, the file with its pixels)."""
    reading, writing = os.pipe()
    server = subprocess.Popen(
        ["Xvfb", "-displayfd", str(writing), "-screen", "0", f"{WIDTH}x{HEIGHT}x24", "-fbdir", str(tmp_path),
         "-noreset", "-nolisten", "tcp"],
        pass_fds=[writing], stderr=subprocess.DEVNULL)
    os.close(writing)
    with os.fdopen(reading) as number:
        display = ":" + number.readline().strip()
    yield display, tmp_path / "Xvfb_screen0"
    server.terminate()
    server.wait()


def pixels_of(path):
    """An X window dump's pixels, top row first, (height, width, RGB)."""
    dump = path.read_bytes()
    head = struct.unpack(">25I", dump[:100])
    header_size, width, height, row_bytes, colors = head[0], head[4], head[5], head[12], head[19]
    data = np.frombuffer(dump, np.uint8, row_bytes * height, header_size + 12 * colors)
    return data.reshape(height, -1, 4)[:, :width, 2::-1].astype(int)


def watch(process, screen_file, seconds):
    """The picture that stood longest on the screen in the last seconds of the window."""
    seen = []
    end = time.monotonic() + seconds
    while process.poll() is None:
        assert time.monotonic() < end, "ParaView's window did not close in time"
        screen = screen_file.read_bytes()
        if screen.count(0) < 0.9 * len(screen):  # a bare screen is black: the process outlives its window
            seen = (seen + [screen])[-12:]
        time.sleep(0.25)
    assert seen, "no window"
    screen_file.write_bytes(max(seen, key=seen.count))
    return pixels_of(screen_file)


def start(display, home, plugin, *arguments):
    """ParaView in a window that fills the screen, with the plugin and settings of its own."""
    homes = {"HOME": str(home), "XDG_CONFIG_HOME": str(home), "XDG_RUNTIME_DIR": str(home)}
    return subprocess.Popen(
        [str(PARAVIEW), "-qwindowgeometry", f"{WIDTH}x{HEIGHT}+0+0", "--dr", f"--plugin-search-paths={plugin.parent}",
         f"--plugins={plugin.stem}", *arguments],
        env={**os.environ, **homes, "DISPLAY": display}, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)


pytestmark = [
    pytest.mark.skipif(not PARAVIEW.is_file(), reason="this ParaView has no GUI"),
    pytest.mark.skipif(not shutil.which("Xvfb"), reason="no Xvfb"),
]


def test_a_user_finds_the_filter_and_sees_the_surface(plugin, data, screen, tmp_path):
    display, screen_file = screen
    process = start(
        display, tmp_path, plugin, f"--data={data('mfem_hex1_p8.vtu')}",
        f"--test-script={Path(__file__).parent / 'gui_events.xml'}", "--exit")
    try:
        window = watch(process, screen_file, 120)
        said = process.stdout.read()
    finally:
        process.kill()
    write_png(Path(os.environ["HOP_BUILD"]) / "Testing" / "gui.png", window)
    assert process.returncode == 0, said
    assert "ERR|" not in said and "WARN|" not in said, said

    view = window[HEIGHT // 4 : -50, WIDTH // 4 : -20]
    colors, counts = np.unique(view.reshape(-1, 3), axis=0, return_counts=True)
    background = colors[counts.argmax()]
    surface = np.any(np.abs(view - background) > 8, axis=2)
    assert 0.05 < surface.mean() < 0.6
    assert np.unique(view[surface], axis=0).shape[0] > 1000, "shaded, and coloured by curvature"


# Runs in ParaView's window: the same filter twice; the first run is to be aborted.
ABORTED = """
import json, os, time
from paraview.simple import *
reader = XMLUnstructuredGridReader(FileName=[{data!r}])
surface = HighOrderParticleIsosurface(Input=reader, ContourBy=["POINTS", "u"], Isosurfaces=[0.2])
runs = []
for surface.Spacing in (0.0015, 0.05):
    surface.UpdatePipeline()
    data = surface.GetClientSideObject().GetOutputDataObject(0)
    runs.append([data.GetNumberOfPoints(), data.GetNumberOfVerts(), time.monotonic()])
with open({answer!r}, "w") as file:
    json.dump(runs, file)
os._exit(0)
"""


def place_of_abort_button(window):
    """(x, y) of the red cross in the status bar while it can be pressed, or None."""
    bar = window[-30:]
    red = (bar[:, :, 0] > 180) & (bar[:, :, 1:].max(axis=2) < 90)
    rows, columns = np.nonzero(red)
    return (int(columns.mean()), HEIGHT - 30 + int(rows.mean())) if red.sum() > 10 else None


VERSION = (simple.GetParaViewVersion().major, simple.GetParaViewVersion().minor)


# Before 6.1 the button does nothing; from 6.2 on it is for what Apply starts, not for scripts.
@pytest.mark.skipif(VERSION != (6, 1), reason="this ParaView's abort button does not end a script's run")
@pytest.mark.skipif(not shutil.which("xdotool"), reason="no xdotool")
def test_the_abort_button_ends_a_run(plugin, data, screen, tmp_path):
    display, screen_file = screen
    answer = tmp_path / "runs.json"
    script = tmp_path / "aborted.py"
    script.write_text(ABORTED.format(data=data("mfem_hex1_p8.vtu"), answer=str(answer)))
    process = start(display, tmp_path, plugin, f"--script={script}")
    end = time.monotonic() + 120
    pressed = None
    while process.poll() is None and time.monotonic() < end:
        window = pixels_of(screen_file)
        place = place_of_abort_button(window)
        if place and (pressed is None or time.monotonic() - pressed > 2.0):
            # 6.1 itself keeps single clicks from the button, and on a busy machine two may count as such.
            subprocess.run(
                ["xdotool", "mousemove", *map(str, place), "click", "--repeat", "2", "--delay", "60", "1"],
                env={**os.environ, "DISPLAY": display}, check=True)
            pressed = time.monotonic()
            write_png(Path(os.environ["HOP_BUILD"]) / "Testing" / "gui_abort.png", window)
        time.sleep(0.1)
    process.kill()
    said = process.stdout.read()
    assert pressed and answer.is_file(), said
    (points, vertices, ended), (again, _, _) = json.loads(answer.read_text())
    assert points == vertices == 0
    assert ended - pressed < 2.0, "the last press did it"
    assert again > 500, "a run afterwards is whole"


@pytest.fixture
def particle_file(plugin, data, tmp_path):
    reader = simple.XMLUnstructuredGridReader(FileName=[data("mfem_hex1_p8.vtu")])
    surface = simple.HighOrderParticleIsosurface(Input=reader, ContourBy=["POINTS", "u"], Isosurfaces=[0.2])
    path = tmp_path / "particles.vtp"
    simple.SaveData(str(path), proxy=surface)
    return path


def test_what_cuts_particles_hides_them(plugin, particle_file, screen, tmp_path):
    display, screen_file = screen
    process = start(
        display, tmp_path, plugin, f"--data={particle_file}",
        f"--test-script={Path(__file__).parent / 'gui_clip_events.xml'}", "--exit")
    try:
        window = watch(process, screen_file, 120)
        said = process.stdout.read()
    finally:
        process.kill()
    write_png(Path(os.environ["HOP_BUILD"]) / "Testing" / "gui_clip.png", window)
    assert process.returncode == 0, said
    surface = (window[:, :, 0] < 70) & (window[:, :, 2] > window[:, :, 0] + 40)  # blue: one isovalue, one colour
    middle = WIDTH // 4 + 3 * WIDTH // 8  # of the view, as of the particles
    view = slice(HEIGHT // 4, -50)
    assert surface[view, WIDTH // 4 : middle].sum() > 10000, "the half that is left"
    assert surface[view, middle + 50 : -20].sum() < 100, "nothing of the half that was cut off"
