#include "frangia/editor/internal/select_by_outline.h"

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/error.h"
#include "frangia/core/parallel.h"
#include "frangia/geometry/ray_scene.h"

namespace frangia {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr std::size_t kOutlineChunk = 4096;

/// Projection from the eye to a plane at distance 1.
class OutlinePlane {
 public:
  explicit OutlinePlane(const ViewedOutline& outline) : eye_mm_(outline.eye_mm) {
    require(outline.corners_mm.size() >= 3, "an outline has at least 3 corners; draw a larger one");
    Vector3d sum = Vector3d::Zero();
    for (const Vector3d& corner : outline.corners_mm)
      sum += (corner - eye_mm_).normalized();
    constexpr double kShortest = 1e-9;  // the directions cancel, or a corner is the eye
    require(sum.allFinite() && sum.norm() > kShortest,
            "the corners of the outline lie around the eye; move the eye away from them");
    axis_ = sum.normalized();
    across_ = axis_.unitOrthogonal();
    up_ = axis_.cross(across_);
    for (const Vector3d& corner : outline.corners_mm) {
      require((corner - eye_mm_).dot(axis_) > 0.0,
              "a corner of the outline lies behind the eye; draw a smaller outline");
      corners_.push_back(project(corner));
      box_.extend(corners_.back());
    }
    constexpr double kRoundingOfRays = 1e-4;  // Embree searches in single precision
    const Vector2d margin = Vector2d::Constant(kRoundingOfRays * box_.sizes().maxCoeff());
    wide_ = {box_.min() - margin, box_.max() + margin};
  }

  /// Whether a triangle may hide something within the outline: it is not beside the box of it.
  [[nodiscard]] bool may_hide(const Vector3d& a, const Vector3d& b, const Vector3d& c) const {
    Eigen::AlignedBox2d box;
    int before = 0;
    for (const Vector3d* corner : {&a, &b, &c}) {
      if (!((*corner - eye_mm_).dot(axis_) > 0.0)) continue;
      ++before;
      box.extend(project(*corner));
    }
    constexpr int kCorners = 3;
    if (before < kCorners) return before > 0;
    return box.intersects(wide_);
  }

  /// Whether a point is in front of the eye and appears within the outline.
  [[nodiscard]] bool contains(const Vector3d& point_mm) const {
    if (!((point_mm - eye_mm_).dot(axis_) > 0.0)) return false;
    const Vector2d p = project(point_mm);
    if (!box_.contains(p)) return false;
    bool inside = false;
    for (std::size_t i = 0, j = corners_.size() - 1; i < corners_.size(); j = i++) {
      const Vector2d& a = corners_[i];
      const Vector2d& b = corners_[j];
      if ((a.y() > p.y()) == (b.y() > p.y())) continue;
      if (p.x() < a.x() + (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y())) inside = !inside;
    }
    return inside;
  }

 private:
  [[nodiscard]] Vector2d project(const Vector3d& point_mm) const {
    const Vector3d d = point_mm - eye_mm_;
    return Vector2d(d.dot(across_), d.dot(up_)) / d.dot(axis_);
  }

  Vector3d eye_mm_;
  Vector3d axis_, across_, up_;
  std::vector<Vector2d> corners_;
  Eigen::AlignedBox2d box_, wide_;
};

/// The triangles between the eye and the outline, without the others, for which a search structure
/// would take longest to build.
struct Occluders {
  std::vector<std::uint32_t> triangle;  ///< in the whole mesh
  Mesh mesh;
};

Occluders occluders_of(const Mesh& mesh, const OutlinePlane& plane) {
  Selection near(mesh.triangles.size());
  const auto corner = [&](std::uint32_t vertex) {
    return Vector3d(mesh.vertices_mm[vertex].cast<double>());
  };
  parallel_chunks(near.size(), kOutlineChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto& [a, b, c] = mesh.triangles[i];
      near[i] = plane.may_hide(corner(a), corner(b), corner(c)) ? 1 : 0;
    }
  });
  Occluders part;
  part.mesh.vertices_mm = mesh.vertices_mm;
  for (std::uint32_t i = 0; i < near.size(); ++i) {
    if (near[i] == 0) continue;
    part.triangle.push_back(i);
    part.mesh.triangles.push_back(mesh.triangles[i]);
  }
  return part;
}

}  // namespace

Selection select_by_outline(const Mesh& mesh,
                            const ViewedOutline& outline,
                            bool visible_only,
                            const Run& run) {
  const OutlinePlane plane(outline);
  Selection selection(mesh.triangles.size());
  const auto corner = [&](std::uint32_t vertex) {
    return Vector3d(mesh.vertices_mm[vertex].cast<double>());
  };
  parallel_chunks(selection.size(), kOutlineChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto& [a, b, c] = mesh.triangles[i];
      selection[i] = plane.contains((corner(a) + corner(b) + corner(c)) / 3.0) ? 1 : 0;
    }
  });
  if (!visible_only || count_selected(selection) == 0) return selection;
  run.check();
  Occluders part = occluders_of(mesh, plane);
  const RayScene scene(std::move(part.mesh), run);
  parallel_chunks(selection.size(), kOutlineChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (selection[i] == 0) continue;
      const auto& [a, b, c] = mesh.triangles[i];
      const Vector3d centroid = (corner(a) + corner(b) + corner(c)) / 3.0;
      const Vector3d to_eye = outline.eye_mm - centroid;
      if (!((corner(b) - corner(a)).cross(corner(c) - corner(a)).dot(to_eye) > 0.0)) {
        selection[i] = 0;
        continue;
      }
      // The first surface on the way from the eye is the triangle itself, up to rounding.
      constexpr double kRounding = 1e-5;
      const auto hit = scene.first_hit(outline.eye_mm, -to_eye);
      selection[i] =
          hit && part.triangle[hit->triangle] != i && hit->distance < 1.0 - kRounding ? 0 : 1;
    }
  });
  return selection;
}

}  // namespace frangia
