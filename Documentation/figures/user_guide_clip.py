"""The user guide's picture of a clipped surface: a bump of density, its inward side in red.

    pvpython Documentation/figures/user_guide_clip.py PLUGIN OUT.png
"""

import sys
from pathlib import Path

from paraview.simple import *

plugin, out = sys.argv[1:3]
LoadPlugin(plugin, remote=False, ns=globals())

file = Path(__file__).parents[2] / "Testing/Data/mfem_dg_advection_2.vtu"
reader = XMLUnstructuredGridReader(FileName=[str(file)])
particles = HighOrderParticleIsosurface(Input=reader, ContourBy=["POINTS", "rho"], Isosurfaces=[0.3])
particles.Spacing = 0.02
particles.UpdatePipeline()
x0, x1, y0, y1, z0, z1 = particles.GetDataInformation().GetBounds()

half = Clip(Input=particles, ClipType="Plane")
half.ClipType.Origin, half.ClipType.Normal = [(x0 + x1) / 2, (y0 + y1) / 2, (z0 + z1) / 2], [0.9, -0.4, 0.2]

view = CreateView("RenderView")
view.UseColorPaletteForBackground = 0
view.Background = [1, 1, 1]
view.OrientationAxesVisibility = 0
view.ViewSize = [900, 700]

surface = Show(half, view)
surface.SetRepresentationType("Surface Splats")
surface.ColorByNormalDirection = 1

view.CameraPosition = [1.6, -3.0, 1.4]
view.CameraFocalPoint = half.ClipType.Origin
view.CameraViewUp = [0, 0, 1]
ResetCamera(view)
view.GetActiveCamera().Zoom(1.35)
SaveScreenshot(out, view)
