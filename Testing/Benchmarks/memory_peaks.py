"""Memory that a run takes at its peak: a table for performance.md.

    pvpython Testing/Benchmarks/memory_peaks.py PLUGIN [FOLDER ...] [--finer FACTOR] [--output-type TYPE]

Every grid of the FOLDERs (default: Testing/Data) is opened as the GUI would, and contoured in a process of its own, with
array and isovalue left as they come, and the default spacing divided by FACTOR (default 1). The peak is what the kernel
counts (Linux: VmHWM) beyond what was resident before the run; the output is part of it.
"""

import argparse
import json
import subprocess
from pathlib import Path

from paraview import simple


def resident(key):
    """Bytes: VmRSS now, VmHWM at most since it was reset."""
    line = next(line for line in Path("/proc/self/status").read_text().splitlines() if line.startswith(key))
    return 1024 * int(line.split()[1])


def measure(plugin, path, finer, output_type):
    simple.LoadPlugin(plugin, remote=False, ns=vars(simple))
    reader = simple.OpenDataFile(path)
    reader.UpdatePipeline()
    surface = simple.HighOrderParticleIsosurface(Input=reader, OutputType=output_type)
    surface.Spacing /= finer
    before = resident("VmRSS")
    Path("/proc/self/clear_refs").write_text("5")  # resets VmHWM
    surface.UpdatePipeline()
    peak = resident("VmHWM") - before
    output = surface.GetClientSideObject().GetOutputDataObject(0)
    return {"points": output.GetNumberOfElements(0), "output": 1024 * output.GetActualMemorySize(), "peak": peak}


def measured(arguments, path):
    """In a process of its own: memory that another file left free would hide some."""
    command = ["pvpython", __file__, arguments.plugin, "--one", str(path), "--finer", str(arguments.finer),
               "--output-type", arguments.output_type]  # fmt: skip
    done = subprocess.run(command, capture_output=True, text=True)
    line = next((line for line in done.stdout.splitlines() if line.startswith("{")), None)
    return json.loads(line) if line else None


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("plugin")
    parser.add_argument("folders", nargs="*", default=[Path(__file__).parent.parent / "Data"], type=Path)
    parser.add_argument("--finer", type=float, default=1.0)
    parser.add_argument("--output-type", default="Particles")
    parser.add_argument("--one", help="this file alone, in this process: JSON")
    arguments = parser.parse_args()
    if arguments.one:
        print(json.dumps(measure(arguments.plugin, arguments.one, arguments.finer, arguments.output_type)))
        return
    print("| file | points | peak, MB | bytes a point | of these the output |\n|---|---|---|---|---|")
    for path in sorted(path for folder in arguments.folders for path in (*folder.glob("*.vtu"), *folder.glob("*.pvtu"))):
        found = measured(arguments, path)
        if not found or not found["points"]:
            print(f"| {path.name} | nothing | | | |", flush=True)
            continue
        points = found["points"]
        print(f"| {path.name} | {points:,} | {found['peak'] / 1e6:.1f} | {found['peak'] / points:,.0f} | "
              f"{found['output'] / points:,.0f} |", flush=True)


if __name__ == "__main__":
    main()
