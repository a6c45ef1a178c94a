#pragma once

#include <span>
#include <string>
#include <vector>

#include "frangia/align/internal/fit_pose.h"

namespace frangia {

/// A motion of a mesh on a reference that changes the fit by nothing.
struct FreeMotion {
  Eigen::Matrix<double, 6, 1> twist;  ///< unit; as of `motion_of`
  Eigen::Vector3d center;
  double lever_mm = 1.0;

  /// The motion by an RMS displacement of the samples of about `s_mm`.
  [[nodiscard]] Eigen::Isometry3d by(double s_mm) const {
    return motion_of(s_mm * twist, center, lever_mm);
  }
  [[nodiscard]] std::string text() const;  ///< "rotation about ...", "translation along ..."
};

/// Share of the samples that lie within a distance of the reference, with a normal like its own.
[[nodiscard]] double share_within(std::span<const MeasuredSample> samples,
                                  const FindFoot& find_foot,
                                  const Eigen::Isometry3d& pose,
                                  double within_mm);

/// The motions that the shape does not determine: after a finite motion along each weak direction
/// of the fit, and a fit from there, the mesh has stayed where it was moved to and fits as well.
[[nodiscard]] std::vector<FreeMotion> free_motions(std::span<const MeasuredSample> samples,
                                                   const FindFoot& find_foot,
                                                   const PoseFit& fit,
                                                   double within_mm,
                                                   const Run& run);

/// Whether free motions lead from one pose to within `near_mm` of another.
[[nodiscard]] bool is_reached(std::span<const MeasuredSample> samples,
                              const std::vector<FreeMotion>& motions,
                              const Eigen::Isometry3d& from,
                              const Eigen::Isometry3d& to,
                              double near_mm);

}  // namespace frangia
