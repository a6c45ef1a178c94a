#pragma once

#include <optional>
#include <span>

#include "frangia/acquisition/capture_options.h"
#include "frangia/core/run.h"
#include "frangia/devices/phase_shift_controller.h"
#include "frangia/devices/rig_devices.h"
#include "frangia/pattern/pattern.h"

namespace frangia {

/// A frame that came whole, and how often it had to be taken.
struct CompleteFrame {
  Frame frame;
  int attempts = 1;
};

/// A rig's devices as a capture session uses them: each call with its deadline, light switched and
/// the table homed where that is due. Counts the time that the devices take.
class CaptureDevices {
 public:
  /// errors   Error(Input) when the devices do not suit the patterns and angles
  CaptureDevices(RigDevices& devices,
                 const Rig& rig,
                 const CaptureOptions& options,
                 const Run& run);

  /// Turns the table, which is enabled and homed first where that is due, and lets it settle.
  void turn_to(double angle_rad);
  /// Before the first frame of a set: hysteresis begins anew.
  void begin_set(const Pattern& pattern, double scale);
  /// Brings the light of one frame.
  void show(const Pattern& pattern, int frame);
  /// The light of the fringes alone, wherever they are.
  void light_fringes() { switch_to(Light::Fringes); }
  void expose_for(double exposure_ms);
  /// Takes a frame, again while it arrives incomplete.
  /// errors   Error(Device), also when none of many came whole
  [[nodiscard]] CompleteFrame capture(const FrameLabel& label);

  /// After a fault: all dark and still.
  void make_safe() noexcept;
  /// Whether all devices answer, and the table can find its angle again.
  /// errors   Error(Device) of the one that does not
  void check_health();

  [[nodiscard]] bool has_phase_shifter() const { return devices_.shifter != nullptr; }
  [[nodiscard]] double seconds() const { return seconds_; }

 private:
  enum class Light { None, Fringes, Line };
  void switch_to(Light wanted);
  [[nodiscard]] Deadline deadline(double seconds) const { return Deadline::in(seconds, run_.stop); }

  RigDevices& devices_;
  const Rig& rig_;
  const CaptureOptions& options_;
  const Run& run_;
  std::optional<PhaseShiftController> shift_;
  Light active_light_ = Light::None;
  double exposure_ms_ = 0.0;  ///< that the camera was told last
  bool enabled_ = false;
  double seconds_ = 0.0;
};

/// Leaves the devices safe, however what uses them ends; and makes them so first.
class SafeStateGuard {
 public:
  explicit SafeStateGuard(RigDevices& devices) : devices_(devices) { devices_.make_safe(); }
  SafeStateGuard(const SafeStateGuard&) = delete;
  SafeStateGuard& operator=(const SafeStateGuard&) = delete;
  SafeStateGuard(SafeStateGuard&&) = delete;
  SafeStateGuard& operator=(SafeStateGuard&&) = delete;
  ~SafeStateGuard() { devices_.make_safe(); }

 private:
  RigDevices& devices_;
};

/// Whether a rig's devices can take these patterns at these angles.
///
/// errors   Error(Input) that names the table that rig.toml lacks, or the angle
void check_devices(const RigDevices& devices,
                   const Rig& rig,
                   std::span<const Pattern> patterns,
                   std::span<const double> angles_rad);

}  // namespace frangia
