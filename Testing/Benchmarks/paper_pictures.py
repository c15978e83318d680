"""Pictures of the paper's cases, particles as points beside the same particles as splats, on one sheet.

    pvbatch Testing/Benchmarks/paper_pictures.py PLUGIN OUT.png NAME:GRID.vtu:ARRAY:ISOVALUE:DENSITY:SPACING ...
"""

import sys

import numpy as np
from paraview import simple
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import vtkWindowToImageFilter

SIZE = [360, 280]
CASES_A_ROW = 2


def grab(view):
    simple.Render(view)
    grabber = vtkWindowToImageFilter()
    grabber.SetInput(view.GetRenderWindow())
    grabber.ReadFrontBufferOff()
    grabber.Update()
    image = grabber.GetOutput()
    width, height, _ = image.GetDimensions()
    return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, 3)[::-1].copy()


def pictures(name, path, array, isovalue, density, spacing):
    reader = simple.XMLUnstructuredGridReader(FileName=[path])
    particles = simple.HighOrderParticleIsosurface(
        Input=reader, ContourBy=["POINTS", array], Isosurfaces=[float(isovalue)], AngularDensity=float(density),
        Spacing=float(spacing))
    view = simple.CreateRenderView(ViewSize=SIZE)
    view.OrientationAxesVisibility = 0
    view.UseColorPaletteForBackground = 0
    view.Background = [1, 1, 1]
    display = simple.Show(particles, view)
    display.ColorArrayName = ["POINTS", ""]
    display.AmbientColor = display.DiffuseColor = [0.18, 0.43, 0.71]
    display.SetRepresentationType("Points")
    count = particles.GetDataInformation().GetNumberOfPoints()
    display.PointSize = 2 if count < 5000 else 1
    caption = simple.Show(simple.Text(Text=f"{name}, rho = {density}: {count:,} particles"), view)
    caption.Color, caption.FontSize, caption.WindowLocation = [0, 0, 0], 14, "Lower Center"
    view.CameraPosition, view.CameraViewUp = [-1, -1.8, 1.1], [0, 0, 1]
    simple.ResetCamera(view)
    view.GetActiveCamera().Zoom(0.9)
    points = grab(view)
    display.SetRepresentationType("Surface Splats")
    splats = grab(view)
    simple.Delete(view)
    return np.concatenate([points, splats], axis=1)


def write(picture, path):
    image = vtkImageData()
    image.SetDimensions(picture.shape[1], picture.shape[0], 1)
    image.GetPointData().SetScalars(numpy_to_vtk(np.ascontiguousarray(picture[::-1]).reshape(-1, 3), deep=True))
    writer = vtkPNGWriter()
    writer.SetFileName(path)
    writer.SetInputData(image)
    writer.Write()


def main():
    plugin, out, *cases = sys.argv[1:]
    simple.LoadPlugin(plugin, remote=False, ns=vars(simple))
    all_of_them = [pictures(*case.split(":")) for case in cases]
    while len(all_of_them) % CASES_A_ROW:
        all_of_them.append(np.full_like(all_of_them[0], 255))
    rows = [np.concatenate(all_of_them[n:n + CASES_A_ROW], axis=1) for n in range(0, len(all_of_them), CASES_A_ROW)]
    write(np.concatenate(rows), out)


main()
