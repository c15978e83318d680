"""Recipes of random inputs: what a grid is made of, and what is asked of the filter, step by step. A recipe is a dict
that JSON can hold; the same recipe makes the same grid."""

import copy

import numpy as np

import cells
import support
from vtkmodules.vtkCommonCore import vtkIdList
from vtkmodules.vtkCommonDataModel import vtkMultiBlockDataSet

CELLS = [*cells.OF_THE_SOURCE, *cells.BY_HAND, *cells.ARBITRARY_ORDER]
FIELDS = ["linear", "sphere", "gyroid", "noise", "steps", "constant", "product", "spike"]
CLASSIC, FAST = 0, 1  # of the filter
PARTICLES, TRIANGLES, CURVED_TRIANGLES = 0, 1, 2
# Powers of ten: units that files of solvers come in, and the ends of what doubles hold.
EXPONENTS = [0] * 6 + [-3, 3, -9, 9, -30, 30, -150, 150, -200, 200, -300]


def random_recipe(seed):
    """A recipe that follows from a number."""
    dice = np.random.default_rng(seed)

    def pick(choices):
        return choices[int(dice.integers(len(choices)))]

    def seldom(value, otherwise, chance=0.15):
        return value if dice.random() < chance else otherwise

    cell = pick(CELLS)
    order = int(dice.integers(1, 11)) if cell in cells.ARBITRARY_ORDER else None
    largest = 3 if not order or order < 4 else 2 if order < 6 else 1
    field, components = pick(FIELDS), pick([1, 1, 1, 3])
    if field in ("noise", "steps", "spike") and order:
        # To isolate the surface of higher degrees takes longer than the limit; a magnitude has twice the degree.
        order = min(order, 3 if components > 1 else 6)
    recipe = {
        "seed": seed,
        "cell": cell,
        "order": order,
        "blocks": int(dice.integers(1, largest + 1)),
        "length": pick(EXPONENTS),
        "offset": pick([0] * 6 + [1, 1e4, -1e8]),
        "warp": pick([0, 0.1, 0.3]),
        "scatter": seldom(pick([0.05, 0.3, 1.0]), 0),
        "flat": seldom(pick([0.0, 1e-12, 1e-3]), 1),
        "field": field,
        "value": pick(EXPONENTS),
        "shift": seldom(pick([1.0, 1e5, -1e12]), 0),
        "number": pick(["float64", "float64", "float32", "int32"]),
        "components": components,
        "isovalues": [float(dice.choice([0.5, 0.33, 0.9, 0.0, 1.0, 0.999, 1.2])) for _ in range(seldom(2, 1))],
        "bad": [pick(["point", "value", "id", "huge value", "far point"]) for _ in range(seldom(2, 0))],
        "weights": pick([None, "random", "wide", "zero", "tiny"]) if "BEZIER" in cell else None,
        "ghosts": seldom(float(dice.random()), 0),
        "properties": random_properties(dice, pick, seldom),
        "changes": [random_change(dice, pick, seldom) for _ in range(seldom(int(dice.integers(1, 4)), 0, 0.4))],
        "file": seldom({"cut": seldom(float(dice.random()), 1), "flips": int(dice.integers(0, 6))}, None),
    }
    return recipe | later_choices(recipe, seed)


def later_choices(recipe, seed):
    """What recipes know since seeds were first written down, by other dice, so that a seed is still what it was."""
    dice = np.random.default_rng([seed, 1])

    def mesh():
        kind = int(dice.choice([PARTICLES, TRIANGLES, CURVED_TRIANGLES]))
        return {"OutputType": kind, "Order": int(dice.integers(2, 5))}

    # In units of the longest side.
    smallest = float(dice.choice([0, 0, 0, 0.01, 0.1]))
    properties = {**recipe["properties"], "SmallestSpacing": smallest, **(mesh() if dice.random() < 0.5 else {})}
    changes = [{"kind": "property", "properties": mesh()}] if dice.random() < 0.15 else []
    return {
        "pieces": int(dice.choice([1, 1, 1, 2, 5])),
        "properties": properties,
        "changes": recipe["changes"] + changes,
    }


def random_properties(dice, pick, seldom):
    method = seldom(CLASSIC, FAST, 0.1)
    return {
        # In units of the longest side. Classic takes seconds where Fast takes milliseconds.
        "Spacing": pick([0, 0.02, 0.05, 0.1, 0.5, 3]) if method == FAST else pick([0.2, 0.5]),
        "AngularDensity": pick([0, 2, 7, 15]),
        "Tolerance": pick([1e-10, 1e-14, 1e-5, 1e-2]),
        "NumberOfParticles": seldom(pick([1, 2, 7, 100, 500]), 0, 0.3),
        "Quality": pick([0, 1, 2]),
        "Method": method,
        "NodeSpacing": seldom(1, 0),
        "Component": pick([0, 0, 1, 3]),
        "WarmStart": seldom(0, 1),
        "Seed": int(dice.integers(0, 1000)),
    }


def random_change(dice, pick, seldom):
    """What is done to the filter or its input before it runs again."""
    kind = pick(["isovalues", "property", "values", "points", "no array", "other grid", "abort"])
    if kind == "isovalues":
        return {"kind": kind, "isovalues": [float(dice.random())]}
    if kind == "property":
        properties = random_properties(dice, pick, seldom)
        name = pick([name for name in properties if name != "Method"])
        return {"kind": kind, "properties": {name: properties[name]}}
    return {"kind": kind, "seed": int(dice.integers(1000)), "after": int(dice.integers(0, 20))}


# Grids


def field_of(recipe, x, dice):
    """Values at points of a box [0, 1]^3, about one in size."""
    kind = recipe["field"]
    if kind == "linear":
        return x @ [1.0, 0.5, 0.25]
    if kind == "sphere":
        return np.sum((x - 0.5) ** 2, axis=1)
    if kind == "gyroid":
        a = 7.0 * x
        return np.sum(np.sin(a) * np.cos(a[:, [1, 2, 0]]), axis=1)
    if kind == "noise":
        return dice.normal(size=len(x))
    if kind == "steps":
        return np.floor(3.0 * x[:, 0]) + (dice.random(len(x)) < 0.2)
    if kind == "constant":
        return np.ones(len(x))
    if kind == "product":
        return np.prod(x - 0.5, axis=1)
    values = np.zeros(len(x))
    values[int(dice.integers(len(x)))] = 1.0
    return values


def make_grid(recipe, seed=0):
    """The grid, with the point array 'f'.
    :param seed: for other points and values of the same kind"""
    dice = np.random.default_rng([recipe["seed"], seed])
    grid = cells.straight_grid(recipe["cell"], order=recipe["order"], blocks=recipe["blocks"])
    straight = support.points_of(grid)
    x = straight / recipe["blocks"]
    values = np.column_stack([field_of(recipe, x, dice) for _ in range(recipe["components"])])
    bent = straight + recipe["warp"] * np.sin(2.0 * straight[:, [1, 2, 0]] + dice.random(3))
    bent += recipe["scatter"] * dice.normal(size=bent.shape) / (recipe["order"] or 2)
    bent[:, 2] *= recipe["flat"]
    values = (values + recipe["shift"]) * 10.0 ** recipe["value"]
    points = (bent + recipe["offset"]) * 10.0 ** recipe["length"]
    spoil(recipe, points, values, dice)
    if recipe["number"] == "int32":
        values = np.clip(np.nan_to_num(values * 1000.0), -2e9, 2e9)
    with np.errstate(over="ignore"):
        values = values.astype(recipe["number"])
        points = points.astype("float32" if recipe["number"] == "float32" else float)
    cells.set_points(grid, points, points.dtype)
    support.add_point_array(grid, "f", values if recipe["components"] > 1 else values[:, 0])
    support.add_point_array(grid, "other", dice.normal(size=(len(x), 2)))
    decorate(grid, recipe, dice)
    return with_bad_ids(grid, dice) if "id" in recipe["bad"] else grid


def spoil(recipe, points, values, dice):
    """Numbers that files should not hold."""
    for bad in recipe["bad"]:
        row = int(dice.integers(len(points)))
        if bad == "point":
            points[row, 0] = dice.choice([np.nan, np.inf, -np.inf])
        elif bad == "far point":
            points[row, 0] = dice.choice([1e20, 1e100, 1e300])
        elif bad == "value":
            values[row] = dice.choice([np.nan, np.inf, -np.inf])
        elif bad == "huge value":
            values[row] = dice.choice([1e30, 1e80, 1e300])


def decorate(grid, recipe, dice):
    """Arrays that tell more about points and cells."""
    if recipe["weights"]:
        weights = dice.random(grid.GetNumberOfPoints()) + 0.5
        weights = {"random": weights, "wide": weights**4, "zero": weights * 0.0, "tiny": weights * 1e-200}
        support.add_point_array(grid, "RationalWeights", weights[recipe["weights"]])
        grid.GetPointData().SetRationalWeights(grid.GetPointData().GetArray("RationalWeights"))
    if recipe["ghosts"]:
        marks = dice.choice([1, 8, 32], size=grid.GetNumberOfCells())
        marks[dice.random(grid.GetNumberOfCells()) > recipe["ghosts"]] = 0
        support.add_cell_array(grid, "vtkGhostType", marks.astype(np.uint8))


def with_bad_ids(grid, dice):
    """A copy whose last cell names a point that is not there."""
    ids = vtkIdList()
    listed = []
    for cell in range(grid.GetNumberOfCells()):
        grid.GetCellPoints(cell, ids)
        listed.append((grid.GetCellType(cell), [ids.GetId(n) for n in range(ids.GetNumberOfIds())]))
    listed[-1][1][int(dice.integers(len(listed[-1][1])))] = int(dice.choice([-1, grid.GetNumberOfPoints(), 10**9]))
    broken = support.grid_of_cells(support.points_of(grid), listed)
    broken.GetPointData().ShallowCopy(grid.GetPointData())
    broken.GetCellData().ShallowCopy(grid.GetCellData())
    return broken


def in_pieces(grid, count):
    """The grid's cells in several blocks that share all points, and a block that is empty; the grid itself if count is
    1. The second value lists what stands at each place of the composite."""
    if count == 1:
        return grid, [grid]
    pieces = []
    ids = vtkIdList()
    for some in np.array_split(np.arange(grid.GetNumberOfCells()), count):
        piece = grid.NewInstance()
        piece.SetPoints(grid.GetPoints())
        piece.GetPointData().ShallowCopy(grid.GetPointData())
        piece.GetCellData().CopyAllOn()
        piece.GetCellData().CopyAllocate(grid.GetCellData(), len(some))
        for row, cell in enumerate(map(int, some)):
            grid.GetCellPoints(cell, ids)
            piece.InsertNextCell(grid.GetCellType(cell), ids)
            piece.GetCellData().CopyData(grid.GetCellData(), cell, row)
        pieces.append(piece)
    composite = vtkMultiBlockDataSet()
    composite.SetNumberOfBlocks(count + 1)
    for place, piece in enumerate(pieces):
        composite.SetBlock(place, piece)
    return composite, pieces


# Smaller recipes


PLAIN = {
    "length": 0, "offset": 0, "warp": 0, "scatter": 0, "flat": 1, "value": 0, "shift": 0, "number": "float64",
    "components": 1, "bad": [], "weights": None, "ghosts": 0, "changes": [], "file": None, "isovalues": [0.5],
    "pieces": 1,
}  # fmt: skip
PLAIN_PROPERTIES = {
    "Spacing": 0, "AngularDensity": 7, "Tolerance": 1e-10, "NumberOfParticles": 0, "Quality": 1, "Method": FAST,
    "NodeSpacing": 0, "Component": 0, "WarmStart": 1, "Seed": 1, "OutputType": PARTICLES, "Order": 2,
    "SmallestSpacing": 0,
}  # fmt: skip


def simpler(recipe):
    """Recipes with one thing less, the largest simplifications first."""

    def changed(**changes):
        return {**copy.deepcopy(recipe), **changes}

    for name, plain in PLAIN.items():
        if recipe.get(name, plain) != plain:
            yield changed(**{name: plain})
    for n in range(len(recipe["changes"])):
        yield changed(changes=recipe["changes"][:n] + recipe["changes"][n + 1 :])
    for name, plain in PLAIN_PROPERTIES.items():
        if recipe["properties"].get(name, plain) != plain:
            yield changed(properties={**recipe["properties"], name: plain})
    if recipe["blocks"] > 1:
        yield changed(blocks=recipe["blocks"] - 1)
    if (recipe["order"] or 0) > 1:
        yield changed(order=recipe["order"] - 1)
