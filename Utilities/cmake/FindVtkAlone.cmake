# VTK without ParaView: what the two modules, and the programs that use them here, are built on.
include(DebianParaView)
find_package(VTK 9.1 REQUIRED COMPONENTS
  CommonCore CommonDataModel CommonExecutionModel CommonMath FiltersCore IOImage IOXML ParallelCore
  RenderingCore RenderingOpenGL2)
message(STATUS "VTK ${VTK_VERSION} in ${VTK_PREFIX_PATH}")
