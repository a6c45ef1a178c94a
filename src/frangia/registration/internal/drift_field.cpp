#include "frangia/registration/internal/drift_field.h"

#include <algorithm>
#include <cmath>

#include "frangia/core/linear_algebra.h"

namespace frangia {
namespace {

/// 1, the products of up to three coordinates of a place.
constexpr Eigen::Index kTerms = 20;
using Terms = Eigen::Matrix<double, kTerms, 1>;

Terms terms_of(const Eigen::Vector3d& at) {
  const double x = at.x();
  const double y = at.y();
  const double z = at.z();
  Terms terms;
  terms << 1.0, x, y, z, x * x, x * y, x * z, y * y, y * z, z * z, x * x * x, x * x * y, x * x * z,
      x * y * y, x * y * z, x * z * z, y * y * y, y * y * z, y * z * z, z * z * z;
  return terms;
}

}  // namespace

DriftField::DriftField(const PointDrift& drift,
                       const Pattern& pattern,
                       const std::vector<SurfelMap::Surfel>& surfels) {
  constexpr std::size_t kSome = 400;  // surfels that show the polynomials
  constexpr double kRidge = 1e-9;     // of the normal equations, where the places lie in a plane
  coefficients_ = Eigen::MatrixXf::Zero(3 * drift.count(), kTerms);
  const std::size_t every = surfels.size() / kSome + 1;
  std::vector<Eigen::Vector3d> points;
  std::vector<PointDrift::Derivative> derivatives;
  for (std::size_t i = 0; i < surfels.size(); i += every) {
    const Eigen::Vector3d point = surfels[i].point_mm.cast<double>();
    PointDrift::Derivative by = drift.of(point, pattern);
    if (by.isZero(0.0F)) continue;
    points.push_back(point);
    derivatives.push_back(std::move(by));
  }
  if (points.empty()) return;
  for (const Eigen::Vector3d& point : points)
    center_mm_ += point / static_cast<double>(points.size());
  double largest = 0.0;
  for (const Eigen::Vector3d& point : points)
    largest = std::max(largest, (point - center_mm_).norm());
  if (largest > 0.0) radius_mm_ = largest;
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(kTerms, kTerms);
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(kTerms, coefficients_.rows());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Terms terms = terms_of((points[i] - center_mm_) / radius_mm_);
    normal += terms * terms.transpose();
    right += terms * derivatives[i].reshaped().cast<double>().transpose();
  }
  normal.diagonal().array() += kRidge * normal.trace();
  coefficients_ = solve_symmetric_columns(normal, right).transpose().cast<float>();
}

PointDrift::Derivative DriftField::of(const Eigen::Vector3d& point_mm) const {
  PointDrift::Derivative by(3, coefficients_.rows() / 3);
  const Terms terms = terms_of((point_mm - center_mm_) / radius_mm_);
  by.reshaped().noalias() = coefficients_ * terms.cast<float>();
  return by;
}

}  // namespace frangia
