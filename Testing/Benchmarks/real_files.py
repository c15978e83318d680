"""What the filter costs on files of real solvers, beside stock Contour: a table, and JSON if asked.

    pvpython Testing/Benchmarks/real_files.py PLUGIN [FOLDER ...] [--finer FACTOR] [--json OUT.json]

Every FOLDER (default: Testing/Data) is searched for the files named below; those missing are said.
The spacing is the proxy's default, divided by FACTOR. Times are one run's, without reading the file.
"""

import argparse
import json
import time
from pathlib import Path

from paraview import simple

CASES = (
    ("mfem_hex1_p8.vtu", "u", 0.2, 0),
    ("mfem_torus_wedge_p4.vtu", "f", 0.3, 0),
    ("mfem_cylinder_hex_prism_p3.vtu", "pressure", -0.5, 0),
    ("mfem_amr_hanging_hex_p3.vtu", "u", 0.0, 0),
    ("mfem_dg_advection_0.vtu", "rho", 0.3, 0),
    ("mfem_dg_advection_4.vtu", "rho", 0.3, 0),
    ("dolfinx_tet_p3.vtu", "u", 0.5, 0),
    ("dealii_shell_p3_00.pvtu", "u", 0.4, 0),
    ("ngsolve_cylinder_ns_tet_p3.vtu", "pressure", 0.6, 0),
    ("trixi_adv_sphere_hex_p3.vtu", "scalar", 1.28, 0),
    ("yeti_pipe_bezier_rational_p333.vtu", "disp", -1e-4, 0),
    ("yeti_pipe_bezier_rational_p423.vtu", "disp", -1e-4, 0),
    ("vtkdata_pyramid_quadratic.vtu", "Polynomial", 4.01, 0),
    ("vtkdata_notch_quadratic_hex20_wedge15.vtu", "Nodal Displacement", 1.68e-6, 0),
    ("pyfr_cylinder_5040hex_696prism_p3.vtu", "Pressure", 17.6, 0),
    ("pyfr_cylinder_3360hex_7656prism_p3.vtu", "Pressure", 17.8, 0),
)


def find(name, folders):
    return next((folder / name for folder in folders if (folder / name).is_file()), None)


def read(path):
    make = simple.XMLPartitionedUnstructuredGridReader if path.suffix == ".pvtu" else simple.XMLUnstructuredGridReader
    reader = make(FileName=[str(path)])
    reader.UpdatePipeline()
    return reader


def timed(proxy):
    start = time.perf_counter()
    proxy.UpdatePipeline()
    return time.perf_counter() - start


def diagonal(reader):
    b = reader.GetDataInformation().GetBounds()
    return sum((b[2 * axis + 1] - b[2 * axis]) ** 2 for axis in range(3)) ** 0.5


def measure(path, array, isovalue, component, finer):
    reader = read(path)
    contour_seconds, contour_points = None, None
    if reader.PointData[array].GetNumberOfComponents() == 1:
        contour = simple.Contour(Input=reader, ContourBy=["POINTS", array], Isosurfaces=[isovalue])
        contour_seconds = timed(contour)
        contour_points = contour.GetDataInformation().GetNumberOfPoints()
    particles = simple.HighOrderParticleIsosurface(
        Input=reader, ContourBy=["POINTS", array], Component=component, Isosurfaces=[isovalue], PassDiagnostics=1
    )
    particles.Spacing = particles.Spacing / finer
    seconds = timed(particles)
    count = particles.GetDataInformation().GetNumberOfPoints()
    field = particles.FieldData
    return {
        "file": path.name,
        "spacing": particles.Spacing,
        "particles": count,
        "seconds": seconds,
        "evaluations_a_particle": field["Evaluations"].GetRange(0)[1] / max(1, count),
        "largest_residual_per_diagonal": particles.PointData["Residual"].GetRange(0)[1] / diagonal(reader),
        "boxes_unresolved": field["BoxesUnresolved"].GetRange(0)[1],
        "undersampled": field["ParticlesUndersampled"].GetRange(0)[1],
        "contour_seconds": contour_seconds,
        "contour_points": contour_points,
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("plugin")
    parser.add_argument("folders", nargs="*", type=Path)
    parser.add_argument("--finer", type=float, default=1.0)
    parser.add_argument("--json", type=Path)
    arguments = parser.parse_args()
    folders = arguments.folders or [Path(__file__).parent.parent / "Data"]
    simple.LoadPlugin(arguments.plugin, remote=False, ns=vars(simple))
    print("| file | particles | seconds | µs a particle | evaluations a particle | largest residual / diagonal "
          "| Contour seconds | Contour points |\n|---|---|---|---|---|---|---|---|")
    results = []
    for name, array, isovalue, component in CASES:
        path = find(name, folders)
        if path is None:
            print(f"| {name} | not found | | | | | | |")
            continue
        row = measure(path, array, isovalue, component, arguments.finer)
        results.append(row)
        contour = "| |" if row["contour_seconds"] is None else f"{row['contour_seconds']:.3f} | {row['contour_points']} |"
        print(f"| {name} | {row['particles']} | {row['seconds']:.2f} | {1e6 * row['seconds'] / max(1, row['particles']):.0f} "
              f"| {row['evaluations_a_particle']:.1f} | {row['largest_residual_per_diagonal']:.1e} | {contour}", flush=True)
    if arguments.json:
        arguments.json.write_text(json.dumps(results, indent=1))


main()
