#pragma once

#include "frangia/devices/device.h"

namespace frangia {

/// The single plane of light. Off when it is opened.
class LineSource : public Device {
 public:
  virtual void switch_line(bool on, Deadline deadline) = 0;
};

}  // namespace frangia
