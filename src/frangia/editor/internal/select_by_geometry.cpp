#include "frangia/editor/internal/select_by_geometry.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/error.h"
#include "frangia/core/parallel.h"
#include "frangia/geometry/ray_scene.h"

namespace frangia {
namespace {

using Eigen::Vector3d;

template <typename IsInside>
Selection select_if(const Mesh& mesh, const IsInside& is_inside) {
  constexpr std::size_t kChunk = 16'384;
  Selection selection(mesh.triangles.size());
  parallel_chunks(selection.size(), kChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto& [a, b, c] = mesh.triangles[i];
      selection[i] = is_inside(mesh.vertices_mm[a].cast<double>(),
                               mesh.vertices_mm[b].cast<double>(),
                               mesh.vertices_mm[c].cast<double>())
                         ? 1
                         : 0;
    }
  });
  return selection;
}

}  // namespace

Selection select_by_plane(const Mesh& mesh, const Eigen::Hyperplane<double, 3>& plane) {
  return select_if(mesh, [&](const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    return plane.signedDistance((a + b + c) / 3.0) > 0.0;
  });
}

Selection select_by_box(const Mesh& mesh, const Eigen::AlignedBox3d& box_mm) {
  return select_if(mesh, [&](const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    return box_mm.contains(Vector3d((a + b + c) / 3.0));
  });
}

Selection select_by_ball(const Mesh& mesh, const Vector3d& center_mm, double radius_mm) {
  return select_if(mesh, [&](const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    return ((a + b + c) / 3.0 - center_mm).norm() <= radius_mm;
  });
}

Selection select_by_normal(const Mesh& mesh, const Vector3d& direction, double within_rad) {
  require(direction.norm() > 0.0, "the direction has no length; write one such as 0,0,1");
  const Vector3d unit = direction.normalized();
  const double min_cosine = std::cos(within_rad);
  return select_if(mesh, [&](const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    const Vector3d cross = (b - a).cross(c - a);
    const double length = cross.norm();
    return length > 0.0 && cross.dot(unit) >= min_cosine * length;
  });
}

namespace {

/// Embree searches in single precision; share of the outline.
constexpr double kRoundingOfRays = 1e-4;

/// Projection from the eye to a plane at distance 1.
class OutlinePlane {
 public:
  explicit OutlinePlane(const ViewedOutline& outline) : eye_mm_(outline.eye_mm) {
    require(outline.corners_mm.size() >= 3, "an outline has at least 3 corners; draw a larger one");
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& corner : outline.corners_mm)
      sum += (corner - eye_mm_).normalized();
    constexpr double kShortest = 1e-9;  // the directions cancel, or a corner is the eye
    require(sum.allFinite() && sum.norm() > kShortest,
            "the corners of the outline lie around the eye; move the eye away from them");
    axis_ = sum.normalized();
    across_ = axis_.unitOrthogonal();
    up_ = axis_.cross(across_);
    for (const Eigen::Vector3d& corner : outline.corners_mm) {
      require((corner - eye_mm_).dot(axis_) > 0.0,
              "a corner of the outline lies behind the eye; draw a smaller outline");
      corners_.push_back(project(corner));
      box_.extend(corners_.back());
    }
    const Eigen::Vector2d margin =
        Eigen::Vector2d::Constant(kRoundingOfRays * box_.sizes().maxCoeff());
    wide_ = {(box_.min() - margin).cast<float>(), (box_.max() + margin).cast<float>()};
  }

  [[nodiscard]] const Eigen::Vector3d& eye_mm() const { return eye_mm_; }

  /// Where a point appears, and its depth, which is not positive behind the eye.
  [[nodiscard]] Eigen::Vector3f appearance(const Eigen::Vector3d& point_mm) const {
    const double depth = (point_mm - eye_mm_).dot(axis_);
    if (!(depth > 0.0)) return {0.0F, 0.0F, -1.0F};
    const Eigen::Vector2d p = project(point_mm);
    return Eigen::Vector3d(p.x(), p.y(), depth).cast<float>();
  }

  /// The box of the outline, with a margin for rays in single precision.
  [[nodiscard]] const Eigen::AlignedBox2f& box() const { return wide_; }

  /// Whether a point is in front of the eye and appears within the outline.
  [[nodiscard]] bool contains(const Eigen::Vector3d& point_mm) const {
    if (!((point_mm - eye_mm_).dot(axis_) > 0.0)) return false;
    const Eigen::Vector2d p = project(point_mm);
    if (!box_.contains(p)) return false;
    bool inside = false;
    for (std::size_t i = 0, j = corners_.size() - 1; i < corners_.size(); j = i++) {
      const Eigen::Vector2d& a = corners_[i];
      const Eigen::Vector2d& b = corners_[j];
      if ((a.y() > p.y()) == (b.y() > p.y())) continue;
      if (p.x() < a.x() + (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y())) inside = !inside;
    }
    return inside;
  }

 private:
  [[nodiscard]] Eigen::Vector2d project(const Eigen::Vector3d& point_mm) const {
    const Eigen::Vector3d d = point_mm - eye_mm_;
    return Eigen::Vector2d(d.dot(across_), d.dot(up_)) / d.dot(axis_);
  }

  Eigen::Vector3d eye_mm_;
  Eigen::Vector3d axis_, across_, up_;
  std::vector<Eigen::Vector2d> corners_;
  Eigen::AlignedBox2d box_;
  Eigen::AlignedBox2f wide_;
};

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr std::size_t kOutlineChunk = 4096;

/// How a triangle appears.
struct Appearance {
  Eigen::AlignedBox2f box;
  float nearest = 0.0F;  ///< depth of its nearest corner
  int before = 0;        ///< corners in front of the eye
};

Appearance appearance_of(const Mesh::Triangle& triangle, const std::vector<Vector3f>& seen) {
  Appearance out{.nearest = std::numeric_limits<float>::infinity()};
  for (const std::uint32_t vertex : triangle) {
    const Vector3f& p = seen[vertex];
    if (!(p.z() > 0.0F)) continue;
    ++out.before;
    out.box.extend(p.head<2>());
    out.nearest = std::min(out.nearest, p.z());
  }
  return out;
}

/// The depth of the farthest point that may be hidden, in cells of the box of an outline.
class DepthMap {
 public:
  explicit DepthMap(const Eigen::AlignedBox2f& box)
      : low_(box.min()),
        margin_(Eigen::Vector2f::Constant(static_cast<float>(kRoundingOfRays) *
                                          box.sizes().maxCoeff())),
        per_cell_(static_cast<float>(kSide) / box.sizes().array().max(kTiny)) {}

  void add(const Vector3f& seen) {
    float& farthest = farthest_.at(index(cell(seen.head<2>())));
    farthest = std::max(farthest, seen.z());
  }

  /// Whether a triangle may be nearer than a point that was added where it appears.
  [[nodiscard]] bool may_hide(const Appearance& triangle) const {
    constexpr float kRoundingOfDepth = 1e-5F;
    const float nearest = triangle.nearest * (1.0F - kRoundingOfDepth);
    const Eigen::Array2i first = cell(triangle.box.min() - margin_);
    const Eigen::Array2i last = cell(triangle.box.max() + margin_);
    for (int y = first.y(); y <= last.y(); ++y) {
      for (int x = first.x(); x <= last.x(); ++x)
        if (nearest <= farthest_.at(index({x, y}))) return true;
    }
    return false;
  }

 private:
  static constexpr int kSide = 128;
  static constexpr float kTiny = 1e-30F;

  [[nodiscard]] Eigen::Array2i cell(const Eigen::Vector2f& p) const {
    return ((p - low_).array() * per_cell_).max(0.0F).min(kSide - 1.0F).cast<int>();
  }
  static std::size_t index(const Eigen::Array2i& cell) {
    return static_cast<std::size_t>(cell.y()) * kSide + static_cast<std::size_t>(cell.x());
  }

  Eigen::Vector2f low_, margin_;
  Eigen::Array2f per_cell_;
  std::vector<float> farthest_ = std::vector<float>(static_cast<std::size_t>(kSide) * kSide, -1.0F);
};

/// The triangles that may hide a selected one, without the others, for which a search structure
/// would take longest to build.
struct Occluders {
  std::vector<std::uint32_t> triangle;  ///< in the whole mesh
  Mesh mesh;
};

/// Keeps of a mesh the triangles whose flag is set, and the vertices that they use.
Occluders part_of(const Mesh& mesh, const Selection& kept) {
  constexpr std::uint32_t kUnused = UINT32_MAX;
  std::vector<std::uint32_t> number(mesh.vertices_mm.size(), kUnused);
  Occluders part;
  for (std::uint32_t i = 0; i < kept.size(); ++i) {
    if (kept[i] == 0) continue;
    part.triangle.push_back(i);
    Mesh::Triangle triangle = mesh.triangles[i];
    for (std::uint32_t& vertex : triangle) {
      if (number[vertex] == kUnused) {
        number[vertex] = static_cast<std::uint32_t>(part.mesh.vertices_mm.size());
        part.mesh.vertices_mm.push_back(mesh.vertices_mm[vertex]);
      }
      vertex = number[vertex];
    }
    part.mesh.triangles.push_back(triangle);
  }
  return part;
}

constexpr int kCorners = 3;

Vector3d centroid_of(const Mesh& mesh, std::size_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  return (mesh.vertices_mm[a].cast<double>() + mesh.vertices_mm[b].cast<double>() +
          mesh.vertices_mm[c].cast<double>()) /
         3.0;
}

/// Takes triangles out of the selection that others hide from the eye. `hiding`: triangles that
/// appear near the outline.
void keep_visible(const Mesh& mesh,
                  const OutlinePlane& plane,
                  const std::vector<Vector3f>& seen,
                  Selection hiding,
                  Selection& selection,
                  const Run& run) {
  const std::size_t count = mesh.triangles.size();
  DepthMap depths(plane.box());
  for (std::size_t i = 0; i < count; ++i) {
    if (selection[i] != 0) depths.add(plane.appearance(centroid_of(mesh, i)));
  }
  parallel_chunks(count, kOutlineChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (hiding[i] == 0) continue;
      const Appearance triangle = appearance_of(mesh.triangles[i], seen);
      if (triangle.before == kCorners && !depths.may_hide(triangle)) hiding[i] = 0;
    }
  });
  Occluders part = part_of(mesh, hiding);
  const RayScene scene(std::move(part.mesh), run);
  parallel_chunks(count, kOutlineChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (selection[i] == 0) continue;
      // The first surface on the way from the eye is the triangle itself, up to rounding.
      constexpr double kRoundingOfSight = 1e-5;
      const auto hit = scene.first_hit(plane.eye_mm(), centroid_of(mesh, i) - plane.eye_mm());
      selection[i] =
          hit && part.triangle[hit->triangle] != i && hit->distance < 1.0 - kRoundingOfSight ? 0
                                                                                             : 1;
    }
  });
}

}  // namespace

Selection select_by_outline(const Mesh& mesh,
                            const ViewedOutline& outline,
                            bool visible_only,
                            const Run& run) {
  const OutlinePlane plane(outline);
  const auto corner = [&](std::uint32_t vertex) {
    return Vector3d(mesh.vertices_mm[vertex].cast<double>());
  };
  std::vector<Vector3f> seen(mesh.vertices_mm.size());
  parallel_chunks(seen.size(), kOutlineChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      seen[i] = plane.appearance(mesh.vertices_mm[i].cast<double>());
  });
  const std::size_t count = mesh.triangles.size();
  Selection selection(count);
  Selection hiding(count);  // whether a triangle appears within the box of the outline
  parallel_chunks(count, kOutlineChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Appearance triangle = appearance_of(mesh.triangles[i], seen);
      const bool near =
          triangle.before < kCorners ? triangle.before > 0 : triangle.box.intersects(plane.box());
      if (!near) continue;
      hiding[i] = 1;
      const auto& [a, b, c] = mesh.triangles[i];
      const Vector3d centroid = centroid_of(mesh, i);
      const bool faces =
          (corner(b) - corner(a)).cross(corner(c) - corner(a)).dot(outline.eye_mm - centroid) > 0.0;
      selection[i] = (faces || !visible_only) && plane.contains(centroid) ? 1 : 0;
    }
  });
  if (!visible_only || count_selected(selection) == 0) return selection;
  run.check();
  run.check();
  keep_visible(mesh, plane, seen, std::move(hiding), selection, run);
  return selection;
}

}  // namespace frangia
