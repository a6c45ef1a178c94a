#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "frangia/core/error.h"
#include "frangia/devices/deadline.h"

namespace frangia {

/// The bytes that switch a device off over its open line. A `Guardian` sends them when the program
/// that opened the device dies.
struct SafeOff {
  std::string line;         ///< name of the line for messages: "/dev/ttyUSB0", "10.0.0.7:5025"
  int file = -1;            ///< open file descriptor of the line; devices on one line share it
  std::string end_command;  ///< ends a command of which only a part was sent
  double pause_s = 0.0;     ///< from `end_command` until the device accepts `off`
  std::string off;          ///< switches light off and stops motion
};

/// Common interface of all devices of a rig.
///
/// A `Driver` opens a device. It starts disabled (light off, motor off) and makes itself safe when
/// destroyed. Only one thread at a time may use it.
class Device {
 public:
  Device() = default;
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;
  Device(Device&&) = delete;
  Device& operator=(Device&&) = delete;
  virtual ~Device() = default;

  /// Name for messages: "camera Basler-22817 at 192.168.0.7". All errors of the device begin with
  /// it.
  [[nodiscard]] virtual std::string name() const = 0;

  /// Checks that the device works, without motion or light, and returns a description of it.
  ///
  /// @errors   Error(Device) when it does not answer or reports a fault
  [[nodiscard]] virtual std::string test(const Deadline& deadline) = 0;

  /// Sentences that the user must know and that no call has returned yet: a setting that the device
  /// cannot take, or one that was changed in its memory. Ask after opening, enabling and testing.
  [[nodiscard]] virtual std::vector<std::string> take_warnings() { return {}; }

  /// Switches light off and stops and disables motion as fast as possible. Called on any fault, on
  /// a signal and at the end, in parallel with the other devices of the rig; never throws.
  /// Returns within 2 s even when the device does not answer.
  virtual void make_safe() noexcept = 0;

  /// How another process switches the device off when this program dies; empty for a device that
  /// is dark and at rest without its program.
  [[nodiscard]] virtual std::optional<SafeOff> safe_off() const { return std::nullopt; }
};

/// Throws Error(Device) with "NAME: WHAT". `what` states the fault and what to do.
[[noreturn]] inline void fail_device(const Device& device, std::string_view what) {
  throw Error(ErrorKind::Device, device.name() + ": " + std::string(what));
}

/// A light that is on or off: the laser or lamp of the fringes (`light`), or the source of the
/// laser sheet (`line`). Off when opened and after `make_safe`.
class SwitchDevice : public Device {
 public:
  /// Switches and returns when the light has changed.
  virtual void set(bool on, const Deadline& deadline) = 0;
  [[nodiscard]] virtual bool is_on() const = 0;  ///< whether the light is on
};

/// The source of the laser sheet.
using LaserSheetSource = SwitchDevice;

}  // namespace frangia
