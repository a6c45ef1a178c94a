#include "frangia/devices/camera_device.h"

#include <fmt/format.h>

namespace frangia {

void CameraDevice::check_exposure(double exposure_ms) const {
  if (exposure_ms >= info().min_exposure_ms && exposure_ms <= info().max_exposure_ms) return;
  fail_device(*this,
              fmt::format("an exposure of {} ms is outside its range, {} to {}",
                          exposure_ms,
                          info().min_exposure_ms,
                          info().max_exposure_ms));
}

}  // namespace frangia
