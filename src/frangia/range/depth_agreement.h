#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/missing.h"

namespace frangia {

/// A point that was measured twice: by two directions of fringes or by two cameras.
struct DepthPair {
  int x = 0;  ///< pixel of the camera on whose ray the two are compared
  int y = 0;  ///< its row
  Eigen::Vector3f point_mm = Eigen::Vector3f::Zero();  ///< in the frame of that camera
  float apart_mm = 0.0F;        ///< the first minus the second, along the ray
  float sigma_mm = 0.0F;        ///< noise of the difference
  float systematic_mm = 0.0F;   ///< systematic part of the difference
  float first_rad = kMissing;   ///< absolute phases of two directions; NaN between cameras
  float second_rad = kMissing;  ///< of the second direction
};

/// How well two measurements of the same points agree. The medians leave wrong fringe orders at
/// depth edges aside.
struct DepthAgreement {
  std::size_t pixels = 0;               ///< compared
  double median_mm = kMissing;          ///< of the absolute difference; NaN without pixels
  double median_over_sigma = kMissing;  ///< of the difference over its noise; 0.67 for noise
  /// Chi squared for each degree of freedom, of the difference over noise, systematic parts and the
  /// uncertainty of the calibration, by the median; about 1 for a sound rig.
  double chi_squared = kMissing;
  /// Share of the pixels that are farther apart than `kContradiction` such combined sigmas.
  double beyond = 0.0;
  /// The uncertainty of the calibration is known and explains the difference.
  bool by_calibration = false;
  std::vector<DepthPair> samples{};  ///< some of the pixels, evenly chosen
};

/// Standard uncertainty that the calibration of the rig adds to the difference at a point; empty
/// where its covariance is not known.
using DifferenceUncertainty = std::function<double(const Eigen::Vector3d& point_mm)>;

/// Combined sigmas beyond which two measurements of a point contradict each other.
inline constexpr double kContradiction = 5.0;
/// Largest chi squared for each degree of freedom of measurements that agree.
inline constexpr double kConsistent = 3.0;

/// Measures how well pairs agree. The calibration is asked only where noise and systematic parts
/// do not explain the differences, and at some pixels only.
///
/// @units    mm
[[nodiscard]] DepthAgreement measure_agreement(std::span<const DepthPair> pairs,
                                               const DifferenceUncertainty& calibration = {});

}  // namespace frangia
