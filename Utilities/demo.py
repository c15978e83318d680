"""Draw a high-order isosurface from a solver's file: what demo.sh runs in pvbatch.

    pvbatch demo.py PLUGIN [FILE.vtu|.pvtu] [OUT.png] [--array NAME] [--isovalue C ...] [--color NAME]
                    [--spacing S] [--density RHO] [--method NAME]

What is not given is left to the filter, as in ParaView's window. Several isosurfaces are coloured by the contoured
array, a single one, unless told otherwise, by another array of the file or by its mean curvature.
"""

import argparse
import time
from pathlib import Path

from paraview import simple

# One hexahedron of order 8: what a stock filter draws as one crude patch bends this much.
DEMO = {
    "file": Path(__file__).parent.parent / "Testing" / "Data" / "mfem_hex1_p8.vtu",
    "array": "u",
    "isovalue": [0.2],
    "color": "Mean_Curvature",
    "spacing": 0.012,
}

# Arrays that describe the mesh, not the solution.
BOOKKEEPING = ("vtk", "RationalWeights", "Global", "subdomain", "Partition")


def parse_arguments():
    parser = argparse.ArgumentParser(prog="demo.sh", description=__doc__.splitlines()[0])
    parser.add_argument("plugin", help=argparse.SUPPRESS)
    parser.add_argument("paths", nargs="*", metavar="FILE.vtu OUT.png", help="what to read, what to write")
    parser.add_argument("--array", help="point array to contour")
    parser.add_argument("--isovalue", type=float, nargs="+", metavar="C")
    parser.add_argument("--color", help="point array to colour by")
    parser.add_argument("--spacing", type=float, help="distance of particles, world units")
    parser.add_argument("--density", type=float, help="AngularDensity: more particles where the surface bends")
    parser.add_argument("--method", help="how particles are distributed")
    arguments = parser.parse_args()
    arguments.output = next((p for p in arguments.paths if p.endswith(".png")), "isosurface.png")
    arguments.file = next((p for p in arguments.paths if not p.endswith(".png")), None)
    if arguments.file and not Path(arguments.file).is_file():
        parser.error(f"no such file: {arguments.file}")
    return arguments


def fill_in(arguments):
    """The demo's own file comes with the settings that make a good picture."""
    if arguments.file is None:
        for key, value in DEMO.items():
            if getattr(arguments, key) is None:
                setattr(arguments, key, value)


def read(path):
    readers = {".vtu": simple.XMLUnstructuredGridReader, ".pvtu": simple.XMLPartitionedUnstructuredGridReader}
    if Path(path).suffix not in readers:
        raise SystemExit(f"error: {path}: expected a .vtu or .pvtu file")
    reader = readers[Path(path).suffix](FileName=[str(path)])
    reader.UpdatePipeline()
    if reader.GetDataInformation().GetNumberOfPoints() == 0:
        raise SystemExit(f"error: ParaView read no points from {path} (its message, if any, stands above; "
                         "see 'What it does not do' in README.md about raw appended data)")
    return reader


def solution_arrays(reader):
    return {a.GetName(): a for a in reader.PointData.values() if not a.GetName().startswith(BOOKKEEPING)}


def contoured_array(reader, particles):
    name = particles.ContourBy[1]
    arrays = {a.GetName(): a for a in reader.PointData.values()}
    if name not in arrays:
        raise SystemExit(f"error: no point array {name or 'to contour'}; there are: {', '.join(arrays) or 'none'}")
    return arrays[name]


def choose_color(reader, particles, array):
    """On a single isosurface its own array is the same everywhere."""
    if len(particles.Isosurfaces) > 1:
        return array.GetName()
    return next((name for name in solution_arrays(reader) if name != array.GetName()), "Mean_Curvature")


def make_filter(reader, arguments):
    options = {
        "ContourBy": arguments.array and ["POINTS", arguments.array],
        "Isosurfaces": arguments.isovalue,
        "PassDiagnostics": 1,
        "Spacing": arguments.spacing,
        "AngularDensity": arguments.density,
        "Method": arguments.method,
    }
    given = {key: value for key, value in options.items() if value is not None}
    return simple.HighOrderParticleIsosurface(Input=reader, **given)


def seconds_of_run(particles):
    start = time.perf_counter()
    particles.UpdatePipeline()
    return time.perf_counter() - start


def draw(reader, particles, color, output):
    view = simple.CreateView("RenderView")
    view.ViewSize = [1600, 1000]
    view.OrientationAxesVisibility = 0
    view.UseColorPaletteForBackground = 0
    view.BackgroundColorMode = "Gradient"
    view.Background, view.Background2 = [0.98, 0.98, 0.97], [0.78, 0.83, 0.88]

    view.HeadLightKHRatio = 1.8  # stronger than usual: open surfaces show their backs

    surface = simple.Show(particles, view)
    surface.SetRepresentationType("Surface Splats")
    if particles.GetDataInformation().GetNumberOfPoints() > 0:
        simple.ColorBy(surface, ("POINTS", color))
        surface.RescaleTransferFunctionToDataRange(False, True)
        surface.SetScalarBarVisibility(view, True)
        legend = simple.GetScalarBar(simple.GetColorTransferFunction(color), view)
        legend.TitleColor = legend.LabelColor = [0.1, 0.1, 0.1]
        legend.WindowLocation = "Any Location"
        legend.Position = [0.9, 0.1]

    outline = simple.Show(reader, view)
    outline.SetRepresentationType("Outline")
    outline.AmbientColor = outline.DiffuseColor = [0.25, 0.25, 0.25]
    outline.ColorArrayName = ["POINTS", ""]

    view.CameraFocalPoint = [0, 0, 0]
    view.CameraPosition = [-0.8, -1.1, 0.6]
    view.CameraViewUp = [0, 0, 1]
    simple.ResetCamera(view)
    view.SMProxy.GetRenderer().ResetCameraScreenSpace(reader.GetDataInformation().GetBounds())
    simple.SaveScreenshot(output, view)


def diagonal(proxy):
    x0, x1, y0, y1, z0, z1 = proxy.GetDataInformation().GetBounds()
    return ((x1 - x0) ** 2 + (y1 - y0) ** 2 + (z1 - z0) ** 2) ** 0.5


def report(reader, particles, array, seconds, output):
    count = particles.GetDataInformation().GetNumberOfPoints()
    print(f"file                      {Path(reader.FileName[0]).name}")
    print(f"isosurface                {array.GetName()} = {', '.join(f'{c:g}' for c in particles.Isosurfaces)}")
    print(f"particles                 {count}")
    print(f"seconds                   {seconds:.2f}")
    if count > 0:
        evaluations = particles.FieldData["Evaluations"].GetRange(0)[1]
        residual = particles.PointData["Residual"].GetRange(0)[1]
        print(f"evaluations a particle    {evaluations / count:.1f}")
        print(f"largest residual          {residual:.2e} ({residual / diagonal(reader):.1e} of the bounding diagonal)")
    else:
        print("the surface is empty      choose another value with --isovalue; the array's range is "
              "[{:g}, {:g}]".format(*array.GetRange(-1)))
    print(f"picture                   {output}")


def main():
    arguments = parse_arguments()
    fill_in(arguments)
    simple.LoadPlugin(arguments.plugin, remote=False, ns=vars(simple))
    reader = read(arguments.file)
    particles = make_filter(reader, arguments)
    array = contoured_array(reader, particles)
    seconds = seconds_of_run(particles)
    draw(reader, particles, arguments.color or choose_color(reader, particles, array), arguments.output)
    report(reader, particles, array, seconds, arguments.output)


main()
