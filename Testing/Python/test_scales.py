"""Lengths and values of very different size in one grid."""

import cells
import numpy as np
import pytest
import support
from vtkmodules.vtkCommonDataModel import VTK_HEXAHEDRON, VTK_LAGRANGE_HEXAHEDRON, VTK_LAGRANGE_WEDGE, VTK_WEDGE
from vtkmodules.vtkFiltersSources import vtkCellTypeSource


def box_of_cells(cell_type, blocks, order=1):
    """Unit cubes, one or two cells each."""
    source = vtkCellTypeSource()
    source.SetCellType(cell_type)
    source.SetCellOrder(order)
    source.SetBlocksDimensions(*blocks)
    source.Update()
    return source.GetOutput()


@pytest.mark.parametrize("cell_type", [VTK_LAGRANGE_HEXAHEDRON, VTK_LAGRANGE_WEDGE])
@pytest.mark.parametrize("amplitude", [1e-1, 1e-2, 1e-3])
def test_small_changes_of_a_large_value(cell_type, amplitude):
    """Values like pressures in pascals."""
    grid = box_of_cells(cell_type, (4, 4, 4), 2)
    x = support.points_of(grid) - 2.0
    change = np.sum(x**2, axis=1) - 2.0
    support.add_point_array(grid, "alone", change)
    support.add_point_array(grid, "beside", 101325.0 + amplitude * change)
    alone, beside = (
        support.run_quietly(grid, name, value, Spacing=0.1) for name, value in (("alone", 0.0), ("beside", 101325.0))
    )
    assert support.reported(beside, "ParticlesRejected") == 0
    assert beside.GetNumberOfPoints() == pytest.approx(alone.GetNumberOfPoints(), rel=0.005)
    radius = np.linalg.norm(support.points_of(beside) - 2.0, axis=1)
    # The values themselves are rounded to 1.5e-11.
    np.testing.assert_allclose(radius, np.sqrt(2.0), atol=3e-11 / amplitude)


@pytest.mark.parametrize("cell_type", [VTK_HEXAHEDRON, VTK_WEDGE])
@pytest.mark.parametrize("layers", [1, 2])
@pytest.mark.parametrize("thickness", [0.03, 0.1])
def test_plates_thinner_than_the_spacing(cell_type, layers, thickness):
    """The two sides of a thin cell are not neighbours of each other. The surface is a strip across twelve cells."""
    grid = box_of_cells(cell_type, (12, 12, layers))
    x = support.points_of(grid) * [1.0, 1.0, thickness / layers]
    cells.set_points(grid, x)
    support.add_point_array(grid, "F", x[:, 1] - 0.3 * x[:, 0] - 4.2)
    spacing = 0.12
    particles = support.run_quietly(grid, "F", 0.0, Spacing=spacing)
    along = np.sort(np.r_[0.0, support.points_of(particles)[:, 0], 12.0]) * np.hypot(1.0, 0.3)
    assert np.max(np.diff(along)) < 1.5 * spacing
    rows = 1 if thickness < 0.4 * spacing else 2
    assert particles.GetNumberOfPoints() == pytest.approx(rows * along[-1] / spacing, rel=0.1)
