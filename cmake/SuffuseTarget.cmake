# suffuse_library(NAME common SOURCES ... [PUBLIC_LINKS ...] [PRIVATE_LINKS ...])
# A static library `suffuse_NAME` with the alias `suffuse::NAME`, our warnings and the include folder `include/`.
# suffuse_export(NAME common [HEADERS FOLDER ...]): installs it and its headers for find_package(Suffuse).

function(suffuse_compile_options target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion)
  if(SUFFUSE_WARNINGS_AS_ERRORS)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
  if(SUFFUSE_SANITIZE)
    target_compile_options(${target} PUBLIC -fsanitize=address,undefined -fno-omit-frame-pointer)
    # GCC: "sanitizers may cause spurious warnings", here within std::regex.
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
    target_link_options(${target} PUBLIC -fsanitize=address,undefined)
  endif()
  if(SUFFUSE_FUZZ)
    target_compile_options(${target} PUBLIC -fsanitize=fuzzer-no-link)
    target_link_options(${target} PUBLIC -fsanitize=fuzzer-no-link)
  endif()
endfunction()

# Headers that take most of a file's time to compile, read once for all libraries: a file then takes some 0.8 s less of 2 or 3. Off by default,
# as compilers' caches know little of it, and a file that lacks an include would pass.
# OWN HEADER...: for a target that is compiled by other options than the libraries, with headers of its own besides.
function(suffuse_precompiled_headers target)
  if(NOT SUFFUSE_PRECOMPILED_HEADERS)
    return()
  endif()
  cmake_parse_arguments(ARG "" "" "OWN" ${ARGN})
  if(target STREQUAL suffuse_common OR ARG_OWN)
    target_precompile_headers(${target} PRIVATE ${ARG_OWN} <Eigen/Dense> <fmt/format.h> <algorithm> <array> <functional> <map> <string> <vector>)
  else()
    target_precompile_headers(${target} REUSE_FROM suffuse_common)
  endif()
endfunction()

# CMAKE_UNITY_BUILD=ON, for a first build too, compiles a library's files some at a time: names in unnamed namespaces must differ within a
# library or program then. Benchmarks, fuzz tests and vector kernels are compiled file by file.
function(suffuse_library)
  cmake_parse_arguments(ARG "" "NAME" "SOURCES;PUBLIC_LINKS;PRIVATE_LINKS" ${ARGN})
  add_library(suffuse_${ARG_NAME} STATIC ${ARG_SOURCES})
  add_library(suffuse::${ARG_NAME} ALIAS suffuse_${ARG_NAME})
  target_include_directories(suffuse_${ARG_NAME} PUBLIC $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>)
  target_link_libraries(suffuse_${ARG_NAME} PUBLIC ${ARG_PUBLIC_LINKS} PRIVATE ${ARG_PRIVATE_LINKS})
  suffuse_compile_options(suffuse_${ARG_NAME})
  suffuse_precompiled_headers(suffuse_${ARG_NAME})
endfunction()

# HEADERS: folders whose headers others include by the folder's name, besides those of include/.
function(suffuse_export)
  cmake_parse_arguments(ARG "" "NAME" "HEADERS" ${ARGN})
  set(folder ${CMAKE_INSTALL_INCLUDEDIR}/suffuse-${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
  set_target_properties(suffuse_${ARG_NAME} PROPERTIES EXPORT_NAME ${ARG_NAME})
  target_include_directories(suffuse_${ARG_NAME} INTERFACE $<INSTALL_INTERFACE:${folder}>)
  install(TARGETS suffuse_${ARG_NAME} EXPORT SuffuseTargets DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT Development)
  if(EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/include)
    install(DIRECTORY include/ DESTINATION ${folder} COMPONENT Development)
  endif()
  foreach(header ${ARG_HEADERS})
    install(DIRECTORY ${header} DESTINATION ${folder} COMPONENT Development FILES_MATCHING PATTERN "*.h")
  endforeach()
endfunction()
