"""Composite inputs: their blocks are one mesh, and every particle goes to the block of its cell."""

import time

import numpy as np
import pytest
from paraview.vtk.util.numpy_support import numpy_to_vtk
from support import (
    add_cell_array, add_point_array, array_names, array_of, cells_of, contents, grid_of_cells, leaves_of, middles_of,
    nearest_neighbors, output_of, points_of, read, run, run_quietly)
from vtkmodules.vtkCommonDataModel import (
    VTK_HEXAHEDRON, vtkCompositeDataSet, vtkDataAssembly, vtkImageData, vtkMultiBlockDataSet, vtkPartitionedDataSet, vtkPartitionedDataSetCollection,
    vtkPolyData, vtkUnstructuredGrid)
from vtkmodules.vtkFiltersCore import vtkAppendPolyData

NAME = vtkCompositeDataSet.NAME()
SURFACE = {"array": "u", "isovalues": 0.5, "Spacing": 0.03}


@pytest.fixture
def whole(data):
    """A box of 384 tetrahedra of order 3."""
    return output_of(read(data("dolfinx_tet_p3.vtu")))


def halves_of(grid):
    middle = grid.GetNumberOfCells() // 2
    return cells_of(grid, range(middle)), cells_of(grid, range(middle, grid.GetNumberOfCells()))


def multiblock(*blocks, names=()):
    composite = vtkMultiBlockDataSet()
    composite.SetNumberOfBlocks(len(blocks))
    for i, block in enumerate(blocks):
        composite.SetBlock(i, block)
    for i, name in enumerate(names):
        composite.GetMetaData(i).Set(NAME, name)
    return composite


def partitioned(*blocks):
    composite = vtkPartitionedDataSet()
    for i, block in enumerate(blocks):
        composite.SetPartition(i, block)
    return composite


def collection(*blocks):
    composite = vtkPartitionedDataSetCollection()
    for i, block in enumerate(blocks):
        composite.SetPartition(i, 0, block)
    return composite


def together(composite):
    append = vtkAppendPolyData()
    for _, _, leaf in leaves_of(composite):
        append.AddInputData(leaf)
    append.Update()
    return append.GetOutput()


@pytest.mark.parametrize("composite", [multiblock, partitioned, collection])
def test_a_mesh_in_two_blocks_has_the_particles_of_the_whole(whole, composite):
    first, second = halves_of(whole)
    alone = run_quietly(cells_of(whole, range(whole.GetNumberOfCells())), **SURFACE)
    output = run_quietly(composite(first, second), **SURFACE)
    assert output.GetClassName() == composite(first, second).GetClassName()
    assert np.array_equal(points_of(together(output)), points_of(alone))
    for offset, (_, _, particles) in zip([0, first.GetNumberOfCells()], leaves_of(output)):
        ids = array_of(particles, "vtkOriginalCellIds") + offset
        own = np.isin(array_of(alone, "vtkOriginalCellIds"), ids)
        assert 100 < particles.GetNumberOfPoints() == np.sum(own)
        assert np.array_equal(ids, array_of(alone, "vtkOriginalCellIds")[own])
        for name in ("Normals", "Radius", "u", "ParametricCoordinates"):
            assert np.array_equal(array_of(particles, name), array_of(alone, name)[own]), name


def test_particles_keep_their_distance_across_blocks(whole):
    """Three slabs have their cells in another order: other particles, but the same number, equally even."""
    across = middles_of(whole)[:, 0]
    owner = np.digitize(across, np.quantile(across, [1 / 3, 2 / 3]))
    slabs = [cells_of(whole, np.flatnonzero(owner == slab)) for slab in range(3)]
    alone, output = run_quietly(whole, **SURFACE), together(run_quietly(multiblock(*slabs), **SURFACE))
    assert output.GetNumberOfPoints() == pytest.approx(alone.GetNumberOfPoints(), rel=0.01)
    apart, expected = nearest_neighbors(output), nearest_neighbors(alone)
    assert apart.min() > expected.min() - 0.1
    assert np.quantile(apart, 0.01) == pytest.approx(np.quantile(expected, 0.01), abs=0.03)
    # There are no boundary curves at the interfaces: contoured one by one, the slabs have more particles than that.
    one_by_one = sum(run_quietly(slab, **SURFACE).GetNumberOfPoints() for slab in slabs)
    assert one_by_one > 1.015 * alone.GetNumberOfPoints()


def test_ghost_cells_of_neighbouring_blocks_are_sampled_once(whole):
    first, second = halves_of(whole)
    every = range(whole.GetNumberOfCells())
    middle, count = len(every) // 2, len(every)
    overlapping = []
    for own in (range(middle), range(middle, count)):
        part = cells_of(whole, [*own, *(i for i in every if i not in own)])
        add_cell_array(part, "vtkGhostType", np.repeat([0, 1], [len(own), count - len(own)]).astype(np.uint8))
        overlapping.append(part)
    bare, ghosted = (together(run_quietly(multiblock(*blocks), **SURFACE)) for blocks in ((first, second), overlapping))
    assert ghosted.GetNumberOfPoints() == pytest.approx(bare.GetNumberOfPoints(), rel=0.01)
    assert np.quantile(nearest_neighbors(ghosted), 0.01) > 0.6


def test_several_results_on_one_grid_have_surfaces_of_their_own(whole):
    """The blocks of an ensemble: the same cells, each time with other fields."""
    shifted = vtkUnstructuredGrid()
    shifted.DeepCopy(whole)
    add_point_array(shifted, "u", array_of(whole, "u") + 0.01)
    output = run_quietly(multiblock(whole, shifted, *halves_of(whole)), **SURFACE)
    for i, grid in enumerate((whole, shifted)):
        assert contents(output.GetBlock(i)) == contents(run_quietly(grid, **SURFACE))
    halves = output.GetBlock(2).GetNumberOfPoints() + output.GetBlock(3).GetNumberOfPoints()
    assert halves == pytest.approx(output.GetBlock(0).GetNumberOfPoints(), rel=0.01)


def test_many_cells_in_one_place_are_sorted_quickly(whole):
    """Cells of a block whose coordinates were never written."""
    heap = grid_of_cells(np.zeros((8, 3)), [(VTK_HEXAHEDRON, range(8))] * 100_000)
    add_point_array(heap, "u", np.zeros(8))
    begin = time.monotonic()
    output = run_quietly(multiblock(whole, heap), **SURFACE)
    assert time.monotonic() - begin < 2
    alone = run_quietly(whole, **SURFACE)
    assert output.GetBlock(0).GetNumberOfPoints() == pytest.approx(alone.GetNumberOfPoints(), rel=0.01)


def test_nested_and_empty_blocks_keep_their_places_and_names(whole):
    first, second = halves_of(whole)
    inner = multiblock(second, vtkUnstructuredGrid(), names=["second", "no cells"])
    outer = multiblock(None, inner, first, names=["nothing", "inner", "first"])
    output = run_quietly(outer, **SURFACE)
    assert [(i, name) for i, name, _ in leaves_of(output)] == [(i, name) for i, name, _ in leaves_of(outer)]
    nothing, _second, no_cells, _first = (leaf for _, _, leaf in leaves_of(output))
    assert nothing is None and no_cells.IsA("vtkPolyData") and no_cells.GetNumberOfPoints() == 0
    assert _second.GetNumberOfPoints() > 100 and _first.GetNumberOfPoints() > 100


def test_collections_keep_names_assembly_and_field_data(whole):
    blocks = collection(*halves_of(whole))
    for i, name in enumerate(("left", "right")):
        blocks.GetMetaData(i).Set(NAME, name)
    time = numpy_to_vtk(np.array([2.5]), deep=True)
    time.SetName("TimeValue")
    blocks.GetFieldData().AddArray(time)
    assembly = vtkDataAssembly()
    assembly.AddDataSetIndices(assembly.AddNode("walls"), [1])
    blocks.SetDataAssembly(assembly)
    output = run_quietly(blocks, **SURFACE)
    assert [output.GetMetaData(i).Get(NAME) for i in range(2)] == ["left", "right"]
    assert output.GetFieldData().GetArray("TimeValue").GetValue(0) == 2.5
    assert output.GetDataAssembly().GetDataSetIndices(output.GetDataAssembly().FindFirstNodeWithName("walls")) == (1,)


def test_blocks_have_the_arrays_that_they_bring(whole):
    first, second = halves_of(whole)
    add_point_array(first, "x", points_of(first)[:, 0])
    add_cell_array(second, "material", np.full(second.GetNumberOfCells(), 7))
    output = run_quietly(multiblock(first, second), **SURFACE)
    particles = [leaf for _, _, leaf in leaves_of(output)]
    assert [("x" in array_names(p.GetPointData())) for p in particles] == [True, False]
    assert [("material" in array_names(p.GetCellData())) for p in particles] == [False, True]
    np.testing.assert_allclose(array_of(particles[0], "x"), points_of(particles[0])[:, 0], atol=1e-12)
    assert np.all(array_of(particles[1], "material", "cell") == 7)


def test_what_takes_no_part_is_named_once(whole):
    first, second = halves_of(whole)
    second.GetPointData().RemoveArray("u")
    vectors = cells_of(whole, [0])
    add_point_array(vectors, "u", np.ones((vectors.GetNumberOfPoints(), 3)))
    image = vtkImageData()
    image.SetDimensions(2, 2, 2)
    composite = multiblock(second, first, image, vectors, names=["bare", "full", "image", "vectors"])
    output, messages = run(composite, **SURFACE)
    assert messages.errors == [] and len(messages.warnings) == 1
    for name in ("'bare'", "'image'", "'vectors'"):
        assert name in messages.warnings[0]
    assert [leaf.GetNumberOfPoints() if leaf else leaf for _, _, leaf in leaves_of(output)] == [
        0, run_quietly(multiblock(first), **SURFACE).GetBlock(0).GetNumberOfPoints(), None, 0]


def test_no_block_has_the_array(whole):
    output, messages = run(multiblock(whole, whole), "v", 0.5)
    assert len(messages.errors) == 1 and messages.warnings == []
    assert "no point array 'v'" in messages.errors[0] and "u" in messages.errors[0]
    assert all(leaf.GetNumberOfPoints() == 0 for _, _, leaf in leaves_of(output))


def test_no_grid_at_all():
    output, messages = run(multiblock(vtkPolyData(), names=["walls"]), "u", 0.5)
    assert len(messages.errors) == 1 and messages.warnings == []
    assert "no unstructured grid" in messages.errors[0] and "'walls'" in messages.errors[0]


def test_bad_cells_are_named_with_their_block(whole):
    first, second = halves_of(whole)
    values = array_of(second, "u").copy()
    values[25] = np.nan
    add_point_array(second, "u", values)
    output, messages = run(multiblock(first, second, names=["first", "second"]), **SURFACE)
    assert len(messages.warnings) == 1
    assert "'second'" in messages.warnings[0] and "first: cell 1)" in messages.warnings[0]
    assert "'first'" not in messages.warnings[0]


def test_weights_apply_to_the_block_that_has_them(data):
    """Planes in a rational Bezier pipe and in a box beside it: a wrong weight would bend them."""
    pipe = vtkUnstructuredGrid()
    pipe.DeepCopy(output_of(read(data("yeti_pipe_bezier_rational_p423.vtu"))))
    assert pipe.GetPointData().GetRationalWeights() is not None
    corners = np.array([[i, j, k] for k in (0, 1) for i, j in ((0, 0), (1, 0), (1, 1), (0, 1))]) * 2 + [5, 0, 0]
    box = grid_of_cells(corners, [(VTK_HEXAHEDRON, range(8))])
    for grid in (pipe, box):
        add_point_array(grid, "y", points_of(grid)[:, 1])
    output = run_quietly(multiblock(box, pipe, box), "y", 0.7, Spacing=0.1)
    for block in range(2):
        points = points_of(output.GetBlock(block))
        assert len(points) > 100
        np.testing.assert_allclose(points[:, 1], 0.7, atol=1e-8)
    assert output.GetBlock(2).GetNumberOfPoints() == pytest.approx(output.GetBlock(0).GetNumberOfPoints(), rel=0.05)
