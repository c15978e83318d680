"""Seeds and what the sweeps of the Fast distribution make of them, on a flat periodic square with a sizing field.

The step is the one of Filters/Core/Kernel/Sweep.h: Newton's step on the energy of a particle, eigenvalues of the
Hessian raised to 0.35 of their value in hexagonal packing, times 1.5, no farther than half a spacing from where the
round began. Here particles move one after the other, in random order; the numerics move colour by colour. Insertion
and deletion are left out: the number of particles stays.
"""

import numpy as np
from matplotlib.tri import Triangulation

from style import BLUE, GREY, ORANGE, plt, save

BETA = 0.5 / np.cos(np.pi / 6)
GOLDEN = 0.61803398874989485
SIZE = 1.0
SOFTEST = 0.35 * 13.7
ROUNDS = (7, 13)


def spacing(p):
    """Between 0.045 and 0.09; its slope stays below the limit of gradation, 0.3."""
    return 0.0675 - 0.0225 * np.cos(2 * np.pi * p[..., 0] / SIZE)


def seeds():
    """Systematic sampling of the density 2/(sqrt(3) h^2), on strips in the order of x."""
    x = np.linspace(0, SIZE, 20001)
    middle = 0.5 * (x[1:] + x[:-1])
    weights = 2 / np.sqrt(3) / spacing(middle[:, None]) ** 2 * SIZE * np.diff(x)
    sums = np.concatenate([[0], np.cumsum(weights)])
    count = int(round(sums[-1]))
    k = np.arange(count)
    return np.column_stack([np.interp((k + 0.5) * sums[-1] / count, sums, x), np.mod(GOLDEN * k, 1.0) * SIZE])


def newton_step(p, i):
    h = spacing(p)
    d = p[i] - p
    d -= SIZE * np.round(d / SIZE)
    alpha = 0.5 * BETA * (1 / h[i] + 1 / h)
    r = alpha * np.hypot(d[:, 0], d[:, 1])
    near = (r < 1) & (np.arange(len(p)) != i)
    d, alpha, r = d[near], alpha[near], np.maximum(r[near], 1e-2)
    q = 1 / np.tan(0.5 * np.pi * r)
    first = -0.5 * np.pi * q * q / r
    second = (0.5 * np.pi ** 2 * q * (1 + q * q) - first) / r ** 2 * alpha ** 2
    gradient = (first[:, None] * d).sum(0)
    hessian = np.einsum("n,na,nb->ab", second, d, d) + first.sum() * np.eye(2)
    values, vectors = np.linalg.eigh(hessian)
    return -vectors @ ((vectors.T @ gradient) / np.maximum(values, SOFTEST))


def relax(p, sweeps, random):
    start = p.copy()
    for _ in range(sweeps):
        for i in random.permutation(len(p)):
            moved = p[i] + 1.5 * newton_step(p, i) - start[i]
            farthest = 0.5 * spacing(start[i])
            p[i] = start[i] + moved * min(1.0, farthest / max(np.hypot(*moved), 1e-30))
    return np.mod(p, SIZE)


def neighbours(p):
    """Number of neighbours of each particle, and distances to the nearest in units of the spacing."""
    shifts = [(i, j) for i in (0, -1, 1) for j in (0, -1, 1)]
    copies = np.concatenate([p + SIZE * np.array(s) for s in shifts])
    triangulation = Triangulation(*copies.T)
    count = np.bincount(triangulation.edges.ravel(), minlength=len(copies))[: len(p)]
    edges = triangulation.edges
    lengths = np.hypot(*(copies[edges[:, 0]] - copies[edges[:, 1]]).T)
    nearest = np.full(len(copies), np.inf)
    np.minimum.at(nearest, edges[:, 0], lengths)
    np.minimum.at(nearest, edges[:, 1], lengths)
    return count, nearest[: len(p)] / spacing(p)


def draw(axes, p, title):
    count, nearest = neighbours(p)
    for mask, colour in ((count == 6, GREY), (count < 6, ORANGE), (count > 6, BLUE)):
        for x, h in zip(p[mask], spacing(p[mask])):
            axes.add_patch(plt.Circle(x, 0.46 * h, facecolor=colour, edgecolor="white", lw=0.3))
    axes.set(xlim=(0, SIZE), ylim=(0, SIZE), xticks=[], yticks=[])
    axes.set_aspect("equal")
    axes.set_title(
        f"{title}\nclosest pair {nearest.min():.2f} $h$, variation {nearest.std() / nearest.mean():.1%}", fontsize=9.5)
    for spine in axes.spines.values():
        spine.set_visible(False)


def main():
    random = np.random.default_rng(1)
    p = seeds()
    figure, axes = plt.subplots(1, 3, figsize=(9.6, 3.7))
    draw(axes[0], p, f"{len(p)} seeds")
    for n, sweeps in enumerate(ROUNDS):
        p = relax(p, sweeps, random)
        draw(axes[n + 1], p, f"after {sum(ROUNDS[: n + 1])} sweeps")
    figure.tight_layout()
    save(figure, __file__)


main()
