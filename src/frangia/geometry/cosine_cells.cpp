#include "frangia/geometry/cosine_cells.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <Eigen/Geometry>

#include "frangia/core/angles.h"

namespace frangia {

std::vector<CosineCell> cosine_cells(const Eigen::Vector3d& normal,
                                     int rings,
                                     int sectors,
                                     double turn) {
  constexpr double kGolden = 0.6180339887498949;  // rings are turned against each other
  const Eigen::Vector3d u = normal.unitOrthogonal();
  const Eigen::Vector3d v = normal.cross(u);
  const auto direction = [&](double ring, double sector) -> Eigen::Vector3d {
    const double square = std::clamp(ring / rings, 0.0, 1.0);  // of the sine
    const double angle = kTwoPi * sector / sectors;
    return std::sqrt(square) * (std::cos(angle) * u + std::sin(angle) * v) +
           std::sqrt(1.0 - square) * normal;
  };
  std::vector<CosineCell> cells;
  cells.reserve(static_cast<std::size_t>(rings) * static_cast<std::size_t>(sectors));
  for (int ring = 0; ring < rings; ++ring) {
    const double turned = turn + kGolden * ring;
    for (int sector = 0; sector < sectors; ++sector) {
      const double r = ring + 0.5;
      const double s = sector + turned - std::floor(turned);
      cells.push_back({direction(r, s),
                       {{{direction(r - 0.5, s), direction(r + 0.5, s)},
                         {direction(r, s - 0.5), direction(r, s + 0.5)}}}});
    }
  }
  return cells;
}

}  // namespace frangia
