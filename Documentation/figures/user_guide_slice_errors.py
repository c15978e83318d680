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
ANGLE = 8.0  # of boxes around z, degrees
KINDS = ["Plane", "Sphere", "Cylinder", "Box"]
FILES = [  # file, array
    ("mfem_cylinder_hex_prism_p3.vtu", "phi"),
    ("mfem_torus_wedge_p4.vtu", "f"),
    ("ngsolve_cylinder_ns_tet_p3.vtu", "pressure"),
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


class Cut:
    """A cut through the middle of a grid's bounds, its width 0.62 of their longest side, or 0.6 of each side for a box."""

    def __init__(self, kind, grid):
        bounds = np.reshape(grid.GetBounds(), (3, 2))
        self.kind, self.middle, self.sides = kind, bounds.mean(axis=1), bounds[:, 1] - bounds[:, 0]
        self.radius = 0.31 * self.sides.max()
        c, s = np.cos(np.radians(ANGLE)), np.sin(np.radians(ANGLE))
        self.turn = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])

    def give(self, function):
        """Sets the properties of ParaView's proxy."""
        if self.kind == "Plane":
            function.Origin, function.Normal = list(self.middle), list(NORMAL)
        elif self.kind == "Box":
            function.Position = list(self.middle - self.turn @ (0.3 * self.sides))
            function.Length, function.Rotation = list(0.6 * self.sides), [0.0, 0.0, ANGLE]
        else:
            function.Center, function.Radius = list(self.middle), self.radius
            if self.kind == "Cylinder":
                function.Axis = list(NORMAL)

    def distances(self, points):
        """Of points from the cut."""
        x = points - self.middle
        along = x @ NORMAL
        if self.kind == "Plane":
            return np.abs(along)
        if self.kind == "Box":
            beyond = np.abs(x @ self.turn) - 0.3 * self.sides
            return np.where((beyond > 0).any(axis=1), np.linalg.norm(np.maximum(beyond, 0), axis=1), -beyond.max(axis=1))
        across = x - np.outer(along, NORMAL) if self.kind == "Cylinder" else x
        return np.abs(np.linalg.norm(across, axis=1) - self.radius)


def errors_of(output, name, cut, cells):
    """Largest distance from the cut, mean and largest error of the array at some 2,000 points."""
    points = vtk_to_numpy(output.GetPoints().GetData()).astype(float)
    some = np.linspace(0, len(points) - 1, min(len(points), 2000)).astype(int)
    values = vtk_to_numpy(output.GetPointData().GetArray(name)).astype(float)[some]
    error = np.abs(values - [cells.value(x) for x in points[some]])
    assert np.isfinite(error).mean() > 0.8
    return cut.distances(points).max(), np.nanmean(error), np.nanmax(error)


print("| file, cut | points | off the cut | array: mean | largest |")
print("|---|---|---|---|---|")
for file, name in FILES:
    reader = XMLUnstructuredGridReader(FileName=[str(Path(__file__).parents[2] / "Testing/Data" / file)])
    grid = output_of(reader)
    cells = Cells(grid, name)
    span, size = np.ptp(cells.nodal), grid.GetLength()
    for kind in KINDS:
        cut = Cut(kind, grid)
        for title, make in (("Slice", Slice), ("particles", HighOrderParticleSlice)):
            proxy = make(Input=reader, SliceType=kind)
            cut.give(proxy.SliceType)
            output = output_of(proxy)
            off, mean, largest = errors_of(output, name, cut, cells)
            print(
                f"| {file.split('_p')[0]}, {kind}: {title} | {output.GetNumberOfPoints():,} | {off / size:.0e} |"
                f" {mean / span:.0e} | {largest / span:.0e} |",
                flush=True,
            )
