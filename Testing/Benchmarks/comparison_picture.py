"""The README's comparison: one hexahedron of order 8, stock Contour on the left, this plugin on the right.

    pvbatch Testing/Benchmarks/comparison_picture.py PLUGIN OUT.png
"""

import sys
from pathlib import Path

from paraview import simple

FILE = Path(__file__).parent.parent / "Data" / "mfem_hex1_p8.vtu"


def make_view(reader):
    view = simple.CreateView("RenderView")
    view.OrientationAxesVisibility = 0
    view.UseColorPaletteForBackground = 0
    view.Background = [1, 1, 1]
    outline = simple.Show(reader, view)
    outline.SetRepresentationType("Outline")
    outline.ColorArrayName = ["POINTS", ""]
    outline.AmbientColor = outline.DiffuseColor = [0.4, 0.4, 0.4]
    return view


def look(view):
    view.CameraFocalPoint = [0, 0, 0]
    view.CameraPosition = [-0.8, -1.1, 0.6]
    view.CameraViewUp = [0, 0, 1]
    simple.ResetCamera(view)
    view.GetActiveCamera().Dolly(1.2)


def main():
    plugin, output = sys.argv[1:3]
    simple.LoadPlugin(plugin, remote=False, ns=vars(simple))
    reader = simple.XMLUnstructuredGridReader(FileName=[str(FILE)])
    choice = {"Input": reader, "ContourBy": ["POINTS", "u"], "Isosurfaces": [0.2]}

    left = make_view(reader)
    contour = simple.Show(simple.Contour(**choice), left)
    right = make_view(reader)
    particles = simple.Show(simple.HighOrderParticleIsosurface(**choice, Spacing=0.012), right)
    particles.SetRepresentationType("Surface Splats")
    for shown, view in ((contour, left), (particles, right)):
        shown.ColorArrayName = ["POINTS", ""]
        shown.AmbientColor = shown.DiffuseColor = [0.55, 0.70, 0.90]
        look(view)

    layout = simple.CreateLayout("comparison")
    layout.AssignView(0, left)
    layout.SplitHorizontal(0, 0.5)
    layout.AssignView(2, right)
    layout.SetSize(1600, 700)
    simple.SaveScreenshot(output, layout)


main()
