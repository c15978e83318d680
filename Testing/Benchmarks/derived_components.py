"""How many components of lambda 2 are missed in random cells other than those of test_derived_components.py: of three
isovalues in straight and in bent cells of each kind, those that a fine lattice sees.

    pvpython Testing/Benchmarks/derived_components.py PLUGIN [CELLS]      default 12 of each kind
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "Python"))
sys.path.insert(0, str(Path(sys.argv[1]).parents[1] / "python3" / "dist-packages"))

import numpy as np
from paraview import simple

simple.LoadPlugin(sys.argv[1], remote=False, ns=vars(simple))

import support
import test_derived_components as components

CELLS = int(sys.argv[2]) if len(sys.argv) > 2 else 12

print("| cells | components | missed | their cubes of the lattice |\n|---|---|---|---|")
for name in components.KINDS:
    seen, sizes = 0, []
    for bend in (0.0, 0.08):
        for which in range(CELLS):
            grid, within, first, gradients = components.sampled.__wrapped__(name, bend, 100 + which)
            values = np.full(within.shape, np.nan)
            values[within] = components.values_of("Lambda 2", first, gradients)
            numbered = components.components_on(values.reshape((components.KINDS[name] + 1,) * 3))
            isovalues = np.quantile(values[within], np.random.default_rng(1000 + which).random(3))
            spacing = components.SPACINGS.get(name, 0.1)
            particles, _ = support.run(grid, "u", list(isovalues), Quantity="Lambda 2", Spacing=spacing, AngularDensity=0)
            whose = np.abs(support.array_of(particles, "Isovalue")[:, None] - isovalues).argmin(axis=1)
            places = components.in_lattice(name, support.array_of(particles, "ParametricCoordinates"))
            for n, isovalue in enumerate(isovalues):
                labels = numbered(isovalue)
                seen += len(np.unique(labels)) - 1
                sizes += [int((labels == c).sum()) for c in components.unseen(labels, places[whose == n])]
    print(f"| {name} | {seen} | {len(sizes)} | {', '.join(map(str, sorted(sizes)))} |", flush=True)
