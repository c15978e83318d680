"""The user guide's table of slices: how far stock Slice and ours are from the cut, and how far their arrays are from those
of the cells, by VTK's own cells.

    pvpython Documentation/figures/user_guide_slice_errors.py PLUGIN
"""

import sys
from pathlib import Path

import numpy as np
from paraview.simple import *
from paraview.vtk.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import reference as vtkReference
from vtkmodules.vtkCommonDataModel import vtkGenericCell, vtkStaticCellLocator

LoadPlugin(sys.argv[1], remote=False, ns=globals())

NORMAL = np.array([0.3, 0.2, 1.0]) / np.linalg.norm([0.3, 0.2, 1.0])
CASES = [  # file, array, slice type
    ("mfem_cylinder_hex_prism_p3.vtu", "phi", "Plane"),
    ("mfem_cylinder_hex_prism_p3.vtu", "phi", "Sphere"),
    ("mfem_torus_wedge_p4.vtu", "f", "Plane"),
    ("mfem_torus_wedge_p4.vtu", "f", "Sphere"),
    ("ngsolve_cylinder_ns_tet_p3.vtu", "pressure", "Plane"),
    ("ngsolve_cylinder_ns_tet_p3.vtu", "pressure", "Sphere"),
]


def output_of(source):
    source.UpdatePipeline()
    return source.GetClientSideObject().GetOutputDataObject(0)


class Cells:
    """The values of an array in the input, by VTK's own cells."""

    def __init__(self, grid, name):
        self.locator, self.cell = vtkStaticCellLocator(), vtkGenericCell()
        self.locator.SetDataSet(grid)
        self.locator.BuildLocator()
        self.nodal = vtk_to_numpy(grid.GetPointData().GetArray(name)).astype(float)
        self.close = 1e-9 * grid.GetLength()

    def place(self, parametric):
        """Position and shape functions."""
        x, weights = np.zeros(3), np.zeros(512)
        self.cell.EvaluateLocation(vtkReference(0), parametric, x, weights)
        return x, weights

    def value(self, x):
        """By Newton's method from where the locator says, for VTK's cells invert their maps on straight pieces only.
        NaN where it leaves the cell."""
        parametric = np.zeros(3)
        if self.locator.FindCell(x, 1e-10, self.cell, parametric, np.zeros(512)) < 0:
            return np.nan
        for _ in range(20):
            here, weights = self.place(parametric)
            if np.linalg.norm(x - here) < self.close:
                ids = [self.cell.GetPointId(n) for n in range(self.cell.GetNumberOfPoints())]
                return weights[: len(ids)] @ self.nodal[ids]
            slopes = [(self.place(parametric + step)[0] - here) / 1e-6 for step in 1e-6 * np.eye(3)]
            parametric = parametric + np.linalg.solve(np.transpose(slopes), x - here)
            if np.abs(parametric - 0.5).max() > 0.501:
                return np.nan
        return np.nan


def errors_of(output, name, middle, radius, cells):
    """Largest distance from the cut, mean and largest error of the array at some 2,000 points."""
    points = vtk_to_numpy(output.GetPoints().GetData()).astype(float)
    x = points - middle
    off = np.abs(np.linalg.norm(x, axis=1) - radius) if radius else np.abs(x @ NORMAL)
    some = np.linspace(0, len(points) - 1, min(len(points), 2000)).astype(int)
    error = np.abs(vtk_to_numpy(output.GetPointData().GetArray(name)).astype(float)[some] - [cells.value(x) for x in points[some]])
    assert np.isfinite(error).mean() > 0.8
    return off.max(), np.nanmean(error), np.nanmax(error)


print("| file, cut | points | off the cut | array: mean | largest |")
print("|---|---|---|---|---|")
for file, name, kind in CASES:
    reader = XMLUnstructuredGridReader(FileName=[str(Path(__file__).parents[2] / "Testing/Data" / file)])
    grid = output_of(reader)
    bounds = np.reshape(grid.GetBounds(), (3, 2))
    middle, size = bounds.mean(axis=1), np.linalg.norm(bounds[:, 1] - bounds[:, 0])
    radius = 0.31 * (bounds[:, 1] - bounds[:, 0]).max() if kind == "Sphere" else 0.0
    cells = Cells(grid, name)
    span = np.ptp(cells.nodal)
    for title, make in (("Slice", Slice), ("particles", HighOrderParticleSlice)):
        cut = make(Input=reader, SliceType=kind)
        if kind == "Sphere":
            cut.SliceType.Center, cut.SliceType.Radius = list(middle), radius
        else:
            cut.SliceType.Origin, cut.SliceType.Normal = list(middle), list(NORMAL)
        output = output_of(cut)
        off, mean, largest = errors_of(output, name, middle, radius, cells)
        print(
            f"| {file.split('_p')[0]}, {kind}: {title} | {output.GetNumberOfPoints():,} | {off / size:.0e} |"
            f" {mean / span:.0e} | {largest / span:.0e} |",
            flush=True,
        )
