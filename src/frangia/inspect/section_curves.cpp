#include "frangia/inspect/section_curves.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "frangia/core/error.h"
#include "frangia/core/missing.h"
#include "frangia/geometry/vertex_data.h"

namespace frangia {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// The key of an edge, alike from both of its triangles.
std::uint64_t edge_key(std::uint32_t a, std::uint32_t b) {
  return std::uint64_t{std::min(a, b)} << 32U | std::max(a, b);
}

/// Cuts triangles and joins the segments at the edges that they share.
class Cutter {
 public:
  Cutter(const Mesh& mesh, const SectionPlane& plane, const std::vector<float>& values)
      : mesh_(mesh), plane_(plane), values_(values), heights_(mesh.vertices_mm.size()) {
    for (std::size_t i = 0; i < heights_.size(); ++i) {
      const Vector3d offset = mesh.vertices_mm[i].cast<double>() - plane.point_mm;
      heights_[i] = offset.dot(plane.normal);
    }
  }

  [[nodiscard]] std::vector<SectionCurve> curves() {
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
      if (mark_of(mesh_, t) != Mark::Synthesized) cut(mesh_.triangles[t]);
    std::vector<SectionCurve> curves;
    // Open curves begin at a node that no segment leads to.
    for (std::uint32_t node = 0; node < next_.size(); ++node)
      if (next_[node] != kNone && !has_previous_[node]) curves.push_back(follow(node));
    for (std::uint32_t node = 0; node < next_.size(); ++node)
      if (next_[node] != kNone) curves.push_back(follow(node));
    return curves;
  }

 private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;

  /// A vertex on the plane counts as above it, so that a cut passes through edges alone.
  [[nodiscard]] bool above(std::uint32_t vertex) const { return heights_[vertex] >= 0.0; }

  std::uint32_t node_on(std::uint32_t a, std::uint32_t b) {
    const auto [entry, is_new] =
        nodes_.try_emplace(edge_key(a, b), static_cast<std::uint32_t>(next_.size()));
    if (!is_new) return entry->second;
    if (a > b) std::swap(a, b);  // alike from both sides
    const double t = heights_[a] / (heights_[a] - heights_[b]);
    const Vector3d p = mesh_.vertices_mm[a].cast<double>();
    const Vector3d q = mesh_.vertices_mm[b].cast<double>();
    const Vector3d offset = p + t * (q - p) - plane_.point_mm;
    points_.emplace_back(offset.dot(plane_.u), offset.dot(plane_.v));
    if (!values_.empty()) {
      const auto at_a = static_cast<double>(values_[a]);
      point_values_.push_back(at_a + t * (static_cast<double>(values_[b]) - at_a));
    }
    next_.push_back(kNone);
    has_previous_.push_back(false);
    return entry->second;
  }

  void cut(const Mesh::Triangle& triangle) {
    // Counter-clockwise around a triangle, the cut runs from the edge that leads below the plane to
    // the edge that leads above it: the material is at its left.
    std::uint32_t from = kNone;
    std::uint32_t to = kNone;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = triangle.at(i);
      const std::uint32_t b = triangle.at((i + 1) % 3);
      if (above(a) == above(b)) continue;
      (above(a) ? from : to) = node_on(a, b);
    }
    if (from == kNone || to == kNone || next_[from] != kNone || has_previous_[to]) return;
    next_[from] = to;
    has_previous_[to] = true;
  }

  SectionCurve follow(std::uint32_t begin) {
    SectionCurve curve;
    std::uint32_t node = begin;
    while (node != kNone) {
      curve.points_mm.push_back(points_[node]);
      if (!values_.empty()) curve.values.push_back(point_values_[node]);
      const std::uint32_t after = next_[node];
      next_[node] = kNone;
      node = after;
      if (node == begin) {
        curve.closed = true;
        break;
      }
    }
    return curve;
  }

  const Mesh& mesh_;
  const SectionPlane& plane_;
  const std::vector<float>& values_;
  std::vector<double> heights_;
  std::unordered_map<std::uint64_t, std::uint32_t> nodes_;
  std::vector<Vector2d> points_;
  std::vector<double> point_values_;
  std::vector<std::uint32_t> next_;
  std::vector<bool> has_previous_;
};

}  // namespace

SectionPlane section_plane(const Vector3d& point_mm, const Vector3d& normal) {
  require(normal.norm() > 1e-12, "the normal of a section must not be zero");
  SectionPlane plane;
  plane.point_mm = point_mm;
  plane.normal = normal.normalized();
  // As the part stands, seen against the normal: z is up unless the plane is nearly horizontal.
  constexpr double kNearlyHorizontal = 0.9;
  const bool horizontal = std::abs(plane.normal.z()) > kNearlyHorizontal;
  const Vector3d across =
      horizontal ? Vector3d(Vector3d::UnitX()) : Vector3d(Vector3d::UnitZ().cross(plane.normal));
  plane.u = (across - across.dot(plane.normal) * plane.normal).normalized();
  plane.v = plane.normal.cross(plane.u);
  return plane;
}

std::vector<SectionCurve> section_curves(const Mesh& mesh,
                                         const SectionPlane& plane,
                                         const std::vector<float>& values) {
  require(values.empty() || values.size() == mesh.vertices_mm.size(),
          "a section needs one value for each vertex");
  std::vector<SectionCurve> curves = Cutter(mesh, plane, values).curves();
  std::stable_sort(curves.begin(), curves.end(), [](const auto& a, const auto& b) {
    return length_mm(a) > length_mm(b);
  });
  return curves;
}

double length_mm(const SectionCurve& curve) {
  double length = 0.0;
  const std::size_t count = curve.points_mm.size();
  for (std::size_t i = 0; i + 1 < count; ++i)
    length += (curve.points_mm[i + 1] - curve.points_mm[i]).norm();
  if (curve.closed && count > 1)
    length += (curve.points_mm.front() - curve.points_mm.back()).norm();
  return length;
}

double area_mm2(const std::vector<SectionCurve>& curves) {
  double doubled = 0.0;
  for (const SectionCurve& curve : curves) {
    if (!curve.closed) return kMissing;
    Vector2d before = curve.points_mm.back();
    for (const Vector2d& point : curve.points_mm) {
      doubled += before.x() * point.y() - before.y() * point.x();
      before = point;
    }
  }
  return 0.5 * doubled;
}

}  // namespace frangia
