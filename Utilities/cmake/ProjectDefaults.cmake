# What every target of the project shares: language level, build type, warnings, where things go.
include(GNUInstallDirs)

set(CMAKE_CXX_STANDARD 17)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_CXX_VISIBILITY_PRESET hidden)
set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/bin")
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/lib")
set(CMAKE_ARCHIVE_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/lib")

if (NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif ()

option(BUILD_SHARED_LIBS "Build the VTK modules as shared libraries" ON)
option(HOP_WITH_PARAVIEW "Build the plugin for ParaView; OFF: filter and mapper for VTK alone" ON)
option(HOP_CORE_ONLY "Build the numerics and their tests alone, without VTK and ParaView" OFF)
option(HOP_GNU_VECTORS "Compute with the vector types of GCC and Clang; OFF: with plain C++, as other compilers do" ON)
option(BUILD_TESTING "Build the tests" ON)
option(BUILD_BENCHMARKS "Build the benchmarks of the numerics (needs Google Benchmark and BUILD_TESTING)" OFF)
option(WARNINGS_AS_ERRORS "Stop at the first compiler warning, as CI does" OFF)

if (BUILD_TESTING)
  enable_testing()
endif ()

# Not tried yet with MSVC: what the code takes for granted of a compiler. Files are UTF-8, names are looked up as the
# standard says, objects may have many sections (each instance of a template is one).
if (MSVC)
  add_compile_options(/utf-8 /permissive- /Zc:__cplusplus /bigobj)
  add_compile_definitions(NOMINMAX)
endif ()

# Warnings for one target of ours; ParaView's own headers are not held to them.
function (target_strict_warnings target)
  if (MSVC) # and clang-cl, to which -Wall means all warnings that there are
    target_compile_options(${target} PRIVATE /W4 $<$<BOOL:${WARNINGS_AS_ERRORS}>:/WX>)
  else ()
    target_compile_options(${target} PRIVATE -Wall -Wextra -Wshadow $<$<BOOL:${WARNINGS_AS_ERRORS}>:-Werror>)
  endif ()
endfunction ()

# precompile_headers(TARGET HEADER...): what most files of the target include is read once, which saves a fifth of the
# time of a build. Not with tests or a compiler launcher: clang-tidy does not read GCC's precompiled headers, and ccache
# keeps nothing of what uses them. So it is that every file has the includes it needs.
function (precompile_headers target)
  if (NOT BUILD_TESTING AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
    target_precompile_headers(${target} PRIVATE ${ARGN})
  endif ()
endfunction ()
