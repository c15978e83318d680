"""What surfaces of noise cost: seconds, particles, microseconds a particle, and undecided boxes.

    pvpython Testing/Benchmarks/noise_costs.py [--limit SECONDS] [--groups NAMES] [--only TEXT] [--quick]

To be run in the environment of the tests. Each case runs in a process of its own, on one thread, at default properties
unless said; a run that takes more processor time than the limit is given up. `--only`: cases whose names hold the text.
`--quick`: one and eight cells, degrees to 6.
"""

import argparse
import os
import resource
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "Python"))

import cells
import numpy as np
import support
from highorderparticles import vtkHighOrderParticleIsosurface
from vtkmodules.vtkCommonCore import vtkSMPTools

SHAPES = {"hexahedra": "HEXAHEDRON", "tetrahedra": "TETRAHEDRON", "wedges": "WEDGE"}


def noise(cell, order, blocks, components=1, warp=0.0, flat=1.0, weights=0.0, seed=1):
    """A grid of random nodal values, uniform from 0 to 1."""
    dice = np.random.default_rng(seed)
    grid = cells.straight_grid(cell, order=order, blocks=blocks)
    points = support.points_of(grid)
    points = points + warp * np.sin(2.0 * points[:, [1, 2, 0]] + 0.3)
    points[:, 2] *= flat
    cells.set_points(grid, points)
    values = dice.random((len(points), components))
    support.add_point_array(grid, "f", values if components > 1 else values[:, 0])
    if weights:
        support.add_point_array(grid, "RationalWeights", 10.0 ** (-weights * dice.random(len(points))))
        grid.GetPointData().SetRationalWeights(grid.GetPointData().GetArray("RationalWeights"))
    return grid


def systematic(quick):
    for blocks in (1, 2) if quick else (1, 2, 4):
        for order in range(1, 7 if quick else 11):
            for name, shape in SHAPES.items():
                yield f"{name} {order} {blocks}³", lambda s=shape, o=order, b=blocks: (noise(f"LAGRANGE_{s}", o, b), {})
        for kind in ("PYRAMID", "QUADRATIC_PYRAMID", "TRIQUADRATIC_PYRAMID"):
            yield f"{kind.lower()} {blocks}³", lambda k=kind, b=blocks: (noise(k, None, b), {})


def vectors():
    for order in range(1, 6):
        for blocks in (1, 2):
            yield (f"magnitude hexahedra {order} {blocks}³",
                   lambda o=order, b=blocks: (noise("LAGRANGE_HEXAHEDRON", o, b, 3), {"Component": 3}))
            yield (f"gradient hexahedra {order} {blocks}³",
                   lambda o=order, b=blocks: (noise("LAGRANGE_HEXAHEDRON", o, b, warp=0.1), {"Quantity": 1}))


def rounding():
    """Fields that are the isovalue but for rounding errors."""
    for order in (2, 4, 6):
        for size in (1e-16, 1e-15, 1e-14, 1e-13, 1e-12):
            def make(order=order, size=size):
                grid = noise("LAGRANGE_HEXAHEDRON", order, 2)
                values = 0.5 + size * (support.array_of(grid, "f") - 0.5)
                # One corner gives the field a range.
                values[0] = 1.5
                support.add_point_array(grid, "f", values)
                return grid, {"isovalue": 0.5}
            yield f"rounding hexahedra {order} {size:g}", make


def named():
    """The cases of reliability.md."""
    yield "rational 7 1e9", lambda: (noise("BEZIER_HEXAHEDRON", 7, 1, weights=9), {})
    for flat in (1e-12, 1e-3):
        for kind, blocks in (("QUADRATIC_PYRAMID", 2), ("QUADRATIC_PYRAMID", 3), ("QUADRATIC_HEXAHEDRON", 3)):
            yield f"flat {flat:g} {kind.lower()} {blocks}³", lambda k=kind, b=blocks, f=flat: (noise(k, None, b, flat=f), {})
    for few, blocks in ((1, 3), (10, 3), (2, 2), (2, 3), (2, 4), (2, 6)):
        yield (f"few particles {few} {blocks}³", lambda n=few, b=blocks: (
            noise("LAGRANGE_HEXAHEDRON", 3, b, 3, warp=0.3), {"Component": 3, "NumberOfParticles": n}))


def run(make):
    grid, properties = make()
    values = support.array_of(grid, "f")
    median = np.median(np.linalg.norm(values, axis=1)) if values.ndim > 1 else 0.5
    isovalue = properties.pop("isovalue", median)
    algorithm = vtkHighOrderParticleIsosurface()
    support.Messages(algorithm)
    algorithm.SetPassDiagnostics(True)
    algorithm.SetInputArrayToProcess(0, 0, 0, 0, "f")
    algorithm.SetInputDataObject(grid)
    for name, value in properties.items():
        getattr(algorithm, "Set" + name)(value)
    algorithm.SetValue(0, isovalue)
    before = resource.getrusage(resource.RUSAGE_SELF).ru_utime
    algorithm.Update()
    seconds = resource.getrusage(resource.RUSAGE_SELF).ru_utime - before
    out = algorithm.GetOutputDataObject(0)
    field = out.GetFieldData()
    undecided, evaluations = (field.GetArray(name).GetValue(0) for name in ("BoxesUnresolved", "Evaluations"))
    count = out.GetNumberOfPoints()
    print(f"{grid.GetNumberOfCells():6d} {seconds:8.2f} {count:8d} {1e6 * seconds / max(1, count):9.0f} "
          f"{undecided:9.0f} {evaluations:10.0f}", flush=True)  # fmt: skip


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--limit", type=float, default=60.0)
    parser.add_argument("--only", default="")
    parser.add_argument("--groups", default="systematic,vectors,rounding,named")
    parser.add_argument("--quick", action="store_true")
    arguments = parser.parse_args()
    vtkSMPTools.Initialize(1)
    print("case: cells, s, particles, us/particle, undecided, evaluations")
    for group in arguments.groups.split(","):
        for name, make in systematic(arguments.quick) if group == "systematic" else globals()[group]():
            if arguments.only not in name:
                continue
            print(f"{name:34s}", end="", flush=True)
            child = os.fork()
            if child == 0:
                resource.setrlimit(resource.RLIMIT_CPU, (int(arguments.limit) + 1, int(arguments.limit) + 2))
                try:
                    run(make)
                except BaseException as error:
                    print("failed", repr(error), flush=True)
                os._exit(0)
            _, status = os.waitpid(child, 0)
            if os.WIFSIGNALED(status):
                print(f"  > {arguments.limit:g} s (signal {os.WTERMSIG(status)})", flush=True)


if __name__ == "__main__":
    main()
