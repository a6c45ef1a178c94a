#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "frangia/core/atomic_file.h"
#include "frangia/files/lowercase_extension.h"
#include "frangia/files/mesh_formats.h"
#include "frangia/files/write_mesh.h"
#include "frangia/pipeline/finish_mesh.h"

#include "option_values.h"

namespace frangia {

/// What an -o says of the files it takes.
[[nodiscard]] inline std::string output_help() {
  return fmt::format("where to write the mesh: {}; may be given more than once", mesh_extensions());
}

/// The variants of formats that have some. `options` must outlive the verb.
inline void add_write_options(CLI::App& verb, WriteOptions& options) {
  static const std::map<std::string, DxfVariant> kVariants = {
      {"faces", DxfVariant::Faces}, {"polyface", DxfVariant::Polyface}, {"mesh", DxfVariant::Mesh}};
  verb.add_option("--dxf",
                  options.dxf.variant,
                  "DXF as faces (3DFACE, the default), polyface (POLYLINE) or mesh (MESH)")
      ->transform(named(kVariants));
  verb.add_flag("--stl-text", options.stl.ascii, "STL as text instead of binary");
}

/// Where a mesh that was measured goes, and in which variants.
struct MeshOutputs {
  std::vector<std::filesystem::path> paths;
  WriteOptions write;
  std::size_t dxf_faces = 200000;  ///< the most triangles of a DXF; 0 for all

  /// Tells before the work what could not be written after it.
  void check() const {
    for (const auto& path : paths) {
      check_mesh_extension(path);
      const AtomicFile probe(path);
    }
  }
  /// Writes every file; a DXF gets fewer triangles, and a note of `run` says how far off they are.
  void write_all(const Mesh& mesh, const Run& run) const {
    for (const auto& path : paths) {
      const bool dxf = lowercase_extension(path) == ".dxf";
      write_mesh(path, dxf ? limit_triangles(mesh, dxf_faces, run) : mesh, write, run);
    }
  }
};

/// `-o` and the options of the formats. `outputs` must outlive the verb.
inline void add_mesh_outputs(CLI::App& verb, MeshOutputs& outputs) {
  verb.add_option("-o,--output", outputs.paths, output_help())->required()->allow_extra_args(false);
  add_write_options(verb, outputs.write);
  verb.add_option("--dxf-faces",
                  outputs.dxf_faces,
                  "the most triangles that a DXF gets, simplified to it; 0 for all")
      ->check(zero_or_more())
      ->capture_default_str();
}

}  // namespace frangia
