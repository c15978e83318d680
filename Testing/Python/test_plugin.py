"""The plugin as ParaView sees it: its name, its proxies, their labels, menu and defaults."""

import re
from pathlib import Path

import cells
import numpy as np
import pytest
from paraview import servermanager, simple
from paraview.vtk.util.numpy_support import numpy_to_vtk
from support import (
    READABLE,
    add_point_array,
    array_of,
    contents,
    grid_of_cells,
    output_of,
    points_of,
    read,
    reported,
    source_of,
)
from vtkmodules.vtkCommonDataModel import VTK_HEXAHEDRON

NAME = "HighOrderParticleIsosurface"
PROXIES = [("filters", NAME), ("representations", "SurfaceSplatRepresentation")]
BOOKKEEPING = ("Modified Time", "Reference Count", "Executive", "Information")


def proxy_manager():
    return servermanager.vtkSMProxyManager.GetProxyManager().GetActiveSessionProxyManager()


def new_proxy(group, name):
    proxy = proxy_manager().NewProxy(group, name)
    assert proxy is not None, f"no proxy {name} in group {group}"
    return proxy


def bare_object(class_name):
    """An object of the class, untouched: made by a proxy without properties."""
    proxy_manager().LoadConfigurationXML(
        f"""<ServerManagerConfiguration><ProxyGroup name="bare">
              <Proxy name="{class_name}" class="{class_name}"/>
            </ProxyGroup></ServerManagerConfiguration>""")
    return new_proxy("bare", class_name).GetClientSideObject()


def state(vtk_object):
    """What PrintSelf says of the object's settings, pointers and counters left out: {name: text}."""
    lines = re.findall(r"^  ?(\w[\w ]*): (.*)$", str(vtk_object), re.MULTILINE)
    return {name: value for name, value in lines if name not in BOOKKEEPING}


def test_plugin_is_loaded_under_its_name(plugin):
    manager = servermanager.vtkSMProxyManager.GetProxyManager().GetPluginManager()
    known = manager.GetLocalInformation()
    loaded = [known.GetPluginName(i) for i in range(known.GetNumberOfPlugins()) if known.GetPluginLoaded(i)]
    assert NAME in loaded
    assert plugin.name == NAME + ".so"


def test_the_plugin_is_described_once():
    """ParaView builds the folder of the file that describes the plugin; the file itself is the one at the top."""
    project = Path(__file__).resolve().parents[2]
    description = project / "paraview.plugin"
    assert (project / "Plugin/paraview.plugin").resolve() == description
    version = re.search(r"project\(\w+ VERSION ([\d.]+)", (project / "CMakeLists.txt").read_text())[1]
    known = servermanager.vtkSMProxyManager.GetProxyManager().GetPluginManager().GetLocalInformation()
    i = next(i for i in range(known.GetNumberOfPlugins()) if known.GetPluginName(i) == NAME)
    # ParaView 6.1 knows the versions of the plugins in its own list alone.
    assert known.GetPluginVersion(i) in ((version, "") if simple.GetParaViewVersion() >= 6 else (version,))
    assert re.sub(r"\s+", " ", known.GetDescription(i)).strip() in re.sub(r"\s+", " ", description.read_text())


def test_filter_has_its_label_and_its_place_in_the_filters_menu():
    proxy = new_proxy("filters", NAME)
    assert proxy.GetXMLLabel() == "High-Order Particle Isosurface"
    hints = proxy.GetHints()
    assert hints is not None and hints.FindNestedElementByName("ShowInMenu") is not None
    assert callable(getattr(simple, NAME))


def test_the_search_for_contour_finds_the_filter():
    """The quick launch searches labels; from 5.13 on also the short help."""
    assert "contour" in new_proxy("filters", NAME).GetDocumentation().GetShortHelp().lower()
    other = new_proxy("filters", "ContourHighOrderCells")
    assert other.GetXMLLabel() == "Contour High-Order Cells"
    assert other.GetHints().FindNestedElementByName("ShowInMenu") is not None


def test_the_other_name_is_the_same_filter(data):
    reader = simple.XMLUnstructuredGridReader(FileName=[data("mfem_hex1_p8.vtu")])
    reader.UpdatePipeline()
    first, second = simple.HighOrderParticleIsosurface(Input=reader), simple.ContourHighOrderCells(Input=reader)
    assert second.ListProperties() == first.ListProperties()
    for name in set(first.ListProperties()) - {"Input"}:
        assert first.GetPropertyValue(name) == second.GetPropertyValue(name), name
    assert contents(output_of(first)) == contents(output_of(second))
    shown = simple.Show(second, simple.CreateView("RenderView"))
    assert shown.Representation == "Surface Splats"


def test_filter_speaks_the_names_of_contour():
    properties = getattr(simple, NAME)(Input=simple.UnstructuredCellTypes()).ListProperties()
    wanted = {"ContourBy", "Isosurfaces", "Spacing", "AngularDensity", "Tolerance", "Method", "Seed"}
    assert wanted <= set(properties)


def filter_on(**arrays):
    """The filter on one hexahedron with these point arrays."""
    corners = np.array([[i, j, k] for k in (0, 1) for i, j in ((0, 0), (1, 0), (1, 1), (0, 1))])
    grid = grid_of_cells(corners, [(VTK_HEXAHEDRON, range(8))])
    for name, values in arrays.items():
        add_point_array(grid, name, values)
    return simple.HighOrderParticleIsosurface(Input=source_of(grid))


def test_contour_by_starts_with_a_field():
    """ParaView's own domain takes the first array of the alphabet."""
    ramp = np.linspace(0.0, 1.0, 8)
    labels = {"GlobalNodeId": np.arange(8), "RationalWeights": ramp + 1, "a_constant": np.ones(8), "subdomain": ramp}
    proxy = filter_on(**labels, temperature=2 * ramp)
    assert proxy.ContourBy == ["POINTS", "temperature"]
    assert list(proxy.Isosurfaces) == [1.0], "the middle of that array's range"
    choice = proxy.SMProxy.GetProperty("SelectInputScalars").GetDomain("array_list")
    assert set(labels) <= {choice.GetString(i) for i in range(choice.GetNumberOfStrings())}, "all can be chosen"


def test_contour_by_takes_what_there_is():
    assert filter_on(GlobalNodeId=np.arange(8)).ContourBy == ["POINTS", "GlobalNodeId"]


@pytest.mark.parametrize("low, high, expected", [
    (-0.35, 0.9364076, 0.29),  # three digits of a range of 1.3
    (1e-3, 2.2343e-3, 0.00162),
    (101325.4, 101987.2, 101656.0),
    (-3.2e-8, 5.7e-8, 1.25e-8),
    (2e9, 9.123e9, 5.56e9),
])
def test_the_default_isovalue_has_three_digits_of_the_range(low, high, expected):
    (isovalue,) = filter_on(u=np.linspace(low, high, 8)).Isosurfaces
    assert isovalue == expected


@pytest.mark.parametrize("scale", [1.0, 3e-7])
def test_the_default_isovalue_of_a_symmetric_field_is_beside_its_saddle(scale):
    """Sheets of xyz = 0 cross; rounding would make it 1e-17 or so."""
    grid = output_of(simple.UnstructuredCellTypes(CellType="Hex", BlocksDimensions=[8, 8, 8]))
    x = points_of(grid)
    x = x / x.max() * 2 - 1
    add_point_array(grid, "u", scale * x.prod(axis=1) + 1e-17 * scale)
    proxy = simple.HighOrderParticleIsosurface(Input=source_of(grid), ContourBy=["POINTS", "u"])
    proxy.SMProxy.GetProperty("ContourValues").ResetToDomainDefaults()
    proxy.PassDiagnostics = 1
    (isovalue,) = proxy.Isosurfaces
    assert 0.02 * scale < isovalue < 0.1 * scale
    assert float(f"{isovalue:.3g}") == isovalue
    output = output_of(proxy)
    assert output.GetNumberOfPoints() > 0
    assert reported(output, "SingularPoints") == 0


# On [-1,1]^3, with values u and -u equally often. At 0 sheets cross, or the gradient vanishes.
SYMMETRIC_FIELDS = {
    "saddle": lambda x, y, z: x * y,
    "turned saddle": lambda x, y, z: x**2 - y**2,
    "three planes": lambda x, y, z: x * y * z,
    "monkey saddle": lambda x, y, z: x**3 - 3 * x * y**2,
    "flat": lambda x, y, z: x**3,
    "odd polynomial": lambda x, y, z: x * y * z + x**3,
    "waves": lambda x, y, z: np.sin(np.pi * x) * np.sin(np.pi * y),
}


@pytest.mark.parametrize("middle", [0.0, 5.0])
@pytest.mark.parametrize("cell_type", ["Lagrange Hexahedron", "Lagrange Tetrahedron"])
def test_no_default_isovalue_is_near_the_middle_of_a_symmetric_field(cell_type, middle):
    grid = output_of(simple.UnstructuredCellTypes(CellType=cell_type, CellOrder=3, BlocksDimensions=[4, 4, 4]))
    x = points_of(grid)
    x = (x - x.min(axis=0)) / np.ptp(x, axis=0) * 2 - 1
    for name, field in SYMMETRIC_FIELDS.items():
        add_point_array(grid, name, middle + field(*x.T))
    proxy = simple.HighOrderParticleIsosurface(Input=source_of(grid))
    for name in SYMMETRIC_FIELDS:
        proxy.ContourBy = ["POINTS", name]
        proxy.SMProxy.GetProperty("ContourValues").ResetToDomainDefaults()
        (isovalue,) = proxy.Isosurfaces
        values = array_of(grid, name)
        assert 0.02 < (isovalue - middle) / np.ptp(values) < 0.1, f"{name}: {isovalue}"


@pytest.mark.parametrize("width, expected", [(1.0, 4.0), (0.1, 2.8)])  # the second: 0.35 of the range
def test_the_default_isovalue_is_not_that_of_a_narrow_place(width, expected):
    """A bar of eight cells, in the middle as wide as told; the field is the place along it."""
    grid = output_of(simple.UnstructuredCellTypes(CellType="Hex", BlocksDimensions=[16, 4, 4]))
    x = points_of(grid)
    along = (x[:, 0] - x[:, 0].min()) / np.ptp(x[:, 0]) * 8
    across = (x[:, 1:] - x[:, 1:].mean(axis=0)) / np.ptp(x[:, 1:], axis=0)
    near_middle = np.abs(along - 4) < 0.9
    grid.GetPoints().SetData(numpy_to_vtk(
        np.c_[np.where(near_middle, 4 + (along - 4) * width, along), across * np.where(near_middle, width, 1)[:, None]],
        deep=1))
    add_point_array(grid, "u", along)
    proxy = simple.HighOrderParticleIsosurface(Input=source_of(grid), ContourBy=["POINTS", "u"])
    proxy.SMProxy.GetProperty("ContourValues").ResetToDomainDefaults()
    assert list(proxy.Isosurfaces) == [expected]


def choose(proxy, array, unchecked=False):
    """Contours by an array, or, as the panel does before Apply, chooses it unchecked."""
    if unchecked:
        proxy.SMProxy.GetProperty("SelectInputScalars").SetUncheckedElement(4, array)
    else:
        proxy.ContourBy = ["POINTS", array]


def unchecked_isovalues(proxy):
    isovalues = proxy.SMProxy.GetProperty("ContourValues")
    return [isovalues.GetUncheckedElement(i) for i in range(isovalues.GetNumberOfUncheckedElements())]


def test_an_untouched_isovalue_follows_contour_by():
    ramp = np.linspace(0.0, 1.0, 8)
    proxy = filter_on(u=ramp, v=10 * ramp, w=np.c_[100 * ramp, 50 * ramp, 0 * ramp])
    assert list(proxy.Isosurfaces) == [0.5]
    choose(proxy, "v")
    assert list(proxy.Isosurfaces) == [5.0]
    choose(proxy, "w")
    assert list(proxy.Isosurfaces) == [56.0], "magnitude"
    proxy.Component = "Y"
    assert list(proxy.Isosurfaces) == [25.0]


def test_an_isovalue_of_the_user_stays_when_contour_by_changes():
    ramp = np.linspace(0.0, 1.0, 8)
    proxy = filter_on(u=ramp, v=10 * ramp)
    proxy.Isosurfaces = [0.25]
    choose(proxy, "v")
    assert list(proxy.Isosurfaces) == [0.25]
    proxy.Isosurfaces = [1.0, 2.0]
    choose(proxy, "u")
    assert list(proxy.Isosurfaces) == [1.0, 2.0]


def test_an_untouched_isovalue_follows_the_panel_before_apply():
    ramp = np.linspace(0.0, 1.0, 8)
    proxy = filter_on(u=ramp, v=10 * ramp, w=20 * ramp)
    isovalues = proxy.SMProxy.GetProperty("ContourValues")
    for array, expected in (("v", 5.0), ("w", 10.0), ("u", 0.5), ("v", 5.0)):
        choose(proxy, array, unchecked=True)
        assert unchecked_isovalues(proxy) == [expected]
        assert list(proxy.Isosurfaces) == [0.5], "nothing is applied yet"
    isovalues.SetUncheckedElement(0, 7.0)
    choose(proxy, "w", unchecked=True)
    assert unchecked_isovalues(proxy) == [7.0], "typed by the user"
    choose(proxy, "w")  # Apply
    assert unchecked_isovalues(proxy) == [7.0]


@pytest.mark.parametrize("isovalue", [0.5, 3.0])
def test_a_state_keeps_its_isovalue(tmp_path, isovalue):
    """Also one that is the default of the array by which the filter would contour by itself."""
    ramp = np.linspace(0.0, 1.0, 8)
    proxy = filter_on(u=ramp, v=10 * ramp)
    path = str(tmp_path / "grid.vtu")
    simple.SaveData(path, proxy.Input, **READABLE)
    reader = simple.XMLUnstructuredGridReader(FileName=[path])
    reader.UpdatePipeline()
    particles = simple.HighOrderParticleIsosurface(registrationName="particles", Input=reader)
    choose(particles, "v")
    particles.Isosurfaces = [isovalue]
    for _ in range(2):
        state = str(tmp_path / "state.pvsm")
        simple.SaveState(state)
        simple.ResetSession()
        simple.LoadState(state)
        loaded = simple.FindSource("particles")
        assert loaded is not None
        assert loaded.ContourBy == ["POINTS", "v"]
        assert list(loaded.Isosurfaces) == [isovalue]
        loaded.UpdatePipeline()
        assert list(loaded.Isosurfaces) == [isovalue]


def shown(isovalues):
    """A cone that is a narrow neck where its tip was, covered with particles and shown. Returns filter and display."""
    grid = cells.straight_grid("LAGRANGE_HEXAHEDRON", 2, 3)
    x = points_of(grid) / points_of(grid).max() * 2 - 1
    add_point_array(grid, "u", np.sum(x[:, :2] ** 2, axis=1) - x[:, 2] ** 2)
    view = simple.CreateView("RenderView")
    proxy = simple.HighOrderParticleIsosurface(Input=source_of(grid), ContourBy=["POINTS", "u"], Isosurfaces=isovalues)
    return proxy, simple.Show(proxy, view)


def range_of(table):
    return [table.RGBPoints[0], table.RGBPoints[-4]]


def test_one_isosurface_is_not_coloured_by_its_constant_isovalue():
    _, display = shown([0.1])
    assert display.ColorArrayName[1] == ""
    _, display = shown([0.1, 0.2])
    assert display.ColorArrayName[:] == ["POINTS", "u"]


@pytest.mark.parametrize("several", [False, True])
def test_active_cell_scalars_colour_the_surface_unless_they_are_constant(several):
    """Solvers write the number of a material for each cell, most often 1 everywhere."""
    grid = cells.straight_grid("LAGRANGE_HEXAHEDRON", 2, 3)
    add_point_array(grid, "u", points_of(grid)[:, 0])
    numbers = np.arange(grid.GetNumberOfCells()) if several else np.ones(grid.GetNumberOfCells())
    material = numpy_to_vtk(numbers.astype(float), deep=1)
    material.SetName("material")
    grid.GetCellData().SetScalars(material)
    isovalue = points_of(grid)[:, 0].max() * 0.4
    proxy = simple.HighOrderParticleIsosurface(
        Input=source_of(grid), ContourBy=["POINTS", "u"], Isosurfaces=[isovalue])
    display = simple.Show(proxy, simple.CreateView("RenderView"))
    assert output_of(proxy).GetNumberOfPoints() > 100
    assert display.ColorArrayName[1] == ("material" if several else "")


def quantiles_by_area(particles, name, shares):
    """The values of an array below which shares of the surface lie; a particle stands for the square of its spacing."""
    values, area = array_of(particles, name), array_of(particles, "Radius").astype(float) ** 2
    order = np.argsort(values)
    passed = np.cumsum(area[order])
    return values[order][np.searchsorted(passed, np.multiply(shares, passed[-1]))]


@pytest.mark.parametrize("name", ["Mean_Curvature", "Gauss_Curvature"])
def test_the_first_legend_of_a_curvature_leaves_out_the_extremes(name):
    """Few by area: most particles stand in the narrow neck."""
    proxy, display = shown([0.001])
    particles = output_of(proxy)
    values = array_of(particles, name)
    simple.ColorBy(display, ("POINTS", name))
    table = simple.GetColorTransferFunction(name)
    wanted = quantiles_by_area(particles, name, [0.02, 0.98])
    np.testing.assert_allclose(range_of(table), wanted, rtol=0.02)
    by_number = np.quantile(values, [0.02, 0.98])
    assert by_number[1] - by_number[0] > 1.2 * (wanted[1] - wanted[0])
    simple.Render()
    np.testing.assert_allclose(range_of(table), wanted, rtol=0.02)
    display.RescaleTransferFunctionToDataRange(False, True)
    np.testing.assert_allclose(range_of(table), [values.min(), values.max()], err_msg="by hand, all are shown")


def test_what_is_made_of_particles_has_such_legends(data):
    """Scripts colour a clip by the array that has a legend already."""
    proxy, display = shown([0.001])
    simple.ColorBy(display, ("POINTS", "Mean_Curvature"))
    simple.Render()
    half = simple.Clip(Input=proxy)
    half.ClipType.Normal = [0, 0, 1]
    simple.ColorBy(simple.Show(half), ("POINTS", "Mean_Curvature"))
    wanted = quantiles_by_area(output_of(half), "Mean_Curvature", [0.02, 0.98])
    np.testing.assert_allclose(range_of(simple.GetColorTransferFunction("Mean_Curvature")), wanted, rtol=0.05)


def test_legends_of_curvature_of_a_real_file_serve_what_is_seen(data):
    """By their number, particles gave -34 to 20 here, and most of the surface had one colour."""
    proxy = simple.HighOrderParticleIsosurface(Input=read(data("dolfinx_tet_p3.vtu")))
    display = simple.Show(proxy, simple.CreateView("RenderView"))
    simple.ColorBy(display, ("POINTS", "Mean_Curvature"))
    low, high = range_of(simple.GetColorTransferFunction("Mean_Curvature"))
    particles = output_of(proxy)
    area = array_of(particles, "Radius").astype(float) ** 2
    bent = np.abs(array_of(particles, "Mean_Curvature")) > 0.2 * (high - low)
    assert area[bent].sum() > 0.1 * area.sum(), "seen in a strong colour"


def test_other_legends_have_the_range_of_the_data():
    proxy, display = shown([0.001])
    simple.ColorBy(display, ("POINTS", "Radius"))
    values = array_of(output_of(proxy), "Radius")
    np.testing.assert_allclose(
        range_of(simple.GetColorTransferFunction("Radius")), [values.min(), values.max()])


def test_one_odd_value_does_not_move_the_default_isovalue():
    """Solvers leave pressures of 1e7 in a corner; the middle of the range would show nothing."""
    grid = output_of(simple.UnstructuredCellTypes(CellType="Hex", BlocksDimensions=[9, 9, 9]))
    x = points_of(grid)[:, 0]
    spoilt = np.append(x[:-1], 5.8e7)
    for values in (spoilt, np.append(x[:-1], np.nan)):
        add_point_array(grid, "p", values)
        proxy = simple.HighOrderParticleIsosurface(Input=source_of(grid), ContourBy=["POINTS", "p"])
        proxy.SMProxy.GetProperty("ContourValues").ResetToDomainDefaults()
        assert list(proxy.Isosurfaces) == pytest.approx([x.max() / 2], rel=0.02)


def test_another_filter_on_a_reader_has_the_same_defaults():
    """Also where the particles of the first filter are the active source."""
    reader = filter_on(u=np.linspace(0.0, 7.0, 8)).Input
    first, second = (simple.HighOrderParticleIsosurface(Input=reader) for _ in range(2))
    simple.SetActiveSource(first)
    simple.UpdatePipeline(proxy=first)
    third = simple.HighOrderParticleIsosurface(Input=reader)
    for proxy in (second, third):
        assert list(proxy.ContourBy) == ["POINTS", "u"] == list(first.ContourBy)
        assert list(proxy.Isosurfaces) == list(first.Isosurfaces)


@pytest.mark.parametrize("next_filter", [None, "Threshold", "GroupDatasets"])
def test_another_filter_does_not_contour_what_the_first_one_made(next_filter):
    """Particles of a vector have no active scalars, and Clip_Angle is the first of their arrays."""
    ramp = np.linspace(0.0, 7.0, 8)
    reader = filter_on(velocity=np.stack([ramp, 0 * ramp, ramp**2], axis=1)).Input
    first = simple.HighOrderParticleIsosurface(Input=reader, ContourBy=["POINTS", "velocity"], Isosurfaces=[3.0])
    active = getattr(simple, next_filter)(Input=first) if next_filter else first
    assert output_of(first).GetNumberOfPoints() > 0
    simple.UpdatePipeline(proxy=active)
    simple.SetActiveSource(active)
    second = simple.HighOrderParticleIsosurface(Input=reader)
    assert list(second.ContourBy) == ["POINTS", "velocity"]
    assert len(second.Isosurfaces) == 1


def test_contour_by_starts_with_no_array_that_the_filter_makes():
    ramp = np.linspace(0.0, 1.0, 8)
    assert filter_on(Jump=ramp, Normals=ramp, temperature=ramp).ContourBy == ["POINTS", "temperature"]


def unread(source):
    """A source with the same data that nobody has updated."""
    return simple.AppendDatasets(Input=source)


@pytest.mark.parametrize("components", [2, 3, 6, 9])
def test_components_have_names_before_their_array_is_known(components):
    """Names as Python state files give them: the component of a scalar has the empty name."""
    vectors = np.linspace(0.0, 1.0, 8)[:, None] * np.arange(1.0, components + 1)
    known = filter_on(v=vectors)
    known.Component = "Magnitude"
    proxy = simple.HighOrderParticleIsosurface(Input=unread(known.Input))
    names = proxy.GetProperty("Component").Available
    assert names == ["X", "Y", "Z", "Magnitude", ""]
    proxy.ContourBy = ["POINTS", "v"]
    for name, value in [("X", 0), ("Y", 1), ("Z", 2), ("", 0)]:
        proxy.Component = name
        assert proxy.SMProxy.GetProperty("Component").GetElement(0) == value
    proxy.Component = "Magnitude"
    known.Isosurfaces = proxy.Isosurfaces = [0.5 * np.linalg.norm(vectors[-1])]
    assert contents(output_of(proxy)) == contents(output_of(known))
    assert proxy.Component == "Magnitude"
    assert proxy.GetProperty("Component").Available == known.GetProperty("Component").Available
    proxy.Component = 0
    proxy.Component = "Magnitude"
    assert contents(output_of(proxy)) == contents(output_of(known))


def test_the_magnitude_stays_chosen_when_the_array_has_fewer_components():
    ramp = np.linspace(0.0, 1.0, 8)[:, None]
    proxy = filter_on(tensor=ramp * np.ones(6), vector=ramp * np.ones(3))
    proxy.ContourBy = ["POINTS", "tensor"]
    proxy.Component = "Magnitude"
    proxy.ContourBy = ["POINTS", "vector"]
    assert proxy.Component == "Magnitude"
    assert proxy.GetProperty("Component").Available == ["X", "Y", "Z", "Magnitude"]


def test_an_array_that_is_not_there_has_no_components_of_another():
    proxy = filter_on(s=np.arange(8.0))
    assert proxy.GetProperty("Component").Available == [""]
    proxy.ContourBy = ["POINTS", "none"]
    assert "Magnitude" in proxy.GetProperty("Component").Available


def test_vectors_start_at_their_magnitude():
    ramp = np.linspace(-1.0, 1.0, 8)
    proxy = filter_on(velocity=np.stack([ramp, 3 * ramp, 0 * ramp], axis=1))
    assert proxy.ContourBy == ["POINTS", "velocity"] and proxy.Component == "Magnitude"
    assert 0 < proxy.Isosurfaces[0] < np.sqrt(10)


def test_a_vector_that_is_chosen_after_a_scalar_starts_at_its_magnitude():
    ramp = np.linspace(-1.0, 1.0, 8)
    proxy = filter_on(pressure=ramp - 5, velocity=np.stack([ramp, 3 * ramp, 0 * ramp], axis=1))
    values = proxy.SMProxy.GetProperty("ContourValues").GetDomain("scalar_range")
    assert proxy.ContourBy == ["POINTS", "pressure"] and proxy.Component == ""
    assert (values.GetMinimum(0), values.GetMaximum(0)) == (-6.0, -4.0)
    assert proxy.Isosurfaces[0] == -5.0
    proxy.ContourBy = ["POINTS", "velocity"]
    assert proxy.Component == "Magnitude"
    proxy.Component = "Y"
    assert (values.GetMinimum(0), values.GetMaximum(0)) == (-3.0, 3.0)


def test_default_isovalue_of_a_magnitude():
    corners = filter_on(v=np.tile([3.0, 4.0, 0.0], (8, 1)) * np.linspace(0, 2, 8)[:, None])
    corners.Component = 3
    corners.SMProxy.GetProperty("ContourValues").ResetToDomainDefaults()
    assert list(corners.Isosurfaces) == pytest.approx([5.0])


def test_the_number_of_particles_has_a_widget():
    """ParaView 5.11 makes none for an IdTypeVectorProperty."""
    number = filter_on(u=np.arange(8.0)).SMProxy.GetProperty("NumberOfParticles")
    assert number.IsA("vtkSMIntVectorProperty")
    assert number.FindDomain("vtkSMIntRangeDomain").GetMinimum(0) == 0


def test_the_slider_of_the_spacing_reaches_beyond_its_default():
    proxy = filter_on(u=np.arange(8.0))
    bounds = proxy.SMProxy.GetProperty("Spacing").GetDomain("bounds")
    assert proxy.Spacing == pytest.approx(0.01)
    assert (bounds.GetMinimum(0), bounds.GetMaximum(0)) == pytest.approx((0, 0.1))


@pytest.mark.parametrize("bad", [np.inf, -np.inf])
def test_no_spacing_comes_from_bounds_that_are_not_finite(bad):
    """One cell of two is wrong; the other has particles with the default properties."""
    corners = np.array([[i, j, k] for k in (0, 1) for i, j in ((0, 0), (1, 0), (1, 1), (0, 1))], dtype=float)
    points = np.concatenate([corners, corners])
    points[8:10, 0] = bad, -bad
    grid = grid_of_cells(points, [(VTK_HEXAHEDRON, range(8)), (VTK_HEXAHEDRON, range(8, 16))])
    add_point_array(grid, "z", points[:, 2])
    proxy = simple.HighOrderParticleIsosurface(Input=source_of(grid))
    assert proxy.Spacing == 0
    assert output_of(proxy).GetNumberOfPoints() > 0


@pytest.mark.parametrize("source, fits", [
    (simple.UnstructuredCellTypes, True),  # an unstructured grid
    (simple.Sphere, False),  # polygons
    (simple.Wavelet, False),  # an image
])
def test_filter_is_enabled_for_unstructured_grids_only(source, fits):
    made = source()
    made.UpdatePipeline()
    selected = new_proxy("filters", NAME).GetProperty("Input")
    selected.AddUncheckedInputConnection(made.SMProxy, 0)
    assert bool(selected.IsInDomains()) == fits


def test_representation_is_offered_for_particles():
    representation = simple.Show(simple.Sphere(), simple.CreateView("RenderView"))
    for name in ("Surface Splats", "Surface Splats With Edges"):
        assert name in representation.GetProperty("Representation").Available


# Settings that PrintSelf does not call by the name of the XML's command.
PRINTED_AS = {
    "MapScalars": "ColorMode",
    "BackfaceRepresentation": "BackfaceCulling",
    "AddBlockSelector": "BlockSelectors",
}


def names_with_defaults(group, name):
    """PrintSelf's names of the settings that have defaults in the XML."""
    definitions = proxy_manager().GetProxyDefinitionManager()
    definition = definitions.GetCollapsedProxyDefinition(group, name, None, True)
    elements = [definition.GetNestedElement(i) for i in range(definition.GetNumberOfNestedElements())]
    commands = {e.GetAttribute("command") for e in elements if e.GetAttribute("default_values")}
    setters = {command.removeprefix("Set") for command in commands}
    return {PRINTED_AS.get(setter, setter) for setter in setters}


def defaults_of(name):
    """{property: its default values as text} of a representation, as the XML has them."""
    definition = proxy_manager().GetProxyDefinitionManager().GetCollapsedProxyDefinition("representations", name, None, True)
    elements = [definition.GetNestedElement(i) for i in range(definition.GetNumberOfNestedElements())]
    return {e.GetAttribute("name"): [float(v) if re.match(r"^[-+.\d]", v) else v for v in e.GetAttribute("default_values").split()]
            for e in elements if e.GetAttribute("default_values")}


def test_defaults_are_those_of_the_stock_representation():
    """The panel shows the stock representation's value of a property that both have, and hands ours only changes."""
    ours, stock = defaults_of("SurfaceSplatRepresentation"), defaults_of("SurfaceRepresentation")
    shared = ours.keys() & stock.keys() - {"BlockColorsDistinctValues"}
    assert len(shared) > 20
    assert {name: ours[name] for name in shared} == {name: stock[name] for name in shared}


def test_what_the_panel_shows_is_what_is_drawn():
    """Those that ParaView's settings change, too, as the number of distinct colours of blocks."""
    shown = simple.Show(simple.Sphere(), simple.CreateView("RenderView"))
    shown.Representation = "Surface Splats"
    drawn = state(shown.SMProxy.GetClientSideObject().GetActiveRepresentation())
    for name in ("SpecularPower", "Roughness", "Metallic", "Specular", "Diffuse", "Ambient", "PointSize", "Opacity",
                 "BlockColorsDistinctValues"):
        assert float(drawn[name]) == getattr(shown, name), name
    assert defaults_of("SurfaceSplatRepresentation")["BlockColorsDistinctValues"] == [shown.BlockColorsDistinctValues]


@pytest.mark.parametrize("group, name", PROXIES)
def test_defaults_of_the_xml_are_those_of_the_class(group, name):
    proxy = new_proxy(group, name)
    proxy.MarkAllPropertiesAsModified()
    proxy.UpdateVTKObjects()
    of_the_xml = state(proxy.GetClientSideObject())
    of_the_class = state(bare_object(proxy.GetVTKClassName()))
    assert names_with_defaults(group, name) <= set(of_the_class), "PrintSelf says too little to compare"
    assert of_the_xml == of_the_class
