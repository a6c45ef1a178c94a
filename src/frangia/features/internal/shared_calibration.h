#pragma once

#include <cmath>

#include <Eigen/Core>

#include "frangia/features/find_features.h"

namespace frangia {

/// Whether it is known what the calibration does to both features.
[[nodiscard]] inline bool knows_calibration(const ShapeUncertainty& a, const ShapeUncertainty& b) {
  return a.calibration.size() > 0 && a.calibration.cols() == b.calibration.cols();
}

/// Half the width of the 95 % interval that the calibration of the rig gives a quantity of two
/// features: each change of its parameters moves both.
template <typename Value>
[[nodiscard]] double calibration_u95(const Feature& feature,
                                     const Feature& datum,
                                     const Value& value) {
  constexpr double k95 = 1.959964;
  const Eigen::MatrixXd& changes = feature.uncertainty.calibration;
  const Eigen::MatrixXd& datum_changes = datum.uncertainty.calibration;
  const double now = value(feature.fit.shape, datum.fit.shape);
  double square = 0.0;
  for (Eigen::Index i = 0; i < changes.cols(); ++i) {
    const double then = value(moved(feature.fit.shape, changes.col(i)),
                              moved(datum.fit.shape, datum_changes.col(i)));
    square += (then - now) * (then - now);
  }
  return k95 * std::sqrt(square);
}

}  // namespace frangia
