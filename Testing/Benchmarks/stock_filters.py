"""What stock filters make of high-order cells, beside this plugin: the figures of Documentation/performance.md.

    pvpython Testing/Benchmarks/stock_filters.py PLUGIN [--quick]

Three cases: a gyroid on warped cubic hexahedra (error against the analytic field), an island between
the nodes of one order-4 hexahedron, and a sphere in one quadratic Bezier hexahedron. Times are the
filter's own, one run each, on the threads that ParaView gives it.
"""

import argparse
import time

import numpy as np
from paraview import simple
from vtkmodules.numpy_interface import dataset_adapter as dsa
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkIdList, vtkPoints
from vtkmodules.vtkCommonDataModel import (
    VTK_BEZIER_HEXAHEDRON,
    VTK_LAGRANGE_HEXAHEDRON,
    vtkLagrangeHexahedron,
    vtkUnstructuredGrid,
)


def lattice(order):
    """Parametric coordinates of a hexahedron's nodes, in VTK's order of points."""
    nodes = np.zeros(((order + 1) ** 3, 3))
    for k in range(order + 1):
        for j in range(order + 1):
            for i in range(order + 1):
                at = vtkLagrangeHexahedron.PointIndexFromIJK(i, j, k, [order] * 3)
                nodes[at] = (i, j, k)
    return nodes / order


def make_grid(cells, cell_type, fields):
    """A grid of hexahedra with nodes of their own. cells: one array of node positions a cell."""
    grid = vtkUnstructuredGrid()
    points = vtkPoints()
    points.SetData(numpy_to_vtk(np.concatenate(cells), deep=True))
    grid.SetPoints(points)
    count = len(cells[0])
    ids = vtkIdList()
    for cell in range(len(cells)):
        ids.Reset()
        for node in range(count):
            ids.InsertNextId(cell * count + node)
        grid.InsertNextCell(cell_type, ids)
    for name, values in fields.items():
        array = numpy_to_vtk(np.concatenate(values), deep=True)
        array.SetName(name)
        grid.GetPointData().AddArray(array)
    return grid


def gyroid(x):
    s, c = np.sin(4 * x), np.cos(4 * x)
    return (s[:, 0] * c[:, 1] + s[:, 1] * c[:, 2] + s[:, 2] * c[:, 0]) / 4


def warp(x):
    return x + 0.05 * np.sin(3 * x[:, [1, 2, 0]])


def gyroid_grid(n, order=3):
    nodes = lattice(order)
    corners = np.stack(np.meshgrid(*[np.arange(n)] * 3, indexing="ij"), axis=-1).reshape(-1, 3)
    cells = [warp(2 * (corner + nodes) / n - 1) for corner in corners]
    return make_grid(cells, VTK_LAGRANGE_HEXAHEDRON, {"f": [gyroid(x) for x in cells]})


def island_grid():
    """One order-4 hexahedron whose nodal values stay below 0.73 though the polynomial reaches 1.17."""
    nodes = lattice(4)
    peak = np.exp(-60 * ((nodes - 0.375) ** 2).sum(axis=1))
    bump = 1.73 * peak / peak.max() * 0.42
    return make_grid([nodes], VTK_LAGRANGE_HEXAHEDRON, {"f": [bump]})


def bezier_sphere_grid():
    """x^2 + y^2 + z^2 on [0,1]^3, exactly, as control values of one quadratic Bezier hexahedron."""
    nodes = lattice(2)
    control = np.where(nodes == 1, 1.0, 0.0).sum(axis=1)
    return make_grid([nodes], VTK_BEZIER_HEXAHEDRON, {"f": [control]})


def run(grid, isovalue, make):
    """Seconds, output points and output of a chain of filters made by make(source)."""
    source = simple.TrivialProducer()
    source.GetClientSideObject().SetOutput(grid)
    source.UpdatePipeline()
    last = make(source, isovalue)
    start = time.perf_counter()
    last.UpdatePipeline()
    seconds = time.perf_counter() - start
    data = last.GetClientSideObject().GetOutputDataObject(0)
    points = dsa.WrapDataObject(data).Points
    simple.Delete(last)
    return seconds, np.zeros((0, 3)) if points is None else np.asarray(points)


def contour(source, isovalue):
    return simple.Contour(Input=source, ContourBy=["POINTS", "f"], Isosurfaces=[isovalue], ComputeNormals=0)


def tessellate(error):
    def make(source, isovalue):
        pieces = simple.Tessellate(Input=source, ChordError=error, FieldError=[error])
        return contour(pieces, isovalue)

    return make


def particles(spacing):
    def make(source, isovalue):
        return simple.HighOrderParticleIsosurface(
            Input=source, ContourBy=["POINTS", "f"], Isosurfaces=[isovalue], Spacing=spacing
        )

    return make


def show(cells, name, seconds, points, error):
    print(f"| {cells} | {name} | {seconds:.3f} s | {len(points)} | {error.max():.1e} | {error.mean():.1e} |")


def gyroid_table(quick):
    print("\nGyroid, cubic hexahedra: error |f - c|, analytic f, gradient about 1")
    print("| cells | filter | time | points | max error | mean error |\n|---|---|---|---|---|---|")
    for n in (4, 16) if quick else (4, 16, 24):
        grid = gyroid_grid(n)
        rows = [("Contour", contour), ("this plugin, spacing 0.04", particles(0.04))]
        if n == 4 and not quick:
            rows.insert(1, ("Tessellate (1e-2), Contour", tessellate(1e-2)))
        for name, make in rows:
            seconds, points = run(grid, 0.1, make)
            show(n**3, name, seconds, points, np.abs(gyroid(points) - 0.1))


def failure_table():
    print("\nCases that go wrong in stock filters")
    grid = island_grid()
    nodal = vtk_to_numpy(grid.GetPointData().GetArray("f"))
    inside = sample_maximum(grid)
    print(f"island: nodal maximum {nodal.max():.3f}, polynomial maximum {inside:.3f}")
    isovalue = 0.5 * (nodal.max() + inside)
    for name, make in (("Contour", contour), ("this plugin", particles(0.01))):
        seconds, points = run(grid, isovalue, make)
        print(f"  {name}: {len(points)} points at f = {isovalue:.3f}")
    print("Bezier sphere of radius 0.7")
    rows = (("Contour", contour), ("Tessellate (1e-3), Contour", tessellate(1e-3)), ("this plugin", particles(0.01)))
    for name, make in rows:
        seconds, points = run(bezier_sphere_grid(), 0.49, make)
        radius = np.linalg.norm(points, axis=1)
        print(f"  {name}: radius {radius.min():.12g} to {radius.max():.12g}")


def sample_maximum(grid):
    """Largest value of the first cell's polynomial on a fine lattice."""
    cell = grid.GetCell(0)
    values = vtk_to_numpy(grid.GetPointData().GetArray("f"))
    weights, x = np.zeros(len(values)), [0.0] * 3
    best = -np.inf
    for u in np.stack(np.meshgrid(*[np.linspace(0, 1, 33)] * 3), axis=-1).reshape(-1, 3):
        cell.InterpolateFunctions(u, weights)
        best = max(best, weights @ values)
    return best


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("plugin")
    parser.add_argument("--quick", action="store_true", help="leave the slow rows out")
    arguments = parser.parse_args()
    simple.LoadPlugin(arguments.plugin, remote=False, ns=vars(simple))
    gyroid_table(arguments.quick)
    failure_table()


main()
