"""Aborts a run on one MPI rank at random moments, and measures how long the other ranks go on.

    mpiexec -n R pvbatch --sym Testing/Fuzz/rank_aborts.py PLUGIN FILE ARRAY ISOVALUE SPACING PARTICLES_PER_WORKER MOMENTS

Every rank reads its piece of a .pvtu file. The ranks take turns in being aborted, at moments chosen evenly in the
progress of a run. Printed are the median and the longest time from the abort until all ranks are back, by the clock:
R cores have to be free, and ranks have one thread each.
"""

import sys
import time

import numpy as np
from paraview import servermanager, simple
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkSMPTools
from vtkmodules.vtkParallelCore import vtkMultiProcessController

plugin, path, array, isovalue, spacing, worth, moments = sys.argv[1:]
simple.LoadPlugin(plugin, remote=False, ns=globals())
vtkSMPTools.SetBackend("STDThread")
vtkSMPTools.Initialize(1)
process = servermanager.vtkProcessModule.GetProcessModule()
rank, ranks = process.GetPartitionId(), process.GetNumberOfLocalPartitions()
controller = vtkMultiProcessController.GetGlobalController()
reader = simple.XMLPartitionedUnstructuredGridReader(FileName=[path])
reader.UpdatePipeline()
surface = HighOrderParticleIsosurface(  # noqa: F821
    Input=reader, ContourBy=["POINTS", array], Isosurfaces=[float(isovalue)], Spacing=float(spacing),
    ParticlesPerWorker=int(worth))  # fmt: skip
surface.SMProxy.UpdateVTKObjects()
algorithm = surface.GetClientSideObject()
dice = np.random.default_rng(1)
asked = {"from": 2.0, "at": 0.0}


def hear(*_):
    if algorithm.GetProgress() >= asked["from"] and not algorithm.GetAbortExecute() and algorithm.GetProgress() < 1:
        algorithm.SetAbortExecute(1)
        asked["at"] = time.monotonic()


def latest(mine):
    """The largest of the ranks' numbers."""
    one, all = vtkDoubleArray(), vtkDoubleArray()
    one.InsertNextValue(mine)
    controller.AllGather(one, all)
    return max(all.GetValue(i) for i in range(all.GetNumberOfValues()))


algorithm.AddObserver("ProgressEvent", hear)
times = []
for n in range(int(moments)):
    moment = dice.random()
    asked["from"], asked["at"] = moment if rank == n % ranks else 2.0, 0.0
    algorithm.SetAbortExecute(0)
    surface.Seed = n + 2  # else the output of the run before would be kept
    surface.SMProxy.UpdateVTKObjects()
    surface.UpdatePipeline()
    back = latest(time.monotonic())
    at = latest(asked["at"])
    if at > 0.0:
        times.append(back - at)
        assert algorithm.GetOutputDataObject(0).GetNumberOfPoints() == 0
if rank == 0:
    print(f"{ranks} ranks: {len(times)} aborts, median {np.median(times):.3f} s, longest {max(times):.3f} s", flush=True)
