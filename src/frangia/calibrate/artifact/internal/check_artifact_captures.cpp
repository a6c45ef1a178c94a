#include "frangia/calibrate/artifact/internal/check_artifact_captures.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>

#include <fmt/format.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"

namespace frangia {

void check_artifact_captures(std::span<const ArtifactCapture> captures, const Rig& start) {
  constexpr std::size_t kFewestViews = 3;
  constexpr double kLeast_rad = 0.35;  // 20 degrees
  if (!start.turntable) {
    throw Error(ErrorKind::Input,
                "the rig has no [turntable]; add its point_mm and axis to rig.toml, within a few "
                "degrees");
  }
  require(!captures.empty(), "there is no plate and no ball to calibrate by");
  for (const ArtifactCapture& capture : captures) {
    const std::string name = name_of(capture.artifact);
    require(!std::holds_alternative<Screen>(capture.artifact), "a screen does not turn");
    if (capture.views.size() < kFewestViews) {
      throw Error(ErrorKind::Input,
                  fmt::format("the {} is found in {} of at least {} views; turn the table by "
                              "smaller steps, so that camera and projector see it",
                              name,
                              capture.views.size(),
                              kFewestViews));
    }
    double widest = 0.0;
    for (const ArtifactView& a : capture.views)
      for (const ArtifactView& b : capture.views)
        widest = std::max(widest, std::abs(std::remainder(a.angle_rad - b.angle_rad, kTwoPi)));
    if (widest < kLeast_rad) {
      throw Error(ErrorKind::Input,
                  fmt::format("the angles of the views of the {} span {:.1f} degrees; state "
                              "angle_deg of each view in scan.toml, and turn the table by 60 to "
                              "120 degrees in all",
                              name,
                              deg_from_rad(widest)));
    }
  }
}

}  // namespace frangia
