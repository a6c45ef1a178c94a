#include "frangia/calibrate/check/calibrate_check.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "frangia/calibrate/check/check_kinds.h"
#include "frangia/core/error.h"
#include "frangia/dataset/scan_folder.h"

namespace frangia {
namespace {

void require_table(const Scan& scan, const Rig& rig) {
  if (rig.turntable || scan.views.size() < 2) return;
  throw Error(
      ErrorKind::Input,
      "the rig has no [turntable], so that its views cannot be compared; find the axis with "
      "`frangia calibrate turntable`, or check a scan of one view");
}

}  // namespace

bool RigCheckItem::passed() const {
  return std::abs(deviation_mm) <= limit_mm;
}

bool RigCheck::passed() const {
  return !items.empty() &&
         std::all_of(items.begin(), items.end(), std::mem_fn(&RigCheckItem::passed));
}

RigCheck joined(RigCheck check, const RigCheck& other) {
  check.views = std::max(check.views, other.views);
  check.left_out.insert(check.left_out.end(), other.left_out.begin(), other.left_out.end());
  check.distance_mm = std::max(check.distance_mm, other.distance_mm);
  check.calibration_sigma_mm = std::max(check.calibration_sigma_mm, other.calibration_sigma_mm);
  check.items.insert(check.items.end(), other.items.begin(), other.items.end());
  return check;
}

RigCheck calibrate_check(const Scan& scan,
                         const Rig& rig,
                         const CheckRigOptions& options,
                         const Run& run) {
  RigCheck check;
  check.kind = scan.artifact ? name_of(*scan.artifact) : "part";
  run.stage("views");
  require_table(scan, rig);
  if (scan.board || (scan.artifact && std::holds_alternative<Screen>(*scan.artifact))) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: a rig is checked by a plate, a ball, a ball-bar or a part on the "
                            "turntable; remove [board] or name another scan",
                            (scan.folder / "scan.toml").string()));
  }
  if (rig.projector.is_label) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: its projector is a label, and a check measures with each camera "
                            "and the projector; calibrate the projector, too, or inspect a part of "
                            "known size",
                            (scan.folder / "scan.toml").string()));
  }
  Scan checked = scan;
  checked.rig = rig;
  for (std::size_t camera = 0; camera < rig.cameras.size(); ++camera) {
    const Scan own = scan_of_camera(checked, camera);
    const auto check_of = !scan.artifact                                  ? check_part_of
                          : std::holds_alternative<Plate>(*scan.artifact) ? check_plate_of
                                                                          : check_balls_of;
    check = joined(std::move(check), check_of(own, options, {rig, camera}, run));
  }
  return joined(std::move(check), check_cameras_of(checked, options, run));
}

}  // namespace frangia
