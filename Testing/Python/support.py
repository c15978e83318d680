"""Helpers for the tests of the filter: run it on a file or on a grid, look at its output and messages, and ask VTK's
own cells, contour and locator for a second opinion."""

import os
from contextlib import contextmanager
from pathlib import Path

import numpy as np
from highorderparticles import vtkHighOrderParticleIsosurface
from paraview import simple
from paraview.vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.util.misc import calldata_type
from vtkmodules.vtkCommonCore import VTK_STRING, reference, vtkIdList, vtkPoints, vtkSMPTools
from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet, vtkStaticPointLocator, vtkUnstructuredGrid
from vtkmodules.vtkFiltersCore import (vtkCleanPolyData, vtkContourFilter, vtkExtractCells, vtkFeatureEdges,
                                       vtkMassProperties, vtkTriangleFilter)
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter


# Arguments of SaveData for XML files that any ParaView reads back: not raw, see Documentation/limitations.md about expat.
READABLE = {"DataMode": "Binary"}

# Running the filter


class Messages:
    """Collects the errors and warnings of an algorithm."""

    def __init__(self, algorithm):
        self.errors = []
        self.warnings = []

        @calldata_type(VTK_STRING)
        def listen(caller, event, text):
            (self.errors if event == "ErrorEvent" else self.warnings).append(text)

        for speaker in (algorithm, algorithm.GetExecutive()):
            speaker.AddObserver("ErrorEvent", listen)
            speaker.AddObserver("WarningEvent", listen)


@contextmanager
def threads(count):
    """Within, the filter runs in so many threads: left alone, it takes all cores."""
    backend = vtkSMPTools.GetBackend()
    vtkSMPTools.SetBackend("STDThread")
    vtkSMPTools.Initialize(count)
    try:
        yield
    finally:
        vtkSMPTools.SetBackend(backend)
        vtkSMPTools.Initialize(0)


def environment_of_ranks():
    """The environment for an MPI program, without the variables by which its processes would take themselves for ranks
    of this process."""
    environment = {k: v for k, v in os.environ.items() if not k.startswith(("OMPI_", "PMIX_", "PRTE_"))}
    return {**environment, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}


def read(path):
    """A reader, updated, for a .vtu or .pvtu file."""
    kind = "XMLPartitionedUnstructuredGridReader" if path.endswith(".pvtu") else "XMLUnstructuredGridReader"
    reader = getattr(simple, kind)(FileName=[path])
    reader.UpdatePipeline()
    return reader


def source_of(data):
    """A source for filters with a data object of this process."""
    source = simple.TrivialProducer()
    source.GetClientSideObject().SetOutput(data)
    source.UpdatePipeline()
    return source


def output_of(proxy):
    proxy.UpdatePipeline()
    return proxy.GetClientSideObject().GetOutputDataObject(0)


def make_filter(data, array, isovalues, **properties):
    """The filter, not yet run, on a source or a data object; array: name of a point array or
    [association, name]; isovalues: one or several. Its output has all arrays. Returns proxy and Messages."""
    source = data if hasattr(data, "SMProxy") else source_of(data)
    proxy = simple.HighOrderParticleIsosurface(Input=source, PassDiagnostics=1)
    proxy.ContourBy = ["POINTS", array] if isinstance(array, str) else array
    proxy.Isosurfaces = isovalues if isinstance(isovalues, (list, tuple)) else [isovalues]
    for name, value in properties.items():
        setattr(proxy, name, value)
    proxy.SMProxy.UpdateVTKObjects()
    return proxy, Messages(proxy.GetClientSideObject())


def run(data, array, isovalues, **properties):
    """Runs the filter; returns its output and Messages."""
    proxy, messages = make_filter(data, array, isovalues, **properties)
    return output_of(proxy), messages


def run_quietly(data, array, isovalues, **properties):
    """Runs the filter, which must give no error or warning; returns its output."""
    output, messages = run(data, array, isovalues, **properties)
    said = messages.errors + messages.warnings
    assert said == [], "\n".join(said)
    return output


# Looking at data


def points_of(data):
    if data.GetNumberOfPoints() == 0:
        return np.zeros((0, 3))
    return vtk_to_numpy(data.GetPoints().GetData()).astype(float)


def array_of(data, name, association="point"):
    attributes = data.GetPointData() if association == "point" else data.GetCellData()
    array = attributes.GetArray(name)
    assert array is not None, f"no {association} array '{name}'"
    return vtk_to_numpy(array)


def array_names(attributes):
    return set(array_list(attributes))


def array_list(attributes):
    return [attributes.GetArrayName(i) for i in range(attributes.GetNumberOfArrays())]


def own_arrays(association):
    """{name: number of components} of the arrays that the filter says outputs with diagnostics have, in their order; association:
    vtkDataObject.POINT or FIELD."""
    table = vtkHighOrderParticleIsosurface
    return {
        table.GetOutputArrayName(i): table.GetOutputArrayNumberOfComponents(i)
        for i in range(table.GetNumberOfOutputArrays())
        if table.GetOutputArrayAssociation(i) == association
    }


def reported(particles, name):
    """One number of the report in the field data."""
    array = particles.GetFieldData().GetArray(name)
    assert array is not None, f"no '{name}' in the report"
    return array.GetValue(0)


def contents(particles):
    """Points and point arrays as bytes, for comparisons bit for bit."""
    data = particles.GetPointData()
    arrays = {name: array_of(particles, name).tobytes() for name in array_names(data)}
    return {"points": points_of(particles).tobytes(), **arrays}


def bounds_of(data):
    """Lower and upper corner."""
    return np.reshape(data.GetBounds(), (3, 2)).T


def longest_side(data):
    lower, upper = bounds_of(data)
    return (upper - lower).max()


def diagonal(data):
    lower, upper = bounds_of(data)
    return np.linalg.norm(upper - lower)


def leaves_of(composite):
    """(flat index, name, leaf) of every leaf, empty ones included."""
    iterator = composite.NewTreeIterator()
    iterator.VisitOnlyLeavesOn()
    iterator.SkipEmptyNodesOff()
    iterator.InitTraversal()
    leaves = []
    while not iterator.IsDoneWithTraversal():
        name = iterator.GetCurrentMetaData().Get(vtkCompositeDataSet.NAME()) if iterator.HasCurrentMetaData() else None
        leaves.append((iterator.GetCurrentFlatIndex(), name, iterator.GetCurrentDataObject()))
        iterator.GoToNextItem()
    return leaves


def middles_of(grid):
    cells = range(grid.GetNumberOfCells())
    return np.array([np.mean(np.reshape(grid.GetCell(i).GetBounds(), (3, 2)), axis=1) for i in cells])


# Second opinions


def evaluate_by_vtk(grid, particles, names):
    """What VTK's own cells say at every particle's vtkOriginalCellIds and ParametricCoordinates:
    positions, {name: values} of the point arrays, and the gradient of the first of them (0 on Bezier cells)."""
    cells = array_of(particles, "vtkOriginalCellIds")
    parametric = array_of(particles, "ParametricCoordinates")
    fields = [array_of(grid, name).astype(float).reshape(grid.GetNumberOfPoints(), -1) for name in names]
    positions = np.zeros((len(cells), 3))
    gradients = np.zeros((len(cells), 3))
    values = [np.zeros((len(cells), field.shape[1])) for field in fields]
    # One cell after the other: making a cell costs more than evaluating it.
    for id in np.unique(cells):
        cell = grid.GetCell(id)
        nodes = [cell.GetPointId(n) for n in range(cell.GetNumberOfPoints())]
        bezier = "Bezier" in cell.GetClassName()
        nodal = [field[nodes] for field in fields]
        contoured = np.ascontiguousarray(nodal[0][:, 0])
        # Some of VTK's cells write a few more weights than they have points.
        room = np.zeros(2 * len(nodes) + 64)
        weights = room[: len(nodes)]
        for i in np.flatnonzero(cells == id):
            cell.EvaluateLocation(reference(0), parametric[i], positions[i], room)
            if not bezier:  # derivatives of VTK's Bezier cells are wrong, and some overrun their memory
                cell.Derivatives(0, parametric[i], contoured, 1, gradients[i])
            for value, field in zip(values, nodal):
                value[i] = weights @ field
    return positions, {n: np.squeeze(v, axis=1) if v.shape[1] == 1 else v for n, v in zip(names, values)}, gradients


def nearest_neighbors(particles, candidates=10):
    """Distance of every particle to the nearest particle of its own sheet (normals less than 90 degrees apart, not at
    the other side of a jump), in units of the harmonic mean of the spacings that both want; infinite where there is no
    such particle."""
    points, normals, wanted = points_of(particles), array_of(particles, "Normals"), array_of(particles, "Radius")
    has_jumps = "Jump" in array_names(particles.GetPointData())
    ends = array_of(particles, "Jump") != 0 if has_jumps else np.zeros(len(points), bool)
    cells = array_of(particles, "vtkOriginalCellIds" if has_jumps else "Radius")
    locator = vtkStaticPointLocator()
    locator.SetDataSet(particles)
    locator.BuildLocator()
    found = vtkIdList()
    nearest = np.full(len(points), np.inf)
    for i, point in enumerate(points):
        locator.FindClosestNPoints(candidates, point, found)
        others = [j for j in map(found.GetId, range(found.GetNumberOfIds())) if j != i]
        same_sheet = [
            j for j in others if normals[i] @ normals[j] > 0 and not (ends[i] and ends[j] and cells[i] != cells[j])
        ]
        if same_sheet:
            means = 2.0 / (1.0 / wanted[i] + 1.0 / wanted[same_sheet])
            nearest[i] = (np.linalg.norm(points[same_sheet] - point, axis=1) / means).min()
    return nearest


def distances_to(particles, points, unit=None):
    """Distance of each point to its nearest particle. With `unit`, the name of an array, distances are in units of the
    particle's value."""
    locator = vtkStaticPointLocator()
    locator.SetDataSet(particles)
    locator.BuildLocator()
    positions = points_of(particles)
    units = array_of(particles, unit) if unit else np.ones(len(positions))
    candidates = min(len(positions), 50 if unit else 1)  # where units differ, the nearest may be farther off
    ids = vtkIdList()

    def nearest(point):
        locator.FindClosestNPoints(candidates, point, ids)
        some = [ids.GetId(n) for n in range(ids.GetNumberOfIds())]
        return np.min(np.linalg.norm(positions[some] - point, axis=1) / units[some])

    return np.array([nearest(point) for point in points])


def sample_surface(grid, name, isovalue, count, seed=1):
    """Points of the true surface, found with VTK's own cells: by bisection between two random places of a random cell
    that lie on different sides of the surface."""
    dice = np.random.default_rng(seed)
    field = array_of(grid, name).astype(float) - isovalue
    samples = []
    ids = vtkIdList()
    for id in dice.permutation(np.repeat(np.arange(grid.GetNumberOfCells()), count)):
        grid.GetCellPoints(id, ids)
        nodal = field[[ids.GetId(n) for n in range(ids.GetNumberOfIds())]]
        if nodal.min() < 0 < nodal.max():
            samples += bisect_in_cell(grid.GetCell(id), nodal, dice)
        if len(samples) == count:
            break
    return np.array(samples)


def bisect_in_cell(cell, nodal, dice):
    """A list with one point at which the polynomial of these nodal values is 0, or an empty list."""
    weights, position = np.zeros(len(nodal)), np.zeros(3)

    def value(u):
        cell.EvaluateLocation(reference(0), u, position, weights)
        return weights @ nodal

    low, high = random_place(cell, dice), random_place(cell, dice)
    if value(low) > value(high):
        low, high = high, low
    if not value(low) < 0 < value(high):
        return []
    for _ in range(40):
        middle = (low + high) / 2
        low, high = (middle, high) if value(middle) < 0 else (low, middle)
    return [position]


def random_place(cell, dice):
    """Parametric coordinates, evenly distributed over a hexahedron, tetrahedron or wedge."""
    if cell.GetNumberOfFaces() == 4:
        return dice.dirichlet([1, 1, 1, 1])[:3]
    if cell.GetNumberOfFaces() == 5:
        return np.append(dice.dirichlet([1, 1, 1])[:2], dice.random())
    return dice.random(3)


def stock_contour(grid, name, isovalue):
    """VTK's contour on straight sub-cells, as triangles: roughly the surface."""
    contour = vtkContourFilter()
    contour.SetInputData(grid)
    contour.SetInputArrayToProcess(0, 0, 0, 0, name)
    contour.SetValue(0, isovalue)
    welded = vtkCleanPolyData()  # cells that bring their own nodes leave seams
    welded.SetInputConnection(contour.GetOutputPort())
    welded.SetTolerance(1e-6)
    triangles = vtkTriangleFilter()
    triangles.SetInputConnection(welded.GetOutputPort())
    triangles.Update()
    return triangles.GetOutput()


def boundary_length(triangles):
    """Length of the edges that have a triangle on one side only."""
    boundary = vtkFeatureEdges()
    boundary.SetInputData(triangles)
    boundary.FeatureEdgesOff()
    boundary.NonManifoldEdgesOff()
    boundary.Update()
    edges = boundary.GetOutput()
    ends = vtk_to_numpy(edges.GetLines().GetConnectivityArray()).reshape(-1, 2)
    points = points_of(edges)
    return np.linalg.norm(points[ends[:, 0]] - points[ends[:, 1]], axis=1).sum()


def area_of(triangles):
    mass = vtkMassProperties()
    mass.SetInputData(triangles)
    mass.Update()
    return mass.GetSurfaceArea()


def hexagonal_count(area, spacing, boundary=0.0):
    """How many particles a hexagonal packing of a spacing puts on an area with a boundary of a length; particles on the
    boundary have half of their own area outside."""
    return area / (np.sqrt(3) / 2 * spacing**2) + boundary / (2 * spacing)


# Grids made here


def add_point_array(grid, name, values):
    array = numpy_to_vtk(np.ascontiguousarray(values), deep=True)
    array.SetName(name)
    grid.GetPointData().AddArray(array)


def add_cell_array(grid, name, values):
    array = numpy_to_vtk(np.ascontiguousarray(values), deep=True)
    array.SetName(name)
    grid.GetCellData().AddArray(array)
    return array


def grid_of_cells(points, cells):
    """points: (n, 3) numbers; cells: [(cell type, point ids), ...]. Points are kept in double."""
    grid = vtkUnstructuredGrid()
    coordinates = vtkPoints()
    coordinates.SetData(numpy_to_vtk(np.ascontiguousarray(points, dtype=float), deep=True))
    grid.SetPoints(coordinates)
    for cell_type, ids in cells:
        grid.InsertNextCell(cell_type, len(ids), [int(i) for i in ids])
    return grid


def cells_of(grid, ids):
    """A grid of some cells of a grid, in the order of their ids; each cell has its own nodes, with the array u."""
    cells, nodes = [], []
    for id in ids:
        cell = grid.GetCell(int(id))
        count = cell.GetNumberOfPoints()
        cells.append((cell.GetCellType(), range(len(nodes), len(nodes) + count)))
        nodes += [cell.GetPointId(n) for n in range(count)]
    part = grid_of_cells(points_of(grid)[nodes], cells)
    add_point_array(part, "u", array_of(grid, "u")[nodes])
    return part


def write_pieces(folder, name, pieces):
    """A .pvtu file as solvers write them, one .vtu file a piece. All pieces have the arrays of the first one; those with
    ghost cells mark them."""
    types = {"d": "Float64", "f": "Float32", "B": "UInt8", "i": "Int32", "l": "Int64", "q": "Int64"}

    def declared(attributes):
        arrays = [attributes.GetArray(array) for array in array_list(attributes)]
        return "".join(f'<PDataArray type="{types[vtk_to_numpy(array).dtype.char]}" Name="{array.GetName()}" '
                       f'NumberOfComponents="{array.GetNumberOfComponents()}"/>' for array in arrays)

    for i, piece in enumerate(pieces):
        writer = vtkXMLUnstructuredGridWriter()
        writer.SetInputData(piece)
        writer.SetFileName(f"{folder}/{name}_{i}.vtu")
        writer.SetDataModeToBinary()
        writer.Write()
    with_ghosts = any("vtkGhostType" in array_list(piece.GetCellData()) and array_of(piece, "vtkGhostType", "cell").any()
                      for piece in pieces)
    sources = "".join(f'<Piece Source="{name}_{i}.vtu"/>' for i in range(len(pieces)))
    coordinates = types[vtk_to_numpy(pieces[0].GetPoints().GetData()).dtype.char]
    Path(folder, f"{name}.pvtu").write_text(f"""<VTKFile type="PUnstructuredGrid" version="0.1">
<PUnstructuredGrid GhostLevel="{int(with_ghosts)}">
<PPoints><PDataArray type="{coordinates}" NumberOfComponents="3"/></PPoints>
<PPointData>{declared(pieces[0].GetPointData())}</PPointData>
<PCellData>{declared(pieces[0].GetCellData())}</PCellData>
{sources}</PUnstructuredGrid></VTKFile>""")
    return Path(folder, f"{name}.pvtu")


def pieces_of(grid, owners):
    """A grid in pieces as DOLFINx makes them: with the nodes that cells share, and the cells of other pieces beside those
    of a piece as ghosts. owners: the piece of each cell."""
    nodes = [{grid.GetCell(c).GetPointId(n) for n in range(grid.GetCell(c).GetNumberOfPoints())}
             for c in range(grid.GetNumberOfCells())]
    pieces = []
    for piece in range(max(owners) + 1):
        own = np.flatnonzero(owners == piece)
        touched = set().union(*(nodes[c] for c in own))
        ghosts = [c for c in range(len(nodes)) if owners[c] != piece and nodes[c] & touched]
        ids = vtkIdList()
        for cell in [*own, *ghosts]:
            ids.InsertNextId(int(cell))
        extract = vtkExtractCells()
        extract.SetInputData(grid)
        extract.SetCellList(ids)
        extract.Update()
        part = extract.GetOutput()
        # The filter keeps the order of the grid.
        add_cell_array(part, "vtkGhostType", (owners[sorted([*own, *ghosts])] != piece).astype(np.uint8))
        pieces.append(part)
    return pieces
