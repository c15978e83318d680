"""The user guide's picture for a paper: white background, symmetric colours, dark legend, outline.

    pvpython Documentation/figures/user_guide_paper.py PLUGIN OUT.png
"""

import sys
from pathlib import Path

from paraview.simple import *

plugin, out = sys.argv[1:3]
LoadPlugin(plugin, remote=False, ns=globals())

file = Path(__file__).parents[2] / "Testing/Data/mfem_hex1_p8.vtu"
reader = XMLUnstructuredGridReader(FileName=[str(file)])
particles = HighOrderParticleIsosurface(Input=reader, ContourBy=["POINTS", "u"], Isosurfaces=[0.2])
particles.Spacing = 0.012

view = CreateView("RenderView")
view.UseColorPaletteForBackground = 0
view.Background = [1, 1, 1]
view.OrientationAxesVisibility = 0
view.ViewSize = [1000, 800]

surface = Show(particles, view)
surface.SetRepresentationType("Surface Splats")
ColorBy(surface, ("POINTS", "Mean_Curvature"))
colors = GetColorTransferFunction("Mean_Curvature")
colors.RescaleTransferFunction(-1.5, 1.5)
surface.SetScalarBarVisibility(view, True)
legend = GetScalarBar(colors, view)
legend.Title, legend.ComponentTitle = "mean curvature", ""
legend.TitleColor = legend.LabelColor = [0, 0, 0]
legend.WindowLocation = "Any Location"
legend.Position = [0.86, 0.1]
legend.AddRangeLabels = 0

outline = Show(reader, view)
outline.SetRepresentationType("Outline")
outline.AmbientColor = outline.DiffuseColor = [0.3, 0.3, 0.3]

view.CameraPosition = [-0.8, -1.1, 0.6]
view.CameraFocalPoint = [0, 0, 0]
view.CameraViewUp = [0, 0, 1]
ResetCamera(view)
view.GetActiveCamera().Zoom(1.05)
view.GetActiveCamera().SetWindowCenter(0.12, 0)  # room for the legend
SaveScreenshot(out, view)
