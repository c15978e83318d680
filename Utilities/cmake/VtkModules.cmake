# build_vtk_modules(MODULES folder... [LIBRARY_DESTINATION dir])
#   The VTK modules in these folders of the project, for ParaView's VTK or for VTK alone. With a
#   destination their libraries are installed there, for a program that loads them from it; without,
#   nothing is installed.
function (build_vtk_modules)
  cmake_parse_arguments(PARSE_ARGV 0 build "" "LIBRARY_DESTINATION" "MODULES")
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
  vtk_module_build(
    MODULES ${modules}
    LIBRARY_DESTINATION "${build_LIBRARY_DESTINATION}"
    INSTALL_HEADERS OFF)
endfunction ()
