"""ParaView's Contour beside this plugin: one picture, and how far each is from the field it shows.

    pvpython compare_with_contour.py [OUT.png]

The file is one hexahedron of order 8 that interpolates u = sin 4x cos 3y + cos(5z)/2 to 1.1e-4.
"""

import os
import sys
from pathlib import Path

from paraview.simple import *

project = Path(__file__).resolve().parents[3]
plugin = os.environ.get("HOP_PLUGIN", project / "build/lib/HighOrderParticleIsosurface/HighOrderParticleIsosurface.so")
out = sys.argv[1] if len(sys.argv) > 1 else "comparison.png"
isovalue = 0.2

LoadPlugin(str(plugin), remote=False, ns=globals())

cell = XMLUnstructuredGridReader(FileName=[str(project / "Testing/Data/mfem_hex1_p8.vtu")])
contour = Contour(Input=cell, ContourBy=["POINTS", "u"], Isosurfaces=[isovalue])
particles = HighOrderParticleIsosurface(Input=cell, ContourBy=["POINTS", "u"], Isosurfaces=[isovalue])
particles.Spacing = 0.02


def largest_error(surface):
    """Errors of the analytic field at the points of the surface."""
    error = Calculator(Input=surface, ResultArrayName="error")
    error.Function = f"abs(sin(4*coordsX)*cos(3*coordsY) + cos(5*coordsZ)/2 - {isovalue})"
    error.UpdatePipeline()
    return error.PointData["error"].GetRange()[1]


layout = CreateLayout("comparison")
left = CreateView("RenderView")
AssignViewToLayout(view=left, layout=layout)
layout.SplitHorizontal(0, 0.5)
right = CreateView("RenderView")
AssignViewToLayout(view=right, layout=layout, hint=2)
layout.SetSize(1400, 700)

Show(contour, left).SetRepresentationType("Surface")
Show(particles, right).SetRepresentationType("Surface Splats")
for view, surface in [(left, contour), (right, particles)]:
    view.OrientationAxesVisibility = 0
    shown = GetDisplayProperties(surface, view)
    shown.ColorArrayName = ["POINTS", ""]
    shown.AmbientColor = shown.DiffuseColor = [0.85, 0.65, 0.35]
    Show(cell, view).SetRepresentationType("Outline")
    view.CameraPosition = [-0.8, -1.1, 0.6]
    view.CameraFocalPoint = [0, 0, 0]
    view.CameraViewUp = [0, 0, 1]
    ResetCamera(view)

SaveScreenshot(out, layout)
for name, surface in [("Contour", contour), ("particles", particles)]:
    count = surface.GetDataInformation().GetNumberOfPoints()
    print(f"{name}: {count} points, largest error {largest_error(surface):.1e}")
print(out)
