"""Whether any number of MPI ranks has the particles of one rank, on all files of a folder: one line a file.

    mpiexec -n R pvbatch --sym Testing/Benchmarks/rank_sweep.py PLUGIN FOLDER

Each cell lies on a rank by chance. The first point array is contoured in the middle of its range. Each line: file,
number of particles, and a number made of all their places and arrays but ids, in any order. The lines of any two R are
the same, to be compared by `diff`.
"""

import hashlib
import sys
from pathlib import Path

import numpy as np
from paraview import servermanager, simple
from paraview.vtk.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkIdList
from vtkmodules.vtkFiltersCore import vtkExtractCells
from vtkmodules.vtkIOXML import vtkXMLPUnstructuredGridReader, vtkXMLUnstructuredGridReader
from vtkmodules.vtkParallelCore import vtkMultiProcessController

plugin, folder = sys.argv[1:]
simple.LoadPlugin(plugin, remote=False, ns=globals())
process = servermanager.vtkProcessModule.GetProcessModule()
rank, ranks = process.GetPartitionId(), process.GetNumberOfLocalPartitions()


def read(path):
    """All of a file, on every rank."""
    reader = vtkXMLPUnstructuredGridReader() if path.suffix == ".pvtu" else vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


def cells_of_rank(grid):
    owners = np.random.default_rng(1).integers(0, ranks, grid.GetNumberOfCells())
    ids = vtkIdList()
    for cell in np.flatnonzero(owners == rank):
        ids.InsertNextId(int(cell))
    extract = vtkExtractCells()
    extract.SetInputData(grid)
    extract.SetCellList(ids)
    extract.Update()
    return extract.GetOutput()


def first_array(grid):
    data = grid.GetPointData()
    return next(a for a in map(data.GetArray, range(data.GetNumberOfArrays())) if a.GetName() != "RationalWeights")


def digests(particles):
    """One number of 32 bits a particle."""
    if particles.GetNumberOfPoints() == 0:
        return []
    data = particles.GetPointData()
    arrays = [data.GetArray(i) for i in range(data.GetNumberOfArrays())]
    arrays = sorted((a for a in arrays if a and "Id" not in a.GetName()), key=lambda a: a.GetName())
    columns = [vtk_to_numpy(a).astype(float) for a in [particles.GetPoints().GetData(), *arrays]]
    table = np.hstack([column.reshape(len(column), -1) for column in columns]) + 0.0
    return [int.from_bytes(hashlib.sha256(row.tobytes()).digest()[:4], "big") for row in table]


def sum_of_ranks(mine):
    one, all = vtkDoubleArray(), vtkDoubleArray()
    one.InsertNextValue(mine)
    vtkMultiProcessController.GetGlobalController().AllGather(one, all)
    return int(sum(all.GetValue(i) for i in range(all.GetNumberOfValues())))


for path in sorted(p for p in Path(folder).iterdir() if p.suffix in (".vtu", ".pvtu")):
    grid = read(path)
    array = first_array(grid)
    low, high = array.GetRange(-1 if array.GetNumberOfComponents() > 1 else 0)
    producer = simple.TrivialProducer()
    producer.GetClientSideObject().SetOutput(cells_of_rank(grid))
    surface = HighOrderParticleIsosurface(  # noqa: F821
        Input=producer, ContourBy=["POINTS", array.GetName()], Isosurfaces=[(low + high) / 2])
    surface.UpdatePipeline()
    some = digests(surface.GetClientSideObject().GetOutputDataObject(0))
    count, sum_of_digests = sum_of_ranks(len(some)), sum_of_ranks(sum(some))
    if rank == 0:
        print(path.name, count, f"{sum_of_digests % 2**32:08x}", flush=True)
