"""Time series and files in pieces, as simulations write them."""

import numpy as np
import pytest
from paraview import simple
from support import (
    add_cell_array, cells_of, contents, longest_side, make_filter, middles_of, nearest_neighbors, output_of,
    points_of, read, run_quietly)
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

FILES = ["mfem_dg_advection_0.vtu", "mfem_dg_advection_2.vtu", "mfem_dg_advection_4.vtu"]


def test_every_step_of_a_series_is_what_its_file_is_alone(data):
    series = simple.PVDReader(FileName=data("mfem_dg_advection.pvd"))
    series.UpdatePipelineInformation()
    surface, messages = make_filter(series, "rho", 0.3, Spacing=0.06, WarmStart=False)
    times = list(series.TimestepValues)
    assert times == [0, 0.3, 0.6]
    for time, file in zip(times + times[:1], FILES + FILES[:1]):  # and back to the start
        surface.UpdatePipeline(time)
        step = surface.GetClientSideObject().GetOutputDataObject(0)
        alone = run_quietly(read(data(file)), "rho", 0.3, Spacing=0.06)
        assert step.GetNumberOfPoints() > 300
        assert contents(step) == contents(alone)
    assert messages.errors == []


def write_in_pieces(grid, owner, folder, ghosts):
    """A .pvtu with one piece an owner; with ghosts, each piece has the cells around it too."""
    middles, reach = middles_of(grid), 0.3 * longest_side(grid)
    names = []
    for piece in np.unique(owner):
        own = np.flatnonzero(owner == piece)
        around = [i for i in np.flatnonzero(owner != piece)
                  if np.linalg.norm(middles[own] - middles[i], axis=1).min() < reach] if ghosts else []
        part = cells_of(grid, np.append(own, around))
        add_cell_array(part, "vtkGhostType", np.repeat([0, 1], [len(own), len(around)]).astype(np.uint8))
        writer = vtkXMLUnstructuredGridWriter()
        names.append(f"piece_{piece}.vtu")
        writer.SetFileName(str(folder / names[-1]))
        writer.SetDataModeToBinary()  # not appended: see the README about expat
        writer.SetInputData(part)
        writer.Write()
    listing = folder / "pieces.pvtu"
    listing.write_text("\n".join([
        '<VTKFile type="PUnstructuredGrid" version="0.1" byte_order="LittleEndian">',
        f'<PUnstructuredGrid GhostLevel="{int(ghosts)}">',
        '<PPoints><PDataArray type="Float64" NumberOfComponents="3"/></PPoints>',
        '<PPointData><PDataArray type="Float64" Name="u"/></PPointData>',
        '<PCellData><PDataArray type="UInt8" Name="vtkGhostType"/></PCellData>',
        *[f'<Piece Source="{name}"/>' for name in names],
        "</PUnstructuredGrid></VTKFile>"]))
    return str(listing)


def test_nothing_is_sampled_twice_where_pieces_meet(data, tmp_path):
    """A box of tetrahedra, whose faces all match, cut into three pieces, without and with ghost cells."""
    grid = output_of(read(data("dolfinx_tet_p3.vtu")))
    across = middles_of(grid)[:, 0]
    owner = np.digitize(across, np.quantile(across, [1 / 3, 2 / 3]))
    assert np.bincount(owner).min() > 20

    whole = run_quietly(grid, "u", 0.5, Spacing=0.03)
    bare, overlapping = (
        run_quietly(read(write_in_pieces(grid, owner, tmp_path, ghosts)), "u", 0.5, Spacing=0.03)
        for ghosts in (False, True))
    assert bare.GetNumberOfPoints() == pytest.approx(whole.GetNumberOfPoints(), rel=0.02)
    assert np.array_equal(points_of(overlapping), points_of(bare))
    # Two sets of particles on one surface would stand at any distance from each other.
    apart, together = nearest_neighbors(bare), nearest_neighbors(whole)
    assert np.quantile(apart, 0.01) == pytest.approx(np.quantile(together, 0.01), abs=0.1)
    assert len(np.unique(points_of(bare), axis=0)) == bare.GetNumberOfPoints()


@pytest.mark.parametrize("method", ["Fast", "Classic"])
def test_a_solvers_file_in_three_pieces(data, method):
    """deal.II's shell: duplicated nodes on the interfaces, no ghost cells, hanging faces."""
    particles = run_quietly(read(data("dealii_shell_p3_00.pvtu")), "u", 0.4, Spacing=0.05, Method=method)
    assert particles.GetNumberOfPoints() > 1500
    assert len(np.unique(points_of(particles), axis=0)) == particles.GetNumberOfPoints()
    apart = nearest_neighbors(particles)
    # Where a surface is covered twice, half of all particles are close to a particle of the other set.
    assert np.mean(apart < 0.4) < 0.02
