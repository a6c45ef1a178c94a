#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "frangia/core/run.h"
#include "frangia/range/camera_phases.h"
#include "frangia/range/depth_agreement.h"
#include "frangia/range/range_grid.h"

namespace frangia {

/// How well the cameras of a view agree.
struct CameraDisagreement : DepthAgreement {
  std::size_t fused = 0;    ///< points of all cameras that a second camera measured as well
  std::size_t removed = 0;  ///< points that a camera contradicts
};

/// Limits of `fuse_cameras`.
struct FuseCamerasOptions {
  /// Two cameras measured the same point unless their depths differ by more than this multiple of
  /// the noise and of the typical difference.
  double max_sigmas = 8.0;
  /// Uncertainty of the difference between the first camera and the second by that of the
  /// calibration; empty where it is not known.
  std::function<DifferenceUncertainty(std::size_t own, std::size_t other)> calibration{};
};

/// Improves the range grids of all cameras of a view by the phases of the other cameras.
///
/// The point of a pixel lies on its ray. Its depth follows by least squares from the phase of the
/// pixel and the phases that the other cameras see at the point: each of them is that of the
/// projector at the point, plus a systematic error that all cameras share (harmonics, step errors)
/// and noise of its own. The weights follow from both uncertainties. Without a known systematic
/// part each camera counts by its noise; where the systematic part dominates, and for a projector
/// that is a label, the difference of the cameras' phases decides, in which it cancels.
///
/// A point of a camera stays as it is where no other camera sees it. A calibrated projector's
/// points behind which another camera sees a surface contradict that surface: both are removed,
/// because one of their fringe orders is wrong and it is not known which. The differences beyond
/// the noise that remain enter the systematic part of all points whole, unless the known
/// uncertainty of the calibration explains them.
///
/// Grids of several cameras repeat the same measurements, and fusion averages them as if they were
/// independent. The variance of each point is therefore multiplied by the number of cameras that
/// share it, weighted by their densities of pixels. A single point's sigma is then larger than its
/// noise, by 1.4 for two cameras; that of the fused surface is right. Interpolation between pixels
/// of another camera also averages noise, which its neighbours share; it is not counted as a gain.
///
/// A camera disagrees by the distance of its own point from that of the other, along the ray, or,
/// with a label and two directions of fringes, by the distance of both rays. A label with one
/// direction leaves nothing to compare.
///
/// @shape    `ranges` one for each camera, of its pixels; with a projector that is a label their
///           depths are start values, as from `match_by_phase`, and other values are not read
/// @units    mm, frame of each camera
/// @missing  with a label, points that no other camera sees become NaN
/// @errors   Error(Input) when the number of cameras, directions or pixels differ; Error(Cancelled)
/// @source   generalized least squares with a common error of known variance; the sharing of
///           correlated estimates follows covariance intersection (Julier and Uhlmann 1997)
[[nodiscard]] CameraDisagreement fuse_cameras(std::span<const CameraPhases> cameras,
                                              std::span<RangeGrid> ranges,
                                              const FuseCamerasOptions& options = {},
                                              const Run& run = {});

}  // namespace frangia
