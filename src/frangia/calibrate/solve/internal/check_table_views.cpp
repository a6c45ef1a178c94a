#include "frangia/calibrate/solve/internal/check_table_views.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"

namespace frangia {

void check_table_views(std::span<const BoardView> views, std::span<const double> angles_rad) {
  constexpr std::size_t kFewest = 3;
  constexpr double kLeast_rad = 0.35;  // 20 degrees; the axis is extrapolated from a shorter arc
  if (views.size() < kFewest) {
    throw Error(ErrorKind::Input,
                fmt::format("the board is found in {} of at least {} views; turn the table by "
                            "smaller steps, so that camera and projector see the board",
                            views.size(),
                            kFewest));
  }
  double widest = 0.0;
  for (const double a : angles_rad)
    for (const double b : angles_rad)
      widest = std::max(widest, std::abs(std::remainder(a - b, kTwoPi)));
  if (widest >= kLeast_rad) return;
  throw Error(ErrorKind::Input,
              fmt::format("the angles of the views span {:.1f} degrees; state angle_deg of each "
                          "view in scan.toml, and turn the table by 60 to 90 degrees in all",
                          deg_from_rad(widest)));
}

}  // namespace frangia
