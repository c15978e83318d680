"""What ParaView's other filters, files and writers make of particles, and how that is shown."""

import importlib.util
import json
import zipfile

import numpy as np
import pytest
import support
from paraview import servermanager, simple
from paraview.vtk.util.numpy_support import vtk_to_numpy
from test_surface_splats import BACKGROUND, make_view, read_png


@pytest.fixture(scope="module")
def grid(plugin, data):
    return simple.XMLUnstructuredGridReader(FileName=[data("mfem_hex1_p8.vtu")])


@pytest.fixture(scope="module")
def particles(grid):
    surface = simple.HighOrderParticleIsosurface(Input=grid, ContourBy=["POINTS", "u"], Isosurfaces=[0.2])
    surface.UpdatePipeline()
    return surface


def shown_as(source):
    view = simple.CreateView("RenderView")
    kind = simple.Show(source, view).Representation
    simple.Delete(view)
    return kind


# How particles are shown


MAKE_PARTICLES = {
    "clip": lambda p: simple.Clip(Input=p),
    "clip by a scalar": lambda p: simple.Clip(Input=p, ClipType="Scalar", Scalars=["POINTS", "Mean_Curvature"], Value=0),
    "threshold": lambda p: simple.Threshold(Input=p, Scalars=["POINTS", "Mean_Curvature"]),
    "calculator": lambda p: simple.Calculator(Input=p, Function="Mean_Curvature^2"),
    "transform": lambda p: simple.Transform(Input=p),
    "reflect": lambda p: simple.Reflect(Input=p),
    "group": lambda p: simple.GroupDatasets(Input=[p, simple.Transform(Input=p)]),
    "extract surface": lambda p: simple.ExtractSurface(Input=simple.Threshold(Input=p, Scalars=["POINTS", "Radius"])),
}


@pytest.mark.parametrize("name", MAKE_PARTICLES)
def test_particles_of_particles_are_shown_as_a_surface(particles, name):
    assert shown_as(MAKE_PARTICLES[name](particles)) == "Surface Splats"


@pytest.mark.parametrize("extension", ["vtp", "vtk", "pvtp"])
def test_particles_from_files_are_shown_as_a_surface(particles, extension, tmp_path):
    path = str(tmp_path / f"particles.{extension}")
    simple.SaveData(path, proxy=particles, **({} if extension == "vtk" else support.READABLE))
    assert shown_as(simple.OpenDataFile(path)) == "Surface Splats"


def test_blocks_of_particles_from_files_are_shown_as_a_surface(particles, tmp_path):
    path = str(tmp_path / "particles.vtm")
    simple.SaveData(path, proxy=simple.GroupDatasets(Input=[particles, simple.Transform(Input=particles)]), **support.READABLE)
    assert shown_as(simple.OpenDataFile(path)) == "Surface Splats"


MAKE_OTHERS = {
    "the grid": lambda p, grid: grid,
    "contour": lambda p, grid: simple.Contour(Input=grid, ContourBy=["POINTS", "u"], Isosurfaces=[0.2]),
    "glyphs": lambda p, grid: simple.Glyph(Input=p, GlyphType="Sphere", GlyphMode="Every Nth Point", Stride=100),
    "grid and particles": lambda p, grid: simple.GroupDatasets(Input=[grid, p]),
    "points without radius": lambda p, grid: simple.PointDatatoCellData(Input=p),
}


@pytest.mark.parametrize("name", MAKE_OTHERS)
def test_others_are_shown_as_before(particles, grid, name):
    assert shown_as(MAKE_OTHERS[name](particles, grid)) == "Surface"


def test_what_a_script_chooses_stays(particles):
    view = simple.CreateView("RenderView")
    display = simple.Show(simple.Clip(Input=particles), view, Representation="Points")
    assert display.Representation == "Points"


def test_hints_of_representations_stay(plugin):
    """ParaView asks before it draws a grid as a volume; an extension's hints replace those that say so."""
    proxy = servermanager.CreateProxy("representations", "UnstructuredGridRepresentation")
    hints = proxy.GetHints()
    assert hints.FindNestedElementByName("WarnOnRepresentationChange").GetAttribute("value") == "Volume"
    assert hints.FindNestedElementByName("InitializationHelper") is not None


# Filters that look for cells


LOOK_FOR_CELLS = {
    "Plot Over Line": lambda p, grid: simple.PlotOverLine(Input=p),
    "Probe": lambda p, grid: simple.ProbeLocation(Input=p, ProbeType="Fixed Radius Point Source"),
    "Resample To Image": lambda p, grid: simple.ResampleToImage(Input=p, SamplingDimensions=[8, 8, 8]),
    "Resample With Dataset": lambda p, grid: simple.ResampleWithDataset(SourceDataArrays=p, DestinationMesh=grid),
    "Slice": lambda p, grid: simple.Slice(Input=p),
}


@pytest.mark.parametrize("name", LOOK_FOR_CELLS)
def test_filters_that_look_for_cells_say_why_nothing_comes(particles, grid, name, capfd):
    shown_as(LOOK_FOR_CELLS[name](particles, grid))
    said = "".join(capfd.readouterr())
    assert said.count("found nothing in particles") == 1, said
    shown_as(LOOK_FOR_CELLS[name](grid, grid))
    assert "found nothing" not in "".join(capfd.readouterr())


LEAVE_NONE = {
    "Extract Selection": lambda p: simple.ExtractSelection(Input=p, Selection=simple.IDSelectionSource(IDs=[])),
    "Threshold": lambda p: simple.Threshold(Input=p, Scalars=["POINTS", "Radius"], LowerThreshold=5, UpperThreshold=6),
    "Gradient": lambda p: simple.Gradient(Input=p, ScalarArray=["POINTS", "not there"]),
}


@pytest.mark.parametrize("name", LEAVE_NONE)
def test_filters_that_leave_no_particles_are_not_told_to_look_for_cells(particles, name, capfd):
    shown_as(LEAVE_NONE[name](particles))
    said = "".join(capfd.readouterr())
    assert said.count(f"{name} left none of the particles") == 1 and "found nothing" not in said, said


# How moved particles look


def picture_of(source, path, place, up):
    """The picture of white particles from a place, looking at the origin."""
    view = make_view()
    view.CameraPosition, view.CameraViewUp = place, up
    display = simple.Show(source, view)
    display.ColorArrayName = [None, ""]
    simple.SaveScreenshot(str(path), view, ImageResolution=view.ViewSize)
    simple.Delete(view)
    return read_png(path)


@pytest.mark.parametrize("all_vectors", [0, 1])
def test_rotated_particles_look_as_unrotated_ones(particles, all_vectors, tmp_path):
    turned = simple.Transform(Input=particles, TransformAllInputVectors=all_vectors)
    turned.Transform.Rotate = [90.0, 0.0, 0.0]  # y to z, z to -y
    before = picture_of(particles, tmp_path / "before.png", [0, -4, 0], [0, 0, 1])
    after = picture_of(turned, tmp_path / "after.png", [0, 0, -4], [0, -1, 0])
    covered = np.any(before != BACKGROUND, axis=2)
    assert covered.mean() > 0.1
    differs = np.abs(before - after).max(axis=2) > 8
    assert differs[covered].mean() < 0.005


def psnr(a, b):
    return 10 * np.log10(255**2 / np.mean((a - b) ** 2.0))


def test_rotated_particles_look_as_those_of_the_rotated_grid(grid, tmp_path):
    """They differ no more than two random distributions of the same surface do."""

    def turned(source):
        moved = simple.Transform(Input=source)
        moved.Transform.Rotate = [21.0, 37.0, -13.0]
        return moved

    def particles_of(source, seed=1):
        surface = simple.HighOrderParticleIsosurface(Input=source, ContourBy=["POINTS", "u"], Isosurfaces=[0.2])
        surface.Spacing, surface.Seed = 0.03, seed
        return surface

    def picture(source, name):
        return picture_of(source, tmp_path / f"{name}.png", [1, -4, 2], [0, 0, 1])

    fresh = picture(particles_of(turned(grid)), "fresh")
    assert np.any(fresh != BACKGROUND, axis=2).mean() > 0.1
    least = psnr(fresh, picture(particles_of(turned(grid), seed=2), "another"))
    found = psnr(fresh, picture(turned(particles_of(grid)), "turned"))
    print(f"PSNR {found:.1f} dB, of two seeds {least:.1f} dB")
    assert found > 30.0
    assert found > least - 1.0


def test_scaled_particles_leave_no_holes(particles, tmp_path):
    scaled = simple.Transform(Input=particles)
    scaled.Transform.Scale = [0.5, 0.5, 0.5]
    larger = simple.Transform(Input=scaled)
    larger.Transform.Scale = [2.0, 2.0, 2.0]
    stretched = simple.Transform(Input=particles)
    stretched.Transform.Scale = [2.0, 1.0, 1.0]
    before = picture_of(particles, tmp_path / "before.png", [0, -4, 0], [0, 0, 1])
    after = picture_of(larger, tmp_path / "after.png", [0, -4, 0], [0, 0, 1])
    assert (np.abs(before - after).max(axis=2) > 8).mean() < 0.001
    wide = picture_of(stretched, tmp_path / "wide.png", [0, -4, 0], [0, 0, 1])
    covered, expected = np.any(wide != BACKGROUND, axis=2), np.any(before != BACKGROUND, axis=2)
    columns = ((np.arange(expected.shape[1]) + 0.5 - 150) / 2 + 150).astype(int)
    assert (covered != expected[:, columns]).mean() < 0.01


# Files


def test_ply_files_have_normals(particles, tmp_path, capfd):
    path = tmp_path / "particles.ply"
    simple.SaveData(str(path), proxy=particles)
    assert "WARN" not in "".join(capfd.readouterr())
    head = path.read_bytes().split(b"end_header")[0]
    assert b"property float nx" in head


def said_once(capfd, words):
    said = "".join(capfd.readouterr())
    assert "Traceback" not in said, said
    return said.count(words) == 1 and said.count("WARN") == 1


def test_stl_files_say_that_they_will_be_empty(particles, grid, tmp_path, capfd):
    simple.SaveData(str(tmp_path / "particles.stl"), proxy=particles)
    assert said_once(capfd, "holds triangles")
    triangles = simple.Contour(Input=grid, ContourBy=["POINTS", "u"], Isosurfaces=[0.2])
    simple.SaveData(str(tmp_path / "triangles.stl"), proxy=triangles)
    assert "WARN" not in "".join(capfd.readouterr())
    assert (tmp_path / "triangles.stl").stat().st_size > 1000


# Some packages of ParaView lack the Python that ends an export for VTK.js.
EXPORTED = ["gltf", "x3d", "vrml", *(["vtkjs"] if importlib.util.find_spec("paraview.web") else [])]


@pytest.mark.parametrize("representation", ["Surface Splats", "Surface Splats With Edges"])
@pytest.mark.parametrize("extension", EXPORTED)
def test_exported_scenes_say_that_they_have_points(grid, extension, representation, tmp_path, capfd):
    view = simple.CreateView("RenderView")
    surface = simple.HighOrderParticleIsosurface(
        registrationName="surface", Input=grid, ContourBy=["POINTS", "u"], Isosurfaces=[0.2])
    simple.Show(surface, view).SetRepresentationType(representation)
    path = tmp_path / f"scene.{extension}"
    simple.ExportView(str(path), view=view)
    assert said_once(capfd, "particles of Surface Splats as points")
    assert path.is_file() and path.stat().st_size > 1000
    if extension == "vtkjs":
        scene = json.loads(zipfile.ZipFile(path).read("index.json"))["scene"]
        assert scene[0]["name"] == "surface"


def test_scenes_of_triangles_say_that_they_leave_particles_out(particles, tmp_path, capfd):
    view = simple.CreateView("RenderView")
    simple.Show(particles, view)
    simple.ExportView(str(tmp_path / "scene.pov"), view=view)
    assert said_once(capfd, "leaves out the particles of Surface Splats")


def test_exported_scenes_without_splats_say_nothing(particles, grid, tmp_path, capfd):
    view = simple.CreateView("RenderView")
    simple.Show(grid, view)
    simple.Show(particles, view)
    simple.Hide(particles, view)
    for extension in EXPORTED:
        simple.ExportView(str(tmp_path / f"scene.{extension}"), view=view)
    assert "WARN" not in "".join(capfd.readouterr())
