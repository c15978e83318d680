"""The user guide's picture of the splat modes: the same particles as points, as disks and as splats.

    pvpython Documentation/figures/user_guide_modes.py PLUGIN OUT.png
"""

import sys
from pathlib import Path

from paraview.simple import *

plugin, out = sys.argv[1:3]
LoadPlugin(plugin, remote=False, ns=globals())

file = Path(__file__).parents[2] / "Testing/Data/mfem_hex1_p8.vtu"
reader = XMLUnstructuredGridReader(FileName=[str(file)])
particles = HighOrderParticleIsosurface(Input=reader, ContourBy=["POINTS", "u"], Isosurfaces=[0.2])
particles.Spacing = 0.05

layout = CreateLayout("modes")
# A third, then a half of what is left.
views = [CreateView("RenderView") for _ in range(3)]
AssignViewToLayout(view=views[0], layout=layout)
layout.SplitHorizontal(0, 1 / 3)
AssignViewToLayout(view=views[1], layout=layout, hint=2)
layout.SplitHorizontal(2, 0.5)
AssignViewToLayout(view=views[2], layout=layout, hint=6)
layout.SetSize(1500, 500)

for view, mode in zip(views, ["Points", "Disks", "Splats"]):
    view.OrientationAxesVisibility = 0
    view.UseColorPaletteForBackground = 0
    view.Background = [1, 1, 1]
    surface = Show(particles, view)
    surface.SetRepresentationType("Surface Splats")
    surface.Mode = mode
    surface.PointSize = 5
    surface.RadiusScale = 0.45 if mode == "Disks" else 1.0  # one by one
    ColorBy(surface, None)
    surface.AmbientColor = surface.DiffuseColor = [0.85, 0.6, 0.25]
    view.CameraPosition = [-0.8, -1.1, 0.6]
    view.CameraFocalPoint = [0, 0, 0]
    view.CameraViewUp = [0, 0, 1]
    ResetCamera(view)
    view.GetActiveCamera().Zoom(1.4)

SaveScreenshot(out, layout)
