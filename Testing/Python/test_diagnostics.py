"""What users are offered of the particles' arrays: few by default, all with Pass Diagnostics."""

import numpy as np
import pytest
import support
from paraview import simple
from pictures import read_png
from vtkmodules.vtkCommonCore import vtkAbstractArray
from vtkmodules.vtkCommonDataModel import vtkDataObject

RENDERERS = "__vtkValidMask__Splats"
TABLE = support.own_arrays(vtkDataObject.POINT)
REPORT = support.own_arrays(vtkDataObject.FIELD)
TECHNICAL = {
    "Clip_Normal", "Clip_Distance", "Clip_Angle", "Clip_Curvature", "Shape_Operator", "Original_Placement", "Cell_Borders",
}  # fmt: skip


@pytest.fixture
def particles(data):
    """A surface with boundary curves, of a file with two arrays."""
    grid = support.output_of(support.read(data("mfem_hex1_p8.vtu")))
    support.add_point_array(grid, "velocity", support.points_of(grid))
    return simple.HighOrderParticleIsosurface(
        Input=support.source_of(grid), ContourBy=["POINTS", "u"], Isosurfaces=[0.2], Spacing=0.06)


def colors_of(source):
    """The entries of the colour list but for solid colour."""
    display = simple.Show(source, simple.CreateView("RenderView"))
    choice = display.SMProxy.GetProperty("ColorArrayName").GetDomain("array_list")
    return [choice.GetString(i) for i in range(choice.GetNumberOfStrings())]


def test_few_colors_are_offered(particles):
    entries = colors_of(particles)
    assert {"u", "velocity", "Mean_Curvature", "Gauss_Curvature", "Isovalue"} <= set(entries)
    assert len(entries) <= 11
    assert not (TECHNICAL | set(REPORT) | {RENDERERS, "Jump"}) & set(entries)


def test_diagnostics_are_offered_where_they_are_asked_for_and_never_the_report(particles):
    particles.PassDiagnostics = 1
    entries = set(colors_of(particles))
    assert TECHNICAL | {"Jump", "ParametricCoordinates"} <= entries
    assert not entries & (set(REPORT) | {RENDERERS})
    assert set(REPORT) <= set(particles.FieldData.keys()), "scripts read it"


def test_the_text_at_the_mouse_has_few_lines(particles):
    """ParaView's tooltip has a line for every numeric point array and every field array with one value."""
    output = support.output_of(particles)
    fields = output.GetFieldData()
    of_fields = [n for n in support.array_list(fields) if fields.GetAbstractArray(n).GetNumberOfTuples() == 1]
    assert of_fields == []
    assert len(support.array_list(output.GetPointData())) <= 12


def test_the_spreadsheet_does_not_show_the_renderers_numbers(particles):
    view = simple.CreateView("SpreadSheetView")
    simple.Show(particles, view)
    simple.Render(view)
    sheet = view.GetClientSideObject()
    shown = [sheet.GetColumnName(i) for i in range(sheet.GetNumberOfColumns()) if sheet.GetColumnVisibility(i)]
    assert "Mean_Curvature" in shown
    assert not [name for name in shown if RENDERERS in name]


def picture(source, path):
    view = simple.CreateView("RenderView")
    view.ViewSize = [300, 300]
    display = simple.Show(source, view)
    display.SetRepresentationType("Surface Splats")
    simple.ResetCamera(view)
    simple.SaveScreenshot(str(path), view)
    return read_png(path)


def test_pictures_do_not_depend_on_diagnostics(particles, tmp_path):
    path = tmp_path / "picture.png"
    plain = picture(particles, path)
    particles.PassDiagnostics = 1
    assert np.array_equal(picture(particles, path), plain)
    without = simple.PassArrays(Input=particles, PointDataArrays=["Normals", "Radius", "Isovalue"])
    assert not np.array_equal(picture(without, path), plain), "planes and shapes are seen"


def reread(source, tmp_path):
    simple.SaveData(str(tmp_path / "particles.vtp"), source, **support.READABLE)
    return simple.XMLPolyDataReader(FileName=[str(tmp_path / "particles.vtp")])


def selected(source, tmp_path):
    simple.QuerySelect(QueryString="Mean_Curvature > -1e9", FieldType="POINT", Source=source)
    return simple.ExtractSelection(Input=source)


def thresholded(source, tmp_path):
    return simple.Threshold(Input=source, Scalars=["POINTS", "Radius"], LowerThreshold=0, UpperThreshold=1)


FILTERS = {
    "Threshold": thresholded,
    "ExtractSelection": selected,
    "a file": reread,
    "AppendDatasets": lambda source, _: simple.AppendDatasets(Input=[source, source]),
    "GroupDatasets": lambda source, _: simple.GroupDatasets(Input=[source]),
    "Calculator": lambda source, _: simple.Calculator(Input=source, Function="Radius", ResultArrayName="r"),
}


@pytest.mark.parametrize("name", FILTERS)
def test_filters_keep_the_renderers_numbers_and_hide_them(particles, name, tmp_path):
    before = support.array_of(support.output_of(particles), RENDERERS)
    assert np.count_nonzero(before) > 0 and before.shape[1] == sum(TABLE[n] for n in TECHNICAL)
    after = FILTERS[name](particles, tmp_path)
    output = support.output_of(after)
    block = output.GetBlock(0) if output.IsA("vtkMultiBlockDataSet") else output
    block = output.GetPartition(0, 0) if output.IsA("vtkPartitionedDataSetCollection") else block
    kept = support.array_of(block, RENDERERS)
    assert kept[: len(before)].tobytes() == before.tobytes()
    assert block.GetPointData().GetArray(RENDERERS).GetInformation().Has(vtkAbstractArray.GUI_HIDE())
    entries = colors_of(after)
    assert "Mean_Curvature" in entries and RENDERERS not in entries


def test_names_of_the_report_are_kept_free(particles):
    """An input's own Iterations would be taken for those of the run."""
    grid = support.output_of(particles.Input)
    array = support.add_cell_array(grid, "Iterations", np.arange(1))
    grid.GetFieldData().AddArray(array)
    plain = simple.HighOrderParticleIsosurface(
        Input=support.source_of(grid), ContourBy=["POINTS", "u"], Isosurfaces=[0.2], Spacing=0.1)
    messages = support.Messages(plain.GetClientSideObject())
    assert support.output_of(plain).GetFieldData().GetArray("Iterations") is None
    assert "field array 'Iterations'" in messages.warnings[0]
