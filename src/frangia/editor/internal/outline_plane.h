#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/error.h"
#include "frangia/editor/internal/select_by_outline.h"

namespace frangia {

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

}  // namespace frangia
