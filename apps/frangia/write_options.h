#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "frangia/core/text.h"
#include "frangia/files/mesh_formats.h"
#include "frangia/files/write_mesh.h"
#include "frangia/reconstruct/finish_mesh.h"

#include "check_can_write.h"
#include "option_values.h"

namespace frangia {

/// The help of -o: which files it writes.
[[nodiscard]] inline std::string output_help() {
  return fmt::format("mesh file to write: {}; may be given more than once", mesh_extensions());
}

/// Adds the options that choose variants of a format. `options` must outlive the verb.
inline void add_write_options(CLI::App& verb, WriteOptions& options) {
  verb.add_option("--dxf",
                  options.dxf.variant,
                  "DXF as faces (3DFACE, the default), polyface (POLYLINE) or mesh (MESH)")
      ->transform(named<DxfVariant>());
  verb.add_flag("--stl-text", options.stl.ascii, "STL as text instead of binary");
}

/// The largest number of triangles of a finished mesh. `max_triangles` must outlive the verb.
inline void add_max_triangles(CLI::App& verb, std::size_t& max_triangles) {
  verb.add_option("--max-triangles",
                  max_triangles,
                  "simplify the mesh to at most this number of triangles; all files hold it")
      ->transform(whole_from_to(kFewestTriangles, kMostTriangles));
}

/// The files that a measured mesh is written to, and their variants.
struct MeshOutputs {
  std::vector<std::filesystem::path> paths;
  WriteOptions write;
  std::size_t dxf_faces = 200000;  ///< the most triangles of a DXF; 0: no limit

  /// Fails before the work where a file could not be written after it.
  void check() const {
    for (const auto& path : paths) {
      check_mesh_extension(path);
      check_can_write(path);
    }
  }
  /// Writes every file. A DXF is simplified to `dxf_faces`; a note of `run` names the file and
  /// the deviation.
  void write_all(const Mesh& mesh, const Run& run) const {
    for (const auto& path : paths) {
      const bool dxf = lowercase_extension(path) == ".dxf";
      Run named = run;
      named.on_note = [&run, &path](const std::string& note) {
        run.note(fmt::format("{}: {}; other formats keep all triangles", path.string(), note));
      };
      write_mesh(path, dxf ? limit_triangles(mesh, dxf_faces, named) : mesh, write, run);
    }
  }
};

/// `-o` and the options of the formats. `outputs` must outlive the verb.
inline void add_mesh_outputs(CLI::App& verb, MeshOutputs& outputs) {
  verb.add_option("-o,--output", outputs.paths, output_help())->required()->allow_extra_args(false);
  add_write_options(verb, outputs.write);
  verb.add_option("--dxf-faces",
                  outputs.dxf_faces,
                  "simplify the mesh of a DXF to this number of triangles; 0 for no limit")
      ->check(zero_or_more())
      ->capture_default_str();
}

}  // namespace frangia
