"""Markdown tables of ns per evaluation from kernel_benchmark's JSON: the least of all repetitions."""
import json
import sys


def least_times(path):
    """{(domain, degree, column): ns}"""
    with open(path) as file:
        runs = json.load(file)["benchmarks"]
    times = {}
    for run in runs:
        if run["run_type"] != "iteration":
            continue
        domain, degree, order, instruction_set, how = run["run_name"].split("/")
        key = domain, int(degree), f"{instruction_set} {order}, {how}"
        times[key] = min(times.get(key, float("inf")), 1e9 * run["evaluation"])
    return times


def print_table(domain, times):
    columns = list(dict.fromkeys(column for (of, _, column) in times if of == domain))
    degrees = sorted({degree for (of, degree, _) in times if of == domain})
    print(f"\n{domain}\n\n| p | " + " | ".join(columns) + " |")
    print("|---" * (1 + len(columns)) + "|")
    for degree in degrees:
        cells = (times.get((domain, degree, column)) for column in columns)
        print(f"| {degree} | " + " | ".join("" if t is None else f"{t:.0f}" for t in cells) + " |")


if __name__ == "__main__":
    least = least_times(sys.argv[1])
    for name in dict.fromkeys(domain for (domain, _, _) in least):
        print_table(name, least)
