#pragma once

#include <string>

#include <fmt/format.h>

#include "frangia/core/error.h"

namespace frangia {

/// What went wrong with a device, as far as it matters for what to do next.
enum class DeviceFault {
  Silent,   ///< no answer before the deadline: try again
  Garbled,  ///< an answer that makes no sense, an incomplete frame: try again
  Refused,  ///< the device understood and will not: a value out of its limits
  Alarm,    ///< the device stopped itself and no longer knows where it is: home it again
  Lost      ///< unplugged or taken by another program: the scan ends, to be resumed
};

/// An Error(Device) whose sentence begins with the device's name, such as "turntable (grbl)".
class DeviceError : public Error {
 public:
  DeviceError(const std::string& device, DeviceFault fault, const std::string& what)
      : Error(ErrorKind::Device, fmt::format("{}: {}", device, what)), fault_(fault) {}
  [[nodiscard]] DeviceFault fault() const noexcept { return fault_; }

 private:
  DeviceFault fault_;
};

}  // namespace frangia
