"""Memory and processor time that a run takes on each MPI rank: rows of a table for performance.md.

    mpiexec -n R pvbatch --sym Testing/Benchmarks/rank_memory.py PLUGIN FILE ARRAY ISOVALUE SPACING PARTICLES_PER_WORKER

Every rank reads its piece of a .pvtu file. Each row: number of ranks, rank, cells and particles of the rank, the
largest memory that the kernel counts (Linux: VmHWM) beyond what was resident before the run, MB, and the processor time
of the run, seconds. Ranks that wait may use the processor, as the MPI library likes.
"""

import sys
import time

from memory_peaks import Path, resident
from paraview import servermanager, simple

plugin, path, array, isovalue, spacing, worth = sys.argv[1:]
simple.LoadPlugin(plugin, remote=False, ns=globals())
process = servermanager.vtkProcessModule.GetProcessModule()
reader = simple.XMLPartitionedUnstructuredGridReader(FileName=[path])
reader.UpdatePipeline()
surface = HighOrderParticleIsosurface(  # noqa: F821
    Input=reader, ContourBy=["POINTS", array], Isosurfaces=[float(isovalue)], Spacing=float(spacing),
    ParticlesPerWorker=int(worth))  # fmt: skip
surface.SMProxy.UpdateVTKObjects()
before, begin = resident("VmRSS"), time.process_time()
Path("/proc/self/clear_refs").write_text("5")  # resets VmHWM
surface.UpdatePipeline()
seconds = time.process_time() - begin
peak = resident("VmHWM") - before
cells = reader.GetClientSideObject().GetOutputDataObject(0).GetNumberOfCells()
particles = surface.GetClientSideObject().GetOutputDataObject(0).GetNumberOfPoints()
row = [process.GetNumberOfLocalPartitions(), process.GetPartitionId(), cells, particles, f"{peak / 1e6:.0f}"]
print("| " + " | ".join(str(entry) for entry in [*row, f"{seconds:.1f}"]) + " |\n", end="", flush=True)
