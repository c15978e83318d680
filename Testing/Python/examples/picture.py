"""A picture of an isosurface, coloured by its curvature, with a legend and the outline of the mesh.

    pvpython picture.py [OUT.png]
"""

import os
import sys
from pathlib import Path

from paraview.simple import *

project = Path(__file__).resolve().parents[3]
plugin = os.environ.get("HOP_PLUGIN", project / "build/lib/HighOrderParticleIsosurface/HighOrderParticleIsosurface.so")
out = sys.argv[1] if len(sys.argv) > 1 else "picture.png"

LoadPlugin(str(plugin), remote=False, ns=globals())

# A spherical shell, written by deal.II in three pieces; hanging nodes where the mesh is finer.
mesh = XMLPartitionedUnstructuredGridReader(FileName=[str(project / "Testing/Data/dealii_shell_p3_00.pvtu")])
surface = HighOrderParticleIsosurface(Input=mesh, ContourBy=["POINTS", "u"], Isosurfaces=[-0.4, 0.4])
surface.Spacing = 0.025  # world units

view = CreateView("RenderView")
view.ViewSize = [1000, 700]
view.OrientationAxesVisibility = 0
display = Show(surface, view)
display.SetRepresentationType("Surface Splats")
ColorBy(display, ("POINTS", "Mean_Curvature"))
GetColorTransferFunction("Mean_Curvature").RescaleTransferFunction(-6.0, 6.0)  # 1 / world units; grey is flat
display.SetScalarBarVisibility(view, True)
Show(mesh, view).SetRepresentationType("Outline")

view.CameraPosition = [2.5, -4.0, 3.0]
view.CameraViewUp = [0, 0, 1]
ResetCamera(view)
SaveScreenshot(out, view)
print(f"{surface.GetDataInformation().GetNumberOfPoints()} particles, {out}")
