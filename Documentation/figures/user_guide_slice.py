"""The user guide's picture of slices: a pipe of rational Bezier cells, stock Slice on the left, ours on the right.

    pvpython Documentation/figures/user_guide_slice.py PLUGIN OUT.png
"""

import sys
from pathlib import Path

from paraview.simple import *

plugin, out = sys.argv[1:3]
LoadPlugin(plugin, remote=False, ns=globals())

file = Path(__file__).parents[2] / "Testing/Data/yeti_pipe_bezier_rational_p333.vtu"
reader = XMLUnstructuredGridReader(FileName=[str(file)])
reader.UpdatePipeline()
bounds = reader.GetDataInformation().GetBounds()
middle = [(bounds[i] + bounds[i + 1]) / 2 for i in (0, 2, 4)]
name = next(a.GetName() for a in reader.PointData if a.GetNumberOfComponents() in (1, 3) and "eight" not in a.GetName())

layout = CreateLayout("slices")
layout.SplitHorizontal(0, 0.5)
for place, make in ((1, Slice), (2, HighOrderParticleSlice)):
    cut = make(Input=reader, SliceType="Plane")
    cut.SliceType.Origin, cut.SliceType.Normal = middle, [0.3, 0.2, 1.0]
    view = CreateView("RenderView")
    AssignViewToLayout(view, layout, place)
    view.UseColorPaletteForBackground = 0
    view.Background = [1, 1, 1]
    view.OrientationAxesVisibility = 0
    shown = Show(cut, view)
    ColorBy(shown, ("POINTS", name))
    shown.SetScalarBarVisibility(view, False)
    view.CameraPosition = [middle[0] + 0.3, middle[1] + 0.2, middle[2] + 1.0]
    view.CameraFocalPoint = middle
    view.CameraViewUp = [0, 1, 0]
    ResetCamera(view)
    view.GetActiveCamera().Zoom(1.15)
layout.SetSize(1200, 460)
SaveScreenshot(out, layout)
