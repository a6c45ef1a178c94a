#include "frangia/simulate/internal/surface_color.h"

#include <cmath>

#include "frangia/core/angles.h"

namespace frangia {

Eigen::Vector3d surface_color(const Eigen::Vector3d& position_mm, double strength) {
  constexpr double kPeriod_mm = 40.0;
  const Eigen::Vector3d along(0.48, 0.36, 0.8);  // unit
  const double phase = kTwoPi * along.dot(position_mm) / kPeriod_mm;
  Eigen::Vector3d color;
  for (int channel = 0; channel < 3; ++channel)
    color[channel] = 1.0 - strength * (0.5 + 0.5 * std::cos(phase + kTwoPi * channel / 3.0));
  return color;
}

double luminance_of_color(const Eigen::Vector3d& color) {
  return Eigen::Vector3d(0.299, 0.587, 0.114).dot(color);
}

}  // namespace frangia
