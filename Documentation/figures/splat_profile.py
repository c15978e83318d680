"""The weight of a splat (Common/SplatProfile.h), and how splats add up to a surface along a line of particles."""

import numpy as np

from style import BLUE, DARK, GREEN, GREY, ORANGE, RED, plt, save

SHARPNESS, THRESHOLD = 2.0, 0.05


def weight(r, sharpness=SHARPNESS):
    at_rim = np.exp(-sharpness)
    return np.where(np.abs(r) < 1, (np.exp(-sharpness * r * r) - at_rim) / (1 - at_rim), 0.0)


def reach():
    at_rim = np.exp(-SHARPNESS)
    return np.sqrt(-np.log(THRESHOLD * (1 - at_rim) + at_rim) / SHARPNESS)


def draw_profile(axes):
    r = np.linspace(0, 1.15, 400)
    for sharpness, colour in ((0.5, GREEN), (2.0, BLUE), (8.0, RED)):
        axes.plot(r, weight(r, sharpness), color=colour, lw=2, label=f"sharpness {sharpness:g}")
    axes.axhline(THRESHOLD, color=ORANGE, lw=1, ls="--")
    axes.axvline(reach(), color=ORANGE, lw=1, ls="--")
    axes.text(reach() - 0.02, 0.42, f"reach {reach():.3f}", color=ORANGE, rotation=90, ha="right")
    axes.text(0.02, THRESHOLD + 0.015, "0.05", color=ORANGE)
    axes.axvline(1.0, color=DARK, lw=0.8)
    axes.text(1.015, 0.55, "rim", rotation=90)
    axes.set(xlim=(0, 1.15), ylim=(0, 1.05), xlabel="distance in radii", ylabel="weight $w$")
    axes.legend(loc="upper right", bbox_to_anchor=(0.82, 1.05), handlelength=1.2)


def draw_sum(axes):
    """A circle of radius 2.2 spacings, seen from the side: disks, and the place that resolving finds."""
    radius = 2.2
    angles = np.arange(-3, 4) / radius
    x = np.linspace(-1.75, 1.75, 700)
    circle = np.sqrt(radius ** 2 - x ** 2)
    sums, depth, normal_sum, offset_sum = 0.0, 0.0, np.zeros((2, x.size)), np.zeros((2, x.size))
    for angle in angles:
        n = np.array([np.sin(angle), np.cos(angle)])
        centre = radius * n
        tangent = np.array([n[1], -n[0]])
        along = (x - centre[0]) / tangent[0]
        w = weight(along)
        z = centre[1] + along * tangent[1]
        axes.plot(*(centre[:, None] + tangent[:, None] * np.array([-1, 1])), color=GREY, lw=2, zorder=1)
        axes.plot(*centre, "o", color=DARK, ms=4, zorder=3)
        sums, depth = sums + w, depth + w * z
        normal_sum += w * n[:, None]
        offset_sum += w * along * tangent[:, None]
    mean_normal = normal_sum / np.hypot(*normal_sum)
    mean_depth = depth / sums
    below = 0.5 * (mean_normal * offset_sum / sums).sum(0)
    axes.plot(x, circle, color=DARK, lw=1, ls=":", label="surface", zorder=2)
    axes.plot(x, mean_depth, color=ORANGE, lw=1.6, label="mean of the disks", zorder=2)
    axes.plot(x, mean_depth - below / mean_normal[1], color=BLUE, lw=1.8, label="resolved", zorder=2)
    axes.set(xlim=(-1.75, 1.75), ylim=(1.25, 2.55), xticks=[], yticks=[])
    axes.set_aspect("equal")
    axes.legend(loc="lower center", ncol=3, fontsize=9)
    axes.set_title("disks one radius $h$ wide on a circle of 2.2 $h$, seen from the side", fontsize=10)
    for spine in axes.spines.values():
        spine.set_visible(False)


def main():
    figure, (left, right) = plt.subplots(1, 2, figsize=(9.2, 3.5), gridspec_kw={"width_ratios": [1, 1.45]})
    draw_profile(left)
    draw_sum(right)
    figure.tight_layout()
    save(figure, __file__)


main()
