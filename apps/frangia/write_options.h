#pragma once

#include <map>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "frangia/files/mesh_formats.h"
#include "frangia/files/write_mesh.h"

namespace frangia {

/// What an -o says of the files it takes.
[[nodiscard]] inline std::string output_help() {
  return fmt::format("where to write the mesh: {}; may be given more than once", mesh_endings());
}

/// The variants of formats that have some. `options` must outlive the verb.
inline void add_write_options(CLI::App& verb, WriteOptions& options) {
  static const std::map<std::string, DxfVariant> kVariants = {
      {"faces", DxfVariant::Faces}, {"polyface", DxfVariant::Polyface}, {"mesh", DxfVariant::Mesh}};
  verb.add_option("--dxf",
                  options.dxf.variant,
                  "DXF as faces (3DFACE, the default), polyface (POLYLINE) or mesh (MESH)")
      ->transform(CLI::CheckedTransformer(kVariants).description(""));
  verb.add_flag("--stl-text", options.stl.ascii, "STL as text instead of binary");
}

}  // namespace frangia
