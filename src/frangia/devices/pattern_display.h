#pragma once

#include "frangia/core/image.h"
#include "frangia/devices/device.h"

namespace frangia {

/// Size and timing of a digital projector; constant while it is open.
struct DisplayInfo {
  int width_px = 0;                ///< width of the images in projector pixels
  int height_px = 0;               ///< height of the images in projector pixels
  double refresh_period_ms = 0.0;  ///< exposures are integer multiples of it; 0: not applicable
};

/// A digital projector that shows an image pixel by pixel.
class PatternDisplay : public Device {
 public:
  [[nodiscard]] virtual const DisplayInfo& info() const = 0;  ///< properties of the open display

  /// Shows an image and returns when it is on the screen and the delay of the display has passed.
  ///
  /// @shape    of the size of the display
  /// @units    desired light, linear: 0 dark, 1 maximum; the driver compensates the response of the
  ///          display
  /// @errors   Error(Device) when the image is not shown by the deadline
  virtual void show(const Image<float>& light, const Deadline& deadline) = 0;

  /// What `show` waits after the buffer swap: the latency of the display, as far as it is known.
  ///
  /// @units    s
  [[nodiscard]] virtual double delay_s() const = 0;
  /// Changes it until the display is closed; `delay_s` of its settings is where it begins.
  virtual void set_delay(double seconds) = 0;

  /// Sets all pixels to dark.
  virtual void show_dark(const Deadline& deadline) = 0;
};

}  // namespace frangia
