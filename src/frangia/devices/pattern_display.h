#pragma once

#include "frangia/devices/device.h"
#include "frangia/pattern/pattern.h"

namespace frangia {

/// A digital projector that shows a pattern, pixel by pixel.
class PatternDisplay : public Device {
 public:
  /// Shows one frame of a pattern; returns once its light is out.
  ///
  /// errors   Error(Input) for a pattern that it cannot show; DeviceError(Silent) when the swap
  /// does
  ///          not come
  virtual void show(const Pattern& pattern, int frame, Deadline deadline) = 0;

  /// All black.
  virtual void show_black(Deadline deadline) = 0;
};

}  // namespace frangia
