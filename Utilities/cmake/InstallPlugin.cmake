# install_plugin(NAME): put the plugin where ParaView looks for plugins.
#
# ParaView finds a plugin by its name in <prefix>/<lib>/paraview-<version>/plugins/NAME/NAME.so, and
# lists it (plugin manager, LoadDistributedPlugin) if an XML file names it and paraview.conf names
# that XML file, one path a line. That file lies in bin/ or, where Debian 13 and later keep it, in
# <lib>/paraview-<version>; paths in it are relative to its folder.
# The plugin's own libraries lie beside it; it is of no use as a library, so no header is installed.
option(REGISTER_PLUGIN "On install, list the plugin in ParaView's paraview.conf" ON)

function (_paraview_library_dir output)
  get_target_property(library ParaView::RemotingCore LOCATION)
  get_filename_component(directory "${library}" DIRECTORY)
  file(RELATIVE_PATH directory "${ParaView_PREFIX_PATH}" "${directory}")
  set("${output}" "${directory}" PARENT_SCOPE)
endfunction ()

if (CMAKE_INSTALL_PREFIX_INITIALIZED_TO_DEFAULT)
  set(CMAKE_INSTALL_PREFIX "${ParaView_PREFIX_PATH}" CACHE PATH
    "ParaView looks for plugins below its own prefix only" FORCE)
endif ()

_paraview_library_dir(library_dir)
set(PLUGINS_INSTALL_DIR "${library_dir}/${PARAVIEW_PLUGIN_SUBDIR}")
set(PLUGIN_INSTALL_DIR "${PLUGINS_INSTALL_DIR}/${PROJECT_NAME}")
get_filename_component(PLUGIN_LIST_DIR "${PLUGINS_INSTALL_DIR}" DIRECTORY)
if (NOT EXISTS "${ParaView_PREFIX_PATH}/${PLUGIN_LIST_DIR}/paraview.conf")
  set(PLUGIN_LIST_DIR "bin")
endif ()

function (install_plugin name)
  # ParaView's macros would install static archives too: the install rules of their directory are
  # left out, though not its targets, and what a running ParaView needs is installed here.
  set_property(DIRECTORY "${PROJECT_SOURCE_DIR}/Plugin" PROPERTY EXCLUDE_FROM_ALL ON)
  set_property(TARGET ${name} PROPERTY EXCLUDE_FROM_ALL OFF)
  add_custom_target(plugin ALL DEPENDS ${name})
  set_property(TARGET ${name} PROPERTY INSTALL_RPATH "$ORIGIN")
  install(TARGETS ${name} LIBRARY DESTINATION "${PLUGIN_INSTALL_DIR}")

  set(plugins_xml "${name}.plugins.xml")
  file(WRITE "${PROJECT_BINARY_DIR}/${plugins_xml}"
    "<Plugins>\n  <Plugin name=\"${name}\" auto_load=\"0\"/>\n</Plugins>\n")
  install(FILES "${PROJECT_BINARY_DIR}/${plugins_xml}" DESTINATION "${PLUGINS_INSTALL_DIR}")

  if (REGISTER_PLUGIN)
    file(RELATIVE_PATH plugin_list_entry "/${PLUGIN_LIST_DIR}" "/${PLUGINS_INSTALL_DIR}/${plugins_xml}")
    configure_file("${PROJECT_SOURCE_DIR}/Utilities/cmake/RegisterPlugin.cmake.in"
      "${PROJECT_BINARY_DIR}/RegisterPlugin.cmake" @ONLY)
    install(SCRIPT "${PROJECT_BINARY_DIR}/RegisterPlugin.cmake")
  endif ()
endfunction ()
