"""A session comes back as it was: from its Python trace, and from state files of both kinds."""

import os
import subprocess
from contextlib import contextmanager

import numpy as np
import pytest
from paraview import servermanager, simple, smstate, smtrace
from pictures import background_share, read_png
from support import contents, output_of

ISOVALUES, SPACING = [0.1, 0.2], 0.04

# Run at the end of a script that is to bring back the session: its particles and picture, as files.
EPILOGUE = """
from paraview import simple
surface = simple.FindSource("surface")
view = simple.GetActiveViewOrCreate("RenderView")
simple.SaveData({data!r}, surface, DataMode="Binary")  # not raw: see the README about expat
display = simple.GetDisplayProperties(surface, view)
assert display.Representation == "Surface Splats", display.Representation
assert display.ColorArrayName[1] == "Mean_Curvature", display.ColorArrayName
assert display.RadiusScale == 1.25, display.RadiusScale
simple.SaveScreenshot({picture!r}, view, ImageResolution=[300, 300])
"""


def trace_item(name, **arguments):
    """A step for the running trace, if there is one, as the GUI's own code makes it where a user acts."""
    tracing = servermanager.vtkSMTrace.GetActiveTracer() is not None
    return smtrace._create_trace_item_internal(name, kwargs=arguments) if tracing else None


@contextmanager
def apply_button(proxy):
    """Does what the properties panel does around a change: without it a trace does not see the change."""
    item = trace_item("PropertiesModified", proxy=proxy.SMProxy)
    yield
    if item:
        item.finalize()


def make_session(data):
    """Does what a user does: opens a file, applies the filter, colours the surface, rotates it."""
    reader = simple.XMLUnstructuredGridReader(registrationName="file", FileName=[data("mfem_hex1_p8.vtu")])
    reader.UpdatePipeline()
    surface = simple.HighOrderParticleIsosurface(registrationName="surface", Input=reader)
    with apply_button(surface):
        surface.ContourBy = ["POINTS", "u"]
        surface.Isosurfaces = ISOVALUES
        surface.Spacing = SPACING
        surface.AngularDensity = 5.0
    view = simple.CreateView("RenderView")
    simple.AssignViewToLayout(view)
    display = simple.Show(surface, view)
    with apply_button(display):
        display.SetRepresentationType("Surface Splats")
        display.RadiusScale = 1.25
    simple.ColorBy(display, ("POINTS", "Mean_Curvature"))
    with apply_button(view):
        view.OrientationAxesVisibility = 0
    view.CameraPosition = [-3, -4, 2]
    view.CameraViewUp = [0, 0, 1]
    simple.ResetCamera(view)
    simple.Render(view)
    trace_item("SaveCameras", proxy=view.SMProxy)
    return surface, view


def run_elsewhere(plugin, path, script):
    """In a ParaView of its own, which knows nothing but the script; path: where to write it."""
    load = f"from paraview.simple import LoadPlugin\nLoadPlugin({str(plugin)!r}, remote=False, ns=globals())\n"
    path.write_text(load + script)
    result = subprocess.run([os.environ["HOP_PVPYTHON"], str(path)], capture_output=True, text=True, timeout=120)
    assert result.returncode == 0, result.stdout + result.stderr + script


class Expected:
    """Particles and picture of the session, and of the script that should repeat it."""

    def __init__(self, folder):
        self.folder = folder

    def keep(self, surface, view):
        self.particles = contents(output_of(surface))
        simple.SaveScreenshot(str(self.folder / "before.png"), view, ImageResolution=[300, 300])

    def run(self, plugin, script):
        names = {"data": str(self.folder / "again.vtp"), "picture": str(self.folder / "again.png")}
        run_elsewhere(plugin, self.folder / "again.py", script + EPILOGUE.format(**names))

    def compare(self):
        again = simple.XMLPolyDataReader(FileName=[str(self.folder / "again.vtp")])
        assert contents(output_of(again)) == self.particles
        before, after = read_png(self.folder / "before.png"), read_png(self.folder / "again.png")
        assert background_share(before) < 0.9
        assert np.abs(before - after).max() <= 2


@pytest.fixture
def expected(tmp_path):
    return Expected(tmp_path)


def test_trace_of_a_session_repeats_it(plugin, data, expected):
    smtrace.start_trace()
    try:
        surface, view = make_session(data)
    finally:
        trace = smtrace.get_current_trace_output()
        smtrace.stop_trace()
    assert "HighOrderParticleIsosurface(" in trace and "Surface Splats" in trace
    expected.keep(surface, view)
    expected.run(plugin, trace)
    expected.compare()


@pytest.mark.parametrize("kind", ["py", "pvsm"])
def test_state_files_bring_the_session_back(plugin, data, expected, kind):
    surface, view = make_session(data)
    expected.keep(surface, view)
    state = expected.folder / "session.pvsm"
    simple.SaveState(str(state))
    load = f"from paraview import simple\nsimple.LoadState({str(state)!r})\n"
    expected.run(plugin, smstate.get_state() if kind == "py" else load)
    expected.compare()


# The component has to keep its name when its array becomes known.
VECTOR_EPILOGUE = """
from paraview import simple
surface = simple.FindSource("surface")
surface.UpdatePipeline()
assert surface.Component == {component!r}, surface.Component
simple.SaveData({data!r}, surface, DataMode="Binary")
"""


def make_vector_session(data, component, isovalue):
    reader = simple.XMLUnstructuredGridReader(
        registrationName="file", FileName=[data("vtkdata_notch_quadratic_hex20_wedge15.vtu")])
    reader.UpdatePipeline()
    surface = simple.HighOrderParticleIsosurface(registrationName="surface", Input=reader)
    with apply_button(surface):
        surface.ContourBy = ["POINTS", "Nodal Displacement"]
        surface.Component = component
        surface.Isosurfaces = [isovalue]
    simple.GetActiveViewOrCreate("RenderView")
    return surface


def script_of(kind, make_session, folder):
    """Calls make_session(); returns its result and a script that brings the session back."""
    if kind == "trace":
        smtrace.start_trace()
        try:
            return make_session(), smtrace.get_current_trace_output()
        finally:
            smtrace.stop_trace()
    made = make_session()
    if kind == "py":
        return made, smstate.get_state()
    state = folder / "session.pvsm"
    simple.SaveState(str(state))
    return made, f"from paraview import simple\nsimple.LoadState({str(state)!r})\n"


@pytest.mark.parametrize("kind", ["py", "pvsm", "trace"])
@pytest.mark.parametrize("component, isovalue", [("Y", 5e-8), ("Magnitude", 1e-6)])
def test_components_come_back_by_name(plugin, data, tmp_path, component, isovalue, kind):
    """Files are not read yet when a script names the component."""
    surface, script = script_of(kind, lambda: make_vector_session(data, component, isovalue), tmp_path)
    particles = str(tmp_path / "again.vtp")
    run_elsewhere(plugin, tmp_path / "again.py", script + VECTOR_EPILOGUE.format(data=particles, component=component))
    again = output_of(simple.XMLPolyDataReader(FileName=[particles]))
    assert again.GetNumberOfPoints() > 0
    assert contents(again) == contents(output_of(surface))
