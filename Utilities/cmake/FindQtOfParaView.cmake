# Sets HOP_HAS_QT: whether code for ParaView's window can be built. Where Qt's development files are missing it cannot,
# and the plugin goes without.
set(HOP_HAS_QT OFF)
set(qt Qt5) # ParaView 5.11 does not say its version of Qt
if (PARAVIEW_QT_MAJOR_VERSION)
  set(qt "Qt${PARAVIEW_QT_MAJOR_VERSION}")
endif ()
if (PARAVIEW_USE_QT AND TARGET ParaView::pqCore)
  find_package(${qt} QUIET COMPONENTS Core Gui Widgets)
  if (${qt}_FOUND)
    set(HOP_HAS_QT ON)
    # ParaView's own lists name libraries that nothing here uses, whose development files are packages of their own.
    foreach (target IN ITEMS ParaView::pqCore ParaView::pqComponents)
      set_target_properties(${target} PROPERTIES
        INTERFACE_LINK_LIBRARIES "ParaView::RemotingServerManager;${qt}::Core;${qt}::Gui;${qt}::Widgets")
      get_target_property(configurations ${target} IMPORTED_CONFIGURATIONS)
      foreach (configuration IN LISTS configurations)
        set_target_properties(${target} PROPERTIES IMPORTED_LINK_DEPENDENT_LIBRARIES_${configuration} "")
      endforeach ()
    endforeach ()
  else ()
    message(STATUS "No ${qt} to build with: the plugin goes without what is for ParaView's window alone")
  endif ()
endif ()
