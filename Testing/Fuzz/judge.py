"""Runs recipes, and judges what comes out: reads one recipe a line from the standard input, and answers with a line of
JSON. To be run by pvpython; fuzz.py starts it."""

import json
import os
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent.parent / "Python"))

import numpy as np
import recipes
import support
from highorderparticles import vtkHighOrderParticleIsosurface
from vtkmodules.vtkCommonDataModel import vtkDataObject
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader, vtkXMLUnstructuredGridWriter

# Particles whose position and value are compared with those of VTK's own cells; more take longer.
COMPARED = 40
# Largest processor time between two questions whether to go on, seconds: a user waits as long for an abort, once a core
# is free. Longer than what is aimed at, 0.2 s, by what other work on the machine adds to times.
LONGEST_SILENCE = 1.0


class Session:
    """One filter object and what is done to it, step by step."""

    def __init__(self, recipe):
        self.recipe = recipe
        self.grid = self.read(recipes.make_grid(recipe))
        self.filter = vtkHighOrderParticleIsosurface()
        self.messages = support.Messages(self.filter)
        self.silence = 0.0
        self.abort_after = None
        self.filter.AddObserver("ProgressEvent", self.progress)
        self.filter.SetPassDiagnostics(True)
        self.filter.SetInputArrayToProcess(0, 0, 0, 0, "f")
        self.set_properties(recipe["properties"])
        self.set_isovalues(recipe["isovalues"])
        self.give_grid()

    def give_grid(self):
        """Lets the filter have the grid, in one piece or several."""
        whole, self.pieces = recipes.in_pieces(self.grid, self.recipe.get("pieces", 1))
        self.filter.SetInputDataObject(whole)

    def read(self, grid):
        """The grid as it comes back from a file, which may be damaged."""
        damage = self.recipe["file"]
        if not damage:
            return grid
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "grid.vtu")
            writer = vtkXMLUnstructuredGridWriter()
            writer.SetFileName(path)
            writer.SetInputData(grid)
            writer.Write()
            text = bytearray(Path(path).read_bytes())
            dice = np.random.default_rng(self.recipe["seed"])
            for _ in range(damage["flips"]):
                text[int(dice.integers(len(text)))] ^= 1 << int(dice.integers(8))
            Path(path).write_bytes(text[: int(damage["cut"] * len(text))])
            answer({"reading": True})
            reader = vtkXMLUnstructuredGridReader()
            reader.SetFileName(path)
            reader.Update()
            answer({"reading": False})
            return reader.GetOutput()

    def set_properties(self, properties):
        for name, value in properties.items():
            if name in ("Spacing", "SmallestSpacing"):
                value = value * side_of(self.grid)
            getattr(self.filter, "Set" + name)(value)

    def set_isovalues(self, shares):
        """Isovalues as shares of the range of the values."""
        array = self.grid.GetPointData().GetArray("f")
        values = support.vtk_to_numpy(array).astype(float).ravel() if array else np.zeros(1)
        values = values[np.isfinite(values)] if np.isfinite(values).any() else np.zeros(1)
        self.filter.SetNumberOfContours(len(shares))
        for i, share in enumerate(shares):
            self.filter.SetValue(i, (1 - share) * values.min() + share * values.max())

    def progress(self, *_):
        now = time.process_time()
        self.silence = max(self.silence, now - self.asked)
        self.asked = now
        if self.abort_after is not None:
            self.abort_after -= 1
            if self.abort_after < 0:
                self.filter.SetAbortExecute(1)

    def change(self, change):
        kind = change["kind"]
        self.abort_after = change["after"] if kind == "abort" else None
        if kind == "isovalues":
            self.set_isovalues(change["isovalues"])
        elif kind == "property":
            self.set_properties(change["properties"])
        elif kind == "no array":
            self.grid.GetPointData().RemoveArray("f")
            self.grid.Modified()
        elif kind == "other grid":
            self.grid = recipes.make_grid(recipes.random_recipe(change["seed"]) | {"bad": [], "blocks": 1, "order": 2})
        elif kind in ("values", "points"):
            other = recipes.make_grid(self.recipe, change["seed"])
            if other.GetNumberOfPoints() != self.grid.GetNumberOfPoints():
                return
            if kind == "points":
                self.grid.SetPoints(other.GetPoints())
            else:
                self.grid.GetPointData().AddArray(other.GetPointData().GetArray("f"))
            self.grid.Modified()
        elif kind == "abort":
            self.filter.SetSeed(change["seed"])  # else the output of the run before would be kept
        if kind in ("no array", "other grid", "values", "points"):
            self.give_grid()

    def run(self):
        """What is wrong with the output; an empty list if nothing is."""
        self.asked = time.process_time()
        self.filter.Update()
        self.progress()
        failed = [text for text in self.messages.errors if "the run failed" in text]
        silent = [f"no question for {self.silence:.2f} s"] if self.silence > LONGEST_SILENCE else []
        output = self.filter.GetOutputDataObject(0)
        parts = [output]
        if output.IsA("vtkCompositeDataSet"):
            parts = [leaf for _, _, leaf in support.leaves_of(output)]
        return failed + silent + [
            text
            for part, grid in zip(parts, self.pieces)
            if part and part.GetNumberOfPoints() > 0
            for text in complaints(self.filter, grid, part, len(self.pieces) > 1)
        ]


def side_of(grid):
    """Longest side of the bounds of the points that are finite."""
    return side_of_points(support.points_of(grid))


def side_of_points(points):
    points = points[np.isfinite(points).all(axis=1)]
    return float(np.ptp(points, axis=0).max()) if len(points) else 1.0


def complaints(contour, grid, output, is_part):
    """What is wrong with an output, or with the output of one of several blocks."""
    found = []
    columns = {"points": support.points_of(output)}
    columns |= {name: support.array_of(output, name).astype(float) for name in support.own_arrays(0)}
    found += [f"{name} is not finite" for name, values in columns.items() if not np.isfinite(values).all()]
    if "other" in support.array_names(output.GetPointData()):
        found += ["values of an array are not finite"] * (not np.isfinite(support.array_of(output, "other")).all())
    lengths = np.linalg.norm(columns["Normals"], axis=1)
    found += ["a normal is not of unit length"] * bool(np.abs(lengths - 1.0).max() > 2e-7)  # floats
    ids = columns["vtkOriginalCellIds"]
    if ids.min() < 0 or ids.max() >= grid.GetNumberOfCells():
        return found + ["a cell id is out of range"]
    places = columns["ParametricCoordinates"]
    found += ["a place is outside its cell"] * bool(places.min() < -1e-9 or places.max() > 1 + 1e-9)
    found += ["a radius is not positive"] * bool(columns["Radius"].min() <= 0)
    if contour.GetOutputType() != contour.PARTICLES:
        found += mesh_faults(output, is_part)
        # Corners may be at home in another block, and nodes of curved triangles off the surface, with a warning.
        if is_part or support.reported(output, "MeshStraightNodes") > 0:
            return found
    return found or misplaced(contour, grid, output)


def mesh_faults(mesh, is_part):
    """What keeps a mesh, of flat or curved triangles, from being an oriented manifold with boundary. The part of a mesh
    that lies in one block may touch itself in a corner."""
    cells = mesh.GetPolys() if mesh.IsA("vtkPolyData") else mesh.GetCells()
    count = cells.GetNumberOfCells()
    ids = support.vtk_to_numpy(cells.GetConnectivityArray()).reshape(count, -1)
    if ids.min() < 0 or ids.max() >= mesh.GetNumberOfPoints():
        return ["a triangle has a corner that is not there"]
    found = ["a triangle has a node twice"] * bool((np.diff(np.sort(ids, axis=1), axis=1) == 0).any())
    found += ["a point has no triangle"] * (len(np.unique(ids)) != mesh.GetNumberOfPoints())
    corners = ids[:, :3]
    edges = np.concatenate([corners[:, [0, 1]], corners[:, [1, 2]], corners[:, [2, 0]]])
    found += ["two triangles are on one side of an edge"] * (len(np.unique(edges, axis=0)) != len(edges))
    return found + ["two fans of triangles touch in a corner"] * (not is_part and has_touching_fans(corners))


def has_touching_fans(corners):
    """Whether the triangles at some corner are not all joined by edges at that corner. No edge has two triangles on one
    side."""
    # A spoke is an edge seen from one of its ends. A triangle leads, around each of its corners, from one spoke to the
    # next, so that the spokes of a fan are a chain, or a ring.
    count = int(corners.max()) + 1
    turns = np.concatenate([np.roll(corners, -i, axis=1) for i in range(3)]).astype(np.int64)
    begins, ends = turns[:, 0] * count + turns[:, 1], turns[:, 0] * count + turns[:, 2]
    spokes = np.unique(np.concatenate([begins, ends]))
    ahead = np.arange(len(spokes))
    ahead[np.searchsorted(spokes, begins)] = np.searchsorted(spokes, ends)
    is_end = ahead == np.arange(len(spokes))
    # Steps of double length: in the end a spoke knows the end of its chain, or the least spoke of its ring.
    least = np.arange(len(spokes))
    for _ in range(int(np.bincount(spokes // count).max()).bit_length()):
        least = np.minimum(least, least[ahead])
        ahead = ahead[ahead]
    fans = np.unique(np.where(is_end[ahead], ahead, least))
    return len(fans) != len(np.unique(corners))


def misplaced(contour, grid, output):
    """Compares some particles with what VTK's own cells say: whether they stand where their parametric coordinates
    are, and on the surface to the tolerance."""
    if contour.GetNodeSpacing() != contour.UNIFORM:
        return []
    rows = np.unique(np.linspace(0, output.GetNumberOfPoints() - 1, COMPARED).astype(int))
    points, ids = support.points_of(output)[rows], support.array_of(output, "vtkOriginalCellIds")[rows]
    places = support.array_of(output, "ParametricCoordinates")[rows]
    isovalues = support.array_of(output, "Isovalue")[rows]
    field = support.array_of(grid, "f").astype(float).reshape(grid.GetNumberOfPoints(), -1)
    component = contour.GetComponent()
    if 0 <= component < field.shape[1]:
        field = field[:, component : component + 1]
    # A diagonal is 1.7 sides at most; coordinates far from the origin are rounded.
    tolerance = 4 * contour.GetTolerance() * side_of(grid) + 2e-15 * np.nanmax(np.abs(points))
    for point, id, place, isovalue in zip(points, ids, places, isovalues):
        cell = grid.GetCell(int(id))
        kind = cell.GetClassName()
        # VTK reads weights of Bezier cells from elsewhere, and takes a voxel for a box also where it is bent.
        if "Voxel" in kind or ("Bezier" in kind and grid.GetPointData().GetRationalWeights()):
            continue
        position, value, rise, rounding = evaluate(cell, place, field, tolerance)
        if not np.abs((position - point) / rounding[0]).max() <= 1e-8:
            return [f"a particle of cell {id} is not where its parametric coordinates are"]
        if not abs(value - isovalue) <= rise + 1e-8 * rounding[1]:
            return [f"a particle of cell {id} is off the surface: {value} for {isovalue}"]
    return []


def evaluate(cell, place, field, distance):
    """Position of a place in a cell of VTK; value or magnitude of the field there, and a bound on how much it changes
    over a distance, infinite where VTK has no derivatives; the size of the numbers that are added up to positions and
    to values."""
    count = cell.GetNumberOfPoints()
    position, weights = np.zeros(3), np.zeros(4096)
    cell.EvaluateLocation(support.reference(0), place, position, weights)
    weights = weights[:count]
    nodes = np.array([cell.GetPoints().GetPoint(n) for n in range(count)])
    values = np.ascontiguousarray(field[[cell.GetPointId(n) for n in range(count)]])
    value = weights @ values
    rise = np.inf
    if "Bezier" not in cell.GetClassName():  # derivatives of VTK's Bezier cells are wrong
        # VTK takes cells that are small in world units for singular.
        length, height = side_of_points(nodes), np.abs(values).max() or 1.0
        for n, node in enumerate((nodes - nodes[0]) / length):
            cell.GetPoints().SetPoint(n, node)
        gradients = np.zeros(3 * values.shape[1])
        cell.Derivatives(0, place, (values / height).ravel(), values.shape[1], gradients)
        slope = np.linalg.norm(gradients)
        # Zero in cells that are flat beside their length: VTK takes them for singular.
        rise = slope * (distance / length) * height if 0 < slope < np.inf else np.inf
    unit = np.abs(value).max()
    size = unit * np.linalg.norm(value / unit) if value.size > 1 and unit > 0 else value[0]
    # Shape functions of high degrees add numbers much larger than their sum.
    rounding = np.abs(weights).sum()
    return position, size, rise, (rounding * np.abs(nodes).max(), rounding * np.abs(values).max())


def answer(words):
    """A line for the fuzzer. Not print(): pvpython puts a stream in its place that may keep the end of a line back."""
    os.write(1, (json.dumps(words) + "\n").encode())


def main():
    for line in open(0):  # pvpython puts something of its own in the place of sys.stdin
        recipe = json.loads(line)
        session = Session(recipe)
        found = session.run()
        for change in recipe["changes"]:
            session.change(change)
            found += session.run()
        particles = session.filter.GetOutputDataObject(0).GetNumberOfElements(vtkDataObject.POINT)
        answer({"complaints": found, "particles": particles, "silence": session.silence})


if __name__ == "__main__":
    main()
