"""Hashes of the particles and meshes of all files: equal before and after a change that must not change any bit.

    pvpython Testing/Benchmarks/particle_hashes.py PLUGIN OUT.json [FOLDER ...]
    pvpython Testing/Benchmarks/particle_hashes.py --compare BEFORE.json AFTER.json

Every grid of the FOLDERs (default: Testing/Data) is contoured by each of its first two point arrays, at a third and
two thirds of the array's range, with one and with two threads, with default properties and with those of VARIANTS.
One hash an array of the output: the comparison names the arrays that differ.
"""

import argparse
import hashlib
import json
import sys
from pathlib import Path

from paraview import simple
from paraview.vtk.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkSMPTools

VARIANTS = {
    "default": {},
    "even": {"AngularDensity": 0.0},
    "high": {"Quality": "High"},
    "draft": {"Quality": "Draft"},
    "number": {"NumberOfParticles": 2000},
    "triangles": {"OutputType": "Triangles"},
}
# Classic takes seconds where Fast takes milliseconds: only on files no larger than this.
CLASSIC_BYTES = 110_000


def read(path):
    make = simple.XMLPartitionedUnstructuredGridReader if path.suffix == ".pvtu" else simple.XMLUnstructuredGridReader
    reader = make(FileName=[str(path)])
    reader.UpdatePipeline()
    return reader


def digest(array):
    return hashlib.sha256(vtk_to_numpy(array).tobytes()).hexdigest()[:16]


def hashes(output):
    result = {"points": output.GetNumberOfPoints()}
    if output.GetNumberOfPoints() > 0:
        result["positions"] = digest(output.GetPoints().GetData())
    if output.GetNumberOfPolys() > 0:
        result["triangles"] = digest(output.GetPolys().GetConnectivityArray())
    for kind, attributes in (("point", output.GetPointData()), ("cell", output.GetCellData()), ("field", output.GetFieldData())):
        for i in range(attributes.GetNumberOfArrays()):
            array = attributes.GetArray(i)
            if array is not None:
                result[f"{kind} {array.GetName()}"] = digest(array)
    return result


def cases(path):
    reader = read(path)
    arrays = [a for a in reader.PointData.values() if a.GetName() != "RationalWeights"][:2]
    for array in arrays:
        component = -1 if array.GetNumberOfComponents() > 1 else 0
        low, high = array.GetRange(component)
        for share in (1 / 3, 2 / 3):
            yield reader, array.GetName(), low + share * (high - low)


def make_all(plugin, folders, only):
    simple.LoadPlugin(plugin, remote=False, ns=vars(simple))
    results = {}
    for path in sorted(p for folder in folders for p in Path(folder).iterdir() if p.suffix in (".vtu", ".pvtu")):
        if only and only not in path.name:
            continue
        variants = dict(VARIANTS)
        if path.stat().st_size < CLASSIC_BYTES and path.suffix == ".vtu":
            variants["classic"] = {"Method": "Classic"}
        for reader, array, isovalue in cases(path):
            for name, properties in variants.items():
                for threads in (1, 2):
                    vtkSMPTools.SetBackend("STDThread")  # left alone, the filter would take all cores
                    vtkSMPTools.Initialize(threads)
                    proxy = simple.HighOrderParticleIsosurface(
                        Input=reader, ContourBy=["POINTS", array], Isosurfaces=[isovalue], **properties)
                    proxy.UpdatePipeline()
                    results[f"{path.name} {array} {isovalue:.6g} {name} {threads}"] = hashes(
                        proxy.GetClientSideObject().GetOutputDataObject(0))
                    simple.Delete(proxy)
            print(path.name, array, f"{isovalue:.6g}", flush=True)
        simple.Delete(reader)
    return results


def compare(before, after):
    differing = 0
    for case in sorted(before.keys() | after.keys()):
        a, b = before.get(case), after.get(case)
        if a != b:
            differing += 1
            names = "one is missing" if a is None or b is None else [k for k in a.keys() | b.keys() if a.get(k) != b.get(k)]
            print(case, names)
    for case in sorted(after):
        if case.endswith(" 1") and after[case] != after.get(case[:-1] + "2"):
            differing += 1
            print(case, "differs with two threads")
    print(f"{len(before)} cases before, {len(after)} after, {differing} differ")
    return differing


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--compare", action="store_true")
    parser.add_argument("--only", default="", help="part of the names of the files wanted")
    parser.add_argument("first")
    parser.add_argument("second")
    parser.add_argument("folders", nargs="*")
    arguments = parser.parse_args()
    if arguments.compare:
        sys.exit(1 if compare(*(json.loads(Path(p).read_text()) for p in (arguments.first, arguments.second))) else 0)
    folders = arguments.folders or [Path(__file__).parent.parent / "Data"]
    Path(arguments.second).write_text(json.dumps(make_all(arguments.first, folders, arguments.only), indent=1))


main()
