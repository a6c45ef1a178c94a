#include "frangia/simulate/internal/solid_builder.h"

#include <array>
#include <cmath>
#include <map>

#include <Eigen/Geometry>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/geometry/triangulate_polygon.h"

namespace frangia {

Loop circle(const Eigen::Vector3d& center, double radius, int count) {
  Loop loop;
  for (int i = 0; i < count; ++i) {
    const double angle = kTwoPi * i / count;
    loop.emplace_back(center + radius * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.0));
  }
  return loop;
}

Loop reversed(const Loop& loop) {
  return {loop.rbegin(), loop.rend()};
}

void SolidBuilder::add_face(const Loop& outer, const std::vector<Loop>& holes) {
  // Newell's normal is exact for any simple polygon, collinear points included.
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < outer.size(); ++i) {
    normal += (outer[i] - outer[0]).cross(outer[(i + 1) % outer.size()] - outer[0]);
  }
  normal.normalize();
  const Eigen::Vector3d x = normal.unitOrthogonal();
  const Eigen::Vector3d y = normal.cross(x);
  const auto flatten = [&](const Loop& loop) {
    Polygon flat;
    for (const auto& p : loop)
      flat.emplace_back(x.dot(p - outer[0]), y.dot(p - outer[0]));
    return flat;
  };
  std::vector<Eigen::Vector3d> points = outer;
  std::vector<Polygon> flat_holes;
  for (const Loop& hole : holes) {
    points.insert(points.end(), hole.begin(), hole.end());
    flat_holes.push_back(flatten(hole));
  }
  for (const auto& triangle : triangulate_polygon(flatten(outer), flat_holes)) {
    for (const std::size_t corner : triangle)
      corners_.push_back(points[corner]);
  }
}

void SolidBuilder::add_quad(const Loop& from, const Loop& to, std::size_t i, std::size_t next) {
  for (const auto& p : {from[i], from[next], to[next], from[i], to[next], to[i]})
    corners_.push_back(p);
}

void SolidBuilder::add_band(const Loop& from, const Loop& to) {
  require(from.size() == to.size(), "add_band: the two lines differ in their number of points");
  for (std::size_t i = 0; i < from.size(); ++i)
    add_quad(from, to, i, (i + 1) % from.size());
}

void SolidBuilder::add_strip(const Loop& from, const Loop& to) {
  require(from.size() == to.size(), "add_strip: the two lines differ in their number of points");
  for (std::size_t i = 0; i + 1 < from.size(); ++i)
    add_quad(from, to, i, i + 1);
}

void SolidBuilder::add_fan(const Loop& loop, const Eigen::Vector3d& tip) {
  for (std::size_t i = 0; i < loop.size(); ++i) {
    for (const auto& p : {loop[i], loop[(i + 1) % loop.size()], tip})
      corners_.push_back(p);
  }
}

Mesh SolidBuilder::build() const {
  Mesh mesh;
  std::map<std::array<float, 3>, std::uint32_t> known;
  const auto vertex_of = [&](const Eigen::Vector3d& point) {
    // Adding zero makes -0 and 0 the same point.
    const Eigen::Vector3f p = point.cast<float>() + Eigen::Vector3f::Zero();
    const auto [entry, is_new] = known.try_emplace(
        {p.x(), p.y(), p.z()}, static_cast<std::uint32_t>(mesh.vertices_mm.size()));
    if (is_new) mesh.vertices_mm.push_back(p);
    return entry->second;
  };
  for (std::size_t i = 0; i < corners_.size(); i += 3) {
    const std::uint32_t a = vertex_of(corners_[i]);
    const std::uint32_t b = vertex_of(corners_[i + 1]);
    const std::uint32_t c = vertex_of(corners_[i + 2]);
    if (a != b && b != c && c != a) mesh.triangles.push_back({a, b, c});
  }
  return mesh;
}

}  // namespace frangia
