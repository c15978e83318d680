#!/usr/bin/env python3
"""A session in ParaView's window: random changes in the panel, each applied and drawn; whether memory grows, and whether
the last changes take longer.

    gui_session.py [--changes N] [--parts N] [--seed N]

First the same round of changes is made: every property once. Then come parts of random changes, the same round after
each; the first part warms up. What is compared are the bytes that are allocated after the rounds, and the processor time of the rounds. Resident memory
is told, too: it has what glibc keeps in pieces.
To be run by pvpython in the environment that `ctest -R Python.test_gui -V` shows.
"""

import argparse
import json
import os
import random
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE.parent / "Python"))

from long_use import MOST_GROWTH, MOST_SLOWDOWN
from paraview import simple
from window import FILTERS_PANEL, PANEL, event, own_screen, start, write_scalar_and_vector

# Widget, command and what it is set to: the first is the default.
CHOICES = {
    "SelectInputScalars": ("ComboBox", "activated", ["u", "velocity"]),
    "Quantity": ("ComboBox", "activated", ["Value", "Gradient Magnitude", "Expression"]),
    "Derivatives": ("ComboBox", "activated", ["In Each Cell", "Averaged At Nodes"]),
    "PassDerivatives": ("CheckBox", "set_boolean", ["false", "true"]),
    "Spacing": ("DoubleRangeWidget/DoubleLineEdit", "set_string", ["0.1", "0.07", "0.15", "0.2"]),
    "AngularDensity": ("DoubleRangeWidget/DoubleLineEdit", "set_string", ["0", "3", "6"]),
    "Quality": ("ComboBox", "activated", ["Standard", "Draft", "High"]),
    "SmallestSpacing": ("DoubleLineEdit0", "set_string", ["0", "0.05"]),
    "Tolerance": ("DoubleLineEdit0", "set_string", ["1e-10", "1e-06"]),
    "WarmStart": ("CheckBox", "set_boolean", ["false", "true"]),
    "NumberOfParticles": ("LineEdit0", "set_string", ["0", "400", "700"]),
    "ParticlesPerWorker": ("LineEdit0", "set_string", ["0", "5000"]),
    "PassDiagnostics": ("CheckBox", "set_boolean", ["false", "true"]),
    "OutputType": ("ComboBox", "activated", ["Particles", "Triangles", "Curved Triangles"]),
    "Order": ("IntRangeWidget/LineEdit", "set_string", ["2", "3"]),
    "Seed": ("LineEdit0", "set_string", [str(n) for n in range(1, 30)]),
    "representation": ("", "activated", ["Surface Splats", "Surface", "Points", "Point Gaussian", "Outline"]),
}
# Seeds by which a round is known.
ROUND_BEGINS, ROUND_ENDS = 1001, 1002

# Runs in ParaView's window: notes what was applied, memory and time after each picture.
WATCHER = """
import ctypes, json, time
from paraview import simple
reader = simple.XMLUnstructuredGridReader(FileName=[{file!r}])
surface = simple.HighOrderParticleIsosurface(Input=reader, ContourBy=["POINTS", "u"], Isosurfaces=[0.2])
surface.Spacing = 0.1
shown = simple.Show(surface)
simple.Hide(reader)
simple.SetActiveSource(surface)
simple.Render()
log = open({log!r}, "w", buffering=1)
class Allocations(ctypes.Structure):  # glibc's struct mallinfo2
    _fields_ = [(name, ctypes.c_size_t) for name in (
        "arena", "ordblks", "smblks", "hblks", "hblkhd", "usmblks", "fsmblks", "uordblks", "fordblks", "keepcost")]
mallinfo2 = ctypes.CDLL(None).mallinfo2
mallinfo2.restype = Allocations
def note(*_):
    with open("/proc/self/statm") as numbers:
        resident = 4096 * int(numbers.read().split()[1])
    allocations = mallinfo2()
    names = [name for name in surface.ListProperties() if name not in ("Input", "Isosurfaces")]
    state = [str(surface.GetPropertyValue(name)) for name in names] + [str(shown.Representation)]
    log.write(json.dumps(dict(seed=surface.Seed, state=state, resident=resident, time=time.process_time(),
                              used=allocations.uordblks + allocations.hblkhd,
                              points=surface.GetClientSideObject().GetOutputDataObject(0).GetNumberOfElements(0))) + "\\n")
simple.GetActiveView().GetRenderWindow().AddObserver("EndEvent", note)
"""


class Session:
    """Writes events; knows what the panel shows, so that each of them changes something."""

    def __init__(self):
        self.events = [event(f"{PANEL}/SearchBox/AdvancedButton", "set_boolean", "true")]
        self.values = {name: values[0] for name, (_, _, values) in CHOICES.items()}

    def change(self, name, value):
        if self.values[name] == value:
            return
        self.values[name] = value
        widget, command, _ = CHOICES[name]
        if name == "representation":
            self.events.append(event("pqClientMainWindow/representationToolbar/displayRepresentation/comboBox", command, value))
        else:
            self.events.append(event(f"{FILTERS_PANEL}/{name}/{widget}", command, value))
            self.events.append(event(f"{PANEL}/Accept", "activate"))
        self.events.append(event("pqClientMainWindow", "pause", "60"))  # until it is drawn

    def change_at_random(self, dice):
        name = dice.choice(list(CHOICES))
        others = [value for value in CHOICES[name][2] if value != self.values[name]]
        self.change(name, dice.choice(others))

    def round(self):
        """The same changes, whatever has been before."""
        for name, (_, _, values) in CHOICES.items():
            self.change(name, values[0])
        self.change("Seed", str(ROUND_BEGINS))
        for name, (_, _, values) in CHOICES.items():
            if name != "Seed":
                self.change(name, values[1])
                self.change(name, values[0])
        self.change("Seed", str(ROUND_ENDS))


def events_of(changes, parts, dice):
    session = Session()
    session.round()
    for _ in range(parts + 1):
        for _ in range(changes // parts):
            session.change_at_random(dice)
        session.round()
    return "<pqevents>" + "\n".join(session.events) + "</pqevents>"


def rounds_of(pictures):
    """(allocated bytes, resident bytes, seconds) of every round."""
    rounds, begin = [], None
    for before, now in zip(pictures, pictures[1:]):
        if now["seed"] == ROUND_BEGINS and before["seed"] != ROUND_BEGINS:
            begin = now["time"]
        if now["seed"] == ROUND_ENDS and before["seed"] != ROUND_ENDS:
            rounds.append((now["used"], now["resident"], now["time"] - begin))
    return rounds


def run(arguments, folder):
    """Pictures that were drawn, and what ParaView said."""
    simple.LoadPlugin(os.environ["HOP_PLUGIN"], remote=False, ns=vars(simple))
    file, log, script, events = (folder / name for name in ("both.vtu", "log.json", "watcher.py", "events.xml"))
    write_scalar_and_vector(str(Path(os.environ["HOP_DATA"]) / "mfem_hex1_p8.vtu"), file)
    script.write_text(WATCHER.format(file=str(file), log=str(log)))
    events.write_text(events_of(arguments.changes, arguments.parts, random.Random(arguments.seed)))
    with own_screen(folder) as (display, _):
        process = start(display, folder, Path(os.environ["HOP_PLUGIN"]), f"--script={script}", f"--test-script={events}", "--exit")
        said, _ = process.communicate()
    assert process.returncode == 0, said
    return [json.loads(line) for line in log.read_text().splitlines()], said


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--changes", type=int, default=500)
    parser.add_argument("--parts", type=int, default=2)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        pictures, said = run(arguments, Path(folder))
    print(said[-1500:])
    applied = sum(before["state"] != now["state"] for before, now in zip(pictures, pictures[1:]))
    print(f"{applied} changes were drawn in {len(pictures)} pictures, {len({str(p['state']) for p in pictures})} states; "
          f"up to {max(p['points'] for p in pictures):,} points")
    rounds = rounds_of(pictures)
    for n, (used, resident, seconds) in enumerate(rounds):
        print(f"after {max(0, n) * (arguments.changes // arguments.parts)} random changes: "
              f"{used / 1e6:.1f} MB allocated, {resident / 1e6:.1f} MB resident, {seconds:.2f} s of processor time for a round")
    assert len(rounds) == arguments.parts + 2, "a round is missing"
    growth, of_resident, slowdown = (last / first - 1 for first, last in zip(rounds[1], rounds[-1]))
    print(f"allocated {growth:+.2%}, resident {of_resident:+.2%}, time {slowdown:+.0%}")
    sys.exit(1 if growth > MOST_GROWTH or slowdown > MOST_SLOWDOWN else 0)


if __name__ == "__main__":
    main()
