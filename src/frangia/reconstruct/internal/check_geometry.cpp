#include "frangia/reconstruct/internal/check_geometry.h"

#include <cmath>
#include <map>
#include <optional>

#include <fmt/format.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/rig/rig.h"

namespace frangia {
namespace {

/// Views at different angles cannot be brought together without the axis that they turned about.
void check_turntable(const Scan& scan) {
  constexpr double kSame = 1e-6;  // rad
  if (scan.rig.turntable) return;
  std::map<int, double> angles;
  for (const ScanView& view : scan.views) {
    const double first = angles.emplace(view.setup, view.angle_rad).first->second;
    if (std::abs(wrap_rad(view.angle_rad - first)) < kSame) continue;
    throw Error(ErrorKind::Input,
                fmt::format("{}: the views are at different angles, but rig.toml has no "
                            "[turntable]; find its axis with `frangia calibrate turntable`, by a "
                            "board or by this scan",
                            scan.folder.string()));
  }
}

/// Fringes along the line from camera to projector do not move with depth.
void check_parallax(const Scan& scan) {
  std::optional<FringeDirection> useless;
  for (const Pattern& pattern : scan.patterns) {
    if (pattern.kind != PatternKind::Fringe && pattern.kind != PatternKind::Gray) continue;
    if (!lacks_parallax(scan.rig, pattern.direction)) return;
    useless = pattern.direction;
  }
  if (!useless) return;
  const bool vertical = *useless == FringeDirection::Vertical;
  throw Error(ErrorKind::Input,
              fmt::format("{}: its {} fringes do not measure depth, because the projector of "
                          "rig.toml stands {} the camera; capture {} ones",
                          scan.folder.string(),
                          vertical ? "vertical" : "horizontal",
                          vertical ? "above or below" : "beside",
                          vertical ? "horizontal" : "vertical"));
}

/// Fringe orders that nothing determines leave distances open, or label no points.
void check_fringe_orders(const Scan& scan, const DecodePlan& plan, const Run& run) {
  if (is_absolute(plan)) return;
  if (scan.rig.projector.is_label) {
    throw Error(
        ErrorKind::Input,
        fmt::format("{}: the patterns do not determine fringe orders, which label the points "
                    "that two cameras see; capture Gray code or coarser fringes, too",
                    scan.folder.string()));
  }
  run.warn(
      "the scan holds neither an absolute pattern nor the laser sheet: distances are relative "
      "to the fringe through the projection axis");
}

}  // namespace

void check_geometry(const Scan& scan, const DecodePlan& plan, const Run& run) {
  check_turntable(scan);
  check_parallax(scan);
  check_fringe_orders(scan, plan, run);
}

}  // namespace frangia
