"""What every file costs with the properties that the panel chooses: tables for performance.md, and JSON if asked.

    pvpython Testing/Benchmarks/default_costs.py PLUGIN [FOLDER ...] [--only WORD] [--repetitions N] [--all] [--json OUT.json]

Every grid of the FOLDERs (default: Testing/Data) is opened as the GUI would, and contoured with array, isovalue and
spacing left as they come. Times are of the filter alone, the best of N runs (default 3), each by a new filter. The
first table has the processor time of a run on one thread, and others as its multiples, all of them run in turns:
  Draft, High   the other levels of Quality
  number        NumberOfParticles, with the number that the spacing gives
  Triangles     OutputType; then what these cost beyond the particles, those on creases and the proof of the topology
                with them, in microseconds a particle, and what the mesh lacks
and the elapsed time on two threads, which only tells something where two processors are free. The second table, with
--all, has
  warm          processor time of Warm Start after a step of the isovalue by STEP of the array's range, as a multiple
                of a run from scratch there; the two columns after it are evaluations a particle, warm and from scratch
"""

import argparse
import json
import time
from pathlib import Path

from paraview import simple
from vtkmodules.vtkCommonCore import vtkSMPTools

STEP = 0.01


def spent(proxy):
    wall, cpu = time.perf_counter(), time.process_time()
    proxy.UpdatePipeline()
    return {"wall": time.perf_counter() - wall, "cpu": time.process_time() - cpu}


def least(runs):
    return {key: min(run[key] for run in runs) for key in runs[0]}


def use_threads(threads):
    vtkSMPTools.SetBackend("STDThread")  # left alone, the filter would take all cores
    vtkSMPTools.Initialize(threads)


def make(reader, **properties):
    return simple.HighOrderParticleIsosurface(Input=reader, **properties)


def from_scratch(reader, **properties):
    proxy = make(reader, **properties)
    result = spent(proxy)
    simple.Delete(proxy)
    return result


def in_turns(reader, repetitions, variants):
    """The least times of each variant, a name and its properties: one run of each, then the next of each."""
    runs = {name: [] for name in variants}
    for _ in range(repetitions):
        for name, properties in variants.items():
            runs[name].append(from_scratch(reader, **properties))
    return {name: least(some) for name, some in runs.items()}


def counted(proxy):
    proxy.UpdatePipeline()
    points = proxy.GetDataInformation().GetNumberOfPoints()
    return {"particles": points, "evaluations": proxy.FieldData["Evaluations"].GetRange(0)[1] / max(1, points)}


def facts(reader, **properties):
    """Particles and evaluations of a run, and what the panel chose."""
    proxy = make(reader, PassDiagnostics=1, **properties)
    found = counted(proxy) | {"array": proxy.ContourBy[1], "isovalues": list(proxy.Isosurfaces)}
    simple.Delete(proxy)
    return found


def lack_of_mesh(reader):
    """Holes and particles left over."""
    proxy = make(reader, OutputType="Triangles", PassDiagnostics=1)
    proxy.UpdatePipeline()
    lack = [int(proxy.FieldData[name].GetRange(0)[1]) for name in ("MeshOpenLoops", "MeshUnusedParticles")]
    simple.Delete(proxy)
    return lack


def stepped(reader, chosen):
    """The isovalues a step higher, or lower where that would be more than the array has."""
    array = reader.PointData[chosen["array"]]
    low, high = array.GetRange(0 if array.GetNumberOfComponents() == 1 else -1)
    step = STEP * (high - low)
    return [v + step if v + step < high else v - step for v in chosen["isovalues"]]


def continued(reader, before, after, repetitions):
    runs = []
    for _ in range(repetitions):
        proxy = make(reader, WarmStart=1, Isosurfaces=before)
        proxy.UpdatePipeline()
        proxy.Isosurfaces = after
        runs.append(spent(proxy))
        simple.Delete(proxy)
    proxy = make(reader, WarmStart=1, Isosurfaces=before, PassDiagnostics=1)
    proxy.UpdatePipeline()
    proxy.Isosurfaces = after
    result = least(runs) | counted(proxy)
    simple.Delete(proxy)
    return result


def measure(path, repetitions, everything):
    reader = simple.OpenDataFile(str(path))
    reader.UpdatePipeline()
    use_threads(1)
    result = {"file": path.name} | facts(reader)
    if result["particles"] == 0:
        return result
    variants = {"one thread": {}, "Draft": {"Quality": "Draft"}, "High": {"Quality": "High"},
                "number": {"NumberOfParticles": result["particles"]}, "Triangles": {"OutputType": "Triangles"}}
    result |= in_turns(reader, repetitions, variants) | {"lacks": lack_of_mesh(reader)}
    use_threads(2)
    result |= in_turns(reader, repetitions, {"two threads": {}})
    use_threads(1)
    if everything:
        after = stepped(reader, result)
        result["warm"] = continued(reader, result["isovalues"], after, repetitions)
        scratch = in_turns(reader, repetitions, {"scratch": {"Isosurfaces": after}})["scratch"]
        result["scratch"] = scratch | facts(reader, Isosurfaces=after)
    simple.Delete(reader)
    return result


def print_costs(results):
    print("\n| file | surface | particles | evaluations a particle | s | µs a particle | two threads, s | µs a particle "
          "| Draft | High | number | Triangles | µs beyond | holes | left over |\n" + 15 * "|---" + "|")
    for r in results:
        surface = f"{r['array']} = {', '.join(f'{v:.4g}' for v in r['isovalues'])}"
        cpu, elapsed = r["one thread"]["cpu"], r["two threads"]["wall"]
        others = " | ".join(f"{r[name]['cpu'] / cpu:.2f}" for name in ("Draft", "High", "number", "Triangles"))
        beyond = 1e6 * (r["Triangles"]["cpu"] - cpu) / r["particles"]
        print(f"| `{r['file']}` | {surface} | {r['particles']:,} | {r['evaluations']:.1f} | {cpu:.3f} "
              f"| {1e6 * cpu / r['particles']:.1f} | {elapsed:.3f} | {1e6 * elapsed / r['particles']:.1f} | {others} "
              f"| {beyond:.1f} | {r['lacks'][0]} | {r['lacks'][1]} |")


def print_more(results):
    print("\n| file | warm | evaluations warm | from scratch |\n|---|---|---|---|")
    for r in results:
        warm, scratch = r["warm"], r["scratch"]
        print(f"| `{r['file']}` | {warm['cpu'] / scratch['cpu']:.2f} | {warm['evaluations']:.1f} "
              f"| {scratch['evaluations']:.1f} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("plugin")
    parser.add_argument("folders", nargs="*", type=Path)
    parser.add_argument("--only", default="", help="part of the names of the files wanted")
    parser.add_argument("--repetitions", type=int, default=3)
    parser.add_argument("--all", action="store_true", help="warm starts, too")
    parser.add_argument("--json", type=Path)
    arguments = parser.parse_args()
    folders = arguments.folders or [Path(__file__).parent.parent / "Data"]
    simple.LoadPlugin(arguments.plugin, remote=False, ns=vars(simple))
    results = []
    # A file that is in several folders is measured once.
    paths = {p.name: p for folder in folders for p in folder.iterdir() if p.suffix in (".vtu", ".pvtu")}
    for name in sorted(paths):
        if arguments.only not in name:
            continue
        result = measure(paths[name], arguments.repetitions, arguments.all)
        if result["particles"] == 0:
            print(f"{name}: no particles", flush=True)
            continue
        results.append(result)
        print(f"{name} measured", flush=True)
        if arguments.json:
            arguments.json.write_text(json.dumps(results, indent=1))
    print_costs(results)
    if arguments.all:
        print_more(results)


main()
