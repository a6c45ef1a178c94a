#pragma once

#include "frangia/devices/device.h"

namespace frangia {

/// Something that is on or off: the laser or lamp of the fringes (`light`), or the source of the
/// single plane of light (`line`). Off when opened and after `make_safe`.
class SwitchDevice : public Device {
 public:
  /// Returns when the light has changed.
  virtual void set(bool on, const Deadline& deadline) = 0;
  [[nodiscard]] virtual bool is_on() const = 0;
};

/// The source of the single plane of light.
using LaserSheetSource = SwitchDevice;

}  // namespace frangia
