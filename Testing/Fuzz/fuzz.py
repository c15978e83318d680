#!/usr/bin/env python3
"""Feeds the filter with random inputs, and shrinks what fails.

    fuzz.py [--first SEED] [--cases N] [--seconds S] [--limit S] [--failures FOLDER]     random recipes
    fuzz.py FILE.json|FOLDER ...                                                          these recipes again

To be run by pvpython, in the environment of the tests: `ctest -R Fuzz.random -V` shows it. Failures are written
as recipes into FOLDER, after shrinking; those worth keeping go to Testing/Fuzz/corpus, which is a test.

A recipe fails if the process ends, if it takes more processor time than the limit, or if judge.py complains. Crashes of
VTK's own reader on damaged files are counted, and are no failures.
"""

import argparse
import json
import os
import re
import select
import subprocess
import sys
import tempfile
import time
from pathlib import Path

HERE = Path(__file__).parent
# Time on the clock, in units of the limit of processor time, after which a process that does nothing is stopped.
WAITING = 20


class Worker:
    """A process that runs recipes, one after the other; started anew where it has ended."""

    def __init__(self, limit):
        self.limit = limit
        self.process = None
        self.errors = None

    def start(self):
        self.errors = tempfile.TemporaryFile(mode="w+", errors="replace")
        self.process = subprocess.Popen(
            [os.environ.get("HOP_PVPYTHON", "pvpython"), str(HERE / "judge.py")],
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=self.errors, text=True, bufsize=1,
        )  # fmt: skip

    def stop(self):
        if self.process:
            self.process.kill()
            self.process.wait()
            self.process = None

    def last_words(self):
        """What a sanitizer or an uncaught exception wrote before the process ended."""
        self.errors.seek(0)
        told = [line.strip() for line in self.errors if re.search("Sanitizer|runtime error|Error:|terminate", line)]
        return "; ".join(told[:2])

    def processor_time(self):
        """Seconds that the process has used."""
        fields = Path(f"/proc/{self.process.pid}/stat").read_text().rsplit(")", 1)[1].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

    def run(self, recipe):
        """(what is wrong, how many particles, longest silence)"""
        if not self.process or self.process.poll() is not None:
            self.start()
        begin, start = self.processor_time(), time.monotonic()
        self.process.stdin.write(json.dumps(recipe) + "\n")
        self.process.stdin.flush()
        reading = False
        text = b""
        while True:
            ready, _, _ = select.select([self.process.stdout], [], [], 0.1)
            if ready:
                # Not readline(): it may keep a second line to itself, for which select() would wait for ever.
                some = os.read(self.process.stdout.fileno(), 65536)
                text += some
                if not some:
                    self.process.wait()
                    code, self.process = self.process.returncode, None
                    return ([] if reading else [f"the process ended with code {code}: {self.last_words()}"]), 0, 0.0
                *lines, text = text.split(b"\n")
                for answer in (json.loads(line) for line in lines if line.startswith(b"{")):
                    reading = answer.get("reading", reading)
                    if "complaints" in answer:
                        return answer["complaints"], answer["particles"], answer["silence"]
                continue
            limit = self.limit * (1 + len(recipe["changes"]))
            if self.processor_time() - begin > limit or time.monotonic() - start > WAITING * limit:
                self.stop()
                return [f"no end after {self.limit} s"], 0, 0.0


def shrink(worker, recipe, complaint, simpler, seconds=120):
    """The simplest recipe found that gives a complaint of the same kind."""
    end = time.monotonic() + seconds
    kind = complaint.split()[:3]
    found = True
    while found and time.monotonic() < end:
        found = False
        for smaller in simpler(recipe):
            if any(text.split()[:3] == kind for text in worker.run(smaller)[0]):
                recipe, found = smaller, True
                break
            if time.monotonic() > end:
                break
    return recipe


def replay(worker, paths):
    failures = 0
    files = [file for path in map(Path, paths) for file in (sorted(path.glob("*.json")) if path.is_dir() else [path])]
    for file in files:
        complaints, particles, silence = worker.run(json.loads(file.read_text()))
        print(f"{file.name}: {particles} particles, {complaints or 'sound'}", flush=True)
        failures += bool(complaints)
    return failures if files else 1


def explore(worker, arguments):
    """Random recipes; those that fail are shrunk."""
    import recipes

    end = time.monotonic() + arguments.seconds
    failures, cases, particles, silences = 0, 0, 0, []
    for seed in range(arguments.first, arguments.first + arguments.cases):
        if time.monotonic() > end:
            break
        recipe = recipes.random_recipe(seed)
        complaints, count, silence = worker.run(recipe)
        cases += 1
        particles += count
        silences.append((silence, seed))
        if complaints:
            failures += 1
            print(f"seed {seed}: {complaints[0]}", flush=True)
            small = shrink(worker, recipe, complaints[0], recipes.simpler) if arguments.shrink else recipe
            folder = Path(arguments.failures)
            folder.mkdir(parents=True, exist_ok=True)
            small["complaint"] = complaints[0]
            (folder / f"seed_{seed}.json").write_text(json.dumps(small, indent=1) + "\n")
    longest = sorted(silences, reverse=True)[:3]
    print(f"{cases} cases, {particles} particles, {failures} failures; longest silences (s, seed): {longest}")
    return failures


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--first", type=int, default=1, help="seed of the first case")
    parser.add_argument("--cases", type=int, default=10**9)
    parser.add_argument("--seconds", type=float, default=60.0, help="no case begins later")
    parser.add_argument("--limit", type=float, default=10.0, help="processor time of a run, seconds")
    parser.add_argument("--failures", default="fuzz_failures", help="folder for recipes that fail")
    parser.add_argument("--no-shrink", dest="shrink", action="store_false")
    parser.add_argument("files", nargs="*")
    arguments = parser.parse_args()
    worker = Worker(arguments.limit)
    failures = replay(worker, arguments.files) if arguments.files else explore(worker, arguments)
    worker.stop()
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    sys.path.insert(0, str(HERE.parent / "Python"))
    main()
