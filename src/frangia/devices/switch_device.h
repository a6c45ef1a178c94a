#pragma once

#include "frangia/devices/device.h"

namespace frangia {

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
