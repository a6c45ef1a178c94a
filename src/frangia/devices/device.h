#pragma once

#include <string>

#include "frangia/devices/deadline.h"

namespace frangia {

/// What all devices have in common. A driver opens its device in its constructor and lets it go,
/// safe, in its destructor. Calls come from one thread at a time.
class Device {
 public:
  Device() = default;
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;
  Device(Device&&) = delete;
  Device& operator=(Device&&) = delete;
  virtual ~Device() = default;

  /// Asks the device for a sign of life: one line for a person, such as maker, model and state.
  ///
  /// errors   DeviceError
  [[nodiscard]] virtual std::string probe(Deadline deadline) = 0;

  /// Light off, motion stopped, drive at rest: as far as the device can still be reached. Called at
  /// the start, on a fault, on a signal and at the end; returns within a second or so.
  virtual void make_safe() noexcept = 0;
};

}  // namespace frangia
