# The loader takes 70 ms to bind OpenCASCADE's libraries, three quarters of the start of a program that links them. So all of
# the module cad that needs them is compiled apart, and a program that calls frangia_cad_on_demand(<target>) loads it from
# lib/frangia/frangia_cad.so, beside its own folder, when it reads a CAD file. Other programs link it.
if(FRANGIA_CAD)
  set(cad ${PROJECT_SOURCE_DIR}/src/frangia/cad/internal)
  file(GLOB with_occt CONFIGURE_DEPENDS ${cad}/occt_*.cpp ${cad}/nominal_shape.cpp ${cad}/shared_nodes.cpp)
  get_target_property(others frangia_cad SOURCES)
  list(REMOVE_ITEM others ${with_occt})
  set_property(TARGET frangia_cad PROPERTY SOURCES ${others})
  add_library(frangia_cad_occt OBJECT ${with_occt})
  target_include_directories(frangia_cad_occt SYSTEM PRIVATE ${OpenCASCADE_INCLUDE_DIR})
  target_include_directories(frangia_cad_occt PRIVATE ${PROJECT_SOURCE_DIR}/src)
  target_compile_features(frangia_cad_occt PRIVATE cxx_std_20)
  target_link_libraries(frangia_cad_occt PRIVATE frangia::build_flags frangia::core frangia::geometry frangia::features)
  target_precompile_headers(frangia_cad_occt REUSE_FROM frangia_core)
  target_sources(frangia_cad PRIVATE $<TARGET_OBJECTS:frangia_cad_occt>)
  target_link_libraries(frangia_cad PRIVATE ${OCCT_LIBRARIES})
  target_compile_definitions(frangia_cad PRIVATE FRANGIA_WITH_CAD)

  add_library(frangia_cad_module MODULE ${cad}/on_demand_module.cpp)
  set_target_properties(frangia_cad_module PROPERTIES PREFIX "" OUTPUT_NAME frangia_cad
    LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib/frangia)
  target_link_libraries(frangia_cad_module PRIVATE frangia::build_flags frangia::cad)
  # Nothing but its one function is seen from outside.
  target_link_options(frangia_cad_module PRIVATE -Wl,--as-needed -Wl,--exclude-libs,ALL)

  add_library(frangia_cad_loader OBJECT ${cad}/on_demand_loader.cpp)
  target_compile_features(frangia_cad_loader PRIVATE cxx_std_20)
  target_link_libraries(frangia_cad_loader PRIVATE frangia::build_flags frangia::cad)
endif()

function(frangia_cad_on_demand target)
  if(FRANGIA_CAD)
    # Objects come before the library, whose own definitions are then left out, and with them OpenCASCADE.
    target_sources(${target} PRIVATE $<TARGET_OBJECTS:frangia_cad_loader>)
    target_link_libraries(${target} PRIVATE ${CMAKE_DL_LIBS})
    target_link_options(${target} PRIVATE -Wl,--as-needed)
    add_dependencies(${target} frangia_cad_module)
  endif()
endfunction()
