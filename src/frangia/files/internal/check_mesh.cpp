#include "frangia/files/internal/check_mesh.h"

#include <array>
#include <fstream>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/error.h"

namespace frangia {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& why) {
  throw Error(ErrorKind::Input, fmt::format("{}: {}", path.string(), why));
}

void check_finite(const std::vector<Eigen::Vector3f>& vectors,
                  const char* what,
                  const std::filesystem::path& path) {
  for (std::size_t i = 0; i < vectors.size(); ++i) {
    const Eigen::Vector3f& v = vectors[i];
    if (v.allFinite()) continue;
    refuse(path,
           fmt::format("{} {} (counted from 0) is {} {} {}, which is not finite; remove it",
                       what,
                       i,
                       v.x(),
                       v.y(),
                       v.z()));
  }
}

/// Damaged numbers are often huge. Squares of distances beyond this one do not fit into float.
void check_near(const std::vector<Eigen::Vector3f>& vertices_mm,
                const std::filesystem::path& path) {
  constexpr float kFarthest_mm = 1e15F;
  for (std::size_t i = 0; i < vertices_mm.size(); ++i) {
    const Eigen::Vector3f& v = vertices_mm[i];
    if (v.cwiseAbs().maxCoeff() <= kFarthest_mm) continue;
    refuse(path,
           fmt::format("vertex {} (counted from 0) is {} {} {}, farther away than any part can be; "
                       "remove it",
                       i,
                       v.x(),
                       v.y(),
                       v.z()));
  }
}

}  // namespace

void check_mesh(const Mesh& mesh, const std::filesystem::path& path) {
  const std::size_t count = mesh.vertices_mm.size();
  check_finite(mesh.vertices_mm, "vertex", path);
  check_near(mesh.vertices_mm, path);
  check_finite(mesh.normals, "normal", path);
  const auto check_count = [&](std::size_t has, const char* what) {
    if (has != 0 && has != count) {
      refuse(path,
             fmt::format("{} {} for {} vertices; give one per vertex, or none", has, what, count));
    }
  };
  check_count(mesh.normals.size(), "normals");
  check_count(mesh.sigma_mm.size(), "values of sigma_mm");
  check_count(mesh.sigma_noise_mm.size(), "values of sigma_noise_mm");
  check_count(mesh.sigma_systematic_mm.size(), "values of sigma_systematic_mm");
  check_count(mesh.views.size(), "counts of views");
  check_count(mesh.colors.size(), "colors");
  check_count(mesh.vertex_marks.size(), "marks");
  if (!mesh.triangle_marks.empty() && mesh.triangle_marks.size() != mesh.triangles.size()) {
    refuse(path,
           fmt::format("{} marks for {} triangles; give one per triangle, or none",
                       mesh.triangle_marks.size(),
                       mesh.triangles.size()));
  }
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    for (const std::uint32_t corner : mesh.triangles[i]) {
      if (corner < count) continue;
      refuse(path,
             fmt::format("triangle {} refers to vertex {}, counted from 0, of only {}; "
                         "export the mesh again",
                         i,
                         corner,
                         count));
    }
  }
}

void check_triangles(const Mesh& mesh, const std::filesystem::path& path) {
  check_mesh(mesh, path);
  if (!mesh.triangles.empty()) return;
  refuse(path, "there is no triangle to write; write points as .ply, .obj, .xyz or .pcd");
}

namespace {

struct Kind {
  std::string_view begin;
  const char* sentence;
};

constexpr std::array<Kind, 10> kKinds{{
    {"\x1F\x8B", "it is compressed by gzip; unpack it with gunzip"},
    {"PK\x03\x04", "it is a zip archive; unpack it, and name the file inside"},
    {"BZh", "it is compressed by bzip2; unpack it with bunzip2"},
    {std::string_view("\xFD\x37zXZ\0", 6), "it is compressed by xz; unpack it with unxz"},
    {"\x28\xB5\x2F\xFD", "it is compressed by zstd; unpack it with unzstd"},
    {"7z\xBC\xAF\x27\x1C", "it is a 7z archive; unpack it, and name the file inside"},
    {"Rar!\x1A", "it is a RAR archive; unpack it, and name the file inside"},
    {"AC10", "it is a DWG drawing; save it as a text (ASCII) DXF"},
    {"ISO-10303-21", "it is a STEP file; name it .step, and use it as a reference"},
    {"%PDF", "it is a PDF; export the mesh itself"},
}};

}  // namespace

std::string other_kind_of(std::string_view head) {
  for (const Kind& kind : kKinds)
    if (head.starts_with(kind.begin)) return kind.sentence;
  return {};
}

std::string other_kind_of_file(const std::filesystem::path& path) {
  std::array<char, 16> head{};
  std::ifstream file(path, std::ios::binary);
  file.read(head.data(), head.size());
  return other_kind_of({head.data(), static_cast<std::size_t>(file.gcount())});
}

}  // namespace frangia
