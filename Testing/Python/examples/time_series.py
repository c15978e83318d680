"""One frame of a movie for every time step of a series, all in the same colours.

    pvpython time_series.py [FOLDER]

Then for instance: ffmpeg -framerate 10 -i FOLDER/frame.%04d.png -pix_fmt yuv420p movie.mp4
"""

import os
import sys
from pathlib import Path

from paraview.simple import *

project = Path(__file__).resolve().parents[3]
plugin = os.environ.get("HOP_PLUGIN", project / "build/lib/HighOrderParticleIsosurface/HighOrderParticleIsosurface.so")
folder = Path(sys.argv[1] if len(sys.argv) > 1 else "frames")
folder.mkdir(parents=True, exist_ok=True)

LoadPlugin(str(plugin), remote=False, ns=globals())

# A bump of density rho that a discontinuous Galerkin code carries around.
series = PVDReader(FileName=str(project / "Testing/Data/mfem_dg_advection.pvd"))
surface = HighOrderParticleIsosurface(Input=series, ContourBy=["POINTS", "rho"], Isosurfaces=[0.3])
surface.Spacing = 0.03

view = CreateView("RenderView")
view.ViewSize = [800, 600]
display = Show(surface, view)
display.SetRepresentationType("Surface Splats")
ColorBy(display, ("POINTS", "Mean_Curvature"))
GetColorTransferFunction("Mean_Curvature").RescaleTransferFunction(-4.0, 8.0)  # or every frame has its own
display.SetScalarBarVisibility(view, True)
Show(series, view).SetRepresentationType("Outline")

view.CameraPosition = [3.0, -4.0, 3.0]
view.CameraViewUp = [0, 0, 1]
ResetCamera(view)  # once, or the camera would follow the bump

animation = GetAnimationScene()
animation.UpdateAnimationUsingDataTimeSteps()
for number, time in enumerate(series.TimestepValues):
    animation.AnimationTime = time
    frame = folder / f"frame.{number:04d}.png"
    SaveScreenshot(str(frame), view)
    print(f"time {time:g}: {surface.GetDataInformation().GetNumberOfPoints()} particles, {frame}")
