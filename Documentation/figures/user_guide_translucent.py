"""The user guide's picture of translucency: three isosurfaces in one hexahedron of order 8.

    pvpython Documentation/figures/user_guide_translucent.py PLUGIN OUT.png
"""

import sys
from pathlib import Path

from paraview.simple import *

plugin, out = sys.argv[1:3]
LoadPlugin(plugin, remote=False, ns=globals())

file = Path(__file__).parents[2] / "Testing/Data/mfem_hex1_p8.vtu"
reader = XMLUnstructuredGridReader(FileName=[str(file)])
particles = HighOrderParticleIsosurface(Input=reader, ContourBy=["POINTS", "u"], Isosurfaces=[-0.4, 0.2, 0.8])
particles.Spacing = 0.015

view = CreateView("RenderView")
view.UseColorPaletteForBackground = 0
view.Background = [1, 1, 1]
view.OrientationAxesVisibility = 0
view.ViewSize = [1000, 800]

surface = Show(particles, view)
surface.SetRepresentationType("Surface Splats")
ColorBy(surface, ("POINTS", "Isovalue"))
GetColorTransferFunction("Isovalue").RescaleTransferFunction(-0.4, 0.8)
surface.Opacity = 0.5

outline = Show(reader, view)
outline.SetRepresentationType("Outline")
outline.AmbientColor = outline.DiffuseColor = [0.3, 0.3, 0.3]

view.CameraPosition = [-0.8, -1.1, 0.6]
view.CameraFocalPoint = [0, 0, 0]
view.CameraViewUp = [0, 0, 1]
ResetCamera(view)
view.GetActiveCamera().Zoom(1.05)
SaveScreenshot(out, view)
