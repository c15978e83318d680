#!/usr/bin/env python3
"""Uses one filter object, and views, for long: whether memory grows, and whether the last uses take longer.

    long_use.py [--runs N] [--views N]

A run changes the isovalue, and every tenth time the type of the output, the quality and the input's values. A view is
made, shows the particles, is drawn and deleted: as ParaView's own Surface, and as splats. The first tenth of all uses
warms up; then resident memory and processor time of the tenth that follows are compared with those of the last tenth.
To be run by pvpython, with a display (`bash Utilities/with-display.sh`) and with the plugin's path in HOP_PLUGIN.
"""

import argparse
import ctypes
import gc
import os
import sys
import time
from pathlib import Path

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE.parent / "Python"))

import numpy as np
import support
from cells import straight_grid
from highorderparticles import vtkHighOrderParticleIsosurface
from paraview import simple

# Growth of memory above which something leaks, and of time above which something slows down.
MOST_GROWTH, MOST_SLOWDOWN = 0.01, 0.2


def resident():
    """Bytes."""
    return 4096 * int(Path("/proc/self/statm").read_text().split()[1])


def grid_of_sphere():
    grid = straight_grid("LAGRANGE_HEXAHEDRON", order=2, blocks=3)
    support.add_point_array(grid, "u", ((support.points_of(grid) - 1.5) ** 2).sum(axis=1))
    return grid


def run_filter(count):
    """Calls of the filter, one after the other, on one object."""
    grid = grid_of_sphere()
    values = support.array_of(grid, "u").copy()
    contour = vtkHighOrderParticleIsosurface()
    contour.SetInputArrayToProcess(0, 0, 0, 0, "u")
    contour.SetInputDataObject(grid)
    contour.SetSpacing(0.3)
    dice = np.random.default_rng(1)
    for n in range(count):
        contour.SetValue(0, dice.uniform(0.3, 1.9))
        if n % 10 == 0:
            contour.SetOutputType(n // 10 % 3)
            contour.SetQuality(n // 30 % 3)
            support.add_point_array(grid, "u", values * dice.uniform(0.9, 1.1))
            grid.Modified()
        contour.Update()
        assert contour.GetOutputDataObject(0).GetNumberOfPoints() > 0
        yield


def open_files():
    return len(os.listdir("/proc/self/fd"))


def use_view(proxy, representation):
    """Opens, draws and closes a view. Returns the window's X connection."""
    view = simple.CreateView("RenderView")
    view.ViewSize = [200, 200]
    shown = simple.Show(proxy, view)
    shown.SetRepresentationType(representation)
    simple.Render(view)
    connection = view.GetRenderWindow().GetGenericDisplayId()  # "_<address>_p_void"
    simple.Delete(shown)
    simple.Delete(view)
    return int(connection.split("_")[1], 16)


def use_views(count, representation):
    """Views, one after the other.

    VTK 9.1's interactor leaves the X connection of its window open, with or without particles, and with it 1.4 MB and
    five threads of Mesa's. It is closed here, so that what else is left shows.
    """
    x11 = ctypes.CDLL("libX11.so.6")
    x11.XCloseDisplay.argtypes = [ctypes.c_void_p]
    proxy, _ = support.make_filter(grid_of_sphere(), "u", 1.0, Spacing=0.1)
    for _ in range(count):
        before = open_files()
        connection = use_view(proxy, representation)
        gc.collect()
        if open_files() > before:
            x11.XCloseDisplay(connection)
        yield


def measure(name, uses, count):
    """Prints memory and time early and late; returns by what shares of the early ones they have grown."""
    tenth = max(1, count // 10)
    memory, moments = [], [time.process_time()]
    for _ in uses:
        memory.append(resident())
        moments.append(time.process_time())
    times = np.diff(moments)
    early, late = max(memory[tenth : 2 * tenth]), max(memory[-tenth:])
    # Single uses differ, as the values do: their median does not.
    fast, slow = np.median(times[tenth : 2 * tenth]), np.median(times[-tenth:])
    growth, slowdown = late / early - 1, slow / fast - 1
    print(f"{count} {name}: memory {early / 1e6:.1f} to {late / 1e6:.1f} MB ({growth:+.2%}), "
          f"{1e3 * fast:.1f} to {1e3 * slow:.1f} ms each ({slowdown:+.0%})", flush=True)
    return np.array([growth, slowdown])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--runs", type=int, default=10_000)
    parser.add_argument("--views", type=int, default=1_000)
    arguments = parser.parse_args()
    most = np.array([MOST_GROWTH, MOST_SLOWDOWN])
    failed = False
    if arguments.runs:
        failed |= (measure("runs", run_filter(arguments.runs), arguments.runs) > most).any()
    if arguments.views:
        simple.LoadPlugin(os.environ["HOP_PLUGIN"], remote=False, ns=vars(simple))
        for kind in ("Surface Splats", "Surface"):
            failed |= (measure(f"views with {kind}", use_views(arguments.views, kind), arguments.views) > most).any()
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
