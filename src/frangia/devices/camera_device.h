#pragma once

#include <cstdint>
#include <string>

#include "frangia/devices/device.h"
#include "frangia/frames/frame.h"

namespace frangia {

/// How a frame is exposed.
struct CameraSettings {
  double exposure_ms = 10.0;
  double gain_db = 0.0;
  double black_level_counts = 0.0;  ///< what the camera adds, so that noise is not cut off at 0
};

/// What a camera is; does not change while it is open.
struct CameraInfo {
  int width_px = 0;
  int height_px = 0;
  int white_level = 255;  ///< the largest value of a pixel: 255, 1023, 4095, 65535
  double min_exposure_ms = 0.01;
  double max_exposure_ms = 10'000.0;
  double max_gain_db = 0.0;  ///< 0 when the gain cannot be set
};

/// What a frame is taken for. A real camera does not care; a replay finds its file by it, and the
/// simulated one its noise, so that a frame taken later is still the same frame.
struct FrameLabel {
  int view = 0;
  std::string pattern;
  int frame = 0;
  int exposure = 0;  ///< index into the pattern's exposures
  int attempt = 0;   ///< 0, then 1, 2 ... when the set is taken again
};

/// One frame, and how it came about.
struct CapturedFrame {
  Frame frame;                   ///< of the size that `info` tells
  CameraSettings settings;       ///< those it was taken with, as the camera reports them
  std::uint64_t id = 0;          ///< the camera's own count
  double timestamp_s = 0.0;      ///< of the camera's own clock
  bool complete = true;          ///< false: parts are missing, the pixels are not to be used
  std::string incomplete_cause;  ///< "12 of 900 packets lost"; empty for a complete one
};

/// A camera that takes one frame when told to.
class CameraDevice : public Device {
 public:
  [[nodiscard]] virtual const CameraInfo& info() const = 0;

  /// Sets what the next frames are taken with, and returns what the camera made of it (it may round
  /// to its own steps).
  /// errors   Error(Device) when a value is out of the camera's range
  virtual CameraSettings configure(const CameraSettings& settings, const Deadline& deadline) = 0;

  /// Triggers one exposure and waits for its frame. The exposure begins after the call does: a
  /// frame that was already under way is never handed out.
  ///
  /// An incomplete frame is returned as such, for the caller to count and to take again.
  /// errors   Error(Device) when no frame has come by the deadline, or the camera is gone
  [[nodiscard]] virtual CapturedFrame capture(const FrameLabel& label,
                                              const Deadline& deadline) = 0;

 protected:
  /// errors   Error(Device) when the exposure is out of the camera's range
  void check_exposure(double exposure_ms) const;
};

}  // namespace frangia
