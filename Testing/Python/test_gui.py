"""ParaView's own window: the filter is chosen from the menu and its surface appears.

The display is an X server whose screen is a file, so that the whole window can be looked at. What was
seen stays in gui.png in the build folder's Testing/.
"""

import json
import os
import re
import shutil
import struct
import subprocess
import time
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
import support
from paraview import simple
from pictures import write_png
from window import FILTERS_PANEL, HEIGHT, PANEL, PARAVIEW, WIDTH, event, own_screen, start, write_scalar_and_vector

VERSION = (simple.GetParaViewVersion().major, simple.GetParaViewVersion().minor)
at_places_of_5 = pytest.mark.skipif(VERSION >= (6, 0), reason="it looks at places of ParaView 5's window")


@pytest.fixture
def screen(tmp_path):
    """A display of our own: (its name, the file with its pixels)."""
    with own_screen(tmp_path) as screen:
        yield screen


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


pytestmark = [
    pytest.mark.skipif(not PARAVIEW.is_file(), reason="this ParaView has no GUI"),
    pytest.mark.skipif(not shutil.which("Xvfb"), reason="no Xvfb"),
]


def play(plugin, screen, tmp_path, file, events, picture):
    """The pixels of ParaView's window, and a picture of them, after the events of a script; it says nothing."""
    display, screen_file = screen
    process = start(
        display, tmp_path, plugin, f"--data={file}", f"--test-script={Path(__file__).parent / events}", "--exit")
    try:
        window = watch(process, screen_file, 120)
        said = process.stdout.read()
    finally:
        process.kill()
    write_png(Path(os.environ["HOP_BUILD"]) / "Testing" / picture, window)
    assert process.returncode == 0, said
    assert "ERR|" not in said and "WARN|" not in said, said
    return window


def test_a_user_finds_the_filter_and_sees_the_surface(plugin, data, screen, tmp_path):
    window = play(plugin, screen, tmp_path, data("mfem_hex1_p8.vtu"), "gui_events.xml", "gui.png")
    view = window[HEIGHT // 4 : -50, WIDTH // 4 : -20]
    colors, counts = np.unique(view.reshape(-1, 3), axis=0, return_counts=True)
    background = colors[counts.argmax()]
    surface = np.any(np.abs(view - background) > 8, axis=2)
    assert 0.05 < surface.mean() < 0.6
    assert np.unique(view[surface], axis=0).shape[0] > 1000, "shaded, and coloured by curvature"


# What a user does to each property of the filter, in this order: name in the XML, widget, event, what it is set to.
EDITS = {
    "Contour By": ("SelectInputScalars", "ComboBox", "activated", "velocity"),
    "Component": ("Component", "ComboBox", "activated", "Y"),
    "Quantity": ("Quantity", "ComboBox", "activated", "Expression"),
    "Expression": ("Expression", "Expression", "set_string", "2 * u"),  # there for this quantity
    "Derivatives": ("Derivatives", "ComboBox", "activated", "Averaged At Nodes"),
    "Isosurfaces": ("ContourValues", "ScalarValueList/Add", "activate", ""),
    "Pass Derivatives": ("PassDerivatives", "CheckBox", "set_boolean", "true"),
    "Spacing": ("Spacing", "DoubleRangeWidget/DoubleLineEdit", "set_string", "0.25"),
    "Angular Density": ("AngularDensity", "DoubleRangeWidget/DoubleLineEdit", "set_string", "3"),
    "Quality": ("Quality", "ComboBox", "activated", "High"),
    "Smallest Spacing": ("SmallestSpacing", "DoubleLineEdit0", "set_string", "0.125"),
    "Tolerance": ("Tolerance", "DoubleLineEdit0", "set_string", "1e-06"),  # no slider
    "Node Spacing": ("NodeSpacing", "ComboBox", "activated", "Gauss-Lobatto-Legendre"),
    "Warm Start": ("WarmStart", "CheckBox", "set_boolean", "true"),
    "Method": ("Method", "ComboBox", "activated", "Classic"),
    "Seed": ("Seed", "LineEdit0", "set_string", "7"),
    "Number Of Particles": ("NumberOfParticles", "LineEdit0", "set_string", "400"),
    "Particles Per Worker": ("ParticlesPerWorker", "LineEdit0", "set_string", "5000"),
    "Pass Diagnostics": ("PassDiagnostics", "CheckBox", "set_boolean", "true"),
    "Output Type": ("OutputType", "ComboBox", "activated", "Curved Triangles"),
    "Order": ("Order", "IntRangeWidget/LineEdit", "set_string", "3"),
}
# As the state file has them.
EDITED = {
    "SelectInputScalars": ["", "", "", "0", "velocity"], "Component": ["1"], "Spacing": ["0.25"], "AngularDensity": ["3"],
    "SmallestSpacing": ["0.125"], "Quantity": ["6"], "PassDerivatives": ["1"], "ParticlesPerWorker": ["5000"],
    "Expression": ["2 * u"], "Derivatives": ["1"],
    "Quality": ["2"], "NodeSpacing": ["1"], "WarmStart": ["1"], "Method": ["0"], "Seed": ["7"],
    "NumberOfParticles": ["400"], "PassDiagnostics": ["1"], "OutputType": ["2"], "Order": ["3"],
}


def edit_every_property(state):
    """A script of events: the filter is made on the open file, every property edited, the state saved."""
    steps = [
        event(f"{PANEL}/Accept", "activate"),
        event("pqClientMainWindow/menubar", "activate", "menuFilters"),
        event("pqClientMainWindow/menubar/menuFilters/Common", "activate", "HighOrderParticleIsosurface"),
        event(f"{FILTERS_PANEL}/Component", "visible", "false", "pqcheck"),  # the first array is a scalar
        event(f"{PANEL}/SearchBox/AdvancedButton", "set_boolean", "true"),
    ]
    for name, widget, command, value in EDITS.values():
        steps.append(event(f"{FILTERS_PANEL}/{name}/{widget}", command, value))
        if name == "SelectInputScalars":
            steps.append(event(f"{FILTERS_PANEL}/Component", "visible", "true", "pqcheck"))
            steps.append(event(f"{FILTERS_PANEL}/Component/ComboBox", "currentText", "Magnitude", "pqcheck"))
    steps += [
        event(f"{PANEL}/Accept", "activate"),
        event("pqClientMainWindow/menubar/menu_File", "activate", "actionFileSaveServerState"),
        event("pqClientMainWindow/FileSaveServerStateDialog", "filesSelected", state),
        event("pqClientMainWindow", "pause", "4000"),
    ]
    return "<pqevents>" + "\n".join(steps) + "</pqevents>"


def test_every_property_is_edited_in_the_panel(plugin, data, screen, tmp_path):
    """Those of the guide's table. ParaView makes no widget for some kinds of properties, and says nothing."""
    guide = (Path(__file__).resolve().parents[2] / "Documentation" / "user-guide.md").read_text()
    table = guide.split("## Properties of the filter")[1].split("\n## ")[0]
    labels = re.findall(r"^\| `\w+` \| ([^|]+) \|", table, re.MULTILINE)
    assert set(labels) == {"Input", *EDITS}

    display, screen_file = screen
    write_scalar_and_vector(data("mfem_hex1_p8.vtu"), tmp_path / "both.vtu")
    state, script = tmp_path / "edited.pvsm", tmp_path / "edits.xml"
    script.write_text(edit_every_property(str(state)))
    process = start(
        display, tmp_path, plugin, f"--data={tmp_path / 'both.vtu'}", f"--test-script={script}", "--exit")
    try:
        window = watch(process, screen_file, 120)
        said = process.stdout.read()
    finally:
        process.kill()
    write_png(Path(os.environ["HOP_BUILD"]) / "Testing" / "gui_panel.png", window)
    assert process.returncode == 0, said
    proxy = ElementTree.parse(state).find(".//Proxy[@type='HighOrderParticleIsosurface']")
    values = {p.get("name"): [e.get("value") for e in p.findall("Element")] for p in proxy.findall("Property")}
    assert len(values["ContourValues"]) == 2, "one more isovalue"
    assert float(values.pop("Tolerance")[0]) == 1e-6  # versions write it in two ways
    assert {name: values[name] for name in EDITED} == EDITED


@at_places_of_5
def test_the_icons_stand_behind_those_of_paraview(plugin, data, screen, tmp_path, monkeypatch):
    """Also where the plugin is auto-loaded: ParaView then reads it before its own list of filters."""
    display, screen_file = screen
    auto = tmp_path / "plugins.xml"
    monkeypatch.setenv("PV_PLUGIN_CONFIG_FILE", str(auto))
    script = tmp_path / "open.xml"
    steps = [event(f"{PANEL}/Accept", "activate"), event("pqClientMainWindow", "pause", "4000")]
    script.write_text("<pqevents>" + "\n".join(steps) + "</pqevents>")
    windows = []
    for plugins in ("<Plugins/>", f'<Plugins><Plugin name="{plugin.stem}" filename="{plugin}" auto_load="1"/></Plugins>'):
        auto.write_text(plugins)
        process = start(
            display, tmp_path, None, f"--data={data('mfem_hex1_p8.vtu')}", f"--test-script={script}", "--exit")
        try:
            windows.append(watch(process, screen_file, 120))
            said = process.stdout.read()
        finally:
            process.kill()
        assert process.returncode == 0, said
    without, window = windows
    write_png(Path(os.environ["HOP_BUILD"]) / "Testing" / "gui_toolbar.png", window)
    # Its icons, of isosurfaces and slices, are the only ones that are mostly blue.
    blue = (window[..., 2] - window[..., 0] > 60) & (window[..., 2] - window[..., 1] > 30)
    in_toolbar = [blue[105:140, x : x + 34].sum() for x in range(13, 430, 34)]
    assert min(in_toolbar[-2:]) > 150 and max(in_toolbar[:-2]) < 75, in_toolbar
    # ParaView's own icons are those that it has without the plugin, the later ones moved by two.
    assert np.array_equal(window[105:140, 16:388], without[105:140, 16:388])
    assert any(np.array_equal(window[105:140, 464:780], without[105:140, 464 - s : 780 - s]) for s in range(60, 80))


# Runs in ParaView's window: shows a file, and from then on writes down what is in the pipeline.
WATCHED = """
import json
from paraview import servermanager, simple
reader = simple.XMLUnstructuredGridReader(FileName=[{data!r}])
reader.UpdatePipeline()
simple.Show({shown})
simple.Render()
def write(caller=None, event=None):
    with open({answer!r}, "w") as file:
        json.dump([source.GetXMLName() for source in simple.GetSources().values()], file)
servermanager.vtkSMProxyManager.GetProxyManager().GetActiveSessionProxyManager().AddObserver("RegisterEvent", write)
write()
"""


class Hands:
    """Keyboard and mouse of a display, and what its screen shows."""

    def __init__(self, display, screen_file):
        self.display, self.screen_file = display, screen_file

    def do(self, *arguments):
        """Returns what xdotool writes."""
        done = subprocess.run(
            ["xdotool", *map(str, arguments)], env={**os.environ, "DISPLAY": self.display}, stdout=subprocess.PIPE, text=True)
        return done.stdout

    def windows(self):
        return set(self.do("search", "--onlyvisible", "--class", "paraview").split())

    def focus(self):
        """There is no window manager to do it."""
        self.do("windowfocus", "--sync", min(self.windows(), key=int))

    def still(self):
        """The screen's pixels once they have stood still for half a second."""
        last = None
        while last is None or not np.array_equal(last, pixels_of(self.screen_file)):
            last = pixels_of(self.screen_file)
            time.sleep(0.5)
        return last


def wait_for(what, process):
    end = time.monotonic() + 60
    while not what():
        assert process.poll() is None and time.monotonic() < end, "in vain"
        time.sleep(0.2)


@pytest.fixture
def watched(request, plugin, data, screen, tmp_path):
    """ParaView with what the test's parameter shows of a file: (process, hands, what gives the pipeline)."""
    display, screen_file = screen
    answer, script = tmp_path / "pipeline.json", tmp_path / "watched.py"
    script.write_text(WATCHED.format(data=data("mfem_hex1_p8.vtu"), shown=request.param, answer=str(answer)))
    process = start(display, tmp_path, plugin, f"--script={script}")
    hands = Hands(display, screen_file)
    wait_for(answer.is_file, process)
    hands.still()
    yield process, hands, lambda: json.loads(answer.read_text() or "[]")
    process.kill()
    process.wait()


@pytest.mark.skipif(not shutil.which("xdotool"), reason="no xdotool")
@pytest.mark.parametrize("watched", ["reader"], indirect=True)
def test_ctrl_space_and_contour_find_the_filter(watched):
    """Below ParaView's own Contour, whose name is just that."""
    process, hands, pipeline = watched
    hands.focus()
    hands.do("key", "ctrl+space")
    wait_for(lambda: len(hands.windows()) == 2, process)
    hands.do("type", "--delay", "50", "contour")
    write_png(Path(os.environ["HOP_BUILD"]) / "Testing" / "gui_launch.png", hands.still())
    hands.do("key", "Down", "Return")
    wait_for(lambda: len(pipeline()) == 2, process)
    assert "ContourHighOrderCells" in pipeline()


@at_places_of_5
@pytest.mark.skipif(not shutil.which("xdotool"), reason="no xdotool")
@pytest.mark.parametrize("watched", [
    "simple.HighOrderParticleIsosurface(Input=reader, ContourBy=['POINTS', 'u'], Isosurfaces=[0.2])"], indirect=True)
def test_the_tooltip_of_a_particle_is_of_a_few_lines(watched):
    """ParaView lists all point arrays of the point under the mouse, but those with hidden names."""
    process, hands, _ = watched
    hands.focus()
    hands.do("mousemove", 857, 183, "click", 1)  # Hover Points On
    wait_for(lambda: len(hands.windows()) == 2, process)
    hands.still()
    hands.do("mousemove", 639, 414, "click", 1)  # OK
    wait_for(lambda: len(hands.windows()) == 1, process)
    hands.focus()
    for place in (740, 760, 772, 780):
        hands.do("mousemove", place, 450)
        time.sleep(0.5)
    hands.still()
    write_png(Path(os.environ["HOP_BUILD"]) / "Testing" / "gui_tooltip.png", hands.still())
    wait_for(lambda: len(hands.windows()) == 2, process)
    tip = max(hands.windows(), key=int)
    size = re.search(r"Geometry: (\d+)x(\d+)", hands.do("getwindowgeometry", tip))
    write_png(Path(os.environ["HOP_BUILD"]) / "Testing" / "gui_tooltip.png", hands.still())
    assert int(size[1]) < WIDTH // 2 and int(size[2]) < HEIGHT // 3, size[0]


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
    simple.SaveData(str(path), proxy=surface, **support.READABLE)
    return path


def test_what_cuts_particles_hides_them(plugin, particle_file, screen, tmp_path):
    window = play(plugin, screen, tmp_path, particle_file, "gui_clip_events.xml", "gui_clip.png")
    red, green, blue = (window[:, :, c].astype(int) for c in range(3))
    # Grey: the background is blue, or one brownish grey, and the plane red. The outline is one pixel wide.
    background = window[HEIGHT - 60, WIDTH - 30].astype(int)
    grey = (np.abs(red - green) < 10) & (np.abs(green - blue) < 15) & (np.abs(window - background).max(axis=2) > 4)
    surface = np.zeros_like(grey)
    surface[1:-1, 1:-1] = (grey[1:-1, 1:-1] & grey[:-2, 1:-1] & grey[2:, 1:-1] & grey[1:-1, :-2] & grey[1:-1, 2:])
    middle = WIDTH // 4 + 3 * WIDTH // 8  # of the view, as of the particles
    view = slice(HEIGHT // 4, -50)
    assert surface[view, WIDTH // 4 : middle].sum() > 10000, "the half that is left"
    assert surface[view, middle + 50 : -20].sum() < 500, "nothing of the half that was cut off"
