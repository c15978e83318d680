# ParaView and the Python it was built with.
#
# A distribution's ParaView belongs to the distribution's Python, but another one (conda, pyenv, a
# virtual environment) often comes first on PATH. So the system's is taken, unless the user names a
# Python or a ParaView of their own.
if (NOT ParaView_DIR AND NOT Python3_EXECUTABLE AND NOT Python3_ROOT_DIR AND EXISTS "/usr/bin/python3")
  set(Python3_EXECUTABLE "/usr/bin/python3" CACHE FILEPATH "The Python that ParaView was built with")
endif ()
include(DebianParaView)
find_package(Python3 REQUIRED COMPONENTS Interpreter Development.Module)

# Without components every Qt module of ParaView would be asked for. Its own configuration files use
# deprecated names, which a user of this project can do nothing about.
set(CMAKE_WARN_DEPRECATED OFF)
find_package(ParaView REQUIRED COMPONENTS RemotingViews VTKExtensionsFiltersRendering)
unset(CMAKE_WARN_DEPRECATED)
message(STATUS "ParaView ${ParaView_VERSION} in ${ParaView_PREFIX_PATH}")

# The programs that come with this very ParaView: tests run in them.
find_program(PVPYTHON pvpython HINTS "${ParaView_PREFIX_PATH}/bin" NO_DEFAULT_PATH)
find_program(PVBATCH pvbatch HINTS "${ParaView_PREFIX_PATH}/bin" NO_DEFAULT_PATH)
mark_as_advanced(PVPYTHON PVBATCH)
