"""What particles cost and how even they stand, on all cases of distribution_benchmark: two tables, and JSON.

    python3 Testing/Benchmarks/distribution_table.py PROGRAM [FOLDER ...] [--only WORD] [--large]
        [--methods METHOD ...] [--classic-up-to N] [--repetitions N] [--json OUT.json]

Every FOLDER (default: Testing/Data) is searched for the files of solvers named below; those missing are
said. Each measurement is a process of its own. Wall times on one and two threads, and processor time of
the run on one thread, from the VTK grid to the VTK polydata, the best of the repetitions; on a machine
that does other work the processor time is the one to compare. Stages are those of one run on two
threads, in processor time; isolation (to boxes of six spacings) is part of the distribution. 'smooth' are
those particles alone whose splats reach no boundary curve and no crease, and over whose spacing the surface bends by
less than half a radian; Classic knows no boundary curves, so all its particles count as smooth there. 'sampled' cuts
every element that can hold surface into so many linear cells, and contours these in threads.
"""

import argparse
import json
import subprocess
from pathlib import Path

PYFR = {"grid": "pyfr_cylinder_5040hex_696prism_p3.vtu", "array": "Pressure", "isovalue": 17.6}
SIBLING = {"grid": "pyfr_cylinder_3360hex_7656prism_p3.vtu", "array": "Pressure", "isovalue": 17.8}
ORDER_8 = {"grid": "mfem_hex1_p8.vtu", "array": "u", "isovalue": 0.2}
DOMAINS = ("hexahedra", "tetrahedra", "wedges")

CASES = (
    *({"grid": f"sphere_{domain}", "particles": 10_000} for domain in DOMAINS),
    *({"grid": f"torus_{domain}", "particles": 10_000} for domain in DOMAINS),
    *({"grid": f"torus_{domain}", "particles": 10_000, "density": 15} for domain in DOMAINS),
    *({"grid": "needle", "particles": n, "density": 7} for n in (1_280, 3_232, 8_647)),
    *({**ORDER_8, "particles": n} for n in (500, 6_800)),
    *({**PYFR, "particles": n} for n in (5_000, 13_000, 28_000, 59_000)),
    {**SIBLING, "particles": 43_000},
    *({"grid": "gyroid", "particles": n} for n in (10_000, 100_000, 1_000_000)),
)
LARGE_CASES = ({"grid": "gyroid", "particles": 10_000_000},)

METHODS = ("fast", "classic", "contour", "tessellate", "sampled")

# Linear cells along each edge of an element, for the contour of sampled elements. Its error falls with
# their square: that of the particles, 1e-10, it would reach at some thousand.
PIECES = (2, 4, 8)

# Tessellate takes a minute and more on more cells.
MOST_CELLS_TO_TESSELLATE = 10
TIME_LIMIT = 900

COST = (
    ("particles", "{:.0f}", lambda r: r["particles"]),
    ("evaluations a particle", "{:.1f}", lambda r: r["evaluations_a_particle"]),
    ("1 thread, s", "{:.3f}", lambda r: r["seconds_1_wall"]),
    ("2 threads, s", "{:.3f}", lambda r: r["seconds_2_wall"]),
    ("processor, s", "{:.3f}", lambda r: r["seconds_1_cpu"]),
    ("processor, µs a particle", "{:.1f}", lambda r: 1e6 * r["seconds_1_cpu"] / max(1, r["particles"])),
    ("faster on 2 threads", "{:.2f}", lambda r: r["seconds_1_wall"] / r["seconds_2_wall"]),
    ("set-up", "{:.3f}", lambda r: r["setup_cpu"]),
    ("isolation", "{:.3f}", lambda r: r["isolation_cpu"]),
    ("distribution", "{:.3f}", lambda r: r["distribution_cpu"]),
    ("pack", "{:.3f}", lambda r: r["pack_cpu"]),
    ("peak MB above the grid", "{:.0f}", lambda r: r["peak_megabytes"] - r["megabytes_before"]),
)
QUALITY = (
    ("min spacing", "{:.2f}", lambda r: r["min_spacing"]),
    ("variation", "{:.3f}", lambda r: r["variation"]),
    ("min spacing, smooth", "{:.2f}", lambda r: r["min_spacing_smooth"]),
    ("variation, smooth", "{:.3f}", lambda r: r["variation_smooth"]),
    ("coverage", "{:.2f}", lambda r: r["coverage"]),
    ("circumradius", "{:.2f}", lambda r: r["circumradius"]),
    ("six-valent", "{:.3f}", lambda r: r["six_valent"]),
    ("mean min angle", "{:.1f}", lambda r: r["mean_min_angle"]),
    ("worst", "{:.1f}", lambda r: r["worst_min_angle"]),
    ("open stars", "{:.0f}", lambda r: r["open_stars"]),
    ("largest distance / diagonal", "{:.1e}", lambda r: r["residual_per_diagonal"]),
    ("mean distance / diagonal", "{:.1e}", lambda r: r["mean_error_per_diagonal"]),
)


def name_of(case):
    density = f", density {case['density']}" if case.get("density") else ""
    return f"{Path(case['grid']).stem}{density}, {case['particles']:,}"


def located(case, folders):
    """The case with the path of its file, or None if it is missing."""
    if not case["grid"].endswith(".vtu"):
        return case
    paths = (folder / case["grid"] for folder in folders)
    path = next((path for path in paths if path.is_file()), None)
    return path and {**case, "grid": str(path)}


def measure(program, **arguments):
    """One measurement, or None if it took too long."""
    command = [program] + [f"{key}={value}" for key, value in arguments.items()]
    try:
        done = subprocess.run(command, stdout=subprocess.PIPE, timeout=TIME_LIMIT, check=True)
    except subprocess.TimeoutExpired:
        return None
    return json.loads(done.stdout)


def methods(case, cells, arguments):
    affordable = {
        "classic": case["particles"] <= arguments.classic_up_to,
        "tessellate": cells <= MOST_CELLS_TO_TESSELLATE,
    }
    return [method for method in arguments.methods if affordable.get(method, True)]


def measure_case(program, case, arguments):
    found = measure(program, **case, method="spacing")
    given = {key: value for key, value in case.items() if key != "particles"}
    given["spacing"] = found["spacing"]
    for method in methods(case, found["cells"], arguments):
        slow = method in ("classic", "tessellate") or case["particles"] > 200_000
        repetitions = 1 if slow else arguments.repetitions
        for pieces in PIECES if method == "sampled" else (None,):
            more = {"pieces": pieces} if pieces else {}
            result = measure(program, **given, **more, method=method, repetitions=repetitions)
            label = f"{method}, {pieces}^3" if pieces else method
            yield {"case": name_of(case), "method": label, **(result or {"timed_out": True})}


def row(result, columns):
    cells = []
    for _, form, value in columns:
        try:
            cells.append(form.format(value(result)))
        except (KeyError, TypeError):  # not measured, or not finite
            cells.append("")
    return " | ".join(cells)


def print_table(title, results, columns):
    print(f"\n{title}\n\n| case | method | " + " | ".join(name for name, *_ in columns) + " |")
    print("|---" * (len(columns) + 2) + "|")
    for result in results:
        print(f"| {result['case']} | {result['method']} | {row(result, columns)} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("folders", nargs="*", type=Path)
    parser.add_argument("--only", default="", help="cases whose name contains this")
    parser.add_argument("--large", action="store_true", help="10 million particles too: several GB")
    parser.add_argument("--methods", nargs="+", choices=METHODS, default=METHODS)
    parser.add_argument("--classic-up-to", type=int, default=20_000, metavar="N")
    parser.add_argument("--repetitions", type=int, default=3)
    parser.add_argument("--json", type=Path)
    arguments = parser.parse_args()
    folders = arguments.folders or [Path(__file__).parent.parent / "Data"]
    results = []
    for case in CASES + (LARGE_CASES if arguments.large else ()):
        if arguments.only not in name_of(case):
            continue
        here = located(case, folders)
        if here is None:
            print(f"{case['grid']} not found")
            continue
        for result in measure_case(arguments.program, here, arguments):
            results.append(result)
            print(f"{result['case']}, {result['method']}: {row(result, COST[:6])}", flush=True)
            if arguments.json:
                arguments.json.write_text(json.dumps(results, indent=1))
    print_table("Cost", results, COST)
    print_table("Quality", results, QUALITY)


main()
