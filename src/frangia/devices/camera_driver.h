#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>

#include "frangia/devices/device.h"
#include "frangia/frames/frame.h"

namespace frangia {

struct CameraSettings {
  double exposure_ms = 10.0;
  double gain_db = 0.0;
  double black_level_counts = 0.0;
};

/// Which frame of a scan is being taken. A real camera needs it for its messages only; a folder of
/// files finds its file by it, a simulated camera its noise.
struct FrameId {
  std::size_t view = 0;
  std::string pattern;  ///< the pattern's name
  int frame = 0;        ///< of the pattern
  int exposure = 0;     ///< index among the exposures of a bracket
  int set_attempt = 0;  ///< how often the pattern's whole set was retaken
  int attempt = 0;      ///< how often this frame was retaken
};

struct CapturedFrame {
  Frame frame;
  CameraSettings settings;               ///< as the camera had them
  std::uint64_t number = 0;              ///< the camera's own count; a gap is a lost frame
  std::chrono::nanoseconds timestamp{};  ///< the camera's own clock
  bool complete = true;                  ///< false: parts did not arrive, the pixels mean nothing
};

class CameraDriver : public Device {
 public:
  /// Sets what the camera can, and returns what it made of it.
  ///
  /// errors   DeviceError(Refused) that names the value and the camera's limits
  virtual CameraSettings configure(const CameraSettings& settings, Deadline deadline) = 0;

  /// Triggers one frame and waits for it: light that falls after the call and before its return.
  ///
  /// errors   DeviceError(Silent) when no frame comes, (Lost) when the camera is gone
  [[nodiscard]] virtual CapturedFrame expose(const FrameId& id, Deadline deadline) = 0;
};

}  // namespace frangia
