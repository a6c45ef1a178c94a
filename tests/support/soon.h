#pragma once

#include "frangia/devices/deadline.h"

namespace frangia::testing {

/// By when an emulated device has long answered, even on a busy machine.
inline Deadline soon() {
  return Deadline::in(30.0);
}

}  // namespace frangia::testing
