# frangia_module(<name> [GLUE] [USES <module>...] [LIBS <target>...] [PRIVATE_LIBS <target>...]
#   [PRIVATE_HEADERS <target>...])
#
# Static library frangia::<name> from src/frangia/<name>/**.cpp; header-only when there is none.
# USES names exactly the modules whose headers the module includes: tools/check_layers.py reads the same statement.
# Headers in the folder and its subfolders are public and installed; those in internal/ are for the module and its tests.
# PRIVATE_LIBS are included by sources only, so that their headers stay out of ours; PRIVATE_HEADERS likewise, and hold
# nothing to link: a program that uses the installed library does not need them.
# GLUE: the module spends its time in others or in files and devices, and is compiled at -O1, which is faster.

# What nearly every source includes is precompiled once for the modules of each level of optimization: GCC keeps the
# level in the precompiled header, and another one on the command line has no effect.
set(FRANGIA_COMMON_HEADERS
  <algorithm> <array> <cmath> <cstdint> <filesystem> <functional> <memory> <string> <vector>
  <Eigen/Core> <Eigen/Geometry> <fmt/format.h>)

function(frangia_module name)
  cmake_parse_arguments(ARG "GLUE" "" "USES;LIBS;PRIVATE_LIBS;PRIVATE_HEADERS" ${ARGN})
  set(dir ${PROJECT_SOURCE_DIR}/src/frangia/${name})
  file(GLOB sources CONFIGURE_DEPENDS ${dir}/*.cpp ${dir}/*/*.cpp ${dir}/*/internal/*.cpp)
  file(GLOB headers CONFIGURE_DEPENDS ${dir}/*.h ${dir}/*/*.h)
  list(FILTER headers EXCLUDE REGEX "/internal/")
  if(NOT FRANGIA_CALIBRATION)  # the modules calibrate and exchange, and sources of other modules that need it
    list(FILTER sources EXCLUDE REGEX "/frangia/(calibrate/|exchange/|[a-z_]+/(internal/)?calibrate_)")
  endif()
  if(NOT FRANGIA_CAD)
    list(FILTER sources EXCLUDE REGEX "/frangia/cad/internal/occt_")
  endif()
  list(FILTER sources EXCLUDE REGEX "/frangia/cad/internal/on_demand_")
  list(TRANSFORM ARG_USES PREPEND "frangia::")
  list(TRANSFORM ARG_PRIVATE_HEADERS REPLACE "(.+)" "$<BUILD_INTERFACE:\\1>")
  if(sources)
    add_library(frangia_${name} STATIC ${sources})
    set(scope PUBLIC)
    set(headers_of frangia_core)
    if(ARG_GLUE)
      set(headers_of frangia_uncertainty)  # the first of them
      target_compile_options(frangia_${name} PRIVATE $<$<CONFIG:Release>:-O1>)
    endif()
    if(headers_of STREQUAL frangia_${name})
      target_precompile_headers(frangia_${name} PRIVATE ${FRANGIA_COMMON_HEADERS})
    else()
      target_precompile_headers(frangia_${name} REUSE_FROM ${headers_of})
    endif()
    target_link_libraries(frangia_${name} PRIVATE
      $<BUILD_INTERFACE:frangia::build_flags> ${ARG_PRIVATE_LIBS} ${ARG_PRIVATE_HEADERS})
  else()
    add_library(frangia_${name} INTERFACE)
    set(scope INTERFACE)
  endif()
  add_library(frangia::${name} ALIAS frangia_${name})
  set_target_properties(frangia_${name} PROPERTIES EXPORT_NAME ${name})
  target_compile_features(frangia_${name} ${scope} cxx_std_20)
  target_sources(frangia_${name} ${scope} FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR}/src FILES ${headers})
  target_link_libraries(frangia_${name} ${scope} ${ARG_USES} ${ARG_LIBS})
  set_property(GLOBAL APPEND PROPERTY FRANGIA_MODULES frangia_${name})
endfunction()
# frangia_cgal_sources(<module> <source without extension>...): compiles these sources of a module with CGAL.
function(frangia_cgal_sources module)
  list(TRANSFORM ARGN REPLACE "(.+)" "${PROJECT_SOURCE_DIR}/src/frangia/${module}/\\1.cpp" OUTPUT_VARIABLE paths)
  get_target_property(others frangia_${module} SOURCES)
  list(REMOVE_ITEM others ${paths})
  set_property(TARGET frangia_${module} PROPERTY SOURCES ${others})
  set(objects frangia_${module}_cgal)
  add_library(${objects} OBJECT ${paths})
  target_compile_definitions(${objects} PRIVATE FRANGIA_WITH_CGAL)
  target_compile_options(${objects} PRIVATE $<$<CONFIG:Release>:-O1>)
  if(FRANGIA_SANITIZE)  # GCC then reports uninitialized values in CGAL's headers that are none
    target_compile_options(${objects} PRIVATE -Wno-maybe-uninitialized)
  endif()
  target_include_directories(${objects} PRIVATE ${PROJECT_SOURCE_DIR}/src)
  target_compile_features(${objects} PRIVATE cxx_std_20)
  target_link_libraries(${objects} PRIVATE frangia::build_flags frangia::core CGAL::CGAL)
  target_sources(frangia_${module} PRIVATE $<TARGET_OBJECTS:${objects}>)
  target_link_libraries(frangia_${module} PRIVATE $<LINK_ONLY:CGAL::CGAL>)
endfunction()

add_library(frangia_build_flags INTERFACE)
add_library(frangia::build_flags ALIAS frangia_build_flags)
# -pthread everywhere: a precompiled header needs one set of flags.
# No fast-math: NaN means missing here. These two only drop errno and floating-point traps,
# which nobody reads and which keep loops from vectorising.
# -Wrestrict of g++ 12 sees overlaps in every "text" + string (GCC bug 105651).
# A member left out of a designated initializer has its default on purpose.
# Compiled as one, a source has the unnamed namespaces of others around it: their names are no fault of a function that uses
# one of them. Compiled alone, by the dev preset, every name counts.
set(FRANGIA_WSHADOW -Wshadow)
if(CMAKE_UNITY_BUILD AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  set(FRANGIA_WSHADOW -Wshadow=local)
endif()
target_compile_options(frangia_build_flags INTERFACE
  -Wall -Wextra -Wpedantic ${FRANGIA_WSHADOW} -Wconversion -Wsign-conversion -Wold-style-cast
  -Wnon-virtual-dtor -Woverloaded-virtual -Wno-missing-field-initializers -Wno-restrict
  # More memory before the compiler collects its garbage: a tenth less time.
  $<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-expand=200 --param=ggc-min-heapsize=524288>
  -pthread -Winvalid-pch -fno-math-errno -fno-trapping-math -ffp-contract=off
  $<$<BOOL:${FRANGIA_WERROR}>:-Werror>)
if(FRANGIA_SANITIZE_MODULES)
  add_link_options(-fsanitize=${FRANGIA_SANITIZE})
elseif(FRANGIA_SANITIZE)
  add_compile_options(-fsanitize=${FRANGIA_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${FRANGIA_SANITIZE})
  # With the address sanitizer Eigen allocates by functions of its own, and would free what Eigen's code in Debian's
  # libceres.a has allocated, or the other way round.
  add_compile_definitions(EIGEN_MALLOC_ALREADY_ALIGNED=1)
  if(FRANGIA_SANITIZE STREQUAL "thread" AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # Asio has fences, which the sanitizer does not see; its locks, which it does, are enough.
    add_compile_options(-Wno-tsan)
  endif()
endif()
