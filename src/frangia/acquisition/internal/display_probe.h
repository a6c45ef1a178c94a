#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "frangia/acquisition/internal/capture_devices.h"
#include "frangia/frames/frame_stack.h"

namespace frangia {

/// Frames that a camera may have under way when it is asked for one; more than webcams have.
inline constexpr std::size_t kMostUnderWay = 6;

/// Pixels that the display lights, and their light between its dark and its full picture.
class LitPixels {
 public:
  LitPixels() = default;
  /// Pixels whose bright frame exceeds the dark one by `min_contrast` of white and stays below it.
  LitPixels(const Frame& dark, const Frame& bright, int white_level, double min_contrast);

  [[nodiscard]] std::size_t size() const { return at_.size(); }
  /// 0 for the dark frame, 1 for the bright one.
  [[nodiscard]] double share_of(const Frame& frame) const;
  /// Share of the pixels that have 0 counts in a frame.
  [[nodiscard]] double zeros_of(const Frame& frame) const;
  /// Light of the bright frame over the dark one, mean counts.
  [[nodiscard]] double light_counts() const { return bright_ - dark_; }
  /// Mean of a frame over the pixels, counts.
  [[nodiscard]] double mean_of(const Frame& frame) const;

 private:
  std::vector<std::size_t> at_;  ///< y * width + x
  double dark_ = 0.0;            ///< mean counts
  double bright_ = 0.0;
};

/// Shows pictures of a digital projector and captures them by the reference camera, one by one.
/// The display has its delay again when the probe is destroyed.
class DisplayProbe {
 public:
  /// The references must outlive this object.
  DisplayProbe(RigDevices& devices, const Rig& rig, const CaptureOptions& options, const Run& run);
  DisplayProbe(const DisplayProbe&) = delete;
  DisplayProbe& operator=(const DisplayProbe&) = delete;
  DisplayProbe(DisplayProbe&&) = delete;
  DisplayProbe& operator=(DisplayProbe&&) = delete;
  ~DisplayProbe() { devices_.display->set_delay(delay_s_); }

  void expose_for(double exposure_ms) { session_.expose_for(exposure_ms); }
  void set_delay(double seconds) { devices_.display->set_delay(seconds); }
  /// Drops so many frames before each one that counts.
  void set_skipped(std::size_t frames) { skipped_ = frames; }
  /// Shows one frame of a pattern and captures it.
  [[nodiscard]] CompleteFrame take(const Pattern& pattern, int frame);
  /// Captures what is shown once more.
  [[nodiscard]] CompleteFrame again(const std::string& pattern);
  /// All frames of a pattern.
  [[nodiscard]] FrameStack stack_of(const Pattern& pattern);

 private:
  RigDevices& devices_;
  const Rig& rig_;
  const Run& run_;
  CaptureDevices session_;
  double delay_s_;
  std::size_t skipped_ = 0;
  int taken_ = 0;
};

/// A uniform field: frame 0 is dark, frame 1 bright.
[[nodiscard]] Pattern dark_and_bright();

/// Flashes, bright or dark, that are repeated without end. No shift of the sequence by less than
/// its length is like it or its inverse, so that flashes that are seen late tell by how many.
///
/// @source   maximum length sequence of x^4 + x + 1
inline constexpr std::array<bool, 15> kFlashCode{false,
                                                 false,
                                                 false,
                                                 true,
                                                 false,
                                                 false,
                                                 true,
                                                 true,
                                                 false,
                                                 true,
                                                 false,
                                                 true,
                                                 true,
                                                 true,
                                                 true};

/// How late flashes are seen.
struct FlashLag {
  std::size_t frames = 0;  ///< whole frames
  double share = 0.0;      ///< of the exposures that still saw the flash before, -0.1 to 0.9
  double residual = 0.0;   ///< rms of what this does not explain, as a share of a flash's light
};

/// Fits the lag to the light of successive frames, each captured when the next flash of the code
/// was shown: light_k = (1 - share) code_{k - frames} + share code_{k - frames - 1}.
///
/// @shape    light: 0 for dark, 1 for bright; the first one is of flash 0, the code is cyclic
[[nodiscard]] FlashLag flash_lag(std::span<const double> light);

}  // namespace frangia
