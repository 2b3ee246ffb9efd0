# suffuse_vector_kernels(TARGET library NAME n SOURCES ... [INCLUDES ...] [LINKS ...] [DEFINITIONS ...])
# Compiles the sources once for each instruction set that `suffuse::InstructionSet` knows, in the namespace that
# SUFFUSE_KERNEL_NAMESPACE names, and adds the objects to a library, whose other sources choose among them with
# suffuse/simd/dispatch.h. Optimised even in debug builds: they would take minutes else. Scheduled for processors that have
# these instructions, not for all x86: GCC 12 gains 7 % with AVX2 and 20 % with AVX-512 in the fluid's kernels (measured on
# Zen 4, whose own model it does not know; docs/decisions/fluid-kernels.md).
function(suffuse_vector_kernels)
  cmake_parse_arguments(ARG "" "TARGET;NAME" "SOURCES;INCLUDES;LINKS;DEFINITIONS" ${ARGN})
  set(instruction_sets portable)
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64" AND NOT SUFFUSE_PORTABLE_KERNELS)
    list(APPEND instruction_sets avx2 avx512)
    target_compile_definitions(${ARG_TARGET} PRIVATE SUFFUSE_HAVE_X86_KERNELS)
  endif()
  set(flags_avx2 -mavx2 -mfma -mtune=skylake)
  set(flags_avx512 -mavx512f -mavx512vl -mavx512dq -mavx512bw -mfma -mtune=skylake-avx512)
  foreach(instruction_set ${instruction_sets})
    set(objects suffuse_${ARG_NAME}_${instruction_set})
    add_library(${objects} OBJECT ${ARG_SOURCES})
    target_include_directories(${objects} PRIVATE ${PROJECT_SOURCE_DIR}/common/include ${ARG_INCLUDES})
    target_link_libraries(${objects} PRIVATE ${ARG_LINKS})
    suffuse_compile_options(${objects})
    target_compile_definitions(${objects} PRIVATE SUFFUSE_KERNEL_NAMESPACE=${instruction_set} ${ARG_DEFINITIONS})
    target_compile_options(${objects} PRIVATE -O3 -fno-math-errno -fno-trapping-math -fno-signed-zeros
      -ffp-contract=fast -Wno-psabi ${flags_${instruction_set}})
    set_target_properties(${objects} PROPERTIES UNITY_BUILD OFF)
    target_sources(${ARG_TARGET} PRIVATE $<TARGET_OBJECTS:${objects}>)
  endforeach()
endfunction()
