"""Helpers for the tests that look at pictures."""

import numpy as np
from paraview.vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOImage import vtkPNGReader, vtkPNGWriter


def read_png(path):
    """Pixels, bottom row first, (height, width, RGB)."""
    reader = vtkPNGReader()
    reader.SetFileName(str(path))
    reader.Update()
    image = reader.GetOutput()
    width, height, _ = image.GetDimensions()
    return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, -1)[:, :, :3].astype(int)


def background_share(pixels):
    """Share of the pixels that have the most frequent colour."""
    colors, counts = np.unique(pixels.reshape(-1, 3), axis=0, return_counts=True)
    return counts.max() / counts.sum()


def write_png(path, pixels):
    """pixels: (height, width, RGB) from 0 to 255, top row first."""
    image = vtkImageData()
    image.SetDimensions(pixels.shape[1], pixels.shape[0], 1)
    colors = numpy_to_vtk(np.ascontiguousarray(pixels[::-1].reshape(-1, 3), dtype=np.uint8), deep=True)
    image.GetPointData().SetScalars(colors)
    writer = vtkPNGWriter()
    writer.SetFileName(str(path))
    writer.SetInputData(image)
    writer.Write()
