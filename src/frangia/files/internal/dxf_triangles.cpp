#include "frangia/files/internal/dxf_triangles.h"

#include <algorithm>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "frangia/files/internal/join_soup.h"
#include "frangia/files/internal/polygon_faces.h"

namespace frangia {

using Eigen::Vector3d;

void DxfTriangles::add(const Vector3d& a, const Vector3d& b, const Vector3d& c, Mark mark) {
  const std::array<Eigen::Vector3f, 3> corners{a.cast<float>(), b.cast<float>(), c.cast<float>()};
  for (const auto& corner : corners) {
    if (!corner.allFinite()) groups_.fail("a coordinate above is not finite; remove it");
  }
  if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) {
    odd_.note_without_area(1);
    return;
  }
  corners_.insert(corners_.end(), corners.begin(), corners.end());
  marks_.push_back(mark);
}

void DxfTriangles::add_polygon(const std::vector<Vector3d>& vertices,
                               std::span<const std::size_t> corners,
                               Mark mark) {
  if (corners.size() < 3) return;
  constexpr std::size_t kMostCorners = 20'000;  // ear clipping takes the square of it
  if (corners.size() > kMostCorners)
    groups_.fail(fmt::format("the face above has more than {} corners", kMostCorners));
  std::vector<Vector3d> points;
  Eigen::AlignedBox3d box;
  for (const std::size_t corner : corners) {
    points.push_back(vertices[corner]);
    box.extend(points.back());
  }
  const PolygonTriangles found = polygon_triangles(points);
  if (corners.size() > 3) odd_.note(found, box.diagonal().norm());
  for (const auto& [a, b, c] : found.triangles)
    add(points[a], points[b], points[c], mark);
}

void DxfTriangles::add_polyface(const DxfPolyline& line) {
  std::vector<std::size_t> corners;
  for (const auto& face : line.faces) {
    corners.clear();
    for (const std::int64_t index : face) {
      if (index == 0) continue;
      const std::uint64_t number =
          index < 0 ? 0U - static_cast<std::uint64_t>(index) : static_cast<std::uint64_t>(index);
      if (number > line.vertices.size()) {
        groups_.fail(fmt::format(
            "the polyface above refers to vertex {} of only {}", number, line.vertices.size()));
      }
      corners.push_back(number - 1);
    }
    add_polygon(line.vertices, corners, line.mark);
  }
}

void DxfTriangles::add_grid(const DxfPolyline& line) {
  constexpr std::int64_t kClosedInM = 1;
  constexpr std::int64_t kClosedInN = 32;
  const std::size_t count = line.vertices.size();
  const bool fits = line.m > 1 && line.n > 1 && line.m <= 0xFFFF && line.n <= 0xFFFF &&
                    static_cast<std::size_t>(line.m * line.n) == count;
  if (!fits) {
    groups_.fail(
        fmt::format("the mesh above states {} x {} vertices but has {}", line.m, line.n, count));
  }
  const auto m = static_cast<std::size_t>(line.m);
  const auto n = static_cast<std::size_t>(line.n);
  const std::size_t rows = (line.flags & kClosedInM) != 0 ? m : m - 1;
  const std::size_t columns = (line.flags & kClosedInN) != 0 ? n : n - 1;
  for (std::size_t i = 0; i < rows; ++i) {
    for (std::size_t j = 0; j < columns; ++j) {
      const std::size_t next_row = (i + 1) % m * n;
      const std::array<std::size_t, 4> corners{
          i * n + j, next_row + j, next_row + (j + 1) % n, i * n + (j + 1) % n};
      add_polygon(line.vertices, corners, line.mark);
    }
  }
}

void DxfTriangles::add_faces(const std::vector<Vector3d>& vertices,
                             std::span<const std::int64_t> list,
                             Mark mark) {
  std::vector<std::size_t> corners;
  for (std::size_t i = 0; i < list.size();) {
    const std::int64_t count = list[i++];
    if (count < 3 || static_cast<std::uint64_t>(count) > list.size() - i) {
      groups_.fail(fmt::format("a face of the MESH above cannot have {} corners", count));
    }
    corners.clear();
    for (std::int64_t k = 0; k < count; ++k) {
      const std::int64_t index = list[i++];
      if (index < 0 || static_cast<std::uint64_t>(index) >= vertices.size()) {
        groups_.fail(fmt::format("the MESH above refers to vertex {}, counted from 0, of only {}",
                                 index,
                                 vertices.size()));
      }
      corners.push_back(static_cast<std::size_t>(index));
    }
    add_polygon(vertices, corners, mark);
  }
}

Mesh DxfTriangles::release_mesh(double mm_per_unit) {
  for (auto& corner : corners_)
    corner *= static_cast<float>(mm_per_unit);
  Mesh mesh = weld_vertices(corners_);
  const bool all_measured =
      std::all_of(marks_.begin(), marks_.end(), [](Mark mark) { return mark == Mark::Measured; });
  if (!all_measured && marks_.size() == mesh.triangles.size()) mesh.triangle_marks = marks_;
  return mesh;
}

}  // namespace frangia
