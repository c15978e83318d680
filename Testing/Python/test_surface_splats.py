"""Particles in ParaView's render view as 'Surface Splats': chosen, coloured, selected, drawn by ranks."""

import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest
from paraview import servermanager, simple
from paraview.vtk.util.numpy_support import vtk_to_numpy
from support import environment_of_ranks
from vtkmodules.vtkIOImage import vtkPNGReader
from vtkmodules.vtkRenderingCore import vtkWindowToImageFilter

SIZE = 300
BACKGROUND = (0, 255, 0)  # a colour that no lit surface of these tests has


def particles(center=(0.0, 0.0, 0.0)):
    """A sphere of radius 0.5 as particles close enough to leave no hole: points, normals, radii."""
    sphere = simple.Sphere(Center=center, ThetaResolution=60, PhiResolution=60)
    return simple.Calculator(Input=sphere, Function="0.035", ResultArrayName="Radius")


def make_view():
    simple._DisableFirstRenderCameraReset()  # else the first test of a run has another camera
    return as_new(simple.CreateView("RenderView"))


def as_new(view):
    view.ViewSize = [SIZE, SIZE]
    view.OrientationAxesVisibility = 0
    view.UseColorPaletteForBackground = 0
    view.Background = [c / 255 for c in BACKGROUND]
    view.CameraPosition = [0, -4, 0]
    view.CameraViewUp = [0, 0, 1]
    view.CameraFocalPoint = [0, 0, 0]
    view.CameraParallelProjection = 1
    view.CameraParallelScale = 1.0
    simple.SetActiveView(view)
    return view


@pytest.fixture(autouse=True)
def fresh_session():
    """As conftest's, in a tenth of its time: what these tests make is known."""
    yield
    for source in simple.GetSources().values():
        simple.Delete(source)
    simple.SetActiveSource(None)
    manager = servermanager.ProxyManager()
    for group in ("scalar_bars", "lookup_tables", "piecewise_functions"):
        for (name, _), proxy in manager.GetProxiesInGroup(group).items():
            manager.UnRegisterProxy(group, name, proxy.SMProxy)


@pytest.fixture(scope="module")
def window():
    """One view for all tests, as each window compiles its shaders anew."""
    yield make_view()
    simple.ResetSession()


@pytest.fixture
def view(window):
    return as_new(window)


def show(source, view):
    display = simple.Show(source, view)
    display.ColorArrayName = ["POINTS", ""]
    display.SetRepresentationType("Surface Splats")
    return display


def read_png(path):
    reader = vtkPNGReader()
    reader.SetFileName(str(path))
    reader.Update()
    image = reader.GetOutput()
    width, height, _ = image.GetDimensions()
    return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, -1)[:, :, :3].astype(int)


@pytest.fixture
def picture(view, tmp_path):
    """picture(): the view's pixels, bottom row first, (height, width, RGB)."""

    def shoot():
        path = tmp_path / "picture.png"
        simple.SaveScreenshot(str(path), view, ImageResolution=[SIZE, SIZE])
        return read_png(path)

    return shoot


def drawn(pixels):
    return np.any(pixels != BACKGROUND, axis=2)


def disk_of_sphere(x=0.0, radius=0.5):
    """Which pixels a sphere at (x, 0, 0) covers."""
    across = (np.arange(SIZE) + 0.5) / (SIZE / 2) - 1
    return (across[None, :] - x) ** 2 + across[:, None] ** 2 < radius**2


def test_a_sphere_of_particles_covers_the_sphere(view, picture):
    show(particles(), view)
    covered = drawn(picture())
    assert np.all(covered[disk_of_sphere(radius=0.49)])
    assert not np.any(covered[~disk_of_sphere(radius=0.52)])


def test_own_properties_reach_the_drawing(view, picture):
    display = show(particles(), view)
    assert (display.RadiusArray, display.RadiusScale, display.DefaultRadius) == ("Radius", 1.0, 0.0)
    assert display.ColorByNormalDirection == 0
    full = drawn(picture()).sum()
    display.RadiusScale = 0.1
    assert 0 < drawn(picture()).sum() < 0.6 * full


def vertices(source):
    """The same particles with one vertex cell each."""
    mask = simple.MaskPoints(Input=source, OnRatio=1, GenerateVertices=1, SingleVertexPerCell=1)
    mask.MaximumNumberofPoints = 100000
    return mask


def test_no_other_array_is_taken_for_the_radius(view):
    display = show(simple.Elevation(Input=simple.Sphere()), view)
    assert display.RadiusArray == "Radius"


@pytest.mark.parametrize("association", ["POINTS", "CELLS"])
def test_color_by_array_follows_the_lookup_table(view, picture, association):
    source = simple.Calculator(Input=vertices(particles()), Function="coordsX", ResultArrayName="x")
    if association == "CELLS":
        source = simple.PointDatatoCellData(Input=source, PassPointData=1)
    display = show(source, view)
    simple.ColorBy(display, (association, "x"))
    table = simple.GetColorTransferFunction("x")
    table.RGBPoints = [-0.5, 1, 0, 0, -1e-6, 1, 0, 0, 1e-6, 0, 0, 1, 0.5, 0, 0, 1]
    table.ColorSpace = "RGB"
    display.SetScalarBarVisibility(view, True)
    bar = simple.GetScalarBar(table, view)
    assert bar.Title == "x" and bar.Visibility == 1
    bar.Visibility = 0
    pixels = picture()
    left = pixels[SIZE // 2, int(0.35 * SIZE)]
    right = pixels[SIZE // 2, int(0.65 * SIZE)]
    assert left[0] > 100 and left[2] < 0.1 * left[0]
    assert right[2] > 100 and right[0] < 0.1 * right[2]


@pytest.mark.parametrize("flip, channel", [(False, 2), (True, 0)], ids=["outward-blue", "inward-red"])
def test_color_by_the_direction_of_the_normal(view, picture, flip, channel):
    source = particles()
    if flip:
        source = simple.ProgrammableFilter(Input=source)
        source.Script = (
            "output.ShallowCopy(inputs[0].VTKObject)\n"
            "output.PointData.append(-inputs[0].PointData['Normals'], 'Normals')\n"
            "output.VTKObject.GetPointData().SetActiveNormals('Normals')\n"
        )
    show(source, view).ColorByNormalDirection = 1
    pixels = picture()[disk_of_sphere(radius=0.4)]
    assert np.all(np.argmax(pixels, axis=1) == channel)


def test_one_side_can_be_culled(view, picture):
    display = show(particles(), view)
    display.ColorByNormalDirection = 1
    display.BackfaceRepresentation = "Cull Frontface"
    pixels = picture()[disk_of_sphere(radius=0.4)]
    assert np.all(np.argmax(pixels, axis=1) == 0), "the far side from within, red"


@pytest.fixture
def nested():
    """Half a sphere that shows its inside to the camera, and a smaller sphere behind it that shows its outside."""
    half = simple.Sphere(Center=(0, -0.5, 0), EndTheta=180, ThetaResolution=60, PhiResolution=60)
    whole = simple.Sphere(Center=(0, 1, 0), Radius=0.4, ThetaResolution=60, PhiResolution=60)
    both = simple.AppendGeometry(Input=[half, whole])
    radii = simple.Calculator(Input=both, Function="0.035", ResultArrayName="Radius")
    return simple.GroupDatasets(Input=[radii])


STYLE = {"BackfaceRepresentation": "Surface"}


@pytest.mark.parametrize("settings, color", [
    ({}, (255, 255, 0)),
    (STYLE, (0, 0, 255)),
    ({**STYLE, "BackfaceOpacity": 0.4}, (153, 153, 102)),
    ({**STYLE, "Opacity": 0.4}, (0, 0, 255)),
    ({**STYLE, "BlockColors": ["/", "1", "0", "1"]}, (0, 0, 255)),
    ({**STYLE, "BlockOpacities": ["/", "0.5"]}, (0, 0, 255)),
    ({**STYLE, "BackfaceOpacity": 0.4, "BlockColors": ["/", "1", "0", "1"]}, (153, 0, 255)),
    ({**STYLE, "Ambient": 0.0, "Diffuse": 0.8}, None),
    ({**STYLE, "Ambient": 0.2, "Specular": 0.5, "SpecularPower": 10.0}, None),
], ids=str)
def test_the_inward_side_looks_as_back_faces_of_polygons_do(view, picture, nested, settings, color):
    compare_with_polygons(nested, view, picture, settings, color, array="")


@pytest.mark.parametrize("settings, color", [
    (STYLE, (255, 0, 0)),
    ({**STYLE, "BackfaceOpacity": 0.4}, (102, 0, 153)),
    ({**STYLE, "BackfaceOpacity": 0.0}, (0, 0, 255)),
], ids=str)
def test_both_sides_have_the_colours_of_an_array(view, picture, nested, settings, color):
    """Red on the half sphere, blue behind it."""
    distance = simple.Calculator(Input=nested, Function="coordsY", ResultArrayName="distance")
    table = simple.GetColorTransferFunction("distance")
    table.RGBPoints = [-0.5, 1, 0, 0, 0.2, 1, 0, 0, 0.3, 0, 0, 1, 1, 0, 0, 1]
    table.ColorSpace = "RGB"
    compare_with_polygons(distance, view, picture, settings, color, array="distance")


@pytest.mark.parametrize("name", ["Points", "Wireframe", "Surface", "Surface With Edges"])
def test_any_representation_of_back_faces_means_the_surface(view, picture, nested, name):
    display = show(nested, view)
    display.Ambient, display.Diffuse = 1.0, 0.0
    display.BackfaceAmbientColor = [0, 0, 1]
    display.BackfaceRepresentation = name
    assert tuple(picture()[SIZE // 2, SIZE // 2]) == (0, 0, 255)
    display.BackfaceRepresentation = "Follow Frontface"
    display.AmbientColor = [1, 0, 0]
    assert tuple(picture()[SIZE // 2, SIZE // 2]) == (255, 0, 0)


def compare_with_polygons(source, view, picture, settings, color, array):
    """Both show `color` in the middle or, if it is not given, the same colour."""
    seen = []
    for representation in ("Surface", "Surface Splats"):
        display = show(source, view)
        display.SetRepresentationType(representation)
        display.ColorArrayName = ["POINTS", array]
        if array:
            display.LookupTable = simple.GetColorTransferFunction(array)
        display.Ambient, display.Diffuse = 1.0, 0.0
        display.AmbientColor = display.DiffuseColor = [1, 1, 0]
        display.BackfaceAmbientColor = display.BackfaceDiffuseColor = [0, 0, 1]
        for name, value in settings.items():
            setattr(display, name, value)
        seen.append(picture()[SIZE // 2, SIZE // 2])
    polygons, splats = seen
    assert np.abs(splats - polygons).max() <= 3, f"polygons {polygons}, splats {splats}"
    if color:
        assert np.abs(splats - color).max() <= 2, f"splats {splats}"


@pytest.fixture(params=["vtkMultiBlockDataSet", "vtkPartitionedDataSetCollection"])
def two_blocks(request):
    """Two spheres side by side, and the selectors of the left and the right one."""
    group = simple.GroupDatasets(Input=[particles((-0.5, 0, 0)), particles((0.5, 0, 0))])
    group.OutputType = request.param
    group.UpdatePipeline()
    hierarchy = group.GetDataInformation().GetHierarchy()
    return group, [f"/Root/{hierarchy.GetNodeName(i)}" for i in (1, 2)]


def test_blocks_of_a_composite_are_drawn(view, picture):
    group = simple.GroupDatasets(Input=[particles((-0.5, 0, 0)), particles((0.5, 0, 0))])
    display = show(group, view)
    covered = drawn(picture())
    offered = display.GetRepresentedDataInformation().GetPointDataInformation()
    names = {offered.GetArrayInformation(i).GetName() for i in range(offered.GetNumberOfArrays())}
    assert names == {"Normals", "Radius"}, "arrays to colour by"
    assert np.all(covered[disk_of_sphere(-0.5, 0.49) | disk_of_sphere(0.5, 0.49)])
    assert not np.any(covered[~(disk_of_sphere(-0.5, 0.52) | disk_of_sphere(0.5, 0.52))])


def test_blocks_can_be_hidden(view, picture, two_blocks):
    group, (_, right) = two_blocks
    display = show(group, view)
    display.BlockSelectors = [right]
    covered = drawn(picture())
    assert np.all(covered[disk_of_sphere(0.5, 0.49)])
    assert not np.any(covered[:, : SIZE // 2 - 5])
    display.BlockSelectors = ["/"]
    assert np.all(drawn(picture())[disk_of_sphere(-0.5, 0.49) | disk_of_sphere(0.5, 0.49)])


def test_blocks_have_colours_of_their_own(view, picture, two_blocks):
    group, (left, right) = two_blocks
    display = show(group, view)
    display.Ambient, display.Diffuse = 1.0, 0.0
    display.DiffuseColor = display.AmbientColor = [1, 1, 1]
    display.BlockColors = [left, "1", "0", "0"]
    pixels = picture()
    assert np.all(pixels[disk_of_sphere(-0.5, 0.4)] == (255, 0, 0))
    assert np.all(pixels[disk_of_sphere(0.5, 0.4)] == (255, 255, 255))
    display.BlockColors = [left, "1", "0", "0", right, "0", "0", "1"]
    assert np.all(picture()[disk_of_sphere(0.5, 0.4)] == (0, 0, 255))
    display.BlockColors = []
    assert np.all(picture()[disk_of_sphere(-0.5, 0.4)] == (255, 255, 255))
    display.BlockColors = ["/Root", "0", "0", "1"]
    assert np.all(picture()[disk_of_sphere(-0.5, 0.4) | disk_of_sphere(0.5, 0.4)] == (0, 0, 255))


def test_blocks_have_opacities_of_their_own(view, picture, two_blocks):
    group, (left, right) = two_blocks
    display = show(group, view)
    display.Ambient, display.Diffuse = 1.0, 0.0
    display.DiffuseColor = display.AmbientColor = [1, 0, 0]
    display.BlockOpacities = [right, "0.4"]
    pixels = picture()
    assert np.all(pixels[disk_of_sphere(-0.5, 0.4)] == (255, 0, 0))
    # Two layers of 0.4 over the background leave 0.36 of it.
    assert np.all(np.abs(pixels[disk_of_sphere(0.5, 0.4)] - (163, 92, 0)) < 5)
    display.BlockOpacities = []
    assert np.all(picture()[disk_of_sphere(0.5, 0.4)] == (255, 0, 0))


# Four spheres as three blocks and an empty one: two of them are pieces of one data set.
TREES = {
    "vtkMultiblockDataSet": """
from vtkmodules.vtkCommonDataModel import vtkMultiPieceDataSet
a, b, c, d = [sphere.VTKObject for sphere in inputs]
pieces = vtkMultiPieceDataSet()
pieces.SetPiece(0, b)
pieces.SetPiece(1, c)
for i, block in enumerate([None, a, pieces, d]):
    output.SetBlock(i, block)
""",
    "vtkPartitionedDataSetCollection": """
a, b, c, d = [sphere.VTKObject for sphere in inputs]
for i, pieces in enumerate([[], [a], [b, c], [d]]):
    for j, piece in enumerate(pieces):
        output.SetPartition(i, j, piece)
""",
}


@pytest.mark.parametrize("distinct", [2, 7])
@pytest.mark.parametrize("tree", TREES)
def test_blocks_have_the_colours_of_their_numbers(view, picture, tree, distinct):
    """Colours by vtkBlockColors, as triangles of the same blocks have them."""
    places = [(x, 0, z) for z in (-0.5, 0.5) for x in (-0.5, 0.5)]
    blocks = simple.ProgrammableFilter(Input=[particles(place) for place in places], OutputDataSetType=tree)
    blocks.Script = TREES[tree]
    view.Background = [0.5, 0.5, 0.5]  # no block has that colour
    display = simple.Show(blocks, view)
    display.Ambient, display.Diffuse = 1.0, 0.0
    display.BlockColorsDistinctValues = distinct
    simple.ColorBy(display, ("FIELD", "vtkBlockColors"))
    colors = {}
    for representation in "Surface", "Surface Splats":
        display.SetRepresentationType(representation)
        pixels = picture()
        colors[representation] = [tuple(pixels[int((1 + z) * SIZE / 2), int((1 + x) * SIZE / 2)]) for x, _, z in places]
    assert colors["Surface Splats"] == colors["Surface"]
    assert len(set(colors["Surface"])) == min(distinct, 3)


@pytest.mark.parametrize("mode, share", [("Splats", 1.0), ("Disks", 1.0), ("Points", 0.5)])
def test_modes(view, picture, mode, share):
    display = show(particles(), view)
    assert display.Mode == "Splats"
    display.Mode = mode
    covered = drawn(picture())[disk_of_sphere(radius=0.48)].mean()
    assert covered == 1.0 if share == 1.0 else 0.01 < covered < share


def test_points_have_the_size_of_paraviews_points(view, picture):
    display = show(particles(), view)
    display.Mode = "Points"
    shares = []
    for display.PointSize in (1.0, 4.0):
        shares.append(drawn(picture())[disk_of_sphere(radius=0.48)].mean())
    assert shares[1] > 4.0 * shares[0] > 0.0


def test_level_of_detail_shows_the_surface(view):
    sphere = simple.Sphere(ThetaResolution=400, PhiResolution=400)
    source = simple.Calculator(Input=sphere, Function="0.01", ResultArrayName="Radius")
    show(source, view)
    view.LODThreshold = 0.0
    simple.Render(view)
    view.SMProxy.InteractiveRender()
    window = view.GetRenderWindow()
    grabber = vtkWindowToImageFilter()
    grabber.SetInput(window)
    grabber.ShouldRerenderOff()
    grabber.ReadFrontBufferOff()
    grabber.Update()
    image = grabber.GetOutput()
    width, height, _ = image.GetDimensions()
    pixels = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, -1)[:, :, :3].astype(int)
    assert np.all(drawn(pixels)[disk_of_sphere(radius=0.48)])


def test_thresholded_particles_are_still_particles(view, picture):
    height = simple.Calculator(Input=vertices(particles()), Function="coordsX", ResultArrayName="x")
    half = simple.Threshold(Input=height, Scalars=["POINTS", "x"], LowerThreshold=0.0, UpperThreshold=1.0)
    show(half, view)
    covered = drawn(picture())
    right = np.arange(SIZE)[None, :] > 0.52 * SIZE
    left = np.arange(SIZE)[None, :] < 0.48 * SIZE
    assert np.all(covered[disk_of_sphere(radius=0.48) & right])
    assert not np.any(covered & left)


@pytest.mark.parametrize("script", ["", "output.VTKObject.GetPoints().Reset()"], ids=["no-arrays", "no-points"])
def test_input_that_lacks_something_is_no_crash(view, picture, script):
    points = simple.ProgrammableFilter(Input=simple.PointSource(NumberOfPoints=50, Radius=0.3))
    points.CopyArrays = 0
    points.Script = "output.DeepCopy(inputs[0].VTKObject)\n" + script
    show(points, view)
    assert np.any(drawn(picture())) == (script == "")


def select(source, view, x, y, how=simple.SelectSurfacePoints):
    """What a click at a pixel selects of a source."""
    how(Rectangle=[x, y, x, y], View=view)
    selected = simple.ExtractSelection(Input=source)
    selected.Selection = source.GetSelectionInput(source.Port)
    selected.UpdatePipeline()
    return servermanager.Fetch(selected)


def test_selection_finds_the_particle_under_the_cursor(view):
    source = particles()
    show(source, view)
    simple.Render(view)
    found = select(source, view, SIZE // 2, SIZE // 2)
    assert found.GetNumberOfPoints() == 1
    assert np.linalg.norm(np.array(found.GetPoint(0)) - [0, -0.5, 0]) < 0.04


def test_selection_finds_the_block_of_a_composite(view):
    group = simple.GroupDatasets(Input=[particles((-0.5, 0, 0)), particles((0.5, 0, 0))])
    show(group, view)
    simple.Render(view)
    found = select(group, view, int(0.75 * SIZE), SIZE // 2)
    points = [found.GetBlock(block).GetNumberOfPoints() for block in range(2) if found.GetBlock(block)]
    assert sum(points) == 1 and found.GetBlock(1).GetNumberOfPoints() == 1
    assert np.linalg.norm(np.array(found.GetBlock(1).GetPoint(0)) - [0.5, -0.5, 0]) < 0.04


def triangles():
    return particles()


def a_block_of_triangles():
    return simple.GroupDatasets(Input=[particles()])


def vertices_after_other_cells():
    """The particles as an unstructured grid whose first cells are something else, which is not drawn."""
    grid = simple.ProgrammableFilter(Input=vertices(particles()), OutputDataSetType="vtkUnstructuredGrid")
    grid.Script = """
from vtkmodules.vtkCommonDataModel import VTK_TETRA, VTK_VERTEX
particles = inputs[0].VTKObject
output.ShallowCopy(inputs[0].VTKObject)
output.Allocate()
for _ in range(500):
    output.InsertNextCell(VTK_TETRA, 4, [0, 1, 2, 3])
for cell in range(particles.GetNumberOfCells()):
    output.InsertNextCell(VTK_VERTEX, 1, [particles.GetCell(cell).GetPointId(0)])
"""
    return grid


@pytest.mark.parametrize("make", [triangles, a_block_of_triangles, vertices_after_other_cells])
def test_a_selected_cell_is_one_under_the_cursor(view, make):
    source = make()
    show(source, view)
    simple.Render(view)
    found = select(source, view, SIZE // 2, SIZE // 2, simple.SelectSurfaceCells)
    found = found.GetBlock(0) if found.IsA("vtkMultiBlockDataSet") else found
    assert found.GetNumberOfCells() == 1
    distances = np.linalg.norm(vtk_to_numpy(found.GetPoints().GetData()) - [0, -0.5, 0], axis=1)
    assert distances.max() < 0.08


RANKS = """
import sys
from paraview import simple
sys.path.insert(0, {folder!r})
import test_surface_splats as here
simple.LoadPlugin({plugin!r}, remote=False, ns=vars(simple))
view = here.make_view()
display = here.show(here.particles(), view)
for opacity, path in {paths!r}.items():
    display.Opacity = opacity
    simple.SaveScreenshot(path, view, ImageResolution=[here.SIZE, here.SIZE])
"""


def test_two_ranks_draw_their_halves(plugin, tmp_path):
    if not (shutil.which("mpirun") and shutil.which("pvbatch")):
        pytest.skip("no mpirun or no pvbatch")
    script = tmp_path / "ranks.py"
    paths = {opacity: str(tmp_path / f"opacity_{opacity}.png") for opacity in (1.0, 0.5)}
    script.write_text(RANKS.format(folder=str(Path(__file__).parent), plugin=str(plugin), paths=paths))
    command = ["mpirun", "-np", "2", "--oversubscribe", "pvbatch", "--sym", str(script)]
    run = subprocess.run(command, env=environment_of_ranks(), capture_output=True, text=True, timeout=120)
    assert run.returncode == 0, run.stdout + run.stderr
    for path in paths.values():
        covered = drawn(read_png(path))
        assert np.all(covered[disk_of_sphere(radius=0.49)])
        assert not np.any(covered[~disk_of_sphere(radius=0.52)])


# Cells


def reddish(pixels):
    return np.count_nonzero((pixels[:, :, 0] > 200) & (pixels[:, :, 1] < 60) & (pixels[:, :, 2] < 60))


@pytest.mark.parametrize("blocks", [1, 2])
@pytest.mark.parametrize("opacity", [1.0, 0.5])
def test_edges_of_cells_are_drawn_in_their_own_colour(view, picture, data, blocks, opacity):
    reader = simple.XMLUnstructuredGridReader(FileName=[data("mfem_amr_hanging_hex_p3.vtu")])
    grid = simple.GroupDatasets(Input=[reader] * blocks) if blocks > 1 else reader
    particles = simple.HighOrderParticleIsosurface(Input=grid, ContourBy=["POINTS", "u"], Isosurfaces=[0.0])
    particles.Spacing = 0.06
    display = show(particles, view)
    view.ResetCamera()
    display.Ambient, display.Diffuse, display.Opacity = 1.0, 0.0, opacity
    display.AmbientColor = display.DiffuseColor = [0, 0.5, 0]
    display.EdgeColor, display.LineWidth = [1, 0, 0], 2.0
    plain = picture()
    display.Representation = "Surface Splats With Edges"
    edged = picture()
    assert np.count_nonzero(drawn(plain) != drawn(edged)) < 0.01 * np.count_nonzero(drawn(plain)), "on the surface"
    changed = np.any(plain != edged, axis=2)
    assert 0.02 * np.count_nonzero(drawn(plain)) < np.count_nonzero(changed) < 0.5 * np.count_nonzero(drawn(plain))
    if opacity == 1.0:
        assert reddish(plain) == 0 and reddish(edged) > 100
        display.LineWidth = 6.0
        assert reddish(picture()) > 2 * reddish(edged)
    display.Representation = "Surface Splats"
    assert np.array_equal(plain, picture())


def test_cell_ids_are_listed_and_end_where_cells_end(view, picture, data):
    reader = simple.XMLUnstructuredGridReader(FileName=[data("mfem_amr_hanging_hex_p3.vtu")])
    particles = simple.HighOrderParticleIsosurface(Input=reader, ContourBy=["POINTS", "u"], Isosurfaces=[0.0])
    particles.Spacing = 0.06
    display = show(particles, view)
    view.ResetCamera()
    assert "Cell_Id" in [array.Name for array in particles.PointData]
    simple.ColorBy(display, ("POINTS", "Cell_Id"))
    display.Ambient, display.Diffuse = 1.0, 0.0
    seen = picture()
    colors, counts = np.unique(seen[drawn(seen)], axis=0, return_counts=True)
    # Few pixels are not of one cell's colour, of which there are some dozens.
    assert np.sort(counts)[-60:].sum() > 0.8 * counts.sum()
