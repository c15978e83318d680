"""ParaView's own window on a display of its own, and the events that drive its panel."""

import contextlib
import os
import subprocess
from pathlib import Path

import support
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

WIDTH, HEIGHT = 1280, 800
PARAVIEW = Path(os.environ["HOP_PVPYTHON"]).parent / "paraview"

PANEL = "pqClientMainWindow/propertiesDock/propertiesPanel"
FILTERS_PANEL = f"{PANEL}/scrollArea/qt_scrollarea_viewport/scrollAreaWidgetContents/PropertiesFrame/ProxyPanel"


@contextlib.contextmanager
def own_screen(folder):
    """An X server whose screen is a file: (name of the display, the file with its pixels)."""
    reading, writing = os.pipe()
    server = subprocess.Popen(
        ["Xvfb", "-displayfd", str(writing), "-screen", "0", f"{WIDTH}x{HEIGHT}x24", "-fbdir", str(folder),
         "-noreset", "-nolisten", "tcp"],
        pass_fds=[writing], stderr=subprocess.DEVNULL)
    os.close(writing)
    with os.fdopen(reading) as number:
        display = ":" + number.readline().strip()
    try:
        yield display, folder / "Xvfb_screen0"
    finally:
        server.terminate()
        server.wait()


def start(display, home, plugin, *arguments):
    """ParaView in a window that fills the screen, with settings of its own, and the plugin if it is named."""
    loaded = [f"--plugin-search-paths={plugin.parent}", f"--plugins={plugin.stem}"] if plugin else []
    homes = {"HOME": str(home), "XDG_CONFIG_HOME": str(home), "XDG_RUNTIME_DIR": str(home)}
    return subprocess.Popen(
        [str(PARAVIEW), "-qwindowgeometry", f"{WIDTH}x{HEIGHT}+0+0", "--dr", *loaded, *arguments],
        env={**os.environ, **homes, "DISPLAY": display}, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)


def event(path, command, arguments="", kind="pqevent"):
    return f'<{kind} object="{path}" {"property" if kind == "pqcheck" else "command"}="{command}" arguments="{arguments}" />'


def write_scalar_and_vector(file, path):
    """A file with the scalar u of another one and the vector velocity."""
    grid = support.output_of(support.read(file))
    support.add_point_array(grid, "velocity", support.points_of(grid))
    writer = vtkXMLUnstructuredGridWriter()
    writer.SetFileName(str(path))
    writer.SetInputData(grid)
    writer.SetDataModeToBinary()
    writer.Write()
