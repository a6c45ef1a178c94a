# frangia_module(<name> [USES <module>...] [LIBS <target>...] [PRIVATE_LIBS <target>...])
# Static library frangia::<name> from src/frangia/<name>/*.cpp; header-only when it has none.
# PRIVATE_LIBS are included by sources only, so that their headers stay out of ours.
# What nearly every source includes is parsed once, with the first module.
set(FRANGIA_COMMON_HEADERS
  <algorithm> <array> <cmath> <cstdint> <filesystem> <functional> <memory> <string> <vector>
  <Eigen/Core> <Eigen/Geometry> <fmt/format.h>)
function(frangia_module name)
  cmake_parse_arguments(ARG "" "" "USES;LIBS;PRIVATE_LIBS" ${ARGN})
  set(dir ${PROJECT_SOURCE_DIR}/src/frangia/${name})
  file(GLOB sources CONFIGURE_DEPENDS ${dir}/*.cpp)
  file(GLOB headers CONFIGURE_DEPENDS ${dir}/*.h)
  list(TRANSFORM ARG_USES PREPEND "frangia::")
  if(sources)
    add_library(frangia_${name} STATIC ${sources})
    set(scope PUBLIC)
    if(name STREQUAL core)
      target_precompile_headers(frangia_core PRIVATE ${FRANGIA_COMMON_HEADERS})
    else()
      target_precompile_headers(frangia_${name} REUSE_FROM frangia_core)
    endif()
    target_link_libraries(frangia_${name} PRIVATE frangia::build_flags ${ARG_PRIVATE_LIBS})
  else()
    add_library(frangia_${name} INTERFACE)
    set(scope INTERFACE)
  endif()
  add_library(frangia::${name} ALIAS frangia_${name})
  target_compile_features(frangia_${name} ${scope} cxx_std_20)
  target_sources(frangia_${name} ${scope} FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR}/src FILES ${headers})
  target_link_libraries(frangia_${name} ${scope} ${ARG_USES} ${ARG_LIBS})
endfunction()

add_library(frangia_build_flags INTERFACE)
add_library(frangia::build_flags ALIAS frangia_build_flags)
# -pthread everywhere: a precompiled header needs one set of flags.
# No fast-math: NaN means missing here. These two only drop errno and floating-point traps,
# which nobody reads and which keep loops from vectorising.
# -Wrestrict of g++ 12 sees overlaps in every "text" + string (GCC bug 105651).
# A member left out of a designated initializer has its default on purpose.
target_compile_options(frangia_build_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wold-style-cast
  -Wnon-virtual-dtor -Woverloaded-virtual -Wno-missing-field-initializers -Wno-restrict
  -pthread -Winvalid-pch -fno-math-errno -fno-trapping-math -ffp-contract=off
  $<$<BOOL:${FRANGIA_WERROR}>:-Werror>)
if(FRANGIA_SANITIZE)
  add_compile_options(-fsanitize=${FRANGIA_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${FRANGIA_SANITIZE})
  if(FRANGIA_SANITIZE STREQUAL "thread" AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # Asio has fences, which the sanitizer does not see; its locks, which it does, are enough.
    add_compile_options(-Wno-tsan)
  endif()
endif()
