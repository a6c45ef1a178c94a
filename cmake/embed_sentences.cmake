# frangia_embed_sentences(<target> <folder>): compiles the rows of the sentences of the library in the languages of the app,
# faults_*.ts, into a target, for fault_sources(): a report says them in the language of its reader, as the app does.
function(frangia_embed_sentences target folder)
  file(GLOB sources CONFIGURE_DEPENDS ${folder}/faults_*.ts)
  set(entries "")
  foreach(source IN LISTS sources)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${source})
    file(READ ${source} text)
    string(APPEND entries "    R\"rows(${text})rows\",\n")
  endforeach()
  set(output ${CMAKE_CURRENT_BINARY_DIR}/fault_sources.cpp)
  file(CONFIGURE OUTPUT ${output} @ONLY CONTENT [[
#include "frangia/report/internal/fault_rows.h"

namespace frangia::report {

const std::vector<std::string_view>& fault_sources() {
  static const std::vector<std::string_view> all = {
@entries@  };
  return all;
}

}  // namespace frangia::report
]])
  target_sources(${target} PRIVATE ${output})
endfunction()
