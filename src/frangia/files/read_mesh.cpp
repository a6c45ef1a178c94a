#include "frangia/files/read_mesh.h"

#include <algorithm>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/files/internal/check_mesh.h"
#include "frangia/files/internal/join_soup.h"
#include "frangia/files/mesh_formats.h"

namespace frangia {
namespace {

/// Warns where single precision rounds coordinates by more than a ten-thousandth of the part, as of
/// scans in coordinates of a hall or a country.
void warn_of_rounding(const Mesh& mesh, const std::filesystem::path& path, const Run& run) {
  constexpr float kHalfStep = 6e-8F;  // of a number's size: 2^-24
  constexpr float kNoticeable = 1e-4F;
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& vertex : mesh.vertices_mm)
    box.extend(vertex);
  if (box.isEmpty()) return;
  const float farthest = std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
  if (!(kHalfStep * farthest > kNoticeable * box.diagonal().norm())) return;
  run.warn(fmt::format(
      "{}: it lies {:.3g} m from the origin, so that coordinates are rounded to {:.2g} mm; move it "
      "to the origin before it is saved",
      path.string(),
      1e-3F * farthest,
      2.0F * kHalfStep * farthest));
}

}  // namespace

Mesh read_mesh(const std::filesystem::path& path, const Run& run, const ReadOptions& options) {
  const MeshFormat* format = find_mesh_format(path);
  if (format == nullptr) {
    const std::string other = other_kind_of_file(path);
    throw Error(ErrorKind::Input,
                other.empty() ? fmt::format("{}: unknown mesh format; use a file that ends in {}",
                                            path.string(),
                                            mesh_extensions())
                              : fmt::format("{}: {}", path.string(), other));
  }
  Mesh mesh = join_soup(format->read(path, options, run), path, run);
  warn_of_rounding(mesh, path, run);
  return mesh;
}

Mesh read_surface(const std::filesystem::path& path, const Run& run, const ReadOptions& options) {
  Mesh mesh = read_mesh(path, run, options);
  if (mesh.triangles.empty()) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: it has {} point{} and no triangles; name a mesh with a surface",
                            path.string(),
                            mesh.vertices_mm.size(),
                            mesh.vertices_mm.size() == 1 ? "" : "s"));
  }
  return mesh;
}

}  // namespace frangia
