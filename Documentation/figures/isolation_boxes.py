"""Isolation of one element, in two dimensions: the boxes into which de Casteljau's algorithm splits it.

A square with a polynomial of degree 8 stands for an element. The tests are those of the numerics
(Filters/Core/Isolation), one dimension lower: a box is dropped if its coefficients have one sign; it is certified if
the corners have both signs and the coefficients of the derivative along the mean gradient are positive; otherwise it
is halved. Certified boxes are halved on until they are small enough.
"""

from math import comb

import numpy as np
from matplotlib.patches import Rectangle

from style import BLUE, DARK, GREEN, GREY, ORANGE, RED, plt, save

DEGREE = 8
SMALL = 1.0 / 8.0  # side of certified boxes at most
ISLAND, RADIUS = np.array([0.79, 0.22]), 0.021


def field(x, y):
    """A curve through the element, and a small closed one beside it."""
    arc = (x - 0.05) ** 2 + (y - 0.98) ** 2 - 0.62 ** 2 + 0.1 * x * y * y
    island = ((x - ISLAND[0]) ** 2 + (y - ISLAND[1]) ** 2) - RADIUS ** 2
    return 6.0 * arc * island


def coefficients():
    """Bernstein coefficients of the field, from its values at the lattice: it is a polynomial of lower degree."""
    t = np.arange(DEGREE + 1) / DEGREE
    basis = np.array([[comb(DEGREE, j) * s ** j * (1 - s) ** (DEGREE - j) for j in range(DEGREE + 1)] for s in t])
    values = field(t[:, None], t[None, :])
    inverse = np.linalg.inv(basis)
    return inverse @ values @ inverse.T


def bisect(c, axis):
    """Coefficients on the two halves along an axis."""
    line = np.moveaxis(c, axis, 0).copy()
    first, second = np.empty_like(line), np.empty_like(line)
    for step in range(DEGREE + 1):
        first[step], second[DEGREE - step] = line[0], line[-1]
        line = 0.5 * (line[1:] + line[:-1])
    return np.moveaxis(first, 0, axis), np.moveaxis(second, 0, axis)


def derivative(c, axis):
    """Coefficients of the derivative, elevated back to the degree of the polynomial."""
    d = DEGREE * np.diff(np.moveaxis(c, axis, 0), axis=0)
    i = np.arange(DEGREE + 1)[:, None] / DEGREE
    lower = np.vstack([np.zeros_like(d[:1]), d])
    upper = np.vstack([d, np.zeros_like(d[:1])])
    return np.moveaxis(i * lower + (1 - i) * upper, 0, axis)


def rises(c):
    du, dv = derivative(c, 0), derivative(c, 1)
    return bool(np.all(du.mean() * du + dv.mean() * dv > 0))


def split(c, x, y, width, height, certified, found):
    if c.min() > 0 or c.max() < 0:
        found["above" if c.min() > 0 else "below"].append((x, y, width, height))
        return
    corners = c[np.ix_([0, -1], [0, -1])]
    certified = certified or (corners.min() < 0 < corners.max() and rises(c))
    if certified and max(width, height) <= SMALL:
        found["certified"].append((x, y, width, height))
        return
    axis = 0 if width >= height else 1
    first, second = bisect(c, axis)
    half = (0.5 * width, height) if axis == 0 else (width, 0.5 * height)
    split(first, x, y, *half, certified, found)
    split(second, x + (width - half[0]), y + (height - half[1]), *half, certified, found)


def draw(axes, found, title):
    for kind, colour in (("above", GREY), ("below", ORANGE), ("certified", GREEN)):
        for x, y, width, height in found[kind]:
            axes.add_patch(Rectangle((x, y), width, height, facecolor=colour, alpha=0.55, edgecolor=DARK, lw=0.4))
    t = np.linspace(0, 1, 1601)
    axes.contour(t, t, field(t[None, :], t[:, None]), levels=[0], colors=[BLUE], linewidths=1.6)
    axes.set_aspect("equal")
    axes.set_title(title)


def main():
    found = {"above": [], "below": [], "certified": []}
    split(coefficients(), 0.0, 0.0, 1.0, 1.0, False, found)
    figure, (whole, zoom) = plt.subplots(1, 2, figsize=(8.6, 4.4))
    dropped = len(found["above"]) + len(found["below"])
    draw(whole, found, f"{len(found['certified'])} certified boxes (green), {dropped} dropped")
    whole.set(xlim=(-0.01, 1.01), ylim=(-0.01, 1.01), xlabel="u", ylabel="v", xticks=[0, 0.5, 1], yticks=[0, 0.5, 1])
    reach = 0.075
    whole.add_patch(Rectangle(ISLAND - reach, 2 * reach, 2 * reach, fill=False, edgecolor=RED, lw=1.5))
    draw(zoom, found, "around the closed curve on the right")
    around = reach * np.array([-1, 1])
    zoom.set(xlim=ISLAND[0] + around, ylim=ISLAND[1] + around, xticks=[], yticks=[])
    for spine in zoom.spines.values():
        spine.set(visible=True, edgecolor=RED, linewidth=1.5)
    figure.tight_layout()
    save(figure, __file__)


main()
