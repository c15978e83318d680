"""The energy of a pair of particles (Filters/Core/Surface/Energy.h) and the rings of hexagonal packing on its axis."""

import numpy as np

from style import BLUE, DARK, GREY, ORANGE, RED, plt, save

BETA = 0.5 / np.cos(np.pi / 6)


def energy(r):
    a = 0.5 * np.pi * r
    return np.where(r < 1, 1 / np.tan(a) + a - 0.5 * np.pi, 0.0)


def slope(r):
    return np.where(r < 1, 0.5 * np.pi * (1 - 1 / np.sin(0.5 * np.pi * np.minimum(r, 1)) ** 2), 0.0)


def draw_curves(axes):
    r = np.linspace(0.2, 1.25, 500)
    axes.plot(r, energy(r), color=BLUE, lw=2, label="$E(r)$")
    axes.plot(r, slope(r), color=RED, lw=2, label="$E'(r)$")
    axes.axhline(0, color=DARK, lw=0.6)
    for place, text in ((BETA, "first ring\n$r=\\beta$"), (1.0, "second ring\n$r=1$")):
        axes.axvline(place, color=ORANGE, lw=1.2, ls="--")
        axes.text(place + 0.015, 1.45, text, color=ORANGE, va="top")
    axes.plot([BETA, BETA], [energy(BETA), slope(BETA)], "o", color=ORANGE, ms=5)
    line = {"arrowstyle": "-", "lw": 0.6}
    axes.annotate(f"$E(\\beta)={energy(BETA):.4f}$", (BETA, energy(BETA)), (0.68, 0.45), arrowprops=line)
    axes.annotate(f"$E'(\\beta)={slope(BETA):.4f}$", (BETA, slope(BETA)), (0.66, -1.35), arrowprops=line)
    axes.set(xlim=(0.2, 1.25), ylim=(-4, 1.5), xlabel="scaled distance $r=\\beta\\,d/h$")
    axes.legend(loc="lower right")


def draw_packing(axes):
    steps = range(-3, 4)
    points = np.array([(i + 0.5 * j, 0.5 * np.sqrt(3) * j) for i in steps for j in steps])
    points = points[np.hypot(*points.T) < 2.3]
    scaled = BETA * np.hypot(*points.T)
    seen = (scaled > 0) & (scaled < 1 - 1e-9)
    axes.scatter(*points[~seen].T, color=GREY, s=70, edgecolors=DARK, linewidths=0.5)
    axes.scatter(*points[seen].T, color=BLUE, s=70)
    axes.scatter(0, 0, color=RED, s=90)
    for radius, text in ((1.0, "$h$"), (1 / BETA, "$h/\\beta=\\sqrt{3}\\,h$")):
        axes.add_patch(plt.Circle((0, 0), radius, fill=False, color=ORANGE, ls="--", lw=1.2))
        axes.text(0.26 * radius, -0.966 * radius - 0.05, text, color=ORANGE, ha="left", va="top")
    axes.set(xlim=(-2.35, 2.35), ylim=(-2.35, 2.35), xticks=[], yticks=[])
    axes.set_aspect("equal")
    for spine in axes.spines.values():
        spine.set_visible(False)
    axes.set_title("only the first ring repels")


def main():
    figure, (left, right) = plt.subplots(1, 2, figsize=(8.6, 3.9), gridspec_kw={"width_ratios": [1.25, 1]})
    draw_curves(left)
    draw_packing(right)
    figure.tight_layout()
    save(figure, __file__)


main()
