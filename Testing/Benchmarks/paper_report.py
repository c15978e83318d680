"""All cases of the paper, by all methods, in one report: tables, plots and pictures.

    bash Utilities/paper.sh [FOLDER]     builds what is needed and runs this

Each measurement is a process of distribution_benchmark, with a limit on its processor time: on a machine that does
other work, processor times are the ones to compare. results.md and its PNGs are written into FOLDER.
"""

import argparse
import json
import resource
import signal
import subprocess
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

HERE = Path(__file__).resolve().parent
ORDER_8 = str(HERE.parent / "Data" / "mfem_hex1_p8.vtu")
STREET = {"grid": "vortex_street", "isovalue": -0.5}

# Name, what is asked for, and what the paper has: particles, seconds, evaluations a particle (None: not known to us).
CASES = (
    ("teardrop, ρ = 7", {"grid": "teardrop", "density": 7, "particles": 1_280}, None),
    ("teardrop, ρ = 7, finer", {"grid": "teardrop", "density": 7, "particles": 3_232}, None),
    ("teardrop, ρ = 7, finest", {"grid": "teardrop", "density": 7, "particles": 8_647}, None),
    ("quartic, ρ = 0", {"grid": "quartic", "density": 0, "spacing": 0.1}, None),
    ("quartic, ρ = 7", {"grid": "quartic", "density": 7, "spacing": 0.1}, None),
    ("quartic, ρ = 15", {"grid": "quartic", "density": 15, "spacing": 0.1}, None),
    ("tangle cube, ρ = 15", {"grid": "tangle", "density": 15, "spacing": 0.1}, None),
    ("octic, ρ = 7", {"grid": "octic", "density": 7, "spacing": 0.1}, None),
    ("one hexahedron of order 8", {"grid": ORDER_8, "array": "u", "isovalue": 0.2, "particles": 6_800},
     "6,800 particles in 3 min"),
    ("vortex street", {**STREET, "particles": 59_000}, "59,000 particles in 39 min, on a flow solver's field"),
    ("gyroid in 4,096 cubic hexahedra", {"grid": "gyroid", "density": 0, "particles": 20_000}, None),
)
PAPER_EVALUATIONS = (555, 859)
PIECES = (2, 4, 8, 16)
MOST_SAMPLED_CELLS = 3_000_000
# Classic and Tessellate take minutes on more.
MOST_FOR_CLASSIC = 9_000
MOST_CELLS_TO_TESSELLATE = 8


def measure(program, limit, **arguments):
    """One measurement, or None where it took more processor time than the limit."""
    command = [program] + [f"{key}={value}" for key, value in arguments.items()]
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (limit, limit)))
    if done.returncode in (-signal.SIGXCPU, -signal.SIGKILL):
        return None
    if done.returncode != 0:
        raise RuntimeError(f"{' '.join(command)}: {done.stderr.decode()}")
    return json.loads(done.stdout)


def runs_of(asked, found):
    """The measurements of a case: label, arguments."""
    yield "Fast", {"method": "fast"}
    if found["particles"] <= MOST_FOR_CLASSIC:
        yield "Classic", {"method": "classic"}
    yield "Contour", {"method": "contour"}
    if found["cells"] <= MOST_CELLS_TO_TESSELLATE and asked["grid"] == "teardrop":
        yield "Tessellate, Contour", {"method": "tessellate"}
    for pieces in PIECES:
        if found["cells"] * pieces**3 <= MOST_SAMPLED_CELLS:
            yield f"sampled {pieces}³", {"method": "sampled", "pieces": pieces}


def measure_case(program, limit, name, case):
    found = measure(program, 60, **{**case, "method": "spacing"})
    asked = {key: value for key, value in case.items() if key != "particles"} | {"spacing": found["spacing"]}
    found["particles"] = case.get("particles", 0)
    for label, arguments in runs_of(asked, found):
        result = measure(program, limit, **asked, **arguments, repetitions=1) or {"over_limit": True}
        print(f"{name}, {label}: {result.get('seconds_1_cpu', 'over the limit')}", flush=True)
        yield {"case": name, "method": label, "spacing": found["spacing"], "cells": found["cells"], **result}


def cell(result, key, form):
    is_error = "residual" in key and not result["particles"]
    value = None if is_error else result.get(key)
    return "" if value is None else form.format(value)


COLUMNS = (
    ("points", "particles", "{:,.0f}"),
    ("triangles", "triangles", "{:,.0f}"),
    ("processor, s", "seconds_1_cpu", "{:.3f}"),
    ("evaluations a particle", "evaluations_a_particle", "{:.1f}"),
    ("largest error / diagonal", "residual_per_diagonal", "{:.1e}"),
    ("after Newton", "residual_after_newton_per_diagonal", "{:.1e}"),
    ("Newton failed", "not_projected", "{:.0f}"),
    ("min spacing", "min_spacing", "{:.2f}"),
    ("variation", "variation", "{:.3f}"),
)


def table(results):
    lines = ["| method | " + " | ".join(name for name, *_ in COLUMNS) + " |", "|---" * (len(COLUMNS) + 1) + "|"]
    for result in results:
        if "over_limit" in result:
            lines.append(f"| {result['method']} | over the limit of processor time |" + " |" * (len(COLUMNS) - 1))
        else:
            lines.append(f"| {result['method']} | " + " | ".join(cell(result, k, f) for _, k, f in COLUMNS) + " |")
    return lines


GROUPS = {"Fast": "o#1f77b4", "Classic": "s#ff7f0e", "Contour": "x#2ca02c", "Tessellate": "+#9467bd", "sampled": ".#d62728"}


def plot_errors(results, path):
    """Largest error against processor time, a panel a case; what finds no surface has no error."""
    names = [name for name, *_ in CASES if name in ("teardrop, ρ = 7, finer", "quartic, ρ = 0", "octic, ρ = 7",
                                                    "one hexahedron of order 8")]
    figure, axes = plt.subplots(1, len(names), figsize=(12, 3.6), sharey=True)
    for axis, name in zip(axes, names):
        of_case = [r for r in results if r["case"] == name and r.get("particles")]
        for group, style in GROUPS.items():
            chosen = [r for r in of_case if r["method"].startswith(group)]
            axis.loglog([r["seconds_1_cpu"] for r in chosen], [r["residual_per_diagonal"] for r in chosen],
                        style[0] + "-", color=style[1:], label=group)
        axis.set_title(name, fontsize=10)
        axis.set_xlabel("processor time, s")
        axis.set_xlim(1e-3, 30)
        axis.grid(alpha=0.3)
    axes[0].set_ylabel("largest error / diagonal")
    figure.legend(*axes[0].get_legend_handles_labels(), loc="lower center", ncol=len(GROUPS))
    figure.tight_layout(rect=(0, 0.1, 1, 1))
    figure.savefig(path, dpi=75)


def plot_evaluations(results, path):
    both = [name for name, *_ in CASES if any(r["case"] == name and r["method"] == "Fast" for r in results)]
    figure, axis = plt.subplots(figsize=(11, 4.2))
    for shift, method in ((-0.2, "Fast"), (0.2, "Classic")):
        found = {r["case"]: r.get("evaluations_a_particle") for r in results if r["method"] == method}
        bars = [(i, found[name]) for i, name in enumerate(both) if found.get(name)]
        drawn = axis.bar([i + shift for i, _ in bars], [value for _, value in bars], 0.38, label=method)
        axis.bar_label(drawn, labels=[f"{value:.0f}" if value >= 100 else f"{value:.1f}" for _, value in bars], fontsize=7)
    axis.axhspan(*PAPER_EVALUATIONS, alpha=0.25, color="grey", zorder=0,
                 label="the paper's method in the paper, {} to {}".format(*PAPER_EVALUATIONS))
    axis.set_yscale("log")
    axis.set_ylim(1, 2000)
    axis.set_xticks(range(len(both)), both, rotation=25, ha="right", fontsize=8)
    axis.set_ylabel("evaluations a particle")
    figure.legend(loc="upper center", ncol=3, fontsize=8)
    figure.tight_layout(rect=(0, 0, 1, 0.93))
    figure.savefig(path, dpi=75)


def seconds_of(result):
    if not result or "over_limit" in result:
        return "over the limit" if result else "not tried"
    return f"{result['particles']:,.0f} in {result['seconds_1_cpu']:.2f} s"


def beside_the_paper(results):
    """What the paper says of a case, and what both methods do here."""
    lines = ["| case | the paper | Fast | Classic | evaluations a particle, Fast | Classic |", "|---" * 6 + "|"]
    for name, _, paper in CASES:
        found = {r["method"]: r for r in results if r["case"] == name}
        if found:
            fast, classic = found.get("Fast"), found.get("Classic")
            counts = [cell(r, "evaluations_a_particle", "{:.1f}") if r and "over_limit" not in r else ""
                      for r in (fast, classic)]
            lines.append(f"| {name} | {paper or ''} | {seconds_of(fast)} | {seconds_of(classic)} | "
                         + " | ".join(counts) + " |")
    return lines


def newest():
    """The commit and the machine, for the head of the report."""
    commit = subprocess.run(["git", "-C", str(HERE), "log", "-1", "--format=%h, %cs"], capture_output=True, text=True)
    lines = Path("/proc/cpuinfo").read_text().splitlines()
    processor = next((line.split(":")[1].strip() for line in lines if line.startswith("model name")), "unknown")
    return f"Commit {commit.stdout.strip()}; {processor}."


def write_report(results, folder, limit):
    lines = [
        "# The paper's cases, measured", "",
        f"By `bash Utilities/paper.sh`. {newest()}", "",
        "Times are processor seconds of one thread, one run, from the VTK grid to the VTK polydata. *sampled k³* cuts",
        "each element that can hold surface into k³ linear cells and contours these (marching cells): it is the peer at a",
        "chosen accuracy. *after Newton* is its largest error once its points are put onto the surface by Newton's method,",
        "in time that is not counted, without those that did not get there within one spacing. Measurements that take",
        f"more than {limit} s of processor time, all checks included, are given up. *Classic* is tried up to",
        f"{MOST_FOR_CLASSIC:,} particles, Tessellate on the teardrop. The cases are in",
        "`Testing/Benchmarks/BenchmarkGrids.h`.", "",
        "[What of the paper is where, what differs, and why Classic takes other numbers of evaluations](paper.md).", "",
        "## Beside the paper", "",
        "Particles, and processor seconds of one thread. The paper's times are those of a machine of 2007; it counts "
        "{} to {}".format(*PAPER_EVALUATIONS),
        "evaluations a particle.", "", *beside_the_paper(results), "",
        "![Largest error against time](ERRORS)", "", "![Evaluations a particle](EVALUATIONS)", "",
    ]
    for name, _, paper in CASES:
        of_case = [r for r in results if r["case"] == name]
        if of_case:
            lines += [f"## {name[0].upper()}{name[1:]}", "",
                      f"{of_case[0]['cells']:,.0f} cells, spacing {of_case[0]['spacing']:.4g}."
                      + (f" The paper: {paper}." if paper else ""), "", *table(of_case), ""]
    lines += ["## Pictures", "", "Each case twice: particles as points, those behind showing through, and the same particles as splats.", "",
              "![All cases](PICTURES)", ""]
    text = "\n".join(lines)
    for word, name in (("ERRORS", "errors"), ("EVALUATIONS", "evaluations"), ("PICTURES", "cases")):
        text = text.replace(f"({word})", f"(pictures/results_{name}.png)")
    (folder / "results.md").write_text(text)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("folder", type=Path)
    parser.add_argument("--limit", type=int, default=40, help="processor seconds a measurement")
    parser.add_argument("--only", default="", help="cases whose name contains this")
    options = parser.parse_args()
    (options.folder / "pictures").mkdir(parents=True, exist_ok=True)
    results = []
    for name, case, _ in CASES:
        if options.only in name:
            results += measure_case(options.program, options.limit, name, case)
            (options.folder / "results.json").write_text(json.dumps(results, indent=1))
    if not options.only:
        plot_errors(results, options.folder / "pictures" / "results_errors.png")
        plot_evaluations(results, options.folder / "pictures" / "results_evaluations.png")
    write_report(results, options.folder, options.limit)


main()
