# VTK without ParaView: what the two modules are built on.
include(DebianParaView)
find_package(VTK 9.1 REQUIRED COMPONENTS
  CommonCore CommonDataModel CommonExecutionModel CommonMath FiltersCore ParallelCore RenderingCore RenderingOpenGL2
  OPTIONAL_COMPONENTS ParallelMPI RenderingUI glad glew opengl)
message(STATUS "VTK ${VTK_VERSION} in ${VTK_PREFIX_PATH}")
