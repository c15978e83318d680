"""The user guide's picture of a slice along a box: a flow past a cylinder, stock Slice on the left, ours on the right.

    pvpython Documentation/figures/user_guide_box.py PLUGIN OUT.png
"""

import sys
from pathlib import Path

from paraview.simple import *

plugin, out = sys.argv[1:3]
LoadPlugin(plugin, remote=False, ns=globals())

file = Path(__file__).parents[2] / "Testing/Data/ngsolve_cylinder_ns_tet_p3.vtu"
reader = XMLUnstructuredGridReader(FileName=[str(file)])
reader.UpdatePipeline()
bounds = reader.GetDataInformation().GetBounds()
lower, size = bounds[::2], [bounds[i + 1] - bounds[i] for i in (0, 2, 4)]

layout = CreateLayout("box")
layout.SplitHorizontal(0, 0.5)
for place, make in ((1, Slice), (2, HighOrderParticleSlice)):
    cut = make(Input=reader, SliceType="Box")
    cut.SliceType.Position = [lower[i] + 0.2 * size[i] for i in range(3)]
    cut.SliceType.Length = [0.6 * length for length in size]
    cut.SliceType.Rotation = [0, 0, 8]
    view = CreateView("RenderView")
    AssignViewToLayout(view, layout, place)
    view.UseColorPaletteForBackground = 0
    view.Background = [1, 1, 1]
    view.OrientationAxesVisibility = 0
    shown = Show(cut, view)
    ColorBy(shown, ("POINTS", "velocity", "Magnitude"))
    shown.SetScalarBarVisibility(view, False)
    middle = [lower[i] + 0.5 * size[i] for i in range(3)]
    view.CameraPosition = [middle[0] + 1.2, middle[1] + 1.0, middle[2] + 2.0]
    view.CameraFocalPoint = middle
    view.CameraViewUp = [0, 1, 0]
    ResetCamera(view)
    view.GetActiveCamera().Zoom(1.3)
layout.SetSize(1200, 460)
SaveScreenshot(out, layout)
