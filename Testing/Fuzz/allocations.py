#!/usr/bin/env python3
"""Lets allocations of the filter fail, one a run: the output is to be empty, an error to say so, the next run to be as
ever, and memory to stay as it is.

    allocations.py [--step N]

To be run by pvpython with FailingAllocations preloaded: `ctest -R Fuzz.allocations -V` shows it.
"""

import argparse
import ctypes

import long_use  # finds support.py
import support
from highorderparticles import vtkHighOrderParticleIsosurface

# Share of memory by which it may have grown, for what VTK and Python keep.
MOST_GROWTH = 0.01
FIRST_SEED = 2


class Runs:
    """Of one filter object, each with another seed, so that each computes all anew."""

    def __init__(self, kind):
        self.allocations = ctypes.CDLL(None)
        self.allocations.failAllocation.argtypes = [ctypes.c_long]
        self.filter = vtkHighOrderParticleIsosurface()
        self.messages = support.Messages(self.filter)
        self.filter.SetInputArrayToProcess(0, 0, 0, 0, "u")
        self.filter.SetInputDataObject(long_use.grid_of_sphere())
        self.filter.SetSpacing(0.3)
        self.filter.SetValue(0, 1.0)
        self.filter.SetOutputType(kind)
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


def try_all(kind, step):
    """Every step-th allocation of a run."""
    runs = Runs(kind)
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
    print(f"output type {kind}: {len(numbers)} of {count} allocations, memory {growth:+.2%}", flush=True)
    assert growth < MOST_GROWTH


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--step", type=int, default=50)
    step = parser.parse_args().step
    for kind in (vtkHighOrderParticleIsosurface.PARTICLES, vtkHighOrderParticleIsosurface.TRIANGLES,
                 vtkHighOrderParticleIsosurface.CURVED_TRIANGLES):
        try_all(kind, step)


if __name__ == "__main__":
    main()
