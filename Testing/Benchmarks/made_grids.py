"""Grids made to look for errors: writes them to a folder, and says what meshes of their surfaces lack.

    pvpython Testing/Benchmarks/made_grids.py PLUGIN FOLDER

All fields are continuous: boundary layers, twisted pipes, a shell, thin tubes, near singular points, sharp fronts, flat
cells, minimal surfaces, at smooth isovalues and at ones that nodes or whole edges have exactly. FOLDER/cases.txt names the
surfaces, FILE:ARRAY:ISOVALUE a line, for splat_errors. A line a mesh, at default properties: corners, holes, particles
without a triangle, triangles that are turned away, whether the topology is proven.
"""

import sys
from collections import namedtuple
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "Python"))
sys.path.insert(0, str(Path(sys.argv[1]).parents[1] / "python3" / "dist-packages"))

import numpy as np
from paraview import simple

simple.LoadPlugin(sys.argv[1], remote=False, ns=vars(simple))

import cells
import support
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

# place: from the unit cube to the world; field: of the unit cube x and the place p.
Made = namedtuple("Made", "name cell order blocks place field isovalues")


def stretched(y):
    """From 0 to 1, the first of n intervals a thousandth of the last."""
    return np.expm1(6.9 * y) / np.expm1(6.9)


def layer(x):
    y = stretched(x[:, 1])
    return np.c_[3 * x[:, 0], y + 0.15 * np.sin(3 * x[:, 0]) * (1 - y), x[:, 2]]


def velocity(x, p):
    y = stretched(x[:, 1])
    return 1 - np.exp(-12 * y) + np.sin(4 * p[:, 0]) * np.sin(5 * p[:, 2]) * y * np.exp(-3 * y)


def twisted(x):
    cosine, sine = np.cos(2.5 * x[:, 2]), np.sin(2.5 * x[:, 2])
    u, v = x[:, 0] - 0.5, x[:, 1] - 0.5
    return np.c_[cosine * u - sine * v, sine * u + cosine * v, 3 * x[:, 2]]


def waves(x, p):
    return np.sin(6 * p[:, 0]) * np.cos(5 * p[:, 1]) + 0.5 * np.sin(3 * p[:, 2])


def shell(x):
    longitude, latitude, r = 1.4 * np.pi * x[:, 0], 2.2 * (x[:, 1] - 0.5), 0.6 + 0.4 * x[:, 2]
    return np.c_[
        r * np.cos(latitude) * np.cos(longitude),
        r * np.cos(latitude) * np.sin(longitude),
        r * np.sin(latitude),
    ]


def harmonic(x, p):
    r = np.linalg.norm(p, axis=1)
    return (p[:, 0] ** 3 - 3 * p[:, 0] * p[:, 1] ** 2) * p[:, 2] / r**4 + 0.1 * (r - 0.8)


def to_a_helix(x, p):
    u, v = x[:, 0] - 0.5 - 0.3 * np.cos(7 * x[:, 2]), x[:, 1] - 0.5 - 0.3 * np.sin(7 * x[:, 2])
    return np.sqrt(u**2 + v**2 + 1e-4)


def balls(x, p):
    middles = np.array([[0.3, 0.5, 0.5], [0.55, 0.5, 0.5], [0.75, 0.62, 0.4], [0.5, 0.2, 0.7]])
    return sum(np.exp(-((x - middle) ** 2).sum(axis=1) / 0.02) for middle in middles)


def centred(x):
    return x - 0.5


def cone(x, p):
    return p[:, 0] ** 2 + p[:, 1] ** 2 - p[:, 2] ** 2


def umbrella(x, p):
    return p[:, 0] ** 2 - p[:, 1] ** 2 * p[:, 2]


def slab(x):
    return np.c_[10 * x[:, 0] + 2 * x[:, 1], 10 * x[:, 1], 0.2 * x[:, 2] + 0.3 * np.sin(6 * x[:, 0])]


def across(x, p):
    return np.sin(0.9 * p[:, 0]) + np.cos(0.7 * p[:, 1]) + 0.4 * (x[:, 2] - 0.5)


def bent(x):
    return x + 0.04 * np.sin(5 * x[:, [1, 2, 0]])


def sines(x, p):
    return np.sin(6 * p).sum(axis=1)


def product(x, p):
    return np.sin(6 * p[:, 0]) * np.cos(5 * p[:, 1]) + np.sin(6 * p[:, 2])


def front(x, p):
    return np.tanh(40 * (x[:, 2] - 0.5 - 0.2 * np.sin(4 * x[:, 0]) * np.cos(3 * x[:, 1])))


def gyroid(x, p):
    sine, cosine = np.sin(3 * np.pi * x), np.cos(3 * np.pi * x)
    return (sine * cosine[:, [1, 2, 0]]).sum(axis=1)


def ring(x):
    angle, r = 2 * np.pi * 0.999999 * x[:, 0], 0.5 + 5 * x[:, 1] ** 1.5
    return np.c_[r * np.cos(angle), r * np.sin(angle), 2 * x[:, 2]]


def vortices(x, p):
    strength = 0.0
    for u, v, sign in ((1.2, 0.4, 1), (2.2, -0.4, -1), (3.4, 0.5, 0.8), (4.5, -0.5, -0.7)):
        moved = p[:, 1] - v - 0.2 * np.sin(3 * p[:, 2])
        strength = strength + sign * np.exp(-((p[:, 0] - u) ** 2 + moved**2) / 0.3)
    return strength


def coiled(x):
    cosine, sine = np.cos(2 * x[:, 2]), np.sin(2 * x[:, 2])
    return np.c_[cosine * (x[:, 0] + 0.4) - sine * x[:, 1], sine * (x[:, 0] + 0.4) + cosine * x[:, 1], 1.5 * x[:, 2]]


def thin_tube(x, p):
    u, v = x[:, 0] - 0.5 - 0.22 * np.cos(6 * x[:, 2]), x[:, 1] - 0.5 - 0.22 * np.sin(6 * x[:, 2])
    return np.sqrt(u**2 + v**2 + 1e-4)


def arch(x):
    r, angle = 0.5 + x[:, 0], 2.2 * x[:, 1]
    return np.c_[r * np.cos(angle), r * np.sin(angle), x[:, 2]]


def tunnels(x, p):
    return np.sin(7 * x[:, 0]) * np.sin(6 * x[:, 1]) + 0.6 * np.sin(5 * x[:, 2])


HEXAHEDRON, TETRAHEDRON, WEDGE = (f"LAGRANGE_{shape}" for shape in ("HEXAHEDRON", "TETRAHEDRON", "WEDGE"))
MADE = (
    Made("layer", HEXAHEDRON, 4, 6, layer, velocity, (0.5, 0.02, 0.95)),
    Made("twist", WEDGE, 3, 4, twisted, waves, (0.2, 0.45)),
    Made("shell", TETRAHEDRON, 4, 6, shell, harmonic, (0.0, 0.001, 0.05, 0.12)),
    Made("helix", HEXAHEDRON, 6, 4, np.array, to_a_helix, (0.03, 0.08, 0.3)),
    Made("balls", HEXAHEDRON, 5, 4, np.array, balls, (0.4, 0.35, 0.9)),
    Made("cone", TETRAHEDRON, 4, 3, centred, cone, (1e-4, -1e-4, 0.01)),
    Made("umbrella", TETRAHEDRON, 4, 3, centred, umbrella, (0.002, -0.002)),
    Made("slab", HEXAHEDRON, 3, 5, slab, across, (0.3,)),
    Made("hexahedra", "QUADRATIC_HEXAHEDRON", None, 6, bent, sines, (0.0, 1.2)),
    Made("pyramids", "QUADRATIC_PYRAMID", None, 5, bent, product, (0.0, 0.001, 1.0)),
    Made("front", HEXAHEDRON, 3, 8, np.array, front, (0.0, 0.001, 0.9, -0.9)),
    Made("gyroid", TETRAHEDRON, 2, 8, np.array, gyroid, (0.0, 0.001, 0.99, 1.0, 1.001, 1.35)),
    Made("wake", HEXAHEDRON, 4, 7, ring, vortices, (0.4, -0.3, 0.1)),
    Made("coil", WEDGE, 4, 5, coiled, thin_tube, (0.1,)),
    Made("arch", "BEZIER_HEXAHEDRON", 3, 5, arch, tunnels, (0.3,)),
)


def grid_of(made):
    grid = cells.straight_grid(made.cell, order=made.order, blocks=made.blocks)
    x = support.points_of(grid) / made.blocks
    cells.set_points(grid, made.place(x))
    support.add_point_array(grid, "u", made.field(x, support.points_of(grid)))
    return grid


def write(grid, path):
    writer = vtkXMLUnstructuredGridWriter()
    writer.SetInputData(grid)
    writer.SetFileName(str(path))
    writer.SetDataModeToBinary()
    writer.Write()


def main():
    folder = Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    names = ("MeshOpenLoops", "MeshUnusedParticles", "MeshTurnedTriangles", "TopologyProven")
    print("grid, isovalue, corners, holes, left over, turned, proven")
    with (folder / "cases.txt").open("w") as cases:
        for made in MADE:
            grid, path = grid_of(made), folder / f"{made.name}.vtu"
            write(grid, path)
            for isovalue in made.isovalues:
                cases.write(f"{path}:u:{isovalue}\n")
                mesh, _ = support.run(grid, "u", isovalue, OutputType="Triangles")
                lacks = [int(support.reported(mesh, name)) for name in names]
                print(made.name, isovalue, mesh.GetNumberOfPoints(), *lacks, sep=", ", flush=True)


main()
