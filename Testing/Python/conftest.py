"""What every Python test shares: the built plugin, loaded once, and the paths of the data.

Run through ctest, which names the plugin (HOP_PLUGIN) and the folders of data (HOP_DATA,
HOP_SHARED_DATA) in the environment.
"""

import os
from pathlib import Path

import pytest
from paraview import simple


@pytest.fixture(scope="session", autouse=True)
def plugin():
    """Load the plugin under test; its constructors are then in paraview.simple. Returns its path."""
    path = Path(os.environ["HOP_PLUGIN"])
    simple.LoadPlugin(str(path), remote=False, ns=vars(simple))
    return path


@pytest.fixture(autouse=True)
def fresh_session():
    """Leave no source, view or colour map of one test to the next."""
    yield
    simple.ResetSession()


def _path_in(folder, name):
    path = Path(folder) / name
    assert path.is_file(), f"no such test file: {path}"
    return str(path)


@pytest.fixture(scope="session")
def data():
    """data('name.vtu'): path of a file in Testing/Data."""
    return lambda name: _path_in(os.environ["HOP_DATA"], name)


@pytest.fixture(scope="session")
def shared_data():
    """shared_data('name.vtu'): path of a file too large for the repository; skips the test without it."""

    def find(name):
        folder = os.environ.get("HOP_SHARED_DATA", "")
        if not folder or not (Path(folder) / name).is_file():
            pytest.skip(f"{name} is not in HOP_SHARED_DATA ('{folder}')")
        return _path_in(folder, name)

    return find
