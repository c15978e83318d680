# compile_kernels(INSTRUCTION_SET file...): these files of the directory are kernels for Baseline, Avx2 or Avx512.
# HOP_X86_KERNELS says whether the latter two are there: the target is an x86-64 processor, and the compiler is known.
#
# Kernels need full optimisation (small loops have to unroll into registers) and fused multiply-add where the processor
# has one. Loops in vector types are left as they are: the compiler's own vectorizer would only lengthen the few scalar
# ones. Vectors wider than the registers never cross a file, so their calling convention does not matter, and GCC takes
# arrays that are filled up to a run-time degree for uninitialised.
# The options for MSVC have not been tried. clang-cl takes them, too.
set(HOP_X86_KERNELS OFF)
if (MSVC)
  string(COMPARE EQUAL "${CMAKE_CXX_COMPILER_ARCHITECTURE_ID}" "x64" HOP_X86_KERNELS)
elseif (CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang" AND CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64|amd64)$")
  set(HOP_X86_KERNELS ON)
endif ()

function (compile_kernels instruction_set)
  set(options "")
  if (MSVC)
    set(options $<$<NOT:$<CONFIG:Debug>>:/O2>) # /arch:AVX2 lets it use FMA
    set(Avx2_options /arch:AVX2)
    set(Avx512_options /arch:AVX512)
  elseif (CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
    set(options $<$<NOT:$<CONFIG:Debug>>:-O3> -ffp-contract=fast -Wno-psabi)
    if (HOP_GNU_VECTORS)
      list(APPEND options -fno-tree-vectorize -fno-tree-slp-vectorize)
    endif ()
    if (CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
      list(APPEND options -Wno-maybe-uninitialized)
    endif ()
    set(Avx2_options -mavx2 -mfma)
    set(Avx512_options -mavx2 -mfma -mavx512f -mavx512dq -mavx512vl)
  endif ()
  set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS "${options};${${instruction_set}_options}"
    COMPILE_DEFINITIONS "$<$<NOT:$<BOOL:${HOP_GNU_VECTORS}>>:HOP_PORTABLE_VECTORS>"
    SKIP_PRECOMPILE_HEADERS ON) # they are for other options
endfunction ()
