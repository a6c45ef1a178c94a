#include "frangia/files/internal/polygon_faces.h"

#include <algorithm>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/files/internal/polygon_triangles.h"

namespace frangia {

void OddFaces::note(const PolygonTriangles& face, double size) {
  constexpr double kPlane = 1e-3;  // of the size of the face: below, formats round as much
  if (face.crosses) ++crossing_;
  if (!(face.off_plane > kPlane * size)) return;
  ++not_plane_;
  largest_ = std::max(largest_, face.off_plane);
}

void OddFaces::warn(const std::filesystem::path& path, double mm_per_unit, const Run& run) const {
  if (without_area_ > 0) {
    run.warn(fmt::format("{}: left out {} triangle{} with two corners at one place",
                         path.string(),
                         without_area_,
                         without_area_ == 1 ? "" : "s"));
  }
  if (not_plane_ > 0) {
    run.warn(fmt::format(
        "{}: {} of its faces with more than three corners {} not plane, by up to {:.3g} mm; their "
        "triangles are those of the projection onto the mean plane",
        path.string(),
        not_plane_,
        not_plane_ == 1 ? "is" : "are",
        mm_per_unit * largest_));
  }
  if (crossing_ > 0) {
    run.warn(fmt::format("{}: the outline of {} face{} crosses itself; export triangles instead",
                         path.string(),
                         crossing_,
                         crossing_ == 1 ? "" : "s"));
  }
}

void PolygonFaces::add(Mesh& mesh, std::span<const std::uint32_t> corners) {
  if (corners.size() > 3)
    fans_.push_back({mesh.triangles.size(), static_cast<std::uint32_t>(corners.size())});
  for (std::size_t i = 2; i < corners.size(); ++i)
    mesh.triangles.push_back({corners[0], corners[i - 1], corners[i]});
}

void PolygonFaces::triangulate(Mesh& mesh,
                               const std::filesystem::path& path,
                               const Run& run) const {
  constexpr std::size_t kPerCheck = 1024;
  constexpr std::uint32_t kMostCorners = 20'000;  // ear clipping takes the square of it
  OddFaces odd;
  std::vector<std::uint32_t> corners;
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < fans_.size(); ++i) {
    if (i % kPerCheck == 0) run.check();
    const Fan& fan = fans_[i];
    if (fan.corners > kMostCorners) {
      throw Error(ErrorKind::Input,
                  fmt::format("{}: a face has {} corners, more than {}; export triangles instead",
                              path.string(),
                              fan.corners,
                              kMostCorners));
    }
    corners = {mesh.triangles[fan.first][0], mesh.triangles[fan.first][1]};
    for (std::uint32_t k = 0; k + 2 < fan.corners; ++k)
      corners.push_back(mesh.triangles[fan.first + k][2]);
    points.clear();
    Eigen::AlignedBox3d box;
    for (const std::uint32_t corner : corners) {
      points.push_back(mesh.vertices_mm[corner].cast<double>());
      box.extend(points.back());
    }
    const PolygonTriangles found = polygon_triangles(points);
    odd.note(found, box.diagonal().norm());
    for (std::size_t k = 0; k < found.triangles.size(); ++k) {
      const auto& [a, b, c] = found.triangles[k];
      mesh.triangles[fan.first + k] = {corners[a], corners[b], corners[c]};
    }
  }
  odd.warn(path, 1.0, run);
}

}  // namespace frangia
