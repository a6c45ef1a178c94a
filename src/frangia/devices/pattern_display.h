#pragma once

#include "frangia/core/image.h"
#include "frangia/devices/device.h"

namespace frangia {

struct DisplayInfo {
  int width_px = 0;
  int height_px = 0;
  double refresh_period_ms = 0.0;  ///< of its refresh; exposures are whole numbers of it; 0: none
};

/// A digital projector that shows a picture pixel by pixel.
class PatternDisplay : public Device {
 public:
  [[nodiscard]] virtual const DisplayInfo& info() const = 0;

  /// Shows a picture and returns once it is on the screen and the display's delay has passed.
  ///
  /// shape    of the display's size
  /// units    light wanted, linear: 0 dark, 1 as bright as can be. The display's response is the
  ///          driver's to undo.
  /// errors   Error(Device) when it could not be shown by the deadline
  virtual void show(const Image<float>& light, const Deadline& deadline) = 0;

  /// All pixels dark.
  virtual void show_dark(const Deadline& deadline) = 0;
};

}  // namespace frangia
