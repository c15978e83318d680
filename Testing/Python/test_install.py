"""An installed plugin is found by ParaView: listed, and loaded by its name."""

import os
import shutil
import subprocess
from pathlib import Path

import pytest

NAME = "HighOrderParticleIsosurface"
PARAVIEW_PREFIX = Path(os.environ["HOP_PVPYTHON"]).parent.parent

LOAD_BY_NAME = f"""
from paraview.simple import *
LoadDistributedPlugin("{NAME}", remote=False, ns=globals())
print({NAME}(Input=UnstructuredCellTypes()).GetXMLLabel())
"""


def install(prefix, root=""):
    """Installs into prefix, the path on a machine whose root directory is `root` here."""
    subprocess.run([os.environ["HOP_CMAKE"], "--install", os.environ["HOP_BUILD"], "--prefix", str(prefix)],
                   env={**os.environ, "DESTDIR": str(root)}, capture_output=True, check=True)


def run(program, script, folder, **environment):
    path = folder / "script.py"
    path.write_text(script)
    return subprocess.run([str(program), str(path)], capture_output=True, text=True, timeout=120,
                          env={**os.environ, **environment})


def test_only_what_paraview_needs_is_installed(tmp_path):
    install(tmp_path)
    names = {path.name for path in tmp_path.rglob("*") if path.is_file()}
    assert f"{NAME}.so" in names
    assert not [name for name in names if name.endswith((".a", ".h", ".cmake"))]


def test_installed_into_paraviews_prefix_it_is_found_by_name(tmp_path):
    install(PARAVIEW_PREFIX, root=tmp_path)
    install(PARAVIEW_PREFIX, root=tmp_path)  # a second time changes nothing
    (conf,) = tmp_path.rglob("paraview.conf")
    assert len(conf.read_text().splitlines()) == 1

    # ParaView looks for plugins from where its program lies: a copy of the program in the new root
    # stands for a ParaView installed there.
    if conf.parent.name != "bin":
        pytest.skip("this ParaView looks for its plugins beside its libraries, wherever its program lies")
    program = conf.parent / "pvpython"
    shutil.copy(Path(shutil.which(os.environ["HOP_PVPYTHON"])).resolve(), program)
    if run(program, "from paraview import simple", tmp_path).returncode != 0:
        pytest.skip("this ParaView does not run from a copy of its program")
    result = run(program, LOAD_BY_NAME, tmp_path)
    assert "High-Order Particle Isosurface" in result.stdout, result.stderr


def test_installed_elsewhere_it_is_found_through_the_environment(tmp_path):
    prefix = tmp_path / "a prefix"
    install(prefix)
    (listing,) = prefix.rglob("*.plugins.xml")
    result = run(os.environ["HOP_PVPYTHON"], LOAD_BY_NAME, tmp_path, PV_PLUGIN_CONFIG_FILE=str(listing))
    assert "High-Order Particle Isosurface" in result.stdout, result.stderr
    assert not list(prefix.rglob("paraview.conf"))


FROM_THE_PACKAGE = """
from highorderparticles import vtkHighOrderParticleIsosurface, vtkSurfaceSplatMapper
print("spacing", vtkHighOrderParticleIsosurface().GetSpacing())
print([line.split()[-1] for line in open("/proc/self/maps") if "HighOrderParticle" in line])
"""


def test_installed_python_package_uses_the_installed_libraries(tmp_path):
    prefix = tmp_path / "prefix"
    install(prefix)
    (package,) = prefix.rglob("highorderparticles")
    result = run(os.environ["HOP_PVPYTHON"], FROM_THE_PACKAGE, tmp_path, PYTHONPATH=str(package.parent))
    assert "spacing 0.0" in result.stdout, result.stderr
    assert os.environ["HOP_BUILD"] not in result.stdout
    assert str(prefix) in result.stdout
