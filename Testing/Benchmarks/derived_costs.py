"""What derived fields cost: processor time a particle, beside an isosurface of an array, and a cell with surface. One
thread.

    pvpython Testing/Benchmarks/derived_costs.py PLUGIN
"""

import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "Python"))
sys.path.insert(0, str(Path(sys.argv[1]).parents[1] / "python3" / "dist-packages"))

import numpy as np
from paraview import simple

simple.LoadPlugin(sys.argv[1], remote=False, ns=vars(simple))

import cells
import support
from vtkmodules.vtkCommonCore import vtkSMPTools

DATA = Path(__file__).parents[1] / "Data"


def bent(name, order):
    """Cells bent to their own degree, with a smooth vector and its first component."""
    grid = cells.straight_grid(name, order=order, blocks=2)
    lower, upper = support.bounds_of(grid)
    x = 2.0 * (support.points_of(grid) - lower) / (upper - lower) - 1.0
    cells.set_points(grid, x + 0.05 * np.sin(2.0 * x[:, [1, 2, 0]]))
    y = support.points_of(grid)
    support.add_point_array(grid, "u", np.sin(2.0 * y[:, [1, 2, 0]]) + 0.3 * y[:, [2, 0, 1]] ** 2)
    support.add_point_array(grid, "p", np.sin(2.0 * y).sum(axis=1))
    return grid


def cost(grid, array, isovalue, **properties):
    """Processor time of the fastest of three runs, with the output."""
    best = np.inf
    for seed in (1, 2, 3):
        proxy, _ = support.make_filter(grid, array, isovalue, Seed=seed, **properties)
        start = time.process_time()
        proxy.UpdatePipeline()
        best = min(best, time.process_time() - start)
    return best, support.output_of(proxy)


def row(title, grid, array, isovalue, **properties):
    """Two runs, of which one has few particles: the times are those of the cells and of the particles."""
    few_time, few = cost(grid, array, isovalue, **{**properties, "Spacing": 100.0 * properties["Spacing"]})
    many_time, many = cost(grid, array, isovalue, **properties)
    count = many.GetNumberOfPoints()
    active = len(np.unique(support.array_of(many, "vtkOriginalCellIds")))
    each = (many_time - few_time) / (count - few.GetNumberOfPoints())
    cells_time = few_time - each * few.GetNumberOfPoints()
    print(f"| {title} | {count:,} | {1e6 * each:.0f} | {active:,} | {1e3 * cells_time / active:.2f} |", flush=True)


vtkSMPTools.SetBackend("STDThread")  # left alone, the filter would take all cores
vtkSMPTools.Initialize(1)
print("| case | particles | microseconds each | cells with surface | milliseconds each |\n|---|---|---|---|---|")
for name, order, spacing in (
    ("LAGRANGE_HEXAHEDRON", 3, 0.04),
    ("LAGRANGE_HEXAHEDRON", 4, 0.04),
    ("LAGRANGE_TETRAHEDRON", 4, 0.04),
):
    grid = bent(name, order)
    title = f"{name.split('_')[1].lower()}, p = {order}"
    row(f"{title}: array", grid, "p", 0.5, Spacing=spacing)
    for quantity, isovalue in (("Q Criterion", 0.3), ("Lambda 2", -0.3)):
        row(f"{title}: {quantity}", grid, "u", isovalue, Spacing=spacing, Quantity=quantity)
