"""What the figures of the documentation share: colours, sizes, and where pictures are written.

Run a figure with a Python that has NumPy and Matplotlib (Debian: python3-numpy, python3-matplotlib):

    /usr/bin/python3 Documentation/figures/isolation_boxes.py [OUT.png]

Without OUT.png the picture of the documentation is replaced.
"""

import os
import sys

import matplotlib
from PIL import Image

matplotlib.use("Agg")
import matplotlib.pyplot as plt

BLUE, RED, GREEN, ORANGE, GREY, DARK = "#2f6db5", "#c0392b", "#3a9a5b", "#e08a1e", "#d9dde3", "#2b2f36"

plt.rcParams.update({
    "figure.dpi": 100,
    "font.size": 10,
    "axes.titlesize": 10.5,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.edgecolor": DARK,
    "text.color": DARK,
    "axes.labelcolor": DARK,
    "xtick.color": DARK,
    "ytick.color": DARK,
    "legend.frameon": False,
})


def save(figure, script):
    """Writes the picture that belongs to a script, or the one named on the command line."""
    name = os.path.splitext(os.path.basename(script))[0] + ".png"
    folder = os.path.join(os.path.dirname(os.path.abspath(script)), "..", "pictures")
    path = sys.argv[1] if len(sys.argv) > 1 else os.path.normpath(os.path.join(folder, name))
    figure.savefig(path, dpi=110)
    # A palette makes the file a third as large.
    Image.open(path).convert("RGB").quantize(64, dither=Image.Dither.NONE).save(path, optimize=True)
    print(path)
