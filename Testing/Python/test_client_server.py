"""A client and a server on one machine, the plugin on both, and ranks: same defaults, particles, pictures."""

import os
import shutil
import socket
import subprocess
from pathlib import Path

import numpy as np
import pytest
from paraview import simple
from pictures import background_share, read_png
from support import contents, environment_of_ranks, output_of

PVSERVER = Path(os.environ["HOP_PVPYTHON"]).parent / "pvserver"
SIZE = 300

# Runs in the client. With the threshold (megabytes of geometry) at 0 the server draws, else the client.
CLIENT = """
import sys
from paraview import simple
sys.path.insert(0, {folder!r})
import test_client_server as here
simple.Connect("127.0.0.1", {port})
simple.LoadPlugin({plugin!r}, remote=True, ns=vars(simple))
simple.LoadPlugin({plugin!r}, remote=False, ns=vars(simple))
print("default isovalue:", here.default_isovalue({data!r}))
surface, view = here.make_session({data!r})
simple.SaveData({folder_out!r} + "/remote.vtp", surface, DataMode="Binary")
for name, threshold in [("server", 0.0), ("client", 1e6)]:
    view.RemoteRenderThreshold = threshold
    here.shoot({folder_out!r} + f"/{{name}}.png", view)
    print(name, "draws remotely:", bool(view.GetClientSideObject().GetUseDistributedRenderingForRender()))
simple.Disconnect()
"""


# Where there are several ranks, only the first runs this script.
RANKS = """
import sys
from paraview import simple
sys.path.insert(0, {folder!r})
import test_client_server as here
simple.LoadPlugin({plugin!r}, remote=False, ns=vars(simple))
print("default isovalue:", here.default_isovalue({data!r}))
"""


def default_isovalue(file):
    reader = simple.OpenDataFile(file)
    reader.UpdatePipeline()
    return list(simple.HighOrderParticleIsosurface(Input=reader).Isosurfaces)


def said_isovalue(said):
    return float(said.split("default isovalue: [")[1].split("]")[0])


def make_session(file):
    reader = simple.XMLUnstructuredGridReader(FileName=[file])
    surface = simple.HighOrderParticleIsosurface(Input=reader, ContourBy=["POINTS", "u"], Isosurfaces=[0.2])
    surface.Spacing = 0.03
    view = simple.CreateView("RenderView")
    view.ViewSize = [SIZE, SIZE]
    view.OrientationAxesVisibility = 0
    display = simple.Show(surface, view)
    display.SetRepresentationType("Surface Splats")
    simple.ColorBy(display, ("POINTS", "Mean_Curvature"))
    view.CameraPosition = [-0.8, -1.1, 0.6]
    view.CameraFocalPoint = [0, 0, 0]
    view.CameraViewUp = [0, 0, 1]
    simple.ResetCamera(view)
    return surface, view


def shoot(path, view):
    simple.Render(view)
    simple.SaveScreenshot(str(path), view, ImageResolution=[SIZE, SIZE])


@pytest.fixture
def server():
    """Port of a server that waits for one client and ends with it."""
    if not PVSERVER.is_file():
        pytest.skip("this ParaView has no pvserver")
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    process = subprocess.Popen(
        [str(PVSERVER), f"--server-port={port}"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    line = ""
    while "Accepting connection" not in line:
        line = process.stdout.readline()
        assert line, "the server did not start"
    yield port
    process.kill()
    process.wait()


def test_client_and_server_agree_with_a_session_without(plugin, data, server, tmp_path):
    surface, view = make_session(data("mfem_hex1_p8.vtu"))
    shoot(tmp_path / "alone.png", view)
    script = tmp_path / "client.py"
    script.write_text(CLIENT.format(
        folder=str(Path(__file__).parent), folder_out=str(tmp_path), port=server, plugin=str(plugin),
        data=data("mfem_hex1_p8.vtu")))
    client = subprocess.run(
        [os.environ["HOP_PVPYTHON"], str(script)], capture_output=True, text=True, timeout=180)
    said = client.stdout + client.stderr
    assert client.returncode == 0, said
    assert "server draws remotely: True" in said and "client draws remotely: False" in said, said
    assert "ERR|" not in said, said
    assert [said_isovalue(said)] == default_isovalue(data("mfem_hex1_p8.vtu"))

    remote = simple.XMLPolyDataReader(FileName=[str(tmp_path / "remote.vtp")])
    assert contents(output_of(remote)) == contents(output_of(surface))
    alone = read_png(tmp_path / "alone.png")
    assert background_share(alone) < 0.9
    for name in ("server", "client"):
        picture = read_png(tmp_path / f"{name}.png")
        differing = np.abs(picture - alone).max(axis=2) > 8
        assert differing.mean() < 0.001, f"drawn by the {name}"


# The first file has its values in three pieces, the second all on one rank. A few values far off must not move the
# default isovalue, as they move the middle of the whole range.
@pytest.mark.parametrize("file", ["dealii_shell_p3_00.pvtu", "mfem_dg_advection_0.vtu"])
def test_ranks_agree_on_the_default_isovalue(plugin, data, tmp_path, file):
    for program in ("mpirun", "pvbatch"):
        if not shutil.which(program):
            pytest.skip(f"no {program} here")
    script = tmp_path / "ranks.py"
    script.write_text(RANKS.format(folder=str(Path(__file__).parent), plugin=str(plugin), data=data(file)))
    command = ["mpirun", "-np", "2", "--oversubscribe", "pvbatch", str(script)]
    ranks = subprocess.run(command, env=environment_of_ranks(), capture_output=True, text=True, timeout=120)
    said = ranks.stdout + ranks.stderr
    assert ranks.returncode == 0 and "ERR|" not in said, said
    alone, = default_isovalue(data(file))
    reader = simple.OpenDataFile(data(file))
    reader.UpdatePipeline()
    lowest, highest = reader.PointData[simple.HighOrderParticleIsosurface(Input=reader).ContourBy[1]].GetRange()
    assert abs(said_isovalue(said) - alone) < 1e-3 * (highest - lowest)
