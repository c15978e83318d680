# find_package(HighOrderParticles): the targets HighOrderParticles::Filters and
# HighOrderParticles::Rendering, built for VTK alone.
include(CMakeFindDependencyMacro)
find_dependency(VTK COMPONENTS
  CommonCore CommonDataModel CommonExecutionModel CommonMath FiltersCore ParallelCore RenderingCore RenderingOpenGL2)
include("${CMAKE_CURRENT_LIST_DIR}/HighOrderParticles-targets.cmake")
include("${CMAKE_CURRENT_LIST_DIR}/HighOrderParticles-vtk-module-properties.cmake")
