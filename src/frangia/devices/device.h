#pragma once

#include <string>
#include <string_view>

#include "frangia/core/error.h"
#include "frangia/devices/deadline.h"

namespace frangia {

/// What every device of a rig can do, whatever it is.
///
/// A device is opened by its `Driver`, starts disabled (light off, motor off) and is made safe when
/// it is destroyed. It is used by one thread at a time.
class Device {
 public:
  Device() = default;
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;
  Device(Device&&) = delete;
  Device& operator=(Device&&) = delete;
  virtual ~Device() = default;

  /// What a person would call it: "camera Basler-22817 at 192.168.0.7". Begins all its errors.
  [[nodiscard]] virtual std::string name() const = 0;

  /// Asks the device whether it works, without moving or lighting anything; what it says of itself.
  /// errors   Error(Device) when it is silent or unwell
  [[nodiscard]] virtual std::string test(const Deadline& deadline) = 0;

  /// Light off, motion stopped and disabled, as fast as can be. Called on any fault, on a signal
  /// and at the end; must never throw, whatever state the device is in.
  virtual void make_safe() noexcept = 0;
};

/// Throws Error(Device), "NAME: WHAT". `what` says what happened and what to do.
[[noreturn]] inline void fail_device(const Device& device, std::string_view what) {
  throw Error(ErrorKind::Device, device.name() + ": " + std::string(what));
}

}  // namespace frangia
