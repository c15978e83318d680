#!/usr/bin/env python3
"""Lets allocations of the filters fail, one a run: the output is to be empty, an error to say so, the next run to be as
ever, and memory to stay as it is. Particles, meshes, derived quantities and slices, one after the other.

    allocations.py [--step N]

To be run by pvpython with FailingAllocations preloaded: `ctest -R Fuzz.allocations -V` shows it.
"""

import argparse
import ctypes

import long_use  # finds support.py
import numpy as np
import support
from highorderparticles import vtkHighOrderParticleIsosurface, vtkHighOrderParticleSlice
from vtkmodules.vtkCommonDataModel import vtkBox, vtkPlane

# Share of memory by which it may have grown, for what VTK and Python keep.
MOST_GROWTH = 0.01
FIRST_SEED = 2


def isosurface_of(array, isovalue, **properties):
    surface = vtkHighOrderParticleIsosurface()
    surface.SetInputArrayToProcess(0, 0, 0, 0, array)
    surface.SetValue(0, isovalue)
    for name, value in properties.items():
        getattr(surface, "Set" + name)(value)
    return surface


def slice_along(function):
    cut = vtkHighOrderParticleSlice()
    cut.SetCutFunction(function)
    return cut


def plane():
    function = vtkPlane()
    function.SetOrigin(1.4, 1.5, 1.6)
    function.SetNormal(0.6, 0.64, 0.48)
    return function


def box():
    function = vtkBox()
    function.SetBounds(0.6, 2.4, 0.7, 2.3, 0.8, 2.2)
    return function


FILTERS = {
    "particles": lambda: isosurface_of("u", 1.0),
    "triangles": lambda: isosurface_of("u", 1.0, OutputType=vtkHighOrderParticleIsosurface.TRIANGLES),
    "curved triangles": lambda: isosurface_of("u", 1.0, OutputType=vtkHighOrderParticleIsosurface.CURVED_TRIANGLES),
    "Q Criterion": lambda: isosurface_of("velocity", 2.0, Quantity=vtkHighOrderParticleIsosurface.Q_CRITERION),
    "Lambda 2": lambda: isosurface_of("velocity", -2.0, Quantity=vtkHighOrderParticleIsosurface.LAMBDA_2),
    "slice": lambda: slice_along(plane()),
    "box": lambda: slice_along(box()),
}


def grid_of_sphere_and_vortex():
    """The vortex turns about an axis along z, the faster, the farther away."""
    grid = long_use.grid_of_sphere()
    x, y, _ = (support.points_of(grid) - 1.5).T
    support.add_point_array(grid, "velocity", np.stack([-y, x, 0 * x], axis=1) * (x**2 + y**2)[:, None])
    return grid


class Runs:
    """Of one filter object, each with another seed, so that each computes all anew."""

    def __init__(self, surface):
        self.allocations = ctypes.CDLL(None)
        self.allocations.failAllocation.argtypes = [ctypes.c_long]
        self.filter = surface
        self.messages = support.Messages(self.filter)
        self.filter.SetInputDataObject(grid_of_sphere_and_vortex())
        self.filter.SetSpacing(0.3)
        self.failing = self.count = -1
        self.filter.AddObserver("StartEvent", lambda *_: self.allocations.failAllocation(self.failing))
        self.filter.AddObserver("EndEvent", self.end)

    def end(self, *_):
        self.count = self.allocations.countedAllocations()
        self.allocations.failAllocation(-1)

    def run(self, seed, failing=-1):
        self.failing = failing
        self.messages.errors.clear()
        self.filter.SetSeed(seed)
        self.filter.Update()
        return self.filter.GetOutputDataObject(0)


def try_all(name, step):
    """Every step-th allocation of a run."""
    runs = Runs(FILTERS[name]())
    whole = support.contents(runs.run(FIRST_SEED))
    count = runs.count
    assert count > 100, f"only {count} allocations: is FailingAllocations preloaded?"
    numbers = range(0, count, step)
    memory = []
    for number in numbers:
        output = runs.run(FIRST_SEED + 1 + number, number)
        # Another seed may need fewer.
        if runs.count > number:
            assert output.GetNumberOfPoints() == 0, f"allocation {number} failed, and there are particles"
            assert any("the run failed" in error for error in runs.messages.errors), f"{number}: no error"
        memory.append(long_use.resident())
    assert support.contents(runs.run(FIRST_SEED)) == whole, "the run after failures is another one"
    fifth = len(memory) // 5
    growth = memory[-1] / memory[fifth] - 1
    print(f"{name}: {len(numbers)} of {count} allocations, memory {growth:+.2%}", flush=True)
    assert growth < MOST_GROWTH


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--step", type=int, default=50)
    step = parser.parse_args().step
    for name in FILTERS:
        try_all(name, step)


if __name__ == "__main__":
    main()
