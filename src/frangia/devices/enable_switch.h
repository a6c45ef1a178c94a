#pragma once

#include "frangia/devices/device.h"

namespace frangia {

/// The enable of a lamp or of a laser's fringes. Off when it is opened, and dropped on any fault.
class EnableSwitch : public Device {
 public:
  /// Returns once the light is steady, or off.
  virtual void enable(bool on, Deadline deadline) = 0;
};

}  // namespace frangia
