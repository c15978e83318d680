"""High-Order Particle Isosurface for Python programs that use VTK's classes, not ParaView's proxies.

    from highorderparticles import vtkHighOrderParticleIsosurface, vtkSurfaceSplatMapper

For pvpython, and for a Python that imports the same VTK as the ParaView that this was built with.
"""

from .vtkHighOrderParticleFilters import vtkHighOrderParticleIsosurface, vtkHighOrderParticleSlice
from .vtkHighOrderParticleRendering import vtkSurfaceSplatActor, vtkSurfaceSplatMapper

__all__ = [
    "vtkHighOrderParticleIsosurface",
    "vtkHighOrderParticleSlice",
    "vtkSurfaceSplatActor",
    "vtkSurfaceSplatMapper",
]
