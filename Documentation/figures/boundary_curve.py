"""A surface that ends at the faces of its domain: particles on its boundary curve, and the others.

Needs ParaView and the built plugin; without a display, through Utilities/with-display.sh:

    bash Utilities/with-display.sh pvpython Documentation/figures/boundary_curve.py PLUGIN.so [OUT.png]

Every particle is drawn as a disk of half its spacing. Orange ones stand on the boundary curve: their first clip plane
ends the surface (angle 180 degrees) at distance 0.
"""

import os
import sys

import numpy as np
from paraview import simple
from paraview.vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from PIL import Image

HERE = os.path.dirname(os.path.abspath(__file__))
FILE = os.path.join(HERE, "..", "..", "Testing", "Data", "mfem_hex1_p8.vtu")
OUT = os.path.join(HERE, "..", "pictures", "boundary_curve.png")
BLUE, ORANGE = (0.55, 0.66, 0.80), (0.93, 0.50, 0.08)


def column(points, name, index):
    values = vtk_to_numpy(points.GetPointData().GetArray(name))
    return values if values.ndim == 1 else values[:, index]


def disks(particles):
    """The filter's output, with colours and opacities of single particles."""
    source = particles.GetClientSideObject().GetOutputDataObject(0)
    data = source.NewInstance()
    data.DeepCopy(source)
    on_boundary = (column(data, "Clip_Angle", 0) > 179.0) & (column(data, "Clip_Distance", 0) == 0.0)
    array = numpy_to_vtk(np.where(on_boundary, 1.0, 0.0), deep=True)
    array.SetName("OnBoundary")
    data.GetPointData().AddArray(array)
    print(f"{len(on_boundary)} particles, {on_boundary.sum()} of them on boundary curves")
    producer = simple.TrivialProducer()
    producer.GetClientSideObject().SetOutput(data)
    producer.UpdatePipeline()
    return producer


def outline(reader, view):
    """The edges of the element, bent as they are."""
    surface = simple.Show(reader, view, "UnstructuredGridRepresentation")
    surface.SetRepresentationType("Outline")
    surface.Visibility = 0
    edges = simple.FeatureEdges(Input=simple.ExtractSurface(Input=reader, NonlinearSubdivisionLevel=4))
    edges.BoundaryEdges = edges.FeatureEdges = 1
    edges.FeatureAngle = 35.0
    shown = simple.Show(edges, view)
    shown.LineWidth = 2.0
    shown.ColorArrayName = [None, ""]
    shown.AmbientColor = shown.DiffuseColor = [0.35, 0.38, 0.43]


def main():
    simple.LoadPlugin(sys.argv[1], remote=False, ns=vars(simple))
    reader = simple.XMLUnstructuredGridReader(FileName=[FILE])
    reader.UpdatePipeline()
    particles = simple.HighOrderParticleIsosurface(
        Input=reader, ContourBy=["POINTS", "u"], Isosurfaces=[0.2], Spacing=0.045, AngularDensity=0.0,
        PassDiagnostics=1)
    particles.UpdatePipeline()

    view = simple.CreateView("RenderView")
    view.ViewSize = [900, 620]
    view.OrientationAxesVisibility = 0
    view.UseColorPaletteForBackground = 0
    view.Background = [1.0, 1.0, 1.0]
    shown = simple.Show(disks(particles), view)
    shown.SetRepresentationType("Surface Splats")
    shown.Mode = "Disks"
    shown.RadiusScale = 0.46
    shown.Ambient, shown.Diffuse = 0.5, 0.6
    simple.ColorBy(shown, ("POINTS", "OnBoundary"))
    colours = simple.GetColorTransferFunction("OnBoundary")
    colours.RGBPoints = [0.0, *BLUE, 1.0, *ORANGE]
    shown.SetScalarBarVisibility(view, False)
    outline(reader, view)
    view.CameraParallelProjection = 1
    view.ResetCamera()
    simple.GetActiveCamera().Azimuth(30)
    simple.GetActiveCamera().Elevation(25)
    view.ResetCamera()
    simple.GetActiveCamera().Zoom(1.25)
    out = sys.argv[2] if len(sys.argv) > 2 else os.path.normpath(OUT)
    simple.SaveScreenshot(out, view, ImageResolution=[1800, 1240])
    picture = Image.open(out).convert("RGB").resize((900, 620), Image.Resampling.LANCZOS)
    picture.quantize(96, dither=Image.Dither.NONE).save(out, optimize=True)
    print(out)


main()
