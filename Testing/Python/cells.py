"""Grids of every 3-D cell type that VTK can hold, made here: straight ones from VTK's own sources and
shape tables, bent afterwards."""

import numpy as np
import support
import vtkmodules.vtkCommonDataModel as model
from paraview.vtk.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkFiltersSources import vtkCellTypeSource

# Types of which vtkCellTypeSource makes a conforming mesh.
OF_THE_SOURCE = (
    "TETRA", "HEXAHEDRON", "WEDGE", "PYRAMID",
    "QUADRATIC_TETRA", "QUADRATIC_HEXAHEDRON", "QUADRATIC_WEDGE", "QUADRATIC_PYRAMID", "TRIQUADRATIC_PYRAMID",
)  # fmt: skip
# Types that it does not know: the linear type with the same corners, and the class.
BY_HAND = {
    "VOXEL": ("HEXAHEDRON", model.vtkVoxel),
    "BIQUADRATIC_QUADRATIC_HEXAHEDRON": ("HEXAHEDRON", model.vtkBiQuadraticQuadraticHexahedron),
    "TRIQUADRATIC_HEXAHEDRON": ("HEXAHEDRON", model.vtkTriQuadraticHexahedron),
    "QUADRATIC_LINEAR_WEDGE": ("WEDGE", model.vtkQuadraticLinearWedge),
    "BIQUADRATIC_QUADRATIC_WEDGE": ("WEDGE", model.vtkBiQuadraticQuadraticWedge),
}
ARBITRARY_ORDER = [
    f"{family}_{shape}" for family in ("LAGRANGE", "BEZIER") for shape in ("TETRAHEDRON", "HEXAHEDRON", "WEDGE")
]


def type_number(name):
    return getattr(model, "VTK_" + name)


def straight_grid(name, order=None, blocks=1, enriched=False):
    """A straight mesh of the type over a box of unit cubes; enriched: with face and body nodes."""
    if name in BY_HAND:
        linear, kind = BY_HAND[name]
        return fill_in_nodes(straight_grid(linear, blocks=blocks), type_number(name), kind)
    source = vtkCellTypeSource()
    source.SetCellType(type_number(name))
    source.SetBlocksDimensions(blocks, blocks, blocks)
    if order:
        source.SetCellOrder(order)
    source.SetCompleteQuadraticSimplicialElements(enriched)
    source.Update()
    made = source.GetOutput()
    assert made.GetCellType(0) == type_number(name)
    cells = [(type_number(name), ids_of(made, cell)) for cell in range(made.GetNumberOfCells())]
    return support.grid_of_cells(support.points_of(made), cells)


def ids_of(grid, cell):
    return point_ids(grid.GetCell(cell))


def point_ids(cell):
    return [cell.GetPointId(n) for n in range(cell.GetNumberOfPoints())]


def fill_in_nodes(linear, cell_type, kind):
    """The same cells as cells of another type with the same corners: with its nodes on edges, on faces and inside.
    Cells share no nodes."""
    points, cells = [], []
    for cell in range(linear.GetNumberOfCells()):
        corners = support.points_of(linear)[ids_of(linear, cell)]
        nodes = nodes_between(corners, kind())
        cells.append((cell_type, range(len(points), len(points) + len(nodes))))
        points.extend(nodes)
    return support.grid_of_cells(points, cells)


def nodes_between(corners, cell):
    if isinstance(cell, model.vtkVoxel):
        return corners[[0, 1, 3, 2, 4, 5, 7, 6]]
    count = cell.GetNumberOfPoints()
    for n in range(count):
        cell.GetPointIds().SetId(n, n)
    # A node that is neither on an edge nor on a face stands in the middle.
    nodes = np.tile(corners.mean(axis=0), (count, 1))
    nodes[: len(corners)] = corners
    faces = [point_ids(cell.GetFace(f)) for f in range(cell.GetNumberOfFaces())]
    edges = [point_ids(cell.GetEdge(e)) for e in range(cell.GetNumberOfEdges())]
    for ids in faces + edges:  # edges last: they correct nodes of faces that stand on edges
        middle = corners[[i for i in ids if i < len(corners)]].mean(axis=0)
        for i in ids:
            if i >= len(corners):
                nodes[i] = middle
    return nodes


def anisotropic_grid(name, degrees):
    """One cell of a tensor type with different degrees, which an array of the grid gives."""
    kind = model.vtkLagrangeHexahedron if name.endswith("HEXAHEDRON") else model.vtkLagrangeWedge
    p, q, r = degrees
    lattice = [
        (i, j, k)
        for k in range(r + 1)
        for j in range(q + 1)
        for i in range(p + 1)
        if name.endswith("HEXAHEDRON") or i + j <= p
    ]
    nodes = np.zeros((len(lattice), 3))
    order = list(degrees) if name.endswith("HEXAHEDRON") else [p, q, r, len(lattice)]
    for at in lattice:
        nodes[kind.PointIndexFromIJK(*at, order)] = np.array(at) / degrees
    grid = support.grid_of_cells(nodes, [(type_number(name), range(len(nodes)))])
    set_degrees(grid, [degrees])
    return grid


def set_degrees(grid, degrees):
    array = support.add_cell_array(grid, "HigherOrderDegrees", np.array(degrees, dtype=float))
    grid.GetCellData().SetHigherOrderDegrees(array)


def bend(grid, amount=0.08):
    """Moves every node or control point by a smooth map."""
    points = support.points_of(grid)
    set_points(grid, points + amount * np.sin(2.0 * points[:, [1, 2, 0]] + [0.3, 0.5, 0.9]))
    return grid


def set_points(grid, points, kind=float):
    coordinates = vtkPoints()
    coordinates.SetData(numpy_to_vtk(np.ascontiguousarray(points, dtype=kind), deep=True))
    grid.SetPoints(coordinates)


def append(grids):
    """All cells of several grids in one, with their point array 'f'."""
    points = np.concatenate([support.points_of(grid) for grid in grids])
    cells, first = [], 0
    for grid in grids:
        cells += [
            (grid.GetCellType(cell), [first + i for i in ids_of(grid, cell)])
            for cell in range(grid.GetNumberOfCells())
        ]
        first += grid.GetNumberOfPoints()
    whole = support.grid_of_cells(points, cells)
    support.add_point_array(whole, "f", np.concatenate([support.array_of(grid, "f") for grid in grids]))
    return whole
