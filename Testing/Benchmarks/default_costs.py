"""What every file costs with the properties that the panel chooses: tables for performance.md, and JSON if asked.

    pvpython Testing/Benchmarks/default_costs.py PLUGIN [FOLDER ...] [--only WORD] [--repetitions N] [--json OUT.json]

Every grid of the FOLDERs (default: Testing/Data) is opened as the GUI would, and contoured with array, isovalue and
spacing left as they come. Times are of the filter alone, the best of N runs (default 3), each by a new filter. On a
machine that does other work processor times are the ones to compare: 'cpu' is that of a run on one thread. The second
table has processor times as multiples of Standard's:
  Draft, High   the other levels of Quality
  number        NumberOfParticles, with the number that the spacing gives
  warm          Warm Start after a step of the isovalue by STEP of the array's range, against a run from scratch there;
                the two columns after it are evaluations a particle, warm and from scratch
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


def from_scratch(reader, repetitions, **properties):
    runs = []
    for _ in range(repetitions):
        proxy = make(reader, **properties)
        runs.append(spent(proxy))
        simple.Delete(proxy)
    return least(runs)


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


def measure(path, repetitions):
    reader = simple.OpenDataFile(str(path))
    reader.UpdatePipeline()
    use_threads(2)
    result = {"file": path.name} | facts(reader)
    if result["particles"] == 0:
        return result
    result["two threads"] = from_scratch(reader, repetitions)
    use_threads(1)
    result["one thread"] = from_scratch(reader, repetitions)
    for quality in ("Draft", "High"):
        result[quality] = from_scratch(reader, repetitions, Quality=quality)
    result["number"] = from_scratch(reader, repetitions, NumberOfParticles=result["particles"])
    after = stepped(reader, result)
    result["warm"] = continued(reader, result["isovalues"], after, repetitions)
    result["scratch"] = from_scratch(reader, repetitions, Isosurfaces=after) | facts(reader, Isosurfaces=after)
    simple.Delete(reader)
    return result


def print_costs(results):
    print("\n| file | surface | particles | evaluations a particle | 1 thread, s | cpu, s | cpu, µs a particle "
          "| 2 threads, s | µs a particle |\n|---|---|---|---|---|---|---|---|---|")
    for r in results:
        surface = f"{r['array']} = {', '.join(f'{v:.4g}' for v in r['isovalues'])}"
        one, two = r["one thread"], r["two threads"]
        print(f"| `{r['file']}` | {surface} | {r['particles']:,} | {r['evaluations']:.1f} | {one['wall']:.3f} "
              f"| {one['cpu']:.3f} | {1e6 * one['cpu'] / r['particles']:.1f} "
              f"| {two['wall']:.3f} | {1e6 * two['wall'] / r['particles']:.1f} |")


def print_ratios(results):
    print("\n| file | Draft | High | number | warm | evaluations warm | from scratch |\n|---|---|---|---|---|---|---|")
    for r in results:
        others = [f"{r[name]['cpu'] / r['one thread']['cpu']:.2f}" for name in ("Draft", "High", "number")]
        warm, scratch = r["warm"], r["scratch"]
        print(f"| `{r['file']}` | {' | '.join(others)} | {warm['cpu'] / scratch['cpu']:.2f} "
              f"| {warm['evaluations']:.1f} | {scratch['evaluations']:.1f} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("plugin")
    parser.add_argument("folders", nargs="*", type=Path)
    parser.add_argument("--only", default="", help="part of the names of the files wanted")
    parser.add_argument("--repetitions", type=int, default=3)
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
        result = measure(paths[name], arguments.repetitions)
        if result["particles"] == 0:
            print(f"{name}: no particles", flush=True)
            continue
        results.append(result)
        print(f"{name} measured", flush=True)
        if arguments.json:
            arguments.json.write_text(json.dumps(results, indent=1))
    print_costs(results)
    print_ratios(results)


main()
