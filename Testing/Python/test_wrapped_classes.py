"""The classes by themselves, as Python sees them without ParaView's proxies."""

import numpy as np
from highorderparticles import vtkHighOrderParticleIsosurface, vtkSurfaceSplatMapper
from paraview.vtk.util.numpy_support import vtk_to_numpy
from support import contents, read, run_quietly
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
from vtkmodules.vtkRenderingCore import vtkActor, vtkRenderer, vtkRenderWindow, vtkWindowToImageFilter

SIZE = 200


def isosurface(path):
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(path)
    surface = vtkHighOrderParticleIsosurface()
    surface.SetInputConnection(reader.GetOutputPort())
    surface.SetInputArrayToProcess(0, 0, 0, 0, "u")
    surface.SetNumberOfContours(1)
    surface.SetValue(0, 0.2)
    surface.SetSpacing(0.03)
    return surface


def test_the_filter_gives_what_its_proxy_gives(data):
    path = data("mfem_hex1_p8.vtu")
    surface = isosurface(path)
    surface.Update()
    by_proxy = run_quietly(read(path), "u", 0.2, Spacing=0.03)
    assert by_proxy.GetNumberOfPoints() > 1000
    assert contents(surface.GetOutput()) == contents(by_proxy)


def test_the_mapper_draws_the_particles(data):
    surface = isosurface(data("mfem_hex1_p8.vtu"))
    mapper = vtkSurfaceSplatMapper()
    mapper.SetInputConnection(surface.GetOutputPort())
    mapper.ScalarVisibilityOff()
    actor = vtkActor()
    actor.SetMapper(mapper)
    renderer = vtkRenderer()
    renderer.SetBackground(0, 1, 0)
    renderer.AddActor(actor)
    renderer.ResetCamera()
    window = vtkRenderWindow()
    window.OffScreenRenderingOn()
    window.SetSize(SIZE, SIZE)
    window.AddRenderer(renderer)
    window.Render()
    shot = vtkWindowToImageFilter()
    shot.SetInput(window)
    shot.Update()
    pixels = vtk_to_numpy(shot.GetOutput().GetPointData().GetScalars())[:, :3]
    drawn = np.any(pixels != (0, 255, 0), axis=1)
    assert 0.1 < drawn.mean() < 0.8
    assert np.ptp(pixels[drawn], axis=0).min() > 50, "lit, not flat"


def test_properties_speak_python():
    surface = vtkHighOrderParticleIsosurface()
    surface.SetMethod(surface.CLASSIC)
    assert surface.GetMethod() == 0 == vtkHighOrderParticleIsosurface.CLASSIC
    assert "isovalue" in vtkHighOrderParticleIsosurface.SetValue.__doc__
