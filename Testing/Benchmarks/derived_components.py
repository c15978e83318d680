"""How many components of lambda 2 are missed in random cells other than those of test_derived_components.py: of three
isovalues in straight and in bent cells of each kind, those that a fine lattice sees.

    pvpython Testing/Benchmarks/derived_components.py PLUGIN [CELLS [FIRST]]      default 12 of each kind, from 100 on
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "Python"))
sys.path.insert(0, str(Path(sys.argv[1]).parents[1] / "python3" / "dist-packages"))

from paraview import simple

simple.LoadPlugin(sys.argv[1], remote=False, ns=vars(simple))

import test_derived_components as components

CELLS = int(sys.argv[2]) if len(sys.argv) > 2 else 12
FIRST = int(sys.argv[3]) if len(sys.argv) > 3 else 100

print("| cells | components | missed | their cubes of the lattice |\n|---|---|---|---|")
for name in components.KINDS:
    seen, sizes = 0, []
    for bend in (0.0, 0.08):
        for which in range(FIRST, FIRST + CELLS):
            count, missed = components.sizes_of_missed(name, bend, which)
            seen += count
            sizes += missed
    print(f"| {name} | {seen} | {len(sizes)} | {', '.join(map(str, sorted(sizes)))} |", flush=True)
