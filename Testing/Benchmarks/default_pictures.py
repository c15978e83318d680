"""What a user sees who applies the filter and touches nothing: one picture a file, and a line of figures.

    pvpython Testing/Benchmarks/default_pictures.py PLUGIN OUT_FOLDER FILE [FILE ...]

Every file is opened as the GUI would, the filter applied with all its defaults, and its output shown with
the representation, colours and legend that it comes with; so is the view. To be looked at. OUT_FOLDER/cases.txt
names the same surfaces, FILE:ARRAY:ISOVALUE a line, for splat_errors.
"""

import argparse
import time
from pathlib import Path

from paraview import simple

SIZE = [640, 480]


def picture(path, folder):
    reader = simple.OpenDataFile(str(path))
    reader.UpdatePipeline()
    surface = simple.HighOrderParticleIsosurface(Input=reader)
    start = time.perf_counter()
    surface.UpdatePipeline()
    seconds = time.perf_counter() - start

    view = simple.CreateRenderView(ViewSize=SIZE)
    display = simple.Show(surface, view)
    if display.ColorArrayName[1]:
        display.SetScalarBarVisibility(view, True)
    simple.Show(reader, view).SetRepresentationType("Outline")
    view.CameraPosition, view.CameraViewUp = [-1, -1.6, 0.9], [0, 0, 1]
    simple.ResetCamera(view)
    with (folder / "cases.txt").open("a") as cases:
        cases.writelines(f"{path}:{surface.ContourBy[1]}:{value}\n" for value in surface.Isosurfaces)
    simple.SaveScreenshot(str(folder / f"{path.stem}.png"), view, ImageResolution=SIZE)
    print(
        f"{path.name:46} {surface.ContourBy[1]:20} {list(surface.Isosurfaces)!s:26} spacing {surface.Spacing:<9.3g}"
        f" {surface.GetDataInformation().GetNumberOfPoints():7} particles {seconds:6.2f} s"
        f"  {display.Representation}, coloured by {display.ColorArrayName[1]}",
        flush=True,
    )
    for proxy in (view, surface, reader):
        simple.Delete(proxy)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("plugin")
    parser.add_argument("folder", type=Path)
    parser.add_argument("files", nargs="+", type=Path)
    options = parser.parse_args()
    simple.LoadPlugin(options.plugin, remote=False, ns=vars(simple))
    options.folder.mkdir(parents=True, exist_ok=True)
    (options.folder / "cases.txt").unlink(missing_ok=True)
    for path in options.files:
        picture(path, options.folder)


main()
