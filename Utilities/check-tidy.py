#!/usr/bin/env python3
"""What clang-tidy finds in the sources (.clang-tidy says what it looks for); they have to be built before.

    python3 Utilities/check-tidy.py [--all] [BUILD_FOLDER]

Most of its time goes into reading headers, so the files of a room are read as one, three times as fast. A group that
it finds something in is read again by halves, down to single files: two files may use one name for things of their own.
Without --all the checks of the static analyzer, which take three times as long, and the tests' sources are left out.
Exit code 77: no clang-tidy 14 here (Debian 12's; other versions find other things), or nothing was built.
"""

import argparse
import collections
import concurrent.futures
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

PROJECT = pathlib.Path(__file__).resolve().parent.parent
OPTIONS = [
    "--quiet",
    "--warnings-as-errors=*",
    "--extra-arg=-Wno-unknown-warning-option",
    "--extra-arg=-Wno-ignored-optimization-argument",
]
LARGEST_GROUP = 12  # files: all cores have something to do until the end


def find_tool():
    for name in ("clang-tidy-14", "clang-tidy"):
        tool = shutil.which(name)
        if tool and " 14." in subprocess.run([tool, "--version"], capture_output=True, text=True).stdout:
            return tool
    sys.exit(skip("clang-tidy 14 is not installed"))


def skip(reason):
    print(f"{reason}: nothing checked")
    return 77


def read_commands(build, folders):
    """How the sources below the folders are compiled. Only what is built: the kernels of instruction sets of other
    processors, for example, are not."""
    database = pathlib.Path(build, "compile_commands.json")
    if not database.exists():
        sys.exit(skip(f"{database} is missing"))
    roots = [PROJECT / folder for folder in folders]
    return {
        entry["file"]: entry
        for entry in json.loads(database.read_text())
        if any(root in pathlib.Path(entry["file"]).parents for root in roots)
    }


def group(commands):
    """Files of one folder that are compiled alike."""
    alike = collections.defaultdict(list)
    for file, entry in sorted(commands.items()):
        object_file = entry["command"].split(" -o ")[1].split()[0]
        command = entry["command"].replace(object_file, "OBJECT").replace(file, "SOURCE")
        alike[os.path.dirname(file), command].append(file)
    return [files[i : i + LARGEST_GROUP] for files in alike.values() for i in range(0, len(files), LARGEST_GROUP)]


def run(tool, database, checks, file):
    done = subprocess.run([tool, "-p", database, *OPTIONS, *checks, file], capture_output=True, text=True, check=False)
    return done.returncode, done.stdout


def check_together(tool, commands, checks, files):
    """The exit code for files read as one."""
    with tempfile.TemporaryDirectory() as folder:
        source = str(pathlib.Path(folder, "together" + pathlib.Path(files[0]).suffix))
        pathlib.Path(source).write_text("".join(f'#include "{file}" // NOLINT\n' for file in files))
        entry = commands[files[0]]
        entry = {**entry, "file": source, "command": entry["command"].replace(files[0], source)}
        pathlib.Path(folder, "compile_commands.json").write_text(json.dumps([entry]))
        shutil.copy(PROJECT / ".clang-tidy", folder)
        sources = r"--header-filter=^" + str(PROJECT) + r"/(Common|Filters|Rendering|Plugin|Testing)/.*\.(h|cpp|cxx)$"
        return run(tool, folder, [*checks, sources], source)[0]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--all", action="store_true")
    parser.add_argument("build", nargs="?", default=str(PROJECT / "build"))
    arguments = parser.parse_args()
    folders = ["Common", "Filters", "Rendering", "Plugin"] + (["Testing"] if arguments.all else [])
    checks = [] if arguments.all else ["--checks=-clang-analyzer-*"]
    tool = find_tool()
    commands = read_commands(arguments.build, folders)

    def check(files):
        """The messages on a group of files; none where all is well."""
        if len(files) == 1:
            code, text = run(tool, arguments.build, checks, files[0])
            return [text] if code != 0 else []
        if check_together(tool, commands, checks, files) == 0:
            return []
        return check(files[::2]) + check(files[1::2])

    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        messages = [text for found in pool.map(check, group(commands)) for text in found]
    print("\n".join(messages) or f"{len(commands)} files: nothing found")
    return 1 if messages else 0


if __name__ == "__main__":
    sys.exit(main())
