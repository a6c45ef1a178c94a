#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/angles.h"
#include "frangia/frames/frame_stack.h"
#include "frangia/frames/noise_model.h"
#include "frangia/phase/algorithm/phase_algorithm.h"

namespace frangia {

/// The wrapped phases that several maps can have together: a curve over the projector's field.
///
/// A place `u` of the field has the phases 2 pi f u of all maps, modulo 2 pi. Phases that do not
/// lie near this curve belong to other frequencies, starts or directions than those of the curve.
class FringeCurve {
 public:
  /// `per_unit` holds the fringes per projector pixel or degree of each map; the field is from
  /// `first` to `last`, in these units.
  FringeCurve(std::vector<double> per_unit, double first, double last);

  /// The point of the curve that is nearest to the phases of a pixel.
  struct Nearest {
    float distance_rad = 0.0F;  ///< root of the squared distances in all maps
    float unit = 0.0F;          ///< place of the point in the field
  };
  /// `phases_rad` holds one phase per map. Points outside of the field are allowed at the cost of
  /// their distance from it.
  [[nodiscard]] Nearest nearest(std::span<const float> phases_rad);

 private:
  std::vector<double> per_unit_;
  double first_;
  double last_;
  std::size_t finest_ = 0;  ///< index of the map with the most fringes
  double slope_weight_ = 0.0;
  std::vector<float> absolute_;  ///< phase of the finest map in each order
  std::vector<float> square_;
  std::vector<float> along_;
};

/// The coefficients of mean, cosine and sine in a frame: I = A + B cos(phi) cos(shift) - B sin(phi)
/// sin(shift), linear in three unknowns.
[[nodiscard]] Eigen::Vector3d fringe_model_row(double shift_rad);

/// The normal matrix of the least-squares fit of the fringe model.
///
/// @errors   Error(Input) when fewer than three shifts differ, so that the phase is undetermined
[[nodiscard]] Eigen::Matrix3d fringe_normal_matrix(const std::vector<double>& shifts_rad);

/// Number of bins of the measured phase over a fringe.
inline constexpr int kPhaseBins = 96;
/// Number of tiles of the image, along x and along y, within which contrasts are compared.
inline constexpr int kContrastTiles = 8;

/// Phase at the centre of a bin, from -pi to pi.
[[nodiscard]] inline double bin_phase(int bin) {
  return -kPi + kTwoPi * (bin + 0.5) / kPhaseBins;
}

/// Statistics of sampled pixels by their measured phase.
struct FringeBins {
  std::size_t pixels = 0;  ///< that contribute
  /// Inverse variance of `residual`, summed over the pixels of each bin.
  Eigen::ArrayXd weight = Eigen::ArrayXd::Zero(kPhaseBins);
  /// Weighted mean residual of each frame (column) from the least-squares fringe, over the
  /// modulation.
  Eigen::ArrayXXd residual;
  /// Weighted mean of mean over modulation.
  Eigen::ArrayXd mean_over_modulation = Eigen::ArrayXd::Zero(kPhaseBins);
  /// Number of pixels, and sums of logarithms, by bin (row) and tile (column).
  Eigen::ArrayXXd tile_count;
  Eigen::ArrayXXd tile_log_contrast;
  Eigen::ArrayXXd tile_log_mean;  ///< sum of the logarithm of the mean
};

/// Samples about `samples` pixels of a stack on a regular grid and bins them by the phase that the
/// algorithm measures. The residuals are those of least squares.
[[nodiscard]] FringeBins bin_fringes(const FrameStack& stack,
                                     const std::vector<double>& shifts_rad,
                                     const NoiseModel& noise,
                                     std::size_t samples,
                                     const PhaseAlgorithm& algorithm);

}  // namespace frangia
