"""The user guide's picture of the cells of a refined mesh, coloured by their ids, with edges.

    pvpython Documentation/figures/cell_edges.py PLUGIN OUT.png
"""

import sys
from pathlib import Path

from paraview.simple import *

plugin, out = sys.argv[1:3]
LoadPlugin(plugin, remote=False, ns=globals())

file = Path(__file__).parents[2] / "Testing/Data/mfem_amr_hanging_hex_p3.vtu"
reader = XMLUnstructuredGridReader(FileName=[str(file)])
particles = HighOrderParticleIsosurface(Input=reader, ContourBy=["POINTS", "u"], Isosurfaces=[0.0])

view = CreateView("RenderView")
view.UseColorPaletteForBackground = 0
view.Background = [1, 1, 1]
view.OrientationAxesVisibility = 0
view.ViewSize = [420, 420]

surface = Show(particles, view)
surface.Representation = "Surface Splats With Edges"
surface.EdgeColor, surface.LineWidth = [0, 0, 0], 1.5
ColorBy(surface, ("POINTS", "Cell_Id"))
surface.RescaleTransferFunctionToDataRange(True, False)
surface.SetScalarBarVisibility(view, False)

view.ResetCamera()
view.GetActiveCamera().Azimuth(30)
view.GetActiveCamera().Elevation(20)
view.GetActiveCamera().Zoom(1.35)
Render(view)
SaveScreenshot(out, view)
