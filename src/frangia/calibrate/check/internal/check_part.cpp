#include <vector>

#include <fmt/format.h>

#include "frangia/calibrate/check/check_kinds.h"
#include "frangia/calibrate/check/internal/check_limits.h"
#include "frangia/calibrate/check/internal/compare_views.h"
#include "frangia/calibrate/internal/artifact_sites.h"
#include "frangia/core/error.h"

namespace frangia {

RigCheck check_part_of(const Scan& scan,
                       const CheckRigOptions& options,
                       const CheckedCamera& camera,
                       const Run& run) {
  const Rig& rig = scan.rig;
  if (scan.views.size() < 2) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: one view of a part has nothing to be compared with; scan it from "
                            "several angles, or state a plate or ball bar in [board]",
                            (scan.folder / "scan.toml").string()));
  }
  std::vector<PartView> views;
  std::vector<Eigen::Vector3d> all;
  for (std::size_t i = 0; i < scan.views.size(); ++i) {
    run.report(static_cast<double>(i) / static_cast<double>(scan.views.size()));
    run.check();
    // In another setup the part lies elsewhere on the table.
    if (scan.views[i].setup != scan.views.front().setup) continue;
    views.push_back(measure_part_view(scan, i, options.part_sites, run));
    views.back().camera_from_zero = table_turn(rig, scan.views[i].angle_rad);
    for (const Eigen::Vector3d& point : views.back().points)
      if (point.allFinite()) all.push_back(point);
  }
  if (all.empty()) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: no point of the part is measured; check that rig and scan belong "
                            "together",
                            (scan.folder / "scan.toml").string()));
  }
  PatchDistances patches;
  for (std::size_t a = 0; a < views.size(); ++a) {
    for (std::size_t b = 0; b < views.size(); ++b)
      if (a != b) compare_views(views[a], views[b], options.match_share, patches);
  }
  constexpr std::size_t kFewest = 20;
  if (patches.mean_mm.size() < kFewest) {
    throw Error(ErrorKind::Numeric,
                fmt::format("the views share {} patches within {:.3g} mm of each other, too few to "
                            "check the rig: it is far off, or the angles between the views are too "
                            "large",
                            patches.mean_mm.size(),
                            options.match_share * all.front().norm()));
  }
  CheckLimits limits(camera, all, options, {.views = views.size()});
  limits.add_spread("disagreement of the views", patches);
  return limits.result();
}

}  // namespace frangia
