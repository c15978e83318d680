# Faults in the CMake files of Debian's later ParaView packages, which stop find_package. Included
# before it; does nothing where the faults are absent (bookworm, ParaView's own builds).

# trixie, sid: the export files of the Python modules name vtkCommonCore.so where the file is
# vtkCommonCore.cpython-313-….so. An export file whose targets are all defined beforehand returns at
# once, unchecked; nothing here links Python modules, so empty targets stand in for them.
file(GLOB exports
  "/usr/lib/*/cmake/paraview-*/*Python*-targets.cmake"
  "/usr/lib/*/cmake/paraview-*/vtk/VTKPython-targets.cmake"
  "/usr/lib/*/cmake/vtk-*/VTKPython-targets.cmake")
foreach (export IN LISTS exports)
  string(REGEX REPLACE "\\.cmake$" "-*.cmake" locations "${export}")
  file(GLOB locations "${locations}")
  set(modules "")
  if (locations)
    file(STRINGS ${locations} modules REGEX "IMPORTED_LOCATION.*\\.so\"" LIMIT_COUNT 1)
  endif ()
  string(REGEX REPLACE ".*\"\\\${_IMPORT_PREFIX}(/.*)\".*" "/usr\\1" module "${modules}")
  if (NOT locations OR (module AND NOT EXISTS "${module}"))
    file(STRINGS "${export}" targets REGEX "_cmake_expected_target IN ITEMS")
    string(REGEX REPLACE ".*IN ITEMS (.*)\\)" "\\1" targets "${targets}")
    separate_arguments(targets)
    foreach (target IN LISTS targets)
      add_library(${target} INTERFACE IMPORTED)
    endforeach ()
  endif ()
endforeach ()

# trixie: targets that the export files use and nobody defines.
foreach (target IN ITEMS hdf5::hdf5 hdf5::hdf5_hl NetCDF::NetCDF)
  if (NOT TARGET ${target} AND exports MATCHES "paraview-5\\.13")
    add_library(${target} INTERFACE IMPORTED)
  endif ()
endforeach ()
