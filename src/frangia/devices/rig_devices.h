#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "frangia/core/run.h"
#include "frangia/devices/camera_device.h"
#include "frangia/devices/device.h"
#include "frangia/devices/device_settings.h"
#include "frangia/devices/driver.h"
#include "frangia/devices/guardian.h"
#include "frangia/devices/pattern_display.h"
#include "frangia/devices/phase_shifter.h"
#include "frangia/devices/turntable_device.h"

namespace frangia {

/// Makes devices safe in parallel, so that a device that does not answer delays no other. Displays
/// are made safe by the calling thread, which owns their windows.
void make_safe(std::span<Device* const> devices) noexcept;

/// Passes on what the device has to say, with its name; see `Device::take_warnings`.
void warn_of(Device& device, const Run& run);

/// The devices of a rig, null where it has none. On destruction and on any fault all are made safe.
struct RigDevices {
  RigDevices() = default;
  RigDevices(const RigDevices&) = delete;
  RigDevices& operator=(const RigDevices&) = delete;
  /// Takes over the devices of another RigDevices, which is left with none.
  RigDevices(RigDevices&&) = default;
  RigDevices& operator=(RigDevices&&) = delete;
  ~RigDevices() { make_safe(); }

  std::vector<Guardian::Watch> watches;  ///< released after the devices are closed

  /// Those of `Rig::cameras`, in their order: tables [devices.camera] and [devices.camera-NAME].
  std::vector<std::unique_ptr<CameraDevice>> cameras =
      std::vector<std::unique_ptr<CameraDevice>>(1);
  std::unique_ptr<PhaseShifter> shifter;          ///< the fringes of an interferometer ...
  std::unique_ptr<PatternDisplay> display;        ///< ... or those of a digital projector
  std::unique_ptr<LaserSheetSource> laser_sheet;  ///< source of the laser sheet, `line`
  std::unique_ptr<SwitchDevice> light;            ///< laser or lamp of the fringes
  std::unique_ptr<TurntableDevice> turntable;     ///< null: the object stays where it is
  std::vector<DeviceSettings> settings;           ///< as read from rig.toml
  /// Exposures are chosen as whole multiples of it, over which the light of the room and of the
  /// display is even: `exposure_step_ms` of the reference camera; 0: any exposure.
  double exposure_step_ms = 0.0;

  /// The device of the reference camera, which any capture needs.
  [[nodiscard]] CameraDevice* reference() const { return cameras.front().get(); }
  /// All devices of the rig, light first.
  [[nodiscard]] std::vector<Device*> all() const;
  /// Switches off all light and stops all motion, in parallel; see `Device::make_safe`.
  void make_safe() noexcept;
  /// As `make_safe`, but a turntable at rest at a known angle stays enabled and keeps the angle.
  void make_dark() noexcept;
};

/// Opens the devices in the `[devices.NAME]` tables of a rig.toml. The camera NAME of
/// the rig has the table `[devices.camera-NAME]`; its driver is given `rig_of_camera`. A
/// `guardian` watches each one from then on; it must outlive the devices.
///
/// @errors   Error(Input) that names the file and the key: an unknown driver, an invalid table or
///          setting, a camera or display whose size differs from the rig; Error(Device) when a
///          device does not answer by the deadline
[[nodiscard]] RigDevices open_devices(const std::filesystem::path& rig_file,
                                      const Rig& rig,
                                      const std::vector<Driver>& drivers,
                                      const Deadline& deadline,
                                      const Run& run = {},
                                      Guardian* guardian = nullptr);

}  // namespace frangia
