"""Shared by the tests that look at pictures."""

import numpy as np
from paraview.vtk.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader


def read_png(path):
    """Pixels, bottom row first, (height, width, RGB)."""
    reader = vtkPNGReader()
    reader.SetFileName(str(path))
    reader.Update()
    image = reader.GetOutput()
    width, height, _ = image.GetDimensions()
    return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, -1)[:, :, :3].astype(int)


def background_share(pixels):
    """Share of the pixels that have the colour of most of them."""
    colors, counts = np.unique(pixels.reshape(-1, 3), axis=0, return_counts=True)
    return counts.max() / counts.sum()
