"""The user guide's picture of a derived field: the Q criterion of a flow past a cylinder, ParaView's Gradient and
Contour on the left, ours on the right. Prints the error |Q - c| of both at their own points, by VTK's own cells.

    pvpython Documentation/figures/user_guide_derived.py PLUGIN OUT.png
"""

import sys
from pathlib import Path

import numpy as np
from paraview.simple import *
from paraview.vtk.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkGenericCell, vtkStaticCellLocator

plugin, out = sys.argv[1:3]
LoadPlugin(plugin, remote=False, ns=globals())

file = Path(__file__).parents[2] / "Testing/Data/ngsolve_cylinder_ns_tet_p3.vtu"
reader = XMLUnstructuredGridReader(FileName=[str(file)])
reader.UpdatePipeline()

ours = HighOrderParticleIsosurface(Input=reader, ContourBy=["POINTS", "velocity"], PassDiagnostics=1)
ours.Quantity = "Q Criterion"
isovalue = 5.0
ours.Isosurfaces = [isovalue]
gradient = Gradient(Input=reader, ScalarArray=["POINTS", "velocity"], ComputeQCriterion=1)
stock = Contour(Input=gradient, ContourBy=["POINTS", "Q Criterion"], Isosurfaces=[isovalue])
for source in (ours, stock):
    source.UpdatePipeline()

grid = reader.GetClientSideObject().GetOutputDataObject(0)
nodal = vtk_to_numpy(grid.GetPointData().GetArray("velocity")).astype(float)


def q_at(cell, parametric):
    ids = [cell.GetPointId(n) for n in range(cell.GetNumberOfPoints())]
    derivatives = np.zeros(9)
    cell.Derivatives(0, parametric, np.ascontiguousarray(nodal[ids]).ravel(), 3, derivatives)
    g = derivatives.reshape(3, 3)
    return -0.5 * np.trace(g @ g)


def q_at_points(points):
    locator, cell = vtkStaticCellLocator(), vtkGenericCell()
    locator.SetDataSet(grid)
    locator.BuildLocator()
    values, parametric, weights = [], np.zeros(3), np.zeros(64)
    for x in points:
        if locator.FindCell(x, 1e-12, cell, parametric, weights) >= 0:
            values.append(q_at(cell, parametric))
    return np.array(values)


def points_of(source):
    return vtk_to_numpy(source.GetClientSideObject().GetOutputDataObject(0).GetPoints().GetData()).astype(float)


middles = np.array([q_at(grid.GetCell(i), np.full(3, 0.25)) for i in range(grid.GetNumberOfCells())])
scale = np.quantile(np.abs(middles), 0.95)
particles = ours.GetClientSideObject().GetOutputDataObject(0).GetPointData()
places = zip(
    vtk_to_numpy(particles.GetArray("vtkOriginalCellIds")),
    vtk_to_numpy(particles.GetArray("ParametricCoordinates")).astype(float),
)
own = np.array([q_at(grid.GetCell(int(cell)), u) for cell, u in places])
for name, values in (("Gradient and Contour", q_at_points(points_of(stock))), ("particles", own)):
    error = np.abs(values - isovalue) / scale
    print(f"{name}: {len(values)} points, |Q - {isovalue}| / {scale:.3g}: mean {error.mean():.2g}, largest {error.max():.2g}")

layout = CreateLayout("derived")
layout.SplitHorizontal(0, 0.5)
bounds = reader.GetDataInformation().GetBounds()
middle = [(bounds[i] + bounds[i + 1]) / 2 for i in (0, 2, 4)]
for place, source in ((1, stock), (2, ours)):
    view = CreateView("RenderView")
    AssignViewToLayout(view, layout, place)
    view.UseColorPaletteForBackground = 0
    view.Background = [1, 1, 1]
    view.OrientationAxesVisibility = 0
    shown = Show(source, view)
    ColorBy(shown, ("POINTS", "velocity"))
    shown.SetScalarBarVisibility(view, False)
    view.CameraPosition = [middle[0] + 1.0, middle[1] + 0.8, middle[2] + 2.0]
    view.CameraFocalPoint = middle
    view.CameraViewUp = [0, 1, 0]
    ResetCamera(view)
    view.GetActiveCamera().Zoom(1.4)
layout.SetSize(1400, 520)
SaveScreenshot(out, layout)
