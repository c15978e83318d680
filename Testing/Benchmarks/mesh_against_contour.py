"""What a mesh costs and how exact it is, beside Contour and Contour on sampled cells at equal numbers of triangles.

    pvpython Testing/Benchmarks/mesh_against_contour.py PLUGIN [--picture OUT.png]

A torus, which 64 straight hexahedra of order 4 hold exactly: (|x|^2 + R^2 - r^2)^2 = 4 R^2 (x^2 + y^2), whose distance
and area are known. Distances are measured at 28 places of every triangle, on curved ones by VTK's own shape functions;
areas by quadrature. Angles are the smallest of each triangle's corners. Times are processor time of the filter, one
thread, the best of three runs; sampled cells are there already when the time of their Contour begins.
"""

import argparse
import time

import numpy as np
from paraview import simple
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkIdList, vtkPoints, vtkSMPTools
from vtkmodules.vtkCommonDataModel import (
    VTK_HEXAHEDRON,
    VTK_LAGRANGE_HEXAHEDRON,
    vtkLagrangeHexahedron,
    vtkUnstructuredGrid,
)

BIG, SMALL = 0.62, 0.25
AREA = 4 * np.pi**2 * BIG * SMALL
CELLS, ORDER = 4, 4  # along each axis of [-1, 1]^3
TURN = np.linalg.qr(np.array([[1.0, 0.3, 0.2], [0.1, 1.0, 0.4], [0.3, 0.2, 1.0]]))[0]  # the torus lies askew


def field(x):
    y = x @ TURN
    ring = (y[:, :2] ** 2).sum(axis=1)
    return ((y**2).sum(axis=1) + BIG**2 - SMALL**2) ** 2 - 4 * BIG**2 * ring


def distance(x):
    y = x @ TURN
    return np.abs(np.hypot(np.hypot(y[:, 0], y[:, 1]) - BIG, y[:, 2]) - SMALL)


def make_grid(points, cells, cell_type):
    """cells: indices of points, a row a cell."""
    grid = vtkUnstructuredGrid()
    grid.SetPoints(vtkPoints())
    grid.GetPoints().SetData(numpy_to_vtk(points, deep=True))
    ids = vtkIdList()
    for cell in cells:
        ids.Reset()
        for point in cell:
            ids.InsertNextId(int(point))
        grid.InsertNextCell(cell_type, ids)
    values = numpy_to_vtk(field(points), deep=True)
    values.SetName("f")
    grid.GetPointData().AddArray(values)
    return grid


def lattice_grid(count, places, cell_type, step):
    """Hexahedra on a lattice of `count` cells an axis, which share points. places: of a cell's nodes, in lattice steps."""
    side = count * step + 1
    axis = np.linspace(-1, 1, side)
    points = np.stack(np.meshgrid(axis, axis, axis, indexing="ij"), axis=-1).reshape(-1, 3)
    corners = step * np.stack(np.meshgrid(*[np.arange(count)] * 3, indexing="ij"), axis=-1).reshape(-1, 1, 3)
    return make_grid(points, ((corners + places) @ [side * side, side, 1]), cell_type)


def high_order_grid():
    places = np.zeros(((ORDER + 1) ** 3, 3), dtype=int)
    for i, j, k in np.ndindex(*[ORDER + 1] * 3):
        places[vtkLagrangeHexahedron.PointIndexFromIJK(i, j, k, [ORDER] * 3)] = (i, j, k)
    return lattice_grid(CELLS, places, VTK_LAGRANGE_HEXAHEDRON, ORDER)


def sampled_grid(k):
    """Every cell cut into k^3 linear ones."""
    places = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]])
    return lattice_grid(CELLS * k, places, VTK_HEXAHEDRON, 1)


def contour(grid):
    return simple.Contour(
        Input=source_of(grid), ContourBy=["POINTS", "f"], Isosurfaces=[0.0], ComputeNormals=0, ComputeScalars=0)


def mesh(grid, triangles, kind, order=2):
    """A closed surface with one handle has twice as many triangles as vertices."""
    return simple.HighOrderParticleIsosurface(
        Input=source_of(grid), ContourBy=["POINTS", "f"], Isosurfaces=[0.0], NumberOfParticles=triangles // 2,
        OutputType=kind, Order=order)


def source_of(grid):
    source = simple.TrivialProducer()
    source.GetClientSideObject().SetOutput(grid)
    source.UpdatePipeline()
    return source


def timed(make):
    """The output of a filter, and the least of three times, s."""
    seconds = []
    for _ in range(3):
        proxy = make()
        start = time.process_time()
        proxy.UpdatePipeline()
        seconds.append(time.process_time() - start)
    return proxy.GetClientSideObject().GetOutputDataObject(0), min(seconds)


def nodes_of(data):
    """Positions of each cell's nodes, and VTK's cell."""
    cells = data.GetPolys() if data.IsA("vtkPolyData") else data.GetCells()
    ids = vtk_to_numpy(cells.GetConnectivityArray()).reshape(cells.GetNumberOfCells(), -1)
    return vtk_to_numpy(data.GetPoints().GetData()).astype(float)[ids], data.GetCell(0)


def shape_functions(cell, places):
    """Values, and derivatives along both coordinates, at places of a cell: places by nodes."""
    count = cell.GetNumberOfPoints()
    values, derivatives = np.zeros((len(places), count)), np.zeros((len(places), 2 * count))
    row, slopes = [0.0] * count, [0.0] * (2 * count)
    for n, (r, s) in enumerate(places):
        cell.InterpolateFunctions([r, s, 0.0], row)
        cell.InterpolateDerivs([r, s, 0.0], slopes)
        values[n], derivatives[n] = row, slopes
    return values, derivatives[:, :count], derivatives[:, count:]


def measure(data):
    """Number of cells, largest and root mean square distance, relative error of the area, angles."""
    nodes, cell = nodes_of(data)
    lattice = [(i / 6, j / 6) for i in range(7) for j in range(7 - i)]
    values = shape_functions(cell, lattice)[0]
    apart = distance(np.einsum("pn,cnx->cpx", values, nodes).reshape(-1, 3)).reshape(len(nodes), -1)
    # Dunavant's rule of degree 4: where, and the weights, which sum up to 1/2.
    a, b = 0.445948490915965, 0.091576213509771
    where = [(a, a), (1 - 2 * a, a), (a, 1 - 2 * a), (b, b), (1 - 2 * b, b), (b, 1 - 2 * b)]
    weights = np.repeat([0.223381589678011 / 2, 0.109951743655322 / 2], 3)
    _, first, second = shape_functions(cell, where)
    normals = np.cross(np.einsum("pn,cnx->cpx", first, nodes), np.einsum("pn,cnx->cpx", second, nodes))
    area = (np.linalg.norm(normals, axis=2) @ weights).sum()
    return {"cells": len(nodes), "apart": apart.max(axis=1), "rms": np.sqrt((apart**2).mean()),
            "area": area / AREA - 1, "angles": angles_of(nodes[:, :3])}


def angles_of(corners):
    """Smallest angle of each triangle, degrees."""
    sides = np.stack([np.linalg.norm(corners[:, (i + 1) % 3] - corners[:, (i + 2) % 3], axis=1) for i in range(3)])
    sides = np.sort(np.maximum(sides, 1e-300), axis=0)
    cosine = (sides[1] ** 2 + sides[2] ** 2 - sides[0] ** 2) / (2 * sides[1] * sides[2])
    return np.degrees(np.arccos(np.clip(cosine, -1, 1)))


def show(name, data, seconds):
    m = measure(data)
    print(f"| {name} | {m['cells']:,} | {seconds:.3f} s | {m['apart'].max():.1e} | {m['rms']:.1e} "
          f"| {m['area']:.1e} | {np.median(m['angles']):.0f}° | {np.quantile(m['angles'], 0.01):.0f}° |")
    return m["cells"]


def table(grid):
    print("| method | triangles | time | largest distance | rms distance | area, relative error | median angle "
          "| 1% of the angles are below |\n|---|---|---|---|---|---|---|---|")
    for k in (None, 8, 16):
        cells = grid if k is None else sampled_grid(k)
        name = "Contour" if k is None else f"sampled {k}³, Contour"
        count = show(name, *timed(lambda: contour(cells)))
        show("this plugin, Triangles", *timed(lambda: mesh(grid, count, "Triangles")))
        if k is None:
            for order in (2, 3, 4):
                show(f"this plugin, Curved Triangles, order {order}",
                     *timed(lambda: mesh(grid, count, "Curved Triangles", order)))


def with_distances(data):
    """Adds a cell array: the largest distance in each triangle, as a power of ten."""
    array = numpy_to_vtk(np.log10(measure(data)["apart"]), deep=True)
    array.SetName("distance")
    data.GetCellData().AddArray(array)
    return data


def color(shown, view, withLegend):
    simple.ColorBy(shown, ("CELLS", "distance"))
    colors = simple.GetColorTransferFunction("distance")
    colors.ApplyPreset("Viridis (matplotlib)", True)
    colors.RescaleTransferFunction(-4.5, -1.5)
    shown.SetScalarBarVisibility(view, withLegend)
    if withLegend:
        bar = simple.GetScalarBar(colors, view)
        bar.Title, bar.ComponentTitle = "distance, log10", ""
        bar.TitleColor = bar.LabelColor = [0, 0, 0]
        bar.RangeLabelFormat = "%.1f"


def draw(grid, output):
    """Contour and both meshes at equal numbers of triangles, coloured by distance."""
    first = timed(lambda: contour(grid))[0]
    meshes = [first] + [
        timed(lambda: mesh(grid, first.GetNumberOfCells(), kind))[0] for kind in ("Triangles", "Curved Triangles")]
    layout = simple.CreateLayout("comparison")
    layout.SplitHorizontal(0, 1 / 3)
    layout.SplitHorizontal(2, 0.5)
    for place, data in zip((1, 5, 6), meshes):
        view = simple.CreateView("RenderView")
        layout.AssignView(place, view)
        view.OrientationAxesVisibility = 0
        view.UseColorPaletteForBackground = 0
        view.Background = [1, 1, 1]
        shown = simple.Show(source_of(with_distances(data)), view)
        shown.SetRepresentationType("Surface With Edges")
        shown.NonlinearSubdivisionLevel = 3
        shown.EdgeColor = [0.25, 0.25, 0.25]
        shown.Ambient = 0.3
        color(shown, view, withLegend=place == 6)
        view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [1.2, -2.2, 1.7], [0, 0, 0], [0, 0, 1]
        simple.ResetCamera(view)
        view.GetActiveCamera().Dolly(1.3)
    layout.SetSize(1800, 600)
    simple.SaveScreenshot(output, layout)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("plugin")
    parser.add_argument("--picture", help="draw Contour and the meshes, and leave the table out")
    arguments = parser.parse_args()
    simple.LoadPlugin(arguments.plugin, remote=False, ns=vars(simple))
    vtkSMPTools.Initialize(1)
    grid = high_order_grid()
    if arguments.picture:
        draw(grid, arguments.picture)
    else:
        table(grid)


main()
