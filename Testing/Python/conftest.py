"""What every Python test shares: the built plugin, loaded once, and the paths of the data.

Run through ctest, which names the plugin (HOP_PLUGIN) and the folder of data (HOP_DATA) in the environment.
HOP_SHARED_DATA may name a second folder of data: see Testing/Data/README.md.
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
    """shared_data('name.vtu'): path of a file in the folder HOP_SHARED_DATA; skips the test without it."""

    def find(name):
        folder = os.environ.get("HOP_SHARED_DATA", "")
        if not folder:
            pytest.skip(f"{name} is not part of the repository, and HOP_SHARED_DATA names no folder that has it")
        if not (Path(folder) / name).is_file():
            pytest.skip(f"{name} is not in the folder that HOP_SHARED_DATA names: {folder}")
        return _path_in(folder, name)

    return find
