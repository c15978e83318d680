"""How far particles of a derived field miss their isovalue, by VTK's own derivatives, beside what the rounding of a
file's numbers alone changes: coordinates and values of the cells moved by up to half a unit in their last place. Both
as shares of the field's 95th percentile.

    pvpython Testing/Benchmarks/derived_residuals.py PLUGIN FOLDER
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "Python"))
sys.path.insert(0, str(Path(sys.argv[1]).parents[1] / "python3" / "dist-packages"))

import numpy as np
from paraview import simple

simple.LoadPlugin(sys.argv[1], remote=False, ns=vars(simple))

import cells
import support
from vtkmodules.vtkCommonDataModel import vtkGenericCell

FILES = [  # file, array, quantity
    ("pyfr_cylinder_5040hex_696prism_p3.vtu", "Pressure", "Gradient Magnitude"),
    ("pyfr_cylinder_3360hex_7656prism_p3.vtu", "Pressure", "Gradient Magnitude"),
    ("ngsolve_cylinder_ns_tet_p3.vtu", "pressure", "Gradient Magnitude"),
]
MOST = 2000


def magnitude(cell, place, nodal):
    gradient = np.zeros(3)
    cell.Derivatives(0, place, nodal, 1, gradient)
    return np.linalg.norm(gradient)


def moved(numbers, unit, dice):
    return numbers * (1.0 + unit * dice.uniform(-0.5, 0.5, np.shape(numbers)))


for file, name, quantity in FILES:
    reader = support.read(str(Path(sys.argv[2]) / file))
    grid = support.output_of(reader)
    stored = support.array_of(grid, name)
    unit = float(np.finfo(stored.dtype).eps)
    field, cell, dice = stored.astype(float), vtkGenericCell(), np.random.default_rng(1)
    middles = []
    for id in range(0, grid.GetNumberOfCells(), 5):
        grid.GetCell(id, cell)
        place = np.zeros(3)
        cell.GetParametricCenter(place)
        middles.append(magnitude(cell, place, field[cells.point_ids(cell)]))
    isovalue, scale = np.quantile(middles, 0.8), np.quantile(middles, 0.95)
    particles, _ = support.run(reader, name, isovalue, Quantity=quantity, Spacing=0.1, AngularDensity=0)
    ids = support.array_of(particles, "vtkOriginalCellIds")
    places = support.array_of(particles, "ParametricCoordinates").astype(float)
    some = np.unique(np.linspace(0, len(ids) - 1, MOST).astype(int))
    missed, rounded = [], []
    for i in some:
        grid.GetCell(int(ids[i]), cell)
        nodal = field[cells.point_ids(cell)]
        exact = magnitude(cell, places[i], nodal)
        missed.append(abs(exact - isovalue) / scale)
        points = cell.GetPoints()
        for n in range(points.GetNumberOfPoints()):
            points.SetPoint(n, moved(np.array(points.GetPoint(n)), unit, dice))
        rounded.append(abs(magnitude(cell, places[i], moved(nodal, unit, dice)) - exact) / scale)
    print(
        f"{file}, {quantity} of {name} = {isovalue:.3g}, {stored.dtype}: {len(ids):,} particles, {len(some):,} looked at."
        f" Particles miss it by {np.median(missed):.1e} (median), {max(missed):.1e} (largest); rounding alone:"
        f" {np.median(rounded):.1e}, {max(rounded):.1e}",
        flush=True,
    )
