#!/usr/bin/env python3
"""Aborts runs at random moments, and measures how long they go on.

    aborts.py [FOLDER ...] [--moments N] [--noise N] [--limit S] [--only WORD] [--kinds KIND ...]

Every .vtu file of the folders (default: Testing/Data and that of HOP_SHARED_DATA) and some random grids of noise are
contoured by every kind of request below, on one thread: once to the end, and then N times with an abort at a moment
chosen evenly in the time of the first run. Times are of the processor: other work on the machine does not count.
What is measured is the time from that moment until the filter is back: the time until it asks whether to go on, and the
time to leave. Progress must not fall. To be run by pvpython in the environment that `ctest -R Fuzz.random -V` shows.
"""

import argparse
import os
import sys
import time
from pathlib import Path

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE.parent / "Python"))

import numpy as np
import recipes
import support
from highorderparticles import vtkHighOrderParticleIsosurface
from test_scales import contoured
from vtkmodules.vtkCommonCore import vtkObject, vtkSMPTools
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

KINDS = {
    "particles": {},
    "high": {"Quality": vtkHighOrderParticleIsosurface.HIGH},
    "number": {"NumberOfParticles": 3000},
    "triangles": {"OutputType": vtkHighOrderParticleIsosurface.TRIANGLES},
    "curved": {"OutputType": vtkHighOrderParticleIsosurface.CURVED_TRIANGLES, "Order": 3},
    "gradient": {"Quantity": vtkHighOrderParticleIsosurface.GRADIENT_MAGNITUDE},
    "classic": {"Method": vtkHighOrderParticleIsosurface.CLASSIC},
}
# Classic takes minutes for what Fast does in a second: seconds of a run after which it is ended, for all kinds.
LONGEST = 20.0


class Run:
    """A run of the filter that is ended at the first question after a moment, in seconds of processor time."""

    def __init__(self, contour):
        self.contour = contour
        self.progress = []
        self.silence = 0.0
        contour.AddObserver("ProgressEvent", self.asked)

    def go(self, moment):
        """Seconds that the run has gone on after the moment; and whether it was aborted."""
        self.moment = moment
        self.progress = []
        self.silence = 0.0
        self.stopped = False
        self.contour.SetAbortExecute(0)
        self.contour.SetSeed(self.contour.GetSeed() + 1)  # else the output of the run before would be kept
        self.begin = self.last = time.process_time()
        self.contour.Update()
        end = time.process_time()
        self.silence = max(self.silence, end - self.last)
        return end - self.begin - moment, self.stopped

    def asked(self, *_):
        now = time.process_time()
        self.silence = max(self.silence, now - self.last)
        self.last = now
        self.progress.append(self.contour.GetProgress())
        if now - self.begin >= self.moment and self.progress[-1] < 1:  # at 1 the output is there
            self.contour.SetAbortExecute(1)
            self.stopped = True


def middling_gradient(grid, name, component):
    """About what the field changes by over half of the grid's diagonal."""
    array = grid.GetPointData().GetArray(name)
    least, most = array.GetRange(component if component < array.GetNumberOfComponents() else -1)
    return 2 * (most - least) / (grid.GetLength() or 1.0)  # of one point


def filter_of(grid, name, component, isovalue, properties):
    contour = vtkHighOrderParticleIsosurface()
    contour.SetPassDiagnostics(True)
    contour.SetWarmStart(False)
    contour.SetInputArrayToProcess(0, 0, 0, 0, name)
    contour.SetComponent(component)
    contour.SetValue(0, middling_gradient(grid, name, component) if "Quantity" in properties else isovalue)
    contour.SetInputDataObject(grid)
    for key, value in properties.items():
        getattr(contour, "Set" + key)(value)
    return contour


def files(folders):
    """(name, grid, array, component, isovalue) of every file with a point array."""
    paths = {path.name: path for folder in folders for path in Path(folder).rglob("*.vtu")}
    for _, path in sorted(paths.items()):
        reader = vtkXMLUnstructuredGridReader()
        reader.SetFileName(str(path))
        reader.Update()
        grid = reader.GetOutput()
        if grid.GetNumberOfCells() > 0 and grid.GetPointData().GetNumberOfArrays() > 0:
            yield (path.name, grid, *contoured(grid))


def noise(count):
    """Random grids of noise; their spacing is the filter's own."""
    seed = 0
    while count > 0:
        seed += 1
        recipe = recipes.random_recipe(seed)
        if recipe["field"] == "noise" and not recipe["bad"] and recipe["weights"] is None and recipe["flat"] == 1:
            count -= 1
            values = support.array_of(grid := recipes.make_grid(recipe), "f").astype(float)
            if values.ndim == 1:
                yield f"noise {seed} ({recipe['cell']})", grid, "f", 0, float(np.median(values))


def try_moments(request, kind, count, dice):
    """The longest time that a run went on after an abort, the longest silence, and whether progress fell."""
    run = Run(filter_of(*request, KINDS[kind]))
    run.go(LONGEST)
    total, silence = run.last - run.begin, run.silence
    fell = run.progress != sorted(run.progress)
    longest, aborted = 0.0, 0
    total = min(total, LONGEST)
    for moment in dice.random(count) * total:
        late, stopped = run.go(moment)
        output = run.contour.GetOutputDataObject(0)
        if stopped:
            aborted += 1
            longest = max(longest, late)
            assert output.GetNumberOfPoints() == 0, "an aborted run has left points"
        fell = fell or run.progress != sorted(run.progress)
    return total, silence, longest, aborted, fell


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--moments", type=int, default=5, help="aborts for each file and each kind of request")
    parser.add_argument("--noise", type=int, default=10, help="random grids of noise")
    parser.add_argument("--limit", type=float, default=0.2, help="seconds that a run may go on")
    parser.add_argument("--only", default="", help="files whose name holds this")
    parser.add_argument("--kinds", nargs="*", default=list(KINDS))
    parser.add_argument("folders", nargs="*")
    arguments = parser.parse_args()
    default = [os.environ[name] for name in ("HOP_DATA", "HOP_SHARED_DATA") if os.environ.get(name)]
    vtkObject.GlobalWarningDisplayOff()
    vtkSMPTools.SetBackend("STDThread")  # left alone, the filter would take all cores
    vtkSMPTools.Initialize(1)
    dice = np.random.default_rng(1)
    aborts, late, fallen, longest = 0, 0, 0, 0.0
    print("input, kind: seconds of a run, longest silence, longest time after an abort")
    for source in (files(arguments.folders or default), noise(arguments.noise)):
        for name, *request in source:
            if arguments.only not in name:
                continue
            for kind in arguments.kinds:
                total, silence, after, aborted, fell = try_moments(request, kind, arguments.moments, dice)
                print(f"{name}, {kind}: {total:.2f} {silence:.3f} {after:.3f}{' progress fell' * fell}", flush=True)
                aborts += aborted
                late += max(silence, after) > arguments.limit
                fallen += fell
                longest = max(longest, after)
    print(f"{aborts} aborts, the longest run after one {longest:.3f} s; {late} requests above {arguments.limit} s; "
          f"progress fell in {fallen}")
    sys.exit(1 if late or fallen else 0)


if __name__ == "__main__":
    main()
