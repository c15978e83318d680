"""The plugin as ParaView sees it: its name, its proxies, their labels and defaults."""

import pytest
from paraview import servermanager, simple

NAME = "HighOrderParticleIsosurface"


def prototype(group, name):
    proxy = servermanager.ProxyManager().SMProxyManager.GetPrototypeProxy(group, name)
    assert proxy is not None, f"no proxy {name} in group {group}"
    return proxy


def test_plugin_is_loaded_under_its_name(plugin):
    manager = servermanager.vtkSMProxyManager.GetProxyManager().GetPluginManager()
    loaded = manager.GetLocalInformation()
    names = [loaded.GetPluginName(i) for i in range(loaded.GetNumberOfPlugins()) if loaded.GetPluginLoaded(i)]
    assert NAME in names
    assert plugin.name == NAME + ".so"


def test_filter_is_a_filter_with_its_label():
    assert prototype("filters", NAME).GetXMLLabel() == "High-Order Particle Isosurface"
    assert callable(getattr(simple, NAME))
