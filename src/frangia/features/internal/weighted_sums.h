#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "frangia/features/feature_points.h"
#include "frangia/features/shape.h"

namespace frangia {

using ParameterVector = Eigen::Matrix<double, 7, 1>;
using ParameterMatrix = Eigen::Matrix<double, 7, 7>;

/// Weights of points in a fit, without the robust factor: one over a variance in mm^2, or 1.
class PointWeights {
 public:
  explicit PointWeights(const FeaturePoints& points, std::span<const std::uint32_t> chosen);

  [[nodiscard]] double of(std::uint32_t point) const {
    if (noise_ == nullptr) return 1.0;
    const double noise = (*noise_)[point];
    return 1.0 / (noise * noise + usual_variance_);
  }
  /// Standard deviation of a residual of weight 1; 0 when no noise is known.
  [[nodiscard]] double unit_weight_sigma() const { return noise_ == nullptr ? 0.0 : 1.0; }

 private:
  const std::vector<double>* noise_ = nullptr;
  double usual_variance_ = 0.0;
};

/// Weighted sums over the residuals of some points.
struct ShapeSums {
  ParameterMatrix hessian = ParameterMatrix::Zero();   ///< of w J J^T
  ParameterVector gradient = ParameterVector::Zero();  ///< of w J r
  ParameterVector shared = ParameterVector::Zero();    ///< of w J s, s the systematic part
  ParameterMatrix noise = ParameterMatrix::Zero();     ///< of w^2 n^2 J J^T, n the noise
  double weight = 0.0;                                 ///< of w
  double slope = 0.0;     ///< of the derivative of w r, see `tukey_slope`
  std::size_t count = 0;  ///< of points within the gate
  double squares = 0.0;   ///< of their residuals
  double low = 0.0;       ///< smallest residual within the gate
  double high = 0.0;      ///< largest

  void add(const ShapeSums& other);
  /// By how much the robust weights understate a standard uncertainty; 1 without them.
  [[nodiscard]] double robust_factor() const;
};

/// Whether a point has a weight above 0, and its terms. A gate of infinity weights all points
/// alike.
void add_point(ShapeSums& sums,
               const FeaturePoints& points,
               std::uint32_t point,
               const Shape& shape,
               const PointWeights& weights,
               double gate_mm,
               bool robust);

}  // namespace frangia
