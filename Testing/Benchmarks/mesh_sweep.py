"""What meshes lack, over many isovalues, spacings and seeds: a table in Markdown, a row a field, and the meshes that
lack something.

    pvpython Testing/Benchmarks/mesh_sweep.py PLUGIN [FOLDER ...] [--only WORD] [--jumps | --every] [--isovalues N]
        [--finer F ...] [--seeds S ...] [--area]

Every FOLDER (default: Testing/Data) is searched for the files of the list below: those whose field is continuous, or,
with --jumps, the others. With --every, each array of each .vtu file counts, continuous or not, by its components and, if
it has several, its magnitude (-1); of equal names the file of the first FOLDER. Isovalues are spread evenly within the range of the field, N of them (default 6); spacings are
the proxy's default over F (default 2, 1 and 0.5); seeds are 1, 2 and 3 by default. Columns:
  closed    meshes without hole, particle without a triangle, or edge of three triangles, of all whose surface has
            triangles, and no singular points
  singular  the same of those on whose surface singular points were found
  holes, left over, threefold
            their numbers in all meshes
  proven    meshes whose topology is proven
  area      with --area, the largest relative error of the area of the triangles against those of a quarter of the
            default spacing, at the spacings in their order
  angles    the least median, and the least 1% quantile, of the smallest angles of the triangles of a mesh, degrees, in
            meshes with a hundred such triangles: all off boundary curves, folds of 10 degrees, and points on creases,
            and those that are 1.5 spacings away from them; at the default spacing, or the first one
"""

import argparse
from collections import namedtuple
from pathlib import Path

import numpy as np
from paraview import simple
from paraview.vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData, vtkStaticPointLocator
from vtkmodules.vtkFiltersCore import vtkFeatureEdges

Field = namedtuple("Field", "file array component")

CONTINUOUS = (
    Field("mfem_hex1_p8.vtu", "u", 0),
    Field("mfem_torus_wedge_p4.vtu", "f", 0),
    Field("mfem_torus_wedge_p4.vtu", "radius", 0),
    Field("mfem_cylinder_hex_prism_p3.vtu", "phi", 0),
    Field("mfem_amr_hanging_hex_p3.vtu", "u", 0),
    Field("dolfinx_tet_p3.vtu", "u", 0),
    Field("dealii_shell_p3_00.pvtu", "u", 0),
    Field("ngsolve_cylinder_ns_tet_p3.vtu", "pressure", 0),
    Field("ngsolve_cylinder_ns_tet_p3.vtu", "velocity", 0),
    Field("ngsolve_cylinder_ns_tet_p3.vtu", "velocity", 1),
    Field("yeti_pipe_bezier_rational_p333.vtu", "disp", 0),
    Field("yeti_pipe_bezier_rational_p333.vtu", "disp", 2),
    Field("yeti_pipe_bezier_rational_p423.vtu", "disp", 0),
    Field("vtkdata_pyramid_quadratic.vtu", "Polynomial", 0),
    Field("vtkdata_pyramid_quadratic.vtu", "DistanceToCenter", 0),
    Field("vtkdata_notch_quadratic_hex20_wedge15.vtu", "Nodal Displacement", 0),
    Field("vtkdata_notch_quadratic_hex20_wedge15.vtu", "Nodal Displacement", 1),
)

WITH_JUMPS = (
    *(Field(f"mfem_dg_advection_{step}.vtu", "rho", 0) for step in range(5)),
    Field("trixi_adv_sphere_hex_p3.vtu", "scalar", 0),
    Field("mfem_cylinder_hex_prism_p3.vtu", "pressure", 0),
    Field("pyfr_cylinder_5040hex_696prism_p3.vtu", "Pressure", 0),
    Field("pyfr_cylinder_3360hex_7656prism_p3.vtu", "Pressure", 0),
)

# Arrays that describe the mesh, not the solution.
BOOKKEEPING = ("RationalWeights", "vtkOriginal")

FOLD = 10  # degrees
ON_EDGE = 0.01  # spacings
AWAY = 1.5


def find(name, folders):
    return next((folder / name for folder in folders if (folder / name).is_file()), None)


def every_field(folders):
    files = {path.name: path for folder in reversed(folders) for path in folder.glob("*.vtu")}
    for name in sorted(files):
        for array in read(files[name]).PointData.values():
            count = array.GetNumberOfComponents()
            for component in range(count) if count == 1 else (*range(count), -1):
                low, high = array.GetRange(component)
                if not array.Name.startswith(BOOKKEEPING) and high - low > 1e-12 * max(abs(low), abs(high)):
                    yield Field(name, array.Name, component)


def read(path):
    make = simple.XMLPartitionedUnstructuredGridReader if path.suffix == ".pvtu" else simple.XMLUnstructuredGridReader
    reader = make(FileName=[str(path)])
    reader.UpdatePipeline()
    return reader


def mesh_of(reader, field, isovalue, finer, **properties):
    component = {} if field.component < 0 else {"Component": field.component}
    proxy = simple.HighOrderParticleIsosurface(
        Input=reader, ContourBy=["POINTS", field.array], Isosurfaces=[isovalue], **component,
        OutputType="Triangles", PassDiagnostics=1, **properties)
    proxy.Spacing = proxy.Spacing / finer
    algorithm = proxy.GetClientSideObject()
    for speaker in (algorithm, algorithm.GetExecutive()):  # what is said is counted below
        speaker.AddObserver("WarningEvent", lambda *_: None)
    proxy.UpdatePipeline()
    mesh = algorithm.GetOutputDataObject(0)
    simple.Delete(proxy)
    return mesh


def points_of(data):
    return vtk_to_numpy(data.GetPoints().GetData()).astype(float) if data.GetNumberOfPoints() else np.zeros((0, 3))


def corners_of(mesh):
    return vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(-1, 3)


def reported(mesh, name):
    return mesh.GetFieldData().GetArray(name).GetValue(0)


def threefold_edges_of(mesh):
    edges = np.sort(corners_of(mesh)[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    return int((np.unique(edges, axis=0, return_counts=True)[1] > 2).sum())


def area_of(mesh):
    a, b, c = np.moveaxis(points_of(mesh)[corners_of(mesh)], 1, 0)
    return np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2


def smallest_angles(mesh):
    """Of each triangle, degrees."""
    corners = points_of(mesh)[corners_of(mesh)]
    sides = np.roll(corners, -1, axis=1) - corners
    sides /= np.linalg.norm(sides, axis=2, keepdims=True)
    return np.degrees(np.arccos(-np.einsum("tix,tix->ti", sides, np.roll(sides, 1, axis=1)).clip(-1, 1))).min(axis=1)


def array_of(mesh, name):
    return vtk_to_numpy(mesh.GetPointData().GetArray(name))


def places_on_edges(mesh):
    """Of points on boundary curves, folds and creases. (Creases of several angles are one curve.)"""
    edges = vtkFeatureEdges()
    edges.SetInputData(mesh)
    edges.SetFeatureAngle(FOLD)
    edges.Update()
    is_at_plane = array_of(mesh, "Clip_Distance") <= ON_EDGE * array_of(mesh, "Radius")[:, None]
    is_on_crease = (is_at_plane & (array_of(mesh, "Clip_Angle") > 0)).any(axis=1)
    return np.concatenate([points_of(edges.GetOutput()), points_of(mesh)[is_on_crease]])


def distances_from_edges(mesh):
    """Of each point from the nearest one on a boundary curve, a fold or a crease, in units of its spacing."""
    points, at_edges = points_of(mesh), places_on_edges(mesh)
    if len(at_edges) == 0:
        return np.full(len(points), np.inf)
    cloud = vtkPolyData()
    cloud.SetPoints(vtkPoints())
    cloud.GetPoints().SetData(numpy_to_vtk(at_edges, deep=True))
    locator = vtkStaticPointLocator()
    locator.SetDataSet(cloud)
    locator.BuildLocator()
    nearest = at_edges[[locator.FindClosestPoint(point) for point in points]]
    return np.linalg.norm(points - nearest, axis=1) / array_of(mesh, "Radius")


def shape_of(mesh):
    """Median and 1% quantile of the smallest angles off the edges, and away from them; None: too few."""
    angles, apart = smallest_angles(mesh), distances_from_edges(mesh)[corners_of(mesh)].min(axis=1)
    kinds = (angles[apart > 0], angles[apart >= AWAY])
    return [(np.median(some), np.quantile(some, 0.01)) if len(some) >= 100 else None for some in kinds]


def measure(mesh, with_shape):
    return {
        "holes": reported(mesh, "MeshOpenLoops"),
        "length": reported(mesh, "MeshOpenLength"),
        "left over": reported(mesh, "MeshUnusedParticles"),
        "threefold": threefold_edges_of(mesh),
        "proven": reported(mesh, "TopologyProven"),
        "singular": reported(mesh, "SingularPoints") > 0,
        "area": area_of(mesh),
        "shape": shape_of(mesh) if with_shape else None,
    }


def isovalues_of(reader, field, count):
    low, high = reader.PointData[field.array].GetRange(field.component)
    return [low + (n + 0.5) / count * (high - low) for n in range(count)]


def sweep(reader, field, arguments):
    """(finer, isovalue, facts) of all meshes that have triangles, and what they lack on the way."""
    shaped = 1.0 if 1.0 in arguments.finer else arguments.finer[0]
    for isovalue in isovalues_of(reader, field, arguments.isovalues):
        reference = area_of(mesh_of(reader, field, isovalue, 4.0)) if arguments.area else None
        for finer in arguments.finer:
            for seed in arguments.seeds:
                mesh = mesh_of(reader, field, isovalue, finer, Seed=seed)
                if mesh.GetNumberOfCells() == 0:
                    continue
                facts = measure(mesh, with_shape=finer == shaped)
                facts["error"] = abs(facts["area"] / reference - 1) if reference else None
                yield finer, isovalue, seed, facts


def is_closed(facts):
    return not (facts["holes"] or facts["left over"] or facts["threefold"])


def what_lacks(facts):
    singular = "singular, " if facts["singular"] else ""
    return (f"{singular}{facts['holes']} holes of length {facts['length']:.3g}, {facts['left over']} left over, "
            f"{facts['threefold']} threefold")


def share(meshes):
    return f"{sum(map(is_closed, meshes))} of {len(meshes)}" if meshes else "-"


def least_shape(meshes, kind):
    shapes = [facts["shape"][kind] for facts in meshes if facts["shape"] and facts["shape"][kind]]
    return " and ".join(f"{min(values):.1f}" for values in zip(*shapes)) if shapes else "-"


def row_of(meshes, finer):
    """meshes: (finer, facts)"""
    all_facts = [facts for _, facts in meshes]
    total = {key: sum(facts[key] for facts in all_facts) for key in ("holes", "left over", "threefold", "proven")}
    errors = [[facts["error"] for f, facts in meshes if f == one and facts["error"] is not None] for one in finer]
    singular = [facts for facts in all_facts if facts["singular"]]
    regular = [facts for facts in all_facts if not facts["singular"]]
    return [
        share(regular), share(singular), total["holes"], total["left over"], total["threefold"],
        f"{total['proven']} of {len(meshes)}", " ".join(f"{max(some):.2%}" if some else "-" for some in errors),
        least_shape(all_facts, 0), least_shape(all_facts, 1)
    ]


def print_row(cells):
    print("|", " | ".join(map(str, cells)), "|", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("plugin")
    parser.add_argument("folders", nargs="*", type=Path)
    parser.add_argument("--only", default="")
    parser.add_argument("--jumps", action="store_true")
    parser.add_argument("--every", action="store_true")
    parser.add_argument("--isovalues", type=int, default=6)
    parser.add_argument("--finer", type=float, nargs="+", default=[2.0, 1.0, 0.5])
    parser.add_argument("--seeds", type=int, nargs="+", default=[1, 2, 3])
    parser.add_argument("--area", action="store_true")
    arguments = parser.parse_args()
    folders = arguments.folders or [Path(__file__).parent.parent / "Data"]
    simple.LoadPlugin(arguments.plugin, remote=False, ns=vars(simple))
    print_row(["field", "closed", "singular", "holes", "left over", "threefold", "proven", "area", "angles off edges", "angles away"])
    print("|---" * 10 + "|")
    everything, lacking = [], []
    fields = every_field(folders) if arguments.every else WITH_JUMPS if arguments.jumps else CONTINUOUS
    for field in fields:
        name = f"{field.file} {field.array} {field.component}"
        path = find(field.file, folders)
        if path is None or arguments.only not in name:
            continue
        meshes = []
        for finer, isovalue, seed, facts in sweep(read(path), field, arguments):
            meshes.append((finer, facts))
            if not is_closed(facts):
                lacking.append(f"{name} at {isovalue:.9g}, spacing / {finer:g}, seed {seed}: " + what_lacks(facts))
        everything += meshes
        print_row([f"`{field.file}` {field.array} {field.component}", *row_of(meshes, arguments.finer)])
    if everything:
        print_row(["all", *row_of(everything, arguments.finer)])
    print("\n" + "\n".join(lacking))


main()
