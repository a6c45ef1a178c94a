#include "frangia/files/mesh_formats.h"

#include <vector>

#include "frangia/files/dxf.h"
#include "frangia/files/ending_of.h"
#include "frangia/files/gltf.h"
#include "frangia/files/obj.h"
#include "frangia/files/off.h"
#include "frangia/files/pcd.h"
#include "frangia/files/ply.h"
#include "frangia/files/stl.h"
#include "frangia/files/three_mf.h"
#include "frangia/files/xyz.h"

namespace frangia {
namespace {

using Path = std::filesystem::path;

/// Formats whose reader has nothing to tell, and whose writer takes no options.
template <Mesh (*Read)(const Path&), void (*Write)(const Path&, const Mesh&)>
MeshFormat plain(const char* ending) {
  return {ending,
          [](const Path& path, const Run&) { return Read(path); },
          [](const Path& path, const Mesh& mesh, const WriteOptions&) { Write(path, mesh); }};
}

template <Mesh (*Read)(const Path&, const Run&), void (*Write)(const Path&, const Mesh&)>
MeshFormat telling(const char* ending) {
  return {ending, Read, [](const Path& path, const Mesh& mesh, const WriteOptions&) {
            Write(path, mesh);
          }};
}

const std::vector<MeshFormat>& formats() {
  static const std::vector<MeshFormat> kAll{
      {".dxf",
       read_dxf,
       [](const Path& path, const Mesh& mesh, const WriteOptions& options) {
         write_dxf(path, mesh, options.dxf);
       }},
      {".stl",
       [](const Path& path, const Run&) { return read_stl(path); },
       [](const Path& path, const Mesh& mesh, const WriteOptions& options) {
         write_stl(path, mesh, options.stl);
       }},
      plain<read_ply, write_ply>(".ply"),
      plain<read_obj, write_obj>(".obj"),
      telling<read_gltf, write_gltf>(".glb"),
      telling<read_gltf, write_gltf>(".gltf"),
      telling<read_3mf, write_3mf>(".3mf"),
      plain<read_off, write_off>(".off"),
      plain<read_xyz, write_xyz>(".xyz"),
      telling<read_pcd, write_pcd>(".pcd"),
  };
  return kAll;
}

}  // namespace

const MeshFormat* find_mesh_format(const Path& path) {
  const std::string ending = ending_of(path);
  for (const MeshFormat& format : formats())
    if (format.ending == ending) return &format;
  return nullptr;
}

std::string mesh_endings() {
  std::string all;
  for (std::size_t i = 0; i < formats().size(); ++i) {
    const bool last = i + 1 == formats().size();
    all += (i == 0 ? "" : last ? " or " : ", ") + formats()[i].ending;
  }
  return all;
}

}  // namespace frangia
