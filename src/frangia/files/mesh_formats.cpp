#include "frangia/files/mesh_formats.h"

#include <vector>

#include "frangia/core/text.h"
#include "frangia/files/dxf.h"
#include "frangia/files/internal/gltf.h"
#include "frangia/files/internal/obj.h"
#include "frangia/files/internal/off.h"
#include "frangia/files/internal/pcd.h"
#include "frangia/files/internal/three_mf.h"
#include "frangia/files/internal/xyz.h"
#include "frangia/files/ply.h"
#include "frangia/files/stl.h"

namespace frangia {
namespace {

using Path = std::filesystem::path;

/// A reader that may warn and whose files take memory in proportion to their size.
template <Mesh (*Read)(const Path&, const Run&)>
Mesh read_with_warnings(const Path& path, const ReadOptions& /*options*/, const Run& run) {
  return Read(path, run);
}

template <void (*Write)(const Path&, const Mesh&)>
void write_silently(const Path& path, const Mesh& mesh, const WriteOptions&, const Run&) {
  Write(path, mesh);
}

const std::vector<MeshFormat>& formats() {
  static const std::vector<MeshFormat> kAll{
      {".dxf",
       [](const Path& path, const ReadOptions& options, const Run& run) {
         return read_dxf(path, run, options);
       },
       [](const Path& path, const Mesh& mesh, const WriteOptions& options, const Run&) {
         write_dxf(path, mesh, options.dxf);
       }},
      {".stl",
       read_with_warnings<read_stl>,
       [](const Path& path, const Mesh& mesh, const WriteOptions& options, const Run&) {
         write_stl(path, mesh, options.stl);
       }},
      {".ply", read_with_warnings<read_ply>, write_silently<write_ply>},
      {".obj", read_with_warnings<read_obj>, write_silently<write_obj>},
      {".glb", read_gltf, write_silently<write_gltf>},
      {".gltf", read_gltf, write_silently<write_gltf>},
      {".3mf",
       read_3mf,
       [](const Path& path, const Mesh& mesh, const WriteOptions&, const Run& run) {
         write_3mf(path, mesh, run);
       }},
      {".off", read_with_warnings<read_off>, write_silently<write_off>},
      {".xyz", read_with_warnings<read_xyz>, write_silently<write_xyz>},
      {".pcd", read_with_warnings<read_pcd>, write_silently<write_pcd>},
  };
  return kAll;
}

}  // namespace

const MeshFormat* find_mesh_format(const Path& path) {
  const std::string extension = lowercase_extension(path);
  for (const MeshFormat& format : formats())
    if (format.extension == extension) return &format;
  return nullptr;
}

std::string mesh_extensions() {
  std::string all;
  for (std::size_t i = 0; i < formats().size(); ++i) {
    const bool last = i + 1 == formats().size();
    all += (i == 0 ? "" : last ? " or " : ", ") + formats()[i].extension;
  }
  return all;
}

}  // namespace frangia
