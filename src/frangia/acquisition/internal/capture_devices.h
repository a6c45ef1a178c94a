#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "frangia/acquisition/capture_options.h"
#include "frangia/core/run.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/devices/phase_shifter.h"
#include "frangia/devices/rig_devices.h"
#include "frangia/pattern/pattern.h"

namespace frangia {

/// A complete frame and the exposures it took.
struct CompleteFrame {
  Frame frame;
  int attempts = 1;
  double timestamp_s = 0.0;  ///< clock of the camera
};

/// The devices of a rig for a capture session. Sets a deadline for each call, switches lights,
/// homes the table when needed, and sums the time of all device calls.
class CaptureDevices {
 public:
  /// The references must outlive this object.
  CaptureDevices(RigDevices& devices,
                 const Rig& rig,
                 const CaptureOptions& options,
                 const Run& run);

  /// States the present angle of a table without a home switch.
  void set_table_angle(double angle_rad) { standing_rad_ = angle_rad; }
  /// Moves the table, with the laser sheet off, and waits until it has settled. Enables and homes
  /// it first when needed.
  void turn_to(double angle_rad);
  /// Switches the fringes' light and the laser sheet off.
  void darken() { switch_to(Light::None); }
  /// Prepares the first frame of a set: returns the phase shifter to its start, which resets its
  /// hysteresis.
  void begin_set(const Pattern& pattern, double scale);
  /// Projects one frame of a pattern.
  void show(const Pattern& pattern, int frame);
  /// Switches the laser sheet off, which is on only while its frames are captured.
  void end_set();
  /// Switches the fringes' light on and the laser sheet off without moving the phase shifter.
  void light_fringes() { switch_to(Light::Fringes); }
  /// Sets the exposure of all cameras.
  void expose_for(double exposure_ms);
  /// Captures a frame of a camera, 0 for the reference camera, and repeats the exposure while it
  /// arrives incomplete.
  /// @errors   Error(Device), also when all `frame_attempts` frames are incomplete
  [[nodiscard]] CompleteFrame capture(const FrameLabel& label, std::size_t number = 0);

  /// Switches all lights off after a fault, and motion unless the table is at rest at a known
  /// angle.
  void make_safe() noexcept;
  /// Checks that all devices answer and that the table can find its angle again.
  ///
  /// @errors   Error(Device) with `cause`, the fault before the check, and the fault that it finds
  void check_health(const std::string& cause);

  [[nodiscard]] bool has_phase_shifter() const { return devices_.shifter != nullptr; }
  [[nodiscard]] double seconds() const { return seconds_; }

 private:
  enum class Light { None, Fringes, Line };
  void switch_to(Light wanted);
  [[nodiscard]] Deadline deadline(double seconds) const { return Deadline::in(seconds, run_.stop); }
  [[nodiscard]] Deadline motion_deadline(double expected_s) const;
  [[nodiscard]] std::string find_fault();

  RigDevices& devices_;
  const Rig& rig_;
  const CaptureOptions& options_;
  const Run& run_;
  std::optional<PhaseShiftController> shift_;
  Light active_light_ = Light::None;
  double exposure_ms_ = 0.0;  ///< set last; 0 when unknown
  bool enabled_ = false;
  /// Angle at which the table stands; empty before its first move and after a fault during a move.
  std::optional<double> standing_rad_;
  double seconds_ = 0.0;
};

/// Switches lights and motion off on construction and on destruction.
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

/// Checks, before any light is on, that the devices can show the patterns at their exposures and
/// reach the angles of a plan.
///
/// @errors   Error(Input) that names the table that rig.toml lacks, the pattern or the angle
void check_devices(const RigDevices& devices, const Scan& plan, const CaptureOptions& options);

}  // namespace frangia
