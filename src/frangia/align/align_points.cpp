#include "frangia/align/align_points.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/core/linear_algebra.h"
#include "frangia/core/rigid_motion.h"
#include "frangia/core/statistics.h"

namespace frangia {
namespace {

using Eigen::Matrix3Xd;
using Eigen::Vector3d;

/// Clicks on a part miss each other by a few percent of its size; a pair of two places by more.
constexpr double kMostMismatch = 0.1;  // of the largest distance of two points
constexpr double kMostScale = 1.25;    // of the distances of the points
constexpr double kOnALine = 1e-3;      // narrowest over widest variance of the points in a plane

struct PointSpread {
  double rms_mm = 0.0;   ///< from the center
  bool on_line = false;  ///< they do not determine a rotation
};

PointSpread spread_of(const Matrix3Xd& points) {
  const Vector3d center = points.rowwise().mean();
  const Matrix3Xd from_center = points.colwise() - center;
  const Eigen::MatrixXd moments = from_center * from_center.transpose();
  const auto eigen = symmetric_eigen(moments);  // ascending
  return {std::sqrt(moments.trace() / static_cast<double>(points.cols())),
          !(eigen.values[1] > kOnALine * eigen.values[2])};
}

double widest_of(const Matrix3Xd& points) {
  double widest = 0.0;
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    for (Eigen::Index k = 0; k < i; ++k)
      widest = std::max(widest, (points.col(i) - points.col(k)).norm());
  return widest;
}

void check_pairs(const Matrix3Xd& scan, const Matrix3Xd& reference) {
  const PointSpread measured = spread_of(scan);
  const PointSpread nominal = spread_of(reference);
  if (measured.on_line || nominal.on_line) {
    throw Error(ErrorKind::Input,
                fmt::format("points: those of the {} lie on one line, about which the part could "
                            "turn; choose a point off that line",
                            nominal.on_line ? "reference" : "scan"));
  }
  const double scale = nominal.rms_mm / measured.rms_mm;
  if (scale > kMostScale || scale < 1.0 / kMostScale) {
    throw Error(ErrorKind::Input,
                fmt::format("points: those of the reference are {:.4g} times as far apart as those "
                            "of the scan; choose the same places, or state the unit of the "
                            "reference by `units`",
                            scale));
  }
}

/// Covariance of a rotation about the center of the reference's points and of a translation.
PoseUncertainty uncertainty_of(const Matrix3Xd& reference, const std::vector<double>& distances) {
  const auto count = static_cast<double>(distances.size());
  const double degrees = 3.0 * count - 6.0;
  double squares = 0.0;
  for (const double distance : distances)
    squares += distance * distance;
  PoseUncertainty uncertainty;
  uncertainty.center_mm = reference.rowwise().mean();
  Eigen::Matrix3d rotations = Eigen::Matrix3d::Zero();
  for (Eigen::Index i = 0; i < reference.cols(); ++i) {
    const Vector3d arm = reference.col(i) - uncertainty.center_mm;
    rotations += arm.squaredNorm() * Eigen::Matrix3d::Identity() - arm * arm.transpose();
  }
  const double student = student_95(degrees) / kNormal95;
  const double variance = student * student * squares / degrees;
  uncertainty.covariance.topLeftCorner<3, 3>() = variance * rotations.inverse();
  uncertainty.covariance.bottomRightCorner<3, 3>() = variance / count * Eigen::Matrix3d::Identity();
  return uncertainty;
}

}  // namespace

PointAlignment align_to_points(std::span<const PointPair> pairs) {
  if (pairs.size() < 3) {
    throw Error(ErrorKind::Input,
                fmt::format("points: there {} {}, and an alignment needs three pairs or more",
                            pairs.size() == 1 ? "is" : "are",
                            pairs.size()));
  }
  const auto count = static_cast<Eigen::Index>(pairs.size());
  Matrix3Xd scan(3, count);
  Matrix3Xd reference(3, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const PointPair& pair = pairs[static_cast<std::size_t>(i)];
    require(pair.scan_mm.allFinite() && pair.reference_mm.allFinite(),
            "points: coordinates must be finite numbers");
    scan.col(i) = pair.scan_mm;
    reference.col(i) = pair.reference_mm;
  }
  check_pairs(scan, reference);
  PointAlignment found;
  found.reference_from_mesh = rigid_motion(scan, reference);
  std::size_t worst = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    found.distances_mm.push_back(
        (found.reference_from_mesh * pairs[i].scan_mm - pairs[i].reference_mm).norm());
    if (found.distances_mm[i] > found.distances_mm[worst]) worst = i;
  }
  if (found.distances_mm[worst] > kMostMismatch * widest_of(reference)) {
    throw Error(ErrorKind::Input,
                fmt::format("points: pair {} does not match the others: its points are {:.3g} mm "
                            "apart after the best motion; choose the same places on both",
                            worst + 1,
                            found.distances_mm[worst]));
  }
  found.uncertainty = uncertainty_of(reference, found.distances_mm);
  return found;
}

}  // namespace frangia
