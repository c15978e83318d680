# package_plugin(NAME): `cpack -G DEB` in the build folder makes a Debian package of the plugin.
#
# A package may not change the file in which ParaView lists its plugins, as that belongs to another package or to none:
# the package's scripts add the plugin to it and take it out again, and a trigger adds it again after an upgrade of
# ParaView. A plugin loads into the ParaView that it was built with only, so the package depends on that version.
function (package_plugin name)
  set(listing "/${PLUGIN_LIST_DIR}/paraview.conf")
  string(PREPEND listing "${ParaView_PREFIX_PATH}")
  file(RELATIVE_PATH entry "/${PLUGIN_LIST_DIR}" "/${PLUGINS_INSTALL_DIR}/${name}.plugins.xml")
  foreach (script IN ITEMS postinst prerm triggers)
    configure_file("${PROJECT_SOURCE_DIR}/Utilities/cmake/debian/${script}.in"
      "${PROJECT_BINARY_DIR}/debian/${script}" @ONLY)
    list(APPEND scripts "${PROJECT_BINARY_DIR}/debian/${script}")
  endforeach ()
  # ParaView 5.11.0 is followed by 5.11.1.
  math(EXPR next_patch "${ParaView_VERSION_PATCH} + 1")
  set(next_version "${ParaView_VERSION_MAJOR}.${ParaView_VERSION_MINOR}.${next_patch}")

  set(CPACK_GENERATOR DEB)
  set(CPACK_PACKAGE_NAME paraview-high-order-particles)
  set(CPACK_PACKAGE_CONTACT "The authors of ${PROJECT_NAME} <unknown@localhost>")
  set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Exact isosurfaces of high-order finite elements for ParaView")
  set(CPACK_RESOURCE_FILE_LICENSE "${PROJECT_SOURCE_DIR}/LICENSE")
  set(CPACK_PACKAGING_INSTALL_PREFIX "${ParaView_PREFIX_PATH}")
  set(CPACK_STRIP_FILES ON)
  set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
  set(CPACK_DEBIAN_PACKAGE_SECTION science)
  set(CPACK_DEBIAN_PACKAGE_DEPENDS "paraview (>= ${ParaView_VERSION}), paraview (<< ${next_version}~)")
  set(CPACK_DEBIAN_PACKAGE_RECOMMENDS python3-paraview)
  set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA "${scripts}")
  set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
  # What registers the plugin on `cmake --install` ran for the package's folder, too.
  file(WRITE "${PROJECT_BINARY_DIR}/debian/unlist.cmake"
    "file(REMOVE \"\${CPACK_TEMPORARY_INSTALL_DIRECTORY}${listing}\")\n")
  set(CPACK_PRE_BUILD_SCRIPTS "${PROJECT_BINARY_DIR}/debian/unlist.cmake")
  include(CPack)
endfunction ()
