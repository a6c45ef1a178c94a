#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "frangia/devices/device.h"
#include "frangia/frames/frame_stack.h"

namespace frangia {

/// Exposure settings of a camera.
struct CameraSettings {
  double exposure_ms = 10.0;        ///< exposure time of a frame
  double gain_db = 0.0;             ///< analogue or digital gain; 0 is the lowest noise
  double black_level_counts = 0.0;  ///< offset that keeps noise from being clipped at 0
};

/// Properties of a camera; constant while it is open.
struct CameraInfo {
  int width_px = 0;                   ///< width of the frames
  int height_px = 0;                  ///< height of the frames
  int white_level = 255;              ///< largest pixel value: 255, 1023, 4095, 65535
  double min_exposure_ms = 0.01;      ///< shortest exposure time
  double max_exposure_ms = 10'000.0;  ///< longest exposure time
  double max_gain_db = 0.0;           ///< 0 when the gain cannot be set
  /// Quality, 1 to 100, of the JPEG compression of frames that the camera delivers compressed.
  std::optional<int> jpeg_quality{};
  /// Frames that are under way when one is wanted, which each capture drops, `skip_frames` of its
  /// settings; empty for a camera with a trigger.
  std::optional<int> skip_frames{};
};

/// Identifies a frame within a scan. Real cameras ignore it; a replay uses it to find the file, and
/// the simulated camera to seed its noise, so that a repeated capture gives the same frame.
struct FrameLabel {
  int view = 0;         ///< index of the view in the scan
  std::string pattern;  ///< name of the pattern
  int frame = 0;        ///< index of the frame within its pattern
  int exposure = 0;     ///< index into the pattern's exposures
  int attempt = 0;      ///< 0 for the first capture of the set, then 1, 2, ...
  int setup = 0;        ///< how the part is clamped; the simulated part is turned over for each
};

/// One frame with its metadata.
struct CapturedFrame {
  Frame frame;                   ///< of the size in `info`
  CameraSettings settings;       ///< in effect, as the camera reports them
  std::uint64_t id = 0;          ///< frame counter of the camera
  double timestamp_s = 0.0;      ///< clock of the camera
  bool complete = true;          ///< false: data is missing; do not use the pixels
  std::string incomplete_cause;  ///< "12 of 900 packets lost"; empty for a complete frame
};

/// A camera that captures single frames on request.
class CameraDevice : public Device {
 public:
  [[nodiscard]] virtual const CameraInfo& info() const = 0;  ///< properties of the open camera

  /// Sets the exposure of the following frames and returns the settings in effect, which the camera
  /// may round.
  ///
  /// @errors   Error(Device) when a value is out of the camera's range
  virtual CameraSettings configure(const CameraSettings& settings, const Deadline& deadline) = 0;

  /// Triggers one exposure and waits for its frame. The exposure starts after the call; a frame
  /// that was already being exposed is discarded.
  ///
  /// @missing  an incomplete frame is returned and marked as such; the caller captures it again
  /// @errors   Error(Device) when no frame arrives by the deadline, or the camera is disconnected
  [[nodiscard]] virtual CapturedFrame capture(const FrameLabel& label,
                                              const Deadline& deadline) = 0;

 protected:
  /// @errors   Error(Device) when the exposure is out of the camera's range
  void check_exposure(double exposure_ms) const;
};

}  // namespace frangia
