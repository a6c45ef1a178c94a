#pragma once

#include <cstddef>

#include <Eigen/Core>

#include "frangia/core/image.h"
#include "frangia/phase/wrap/phase_map.h"
#include "frangia/range/depth_agreement.h"
#include "frangia/range/range_grid.h"

namespace frangia {

/// How the points from vertical and horizontal fringes become one point per pixel.
enum class DirectionFusion {
  LeastSquares,  ///< both planes of light, weighted by the inverse variances of their depths
  Best           ///< the direction with the smaller standard deviation at this pixel
};

/// How well the depths from two directions of fringes agree along the camera's rays.
struct DirectionDisagreement : DepthAgreement {
  std::size_t removed = 0;  ///< pixels that differ by far more than the others
  /// What the known uncertainties do not explain, mm along the ray, for each block of pixels; empty
  /// if nothing is left. It is in the systematic part of the points already.
  Image<float> unexplained_mm{};
};

/// Limits of `fuse_directions`.
struct FuseDirectionsOptions {
  DirectionFusion fusion = DirectionFusion::LeastSquares;  ///< how points are combined
  /// A pixel is removed whose depths differ by more than this multiple of the noise and of the
  /// typical difference: one of its fringe orders is wrong, but not known which.
  double max_sigmas = 8.0;
  /// Uncertainty of the difference by that of the calibration; empty where it is not known.
  DifferenceUncertainty calibration{};
};

/// Adds what two directions left unexplained to the systematic part of all points of a grid, whose
/// points were replaced since.
void add_unexplained(const Image<float>& unexplained_mm, RangeGrid& range);

/// Combines the range grids of vertical and horizontal fringes of one view.
///
/// Both planes of light meet the same camera ray, so the least-squares point is the mean of the two
/// depths weighted by their inverse variances. A point that only one direction measured is kept.
/// The disagreement is a check of the rig: errors of its calibration move the two depths
/// differently, and both of them away from the truth. Unless the known uncertainty of the
/// calibration explains it, it enters the systematic part of all points whole, also of those that
/// one direction alone measured: its smooth part in blocks of pixels, and where chi squared says
/// that it exceeds noise by far, the rest, too.
///
/// @shape    both grids w x h; `first` and its `status` become those of the result; `rays` as
///           rays_of(rig.reference().model)
/// @units    mm, rig frame
/// @missing  `phase_rad` is that of `first`; NaN where only `second` has a point
/// @errors   Error(Input) when the grids differ in size
[[nodiscard]] DirectionDisagreement fuse_directions(const RangeGrid& second,
                                                    const Image<Eigen::Vector2f>& rays,
                                                    const FuseDirectionsOptions& options,
                                                    RangeGrid& first,
                                                    Image<PixelStatus>& status);

}  // namespace frangia
