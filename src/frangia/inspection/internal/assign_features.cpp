#include "frangia/inspection/internal/assign_features.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>

#include "frangia/inspection/internal/shape_mismatch.h"

namespace frangia::inspection {
namespace {

/// Distance of a planned place from where the points of a feature are, its axis among them; 0
/// within their box.
double off_mm(const PlannedFeature& planned, const MeasuredFeature& measured) {
  const Shape& shape = measured.feature.fit.shape;
  Eigen::AlignedBox3d box(shape.center_mm);
  for (const Eigen::Vector3d& point : measured.points_mm)
    box.extend(point);
  for (const double along_mm : {measured.low_mm, measured.high_mm})
    box.extend(Eigen::Vector3d(shape.center_mm + along_mm * shape.axis));
  return box.exteriorDistance(planned.near_mm);
}

/// Whether a feature is what a plan describes, within `slack_mm`, and not only the nearest to it.
bool is_meant(const PlannedFeature& planned, const MeasuredFeature& measured, double slack_mm) {
  const Shape& shape = measured.feature.fit.shape;
  if (measured.points_mm.empty()) return shape_mismatch_mm(planned, shape) <= slack_mm;
  const bool of_size =
      !planned.diameter_mm || std::abs(2.0 * shape.radius_mm - *planned.diameter_mm) <= slack_mm;
  return of_size && off_mm(planned, measured) <= slack_mm;
}

}  // namespace

std::function<bool(const Shape&)> planned_shapes(std::vector<PlannedFeature> planned,
                                                 const Mesh& mesh) {
  constexpr double kSlack = 0.01;  // of the diagonal of the part
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3f& vertex : mesh.vertices_mm)
    if (vertex.allFinite()) box.extend(vertex.cast<double>());
  if (planned.empty() || box.isEmpty()) return {};
  const double slack_mm = kSlack * box.diagonal().norm();
  return [planned = std::move(planned), slack_mm](const Shape& shape) {
    return std::any_of(planned.begin(), planned.end(), [&](const PlannedFeature& one) {
      return one.kind == shape.kind && shape_mismatch_mm(one, shape) <= slack_mm;
    });
  };
}

std::vector<AssignedFeature> assign_features(const std::vector<PlannedFeature>& planned,
                                             const std::vector<MeasuredFeature>& measured,
                                             double farthest_mm) {
  constexpr double kSlack = 0.1;  // of the farthest: 1 % of the diagonal of the part
  const double slack_mm = kSlack * farthest_mm;
  std::vector<AssignedFeature> assigned(planned.size());
  std::vector<double> mismatch_mm(planned.size(), farthest_mm);
  for (std::size_t i = 0; i < planned.size(); ++i) {
    for (const MeasuredFeature& one : measured) {
      const Shape& shape = one.feature.fit.shape;
      if (shape.kind != planned[i].kind) continue;
      const double mismatch = shape_mismatch_mm(planned[i], shape);
      if (mismatch >= mismatch_mm[i]) continue;
      mismatch_mm[i] = mismatch;
      assigned[i].measured = &one;
    }
  }
  const std::vector<AssignedFeature> nearest = assigned;
  for (std::size_t i = 0; i < planned.size(); ++i) {
    const MeasuredFeature* const one = nearest[i].measured;
    if (one == nullptr) continue;
    std::size_t owner = i;
    for (std::size_t k = 0; k < planned.size(); ++k) {
      if (nearest[k].measured == one && mismatch_mm[k] < mismatch_mm[owner]) owner = k;
    }
    if (owner != i && !is_meant(planned[i], *one, slack_mm)) {
      assigned[i] = {nullptr, &planned[owner], 0.0};
    } else if (!one->points_mm.empty()) {
      const double off = off_mm(planned[i], *one);
      if (off > slack_mm) assigned[i].off_mm = off;
    }
  }
  return assigned;
}

}  // namespace frangia::inspection
