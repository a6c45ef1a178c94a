#include "frangia/inspect/internal/lighting.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "frangia/core/angles.h"
#include "frangia/core/random.h"

namespace frangia {

using Eigen::Vector3d;

const std::array<Light, 3>& lights() {
  static const std::array<Light, 3> three{
      {{Vector3d(-0.72, 0.70, 0.50).normalized(), Vector3d(0.80, 0.765, 0.71), 0.12},
       {Vector3d(0.80, 0.22, 0.55).normalized(), Vector3d(0.11, 0.13, 0.17), 0.25},
       {Vector3d(0.45, 0.55, -0.75).normalized(), Vector3d(0.30, 0.32, 0.36), 0.15}}};
  return three;
}

Vector3d backdrop(double x, double y) {
  const double halo = std::exp(-0.55 * (x * x + (y - 0.15) * (y - 0.15)));
  const double height = std::clamp(0.5 + 0.5 * y, 0.0, 1.0);
  return Vector3d(0.44, 0.465, 0.50) + halo * Vector3d(0.40, 0.395, 0.38) +
         0.05 * height * Vector3d::Ones();
}

Eigen::Vector2d SampleSequence::point(std::size_t use, std::size_t i, std::size_t count) const {
  const auto index = static_cast<double>(sample * count + i + 1);
  const std::uint64_t stream = hash(pixel, use);
  const Eigen::Vector2d offset(uniform_from(hash(stream, 1)), uniform_from(hash(stream, 2)));
  const Eigen::Vector2d p =
      offset + index * Eigen::Vector2d(0.7548776662466927, 0.5698402909980532);
  return p - Eigen::Vector2d(p.array().floor());
}

Vector3d sky_direction(const Vector3d& n, const Eigen::Vector2d& point) {
  const double around = kTwoPi * point.x();
  const double out2 = point.y();
  const Vector3d u = n.unitOrthogonal();
  return std::sqrt(out2) * (std::cos(around) * u + std::sin(around) * n.cross(u)) +
         std::sqrt(1.0 - out2) * n;
}

Vector3d light_direction(const Viewpoint& viewpoint,
                         const Light& light,
                         const Eigen::Vector2d& point) {
  const double around = kTwoPi * point.x();
  const Vector3d u = light.direction.unitOrthogonal();
  const Vector3d off = std::cos(around) * u + std::sin(around) * light.direction.cross(u);
  return viewpoint.axes.transpose() *
         (light.direction + light.spread * std::sqrt(point.y()) * off).normalized();
}

Rgb screen_color(const Vector3d& light) {
  Rgb color{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double value = light[static_cast<Eigen::Index>(i)];
    const double soft = value < 0.8 ? value : 1.0 - 0.2 * std::exp(-(value - 0.8) / 0.2);
    color[i] = static_cast<std::uint8_t>(std::lround(255.0 * std::pow(soft, 1.0 / 2.2)));
  }
  return color;
}

}  // namespace frangia
