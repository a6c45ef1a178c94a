#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "frangia/frames/frame_stack.h"
#include "frangia/frames/noise_model.h"
#include "frangia/rig/fringe_waveform.h"

namespace frangia {

/// Harmonics of the fringes and gains of the frames, pooled over the image.
struct WaveformFit {
  FringeWaveform waveform;  ///< harmonics 2, 3, ...; 0 where not significant
  /// Standard deviation of each harmonic's amplitude, relative to the fundamental; NaN where the
  /// frames do not determine it.
  std::vector<double> sigma;
  /// Relative gain of each frame: lamp or exposure flicker. Empty unless it is significant and the
  /// frames tell it from motion.
  std::vector<double> gains;
  /// Share of the mean counts that no gain acts on: light of the room. 0 without gains.
  double steady_share = 0.0;
  /// Mean ratio of mean to modulation of the sampled pixels; a gain error acts on the mean.
  double mean_over_modulation = 0.0;
  /// Rms phase error due to flicker that the frames do not determine, such as that of three or four
  /// frames, or cannot tell from motion; 0 if not significant.
  ///
  /// @units    rad
  double flicker_error_rad = 0.0;
  bool is_square = false;   ///< the harmonics are those of a blurred square wave
  bool is_flicker = false;  ///< the frames do not suggest that it is motion instead
  /// Standard deviation of the offset from which it follows, relative to the modulation; infinite
  /// where the frames do not determine it.
  double offset_sigma = std::numeric_limits<double>::infinity();

  /// Returns the order of the largest significant harmonic; 0 if there is none.
  [[nodiscard]] int largest_harmonic() const;
  /// What multiplies the mean counts in a frame of this gain, and its fringes by 1 + gain.
  [[nodiscard]] double gain_of_mean(double gain) const { return 1.0 + (1.0 - steady_share) * gain; }
  /// Returns the rms of the gains; 0 if there is no flicker.
  [[nodiscard]] double flicker() const;
  /// Moves the effect of the gains to `flicker_error_rad`: for weights that do not compensate them.
  void count_gains();
};

/// Sampling and significance of the fit of harmonics and gains.
struct WaveformOptions {
  std::size_t samples = 30'000;  ///< approximate number of sampled pixels
  /// Least amplitude of a significant harmonic, relative to the fundamental. The sound scans of
  /// `./run figures harmonics` stay below 0.002.
  double min_harmonic = 0.004;
};

/// Fits the harmonics of the fringes and, for a digital projector, the gains of the frames.
///
/// With four frames or more, harmonics leave residuals of the fringe fit that repeat with the phase
/// of the fringes: harmonic n as its n-th multiple. A frame's gain leaves a residual of multiples 0
/// and 1, camera noise and motion leave none that is common to all pixels. The lowest harmonic that
/// leaves no residual, such as the second of three frames, changes the apparent contrast with the
/// phase; the contrast of neighbouring pixels is compared, so that texture and uneven light cancel.
/// Its sigma is the scatter over the image (jackknife).
///
/// @shape    one shift per frame; the actual shifts
/// @missing  pixels that are saturated or hardly modulated are ignored; nothing is
///           significant with fewer than 2000 others
/// @source   Guo, He and Chen 2004 for gamma from the statistics of few frames
[[nodiscard]] WaveformFit fit_waveform(const FrameStack& stack,
                                       const std::vector<double>& shifts_rad,
                                       const NoiseModel& noise,
                                       const WaveformOptions& options = {});

}  // namespace frangia
