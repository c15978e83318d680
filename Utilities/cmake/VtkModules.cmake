# build_vtk_modules(MODULES folder... LIBRARY_DESTINATION dir [DEVELOPMENT])
#   The VTK modules in these folders of the project, for ParaView's VTK or for VTK alone; their
#   libraries are installed in the destination. DEVELOPMENT installs what programs need to be built
#   with them as well: headers, and CMake files for find_package(HighOrderParticles).
function (build_vtk_modules)
  cmake_parse_arguments(PARSE_ARGV 0 build "DEVELOPMENT" "LIBRARY_DESTINATION" "MODULES")
  list(TRANSFORM build_MODULES REPLACE "(.+)" "${PROJECT_SOURCE_DIR}/\\1/vtk.module")
  vtk_module_scan(
    MODULE_FILES ${build_MODULES}
    PROVIDES_MODULES modules
    REQUIRES_MODULES required_modules
    WANT_BY_DEFAULT ON
    HIDE_MODULES_FROM_CACHE ON
    ENABLE_TESTS OFF)
  foreach (module IN LISTS required_modules)
    if (NOT TARGET "${module}")
      message(FATAL_ERROR "The VTK or ParaView found lacks the module ${module}, without which nothing can be built")
    endif ()
  endforeach ()
  set(CMAKE_INSTALL_RPATH "$ORIGIN")
  set(development INSTALL_HEADERS OFF)
  if (build_DEVELOPMENT)
    set(cmake_destination "${build_LIBRARY_DESTINATION}/cmake/HighOrderParticles")
    set(development INSTALL_HEADERS ON INSTALL_EXPORT HighOrderParticles CMAKE_DESTINATION "${cmake_destination}")
    install(FILES "${PROJECT_SOURCE_DIR}/Utilities/cmake/HighOrderParticlesConfig.cmake" DESTINATION "${cmake_destination}")
  endif ()
  vtk_module_build(
    MODULES ${modules}
    PACKAGE HighOrderParticles
    LIBRARY_DESTINATION "${build_LIBRARY_DESTINATION}"
    ${development})
endfunction ()
