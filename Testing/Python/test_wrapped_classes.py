"""The classes by themselves, as Python sees them without ParaView's proxies."""

import numpy as np
import pytest
from highorderparticles import vtkHighOrderParticleIsosurface, vtkSurfaceSplatMapper
from paraview.vtk.util.numpy_support import vtk_to_numpy
from support import Messages, add_point_array, contents, points_of, read, run_quietly
from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkDataSetAttributes
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
    surface.SetPassDiagnostics(True)  # as by_proxy
    return surface


def test_the_filter_gives_what_its_proxy_gives(data):
    path = data("mfem_hex1_p8.vtu")
    surface = isosurface(path)
    surface.Update()
    by_proxy = run_quietly(read(path), "u", 0.2, Spacing=0.03)
    assert by_proxy.GetNumberOfPoints() > 1000
    assert contents(surface.GetOutput()) == contents(by_proxy)


def vector_field(path):
    """A grid whose active scalars and active vectors are different arrays."""
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(path)
    reader.Update()
    grid = reader.GetOutput()
    add_point_array(grid, "v", points_of(grid))
    grid.GetPointData().SetActiveScalars("u")
    grid.GetPointData().SetActiveVectors("v")
    return grid


def run_alone(grid, array, component):
    surface = vtkHighOrderParticleIsosurface()
    surface.SetInputData(grid)
    surface.SetInputArrayToProcess(0, 0, 0, vtkDataObject.POINT, array)
    surface.SetComponent(component)
    surface.SetValue(0, 0.2)
    surface.SetSpacing(0.1)
    messages = Messages(surface)
    surface.Update()
    return surface.GetOutput(), messages


@pytest.mark.parametrize("kind, name, component", [("SCALARS", "u", 0), ("VECTORS", "v", 1), ("VECTORS", "v", 3)])
def test_the_active_array_of_a_kind_can_be_asked_for(data, kind, name, component):
    grid = vector_field(data("mfem_hex1_p8.vtu"))
    active, messages = run_alone(grid, getattr(vtkDataSetAttributes, kind), component)
    assert messages.errors + messages.warnings == []
    assert active.GetNumberOfPoints() > 50
    assert contents(active) == contents(run_alone(grid, name, component)[0])


def test_an_active_array_that_is_not_there_is_named(data):
    grid = vector_field(data("mfem_hex1_p8.vtu"))
    grid.GetPointData().SetActiveVectors(None)
    nothing, messages = run_alone(grid, vtkDataSetAttributes.VECTORS, 0)
    assert nothing.GetNumberOfPoints() == 0
    assert len(messages.errors) == 1 and "no active point array (Vectors)" in messages.errors[0]


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
