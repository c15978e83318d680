"""A number of particles that several MPI ranks share: deal.II's shell in three pieces, on four ranks, so that one rank
has no data at all."""

import json
import shutil
import subprocess
from pathlib import Path

import pytest
import support

RANKS = 4
NUMBER = 1000
VALUES = [0.3, 0.4]

# Every rank runs this script and writes, case by case, what it has of each isosurface in each block: the number of
# particles, and the smallest and largest Radius.
SCRIPT = """
import json, sys
from paraview import servermanager, simple
from paraview.vtk.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkMultiBlockDataSet, vtkUnstructuredGrid

plugin, path, folder, tests = sys.argv[1:]
sys.path.append(tests)
from support import cells_of

simple.LoadPlugin(plugin, remote=False, ns=globals())
rank = servermanager.vtkProcessModule.GetProcessModule().GetPartitionId()
reader = simple.XMLPartitionedUnstructuredGridReader(FileName=[path])
reader.UpdatePipeline()
piece = vtkUnstructuredGrid()
piece.DeepCopy(reader.GetClientSideObject().GetOutputDataObject(0))


def particles_of(data, number=NUMBER, change=lambda algorithm: None, **properties):
    source = simple.TrivialProducer()
    source.GetClientSideObject().SetOutput(data)
    surface = HighOrderParticleIsosurface(Input=source, ContourBy=["POINTS", "u"], Isosurfaces=VALUES)
    surface.NumberOfParticles = number
    for name, value in properties.items():
        setattr(surface, name, value)
    surface.SMProxy.UpdateVTKObjects()
    change(surface.GetClientSideObject())
    surface.UpdatePipeline()
    return surface.GetClientSideObject().GetOutputDataObject(0)


def described(particles):
    if not particles or particles.GetNumberOfPoints() == 0:
        return [[0, None, None]] * len(VALUES)
    isovalue, radius = (vtk_to_numpy(particles.GetPointData().GetArray(n)) for n in ("Isovalue", "Radius"))
    some = [radius[isovalue == value] for value in VALUES]
    return [[len(r), r.min(), r.max()] if len(r) else [0, None, None] for r in some]


def two_results():
    # On one grid, and on rank 1 only the first of them.
    blocks, other = vtkMultiBlockDataSet(), vtkUnstructuredGrid()
    other.DeepCopy(piece)
    blocks.SetBlock(0, piece)
    blocks.SetBlock(1, None if rank == 1 else other)
    return blocks


def halves():
    # Each rank's cells in two blocks.
    blocks, count = vtkMultiBlockDataSet(), piece.GetNumberOfCells()
    for b, cells in enumerate((range(count // 2), range(count // 2, count))):
        blocks.SetBlock(b, cells_of(piece, cells) if count else None)
    return blocks


def abort_here(algorithm):
    if rank == 1:
        algorithm.AddObserver("ProgressEvent", lambda *_: algorithm.SetAbortExecute(1))


def without_array_here():
    grid = vtkUnstructuredGrid()
    grid.ShallowCopy(piece)
    if rank == 1:
        grid.GetPointData().RemoveArray("u")
    return grid


even = {"AngularDensity": 0}
result = {
    "even": [described(particles_of(piece, **even))],
    "bent": [described(particles_of(piece))],
    "classic": [described(particles_of(piece, Method="Classic", **even))],
    "bent classic": [described(particles_of(piece, Method="Classic"))],
    "one": [described(particles_of(piece, number=1, **even))],
    "halves": [described(halves_of) for halves_of in map(particles_of(halves(), **even).GetBlock, (0, 1))],
    "two results": [described(block) for block in map(particles_of(two_results(), **even).GetBlock, (0, 1))],
    "aborted": [described(particles_of(piece, change=abort_here, **even))],
    "no array": [described(particles_of(without_array_here(), **even))],
    "too many": [described(particles_of(piece, number=2 * 10**9))],
    "spacing": [described(particles_of(piece, number=0, Spacing=0.1, **even))],
}
with open(f"{folder}/rank{rank}.json", "w") as file:
    json.dump(result, file)
"""


@pytest.fixture(scope="module")
def ranks(data, plugin, tmp_path_factory):
    """{case: [block of [rank of [isovalue of (count, smallest and largest Radius)]]]}"""
    for program in ("mpirun", "pvbatch"):
        if not shutil.which(program):
            pytest.skip(f"no {program} here")
    folder = tmp_path_factory.mktemp("ranks")
    script = folder / "script.py"
    script.write_text(SCRIPT.replace("NUMBER", str(NUMBER)).replace("VALUES", str(VALUES)))
    command = ["mpirun", "-np", str(RANKS), "--oversubscribe", shutil.which("pvbatch"), "--sym", str(script)]
    done = subprocess.run(
        [*command, str(plugin), data("dealii_shell_p3_00.pvtu"), str(folder), str(Path(__file__).parent)],
        env=support.environment_of_ranks(), capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stdout + done.stderr
    of_ranks = [json.loads((folder / f"rank{r}.json").read_text()) for r in range(RANKS)]
    return {case: list(zip(*[of_rank[case] for of_rank in of_ranks])) for case in of_ranks[0]}


def counts(block):
    """How many particles each rank has, isovalue by isovalue."""
    return [[of_rank[v][0] for of_rank in block] for v in range(len(VALUES))]


def radii(block, value):
    """All smallest and largest radii."""
    return [radius for of_rank in block for radius in of_rank[value][1:] if radius is not None]


@pytest.mark.parametrize("case", ["even", "bent"])
def test_ranks_give_the_number_together(ranks, case):
    (block,) = ranks[case]
    for some in counts(block):
        assert sum(some) == NUMBER
        assert sorted(some)[0] == 0 and sorted(some)[1] > 100  # three pieces on four ranks


def test_particles_stand_as_dense_on_all_ranks(ranks, data):
    (block,) = ranks["even"]
    (with_spacing,) = ranks["spacing"]
    for value in range(len(VALUES)):
        assert len(set(radii(block, value))) == 1
        # The number that the common spacing asks for.
        expected = [0.1**2 / radii(block, value)[0] ** 2 * n for n in counts(with_spacing)[value]]
        assert counts(block)[value] == pytest.approx(expected, rel=0.1)


def test_classic_gives_the_number_too(ranks):
    """But for single particles that it loses, also on one rank."""
    for case in ("classic", "bent classic"):
        (block,) = ranks[case]
        assert all(0.99 * NUMBER <= sum(some) <= NUMBER for some in counts(block))
    # Ranks have the same shares with both methods.
    for some, of_fast in zip(*(counts(ranks[case][0]) for case in ("classic", "even"))):
        assert some == pytest.approx(of_fast, abs=0.01 * NUMBER)


def test_one_particle_is_that_of_one_rank(ranks):
    (block,) = ranks["one"]
    assert [sum(some) for some in counts(block)] == [1] * len(VALUES)


def test_blocks_of_one_mesh_have_the_number_together(ranks):
    first, second = map(counts, ranks["halves"])
    for a, b in zip(first, second):
        assert sum(a) > 100 and sum(b) > 100 and sum(a) + sum(b) == NUMBER


def test_each_of_two_results_on_one_grid_has_the_number(ranks):
    for block in ranks["two results"]:
        assert [sum(some) for some in counts(block)] == [NUMBER] * len(VALUES)
    second = ranks["two results"][1]
    assert [some[1] for some in counts(second)] == [0] * len(VALUES)


def test_ranks_do_not_wait_for_one_that_is_aborted(ranks):
    (block,) = ranks["aborted"]
    for some in counts(block):
        assert some[1] == 0 and sum(some) > 0


def test_ranks_do_not_wait_for_one_without_the_array(ranks):
    (block,) = ranks["no array"]
    for some in counts(block):
        assert some[1] == 0 and sum(some) == NUMBER


def test_too_many_particles_are_refused_by_all_ranks(ranks):
    (block,) = ranks["too many"]
    assert counts(block) == [[0] * RANKS] * len(VALUES)
