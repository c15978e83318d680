# wrap_for_python(MODULE...): the classes of these VTK modules as the Python package
# `highorderparticles`, for scripts that do without ParaView's proxies.
#
# The package lies, in the build folder and below the installation prefix, where ParaView's own Python
# package lies below its prefix: there pvpython finds it without PYTHONPATH.
function (_python_package_dir output)
  file(GLOB packages RELATIVE "${ParaView_PREFIX_PATH}"
    "${ParaView_PREFIX_PATH}/lib*/python3*/*-packages/paraview/simple*")
  if (packages)
    list(GET packages 0 package)
    string(REGEX REPLACE "/paraview/simple.*" "" directory "${package}")
  else ()
    vtk_module_python_default_destination(directory)
  endif ()
  set("${output}" "${directory}" PARENT_SCOPE)
endfunction ()

_python_package_dir(PYTHON_PACKAGE_DIR)

function (wrap_for_python)
  set(package highorderparticles)
  vtk_module_wrap_python(
    MODULES ${ARGN}
    PYTHON_PACKAGE ${package}
    MODULE_DESTINATION "${PYTHON_PACKAGE_DIR}"
    LIBRARY_DESTINATION "${PLUGIN_INSTALL_DIR}"
    BUILD_STATIC OFF
    INSTALL_HEADERS OFF)
  set(init "${PROJECT_SOURCE_DIR}/Plugin/${package}/__init__.py")
  configure_file("${init}" "${PROJECT_BINARY_DIR}/${PYTHON_PACKAGE_DIR}/${package}/__init__.py" COPYONLY)
  install(FILES "${init}" DESTINATION "${PYTHON_PACKAGE_DIR}/${package}")
endfunction ()
