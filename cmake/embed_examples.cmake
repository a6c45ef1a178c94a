# frangia_embed_examples(<target> <folder>): compiles the rig files of a folder into a target, for example_rigs().
function(frangia_embed_examples target folder)
  file(GLOB examples CONFIGURE_DEPENDS ${folder}/*.toml)
  set(entries "")
  foreach(example IN LISTS examples)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${example})
    get_filename_component(name ${example} NAME_WE)
    file(READ ${example} text)
    string(APPEND entries "    {\"${name}\", R\"toml(${text})toml\"},\n")
  endforeach()
  set(output ${CMAKE_CURRENT_BINARY_DIR}/example_rigs.cpp)
  file(CONFIGURE OUTPUT ${output} @ONLY CONTENT [[
#include "frangia/service/example_rigs.h"

namespace frangia {

const std::vector<ExampleRig>& example_rigs() {
  static const std::vector<ExampleRig> all = {
@entries@  };
  return all;
}

}  // namespace frangia
]])
  target_sources(${target} PRIVATE ${output})
endfunction()
