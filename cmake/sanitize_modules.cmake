# Compiles the modules of FRANGIA_SANITIZE_MODULES and their tests with sanitizers, and everything else as the release
# preset does, whose objects a compiler cache has. `apps` is the program.
foreach(module IN LISTS FRANGIA_SANITIZE_MODULES)
  set(targets frangia_${module} frangia_${module}_cgal frangia_${module}_occt frangia_${module}_module test_${module})
  if(module STREQUAL apps)
    set(targets frangia frangia_app_network test_apps)
  endif()
  foreach(target IN LISTS targets)
    if(TARGET ${target} AND NOT target STREQUAL frangia_core)  # others use its precompiled header
      target_compile_options(${target} PRIVATE -g1 -O1 -UNDEBUG -fsanitize=${FRANGIA_SANITIZE} -fno-sanitize-recover=all
        -fno-omit-frame-pointer -Wno-maybe-uninitialized)
      target_compile_definitions(${target} PRIVATE EIGEN_MALLOC_ALREADY_ALIGNED=1)
      set_target_properties(${target} PROPERTIES DISABLE_PRECOMPILE_HEADERS ON)
    endif()
  endforeach()
endforeach()
