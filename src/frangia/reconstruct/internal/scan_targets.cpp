#include "frangia/reconstruct/internal/scan_targets.h"

#include <cstddef>
#include <set>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/dataset/read_frames.h"

#ifdef FRANGIA_WITH_CALIBRATION
#include "frangia/calibrate/board/board_image.h"
#include "frangia/targets/calibrate_find_targets.h"
#endif

namespace frangia {

ScanTargets find_scan_targets(const Scan& scan, const MeasuredViews& measured, const Run& run) {
  ScanTargets out{scan.targets.value(), {}};
#ifdef FRANGIA_WITH_CALIBRATION
  run.stage("targets");
  std::map<std::string, std::size_t> views;
  for (std::size_t i = 0; i < scan.views.size(); ++i)
    views[scan.views[i].folder.string()] = i;
  std::size_t seen = 0;
  for (std::size_t i = 0; i < measured.stations.size(); ++i) {
    run.check();
    run.report(static_cast<double>(i) / static_cast<double>(measured.stations.size()));
    const std::string& name = measured.stations[i].name;
    const Image<float> counts = board_image(read_frames(scan, views.at(name), run));
    auto& sightings = out.sightings[name];
    sightings = find_targets(
        counts, measured.reference().load_points(i).range, scan.rig.reference().model, out.set);
    seen += sightings.size();
    run.note(fmt::format("{}: {} targets", name, sightings.size()));
  }
  if (seen == 0) {
    run.warn(
        "no view shows a target of [targets] in scan.toml: check its sizes, whether the discs are "
        "dark or light, and that a target spans ten pixels");
  }
#else
  static_cast<void>(measured);
  static_cast<void>(run);
  throw Error(ErrorKind::Input,
              "scan.toml has [targets], which this build without calibration does not find; remove "
              "the table, or build with FRANGIA_CALIBRATION");
#endif
  return out;
}

std::vector<TargetView> target_views(const ScanTargets& targets, const MeasuredViews& measured) {
  std::vector<TargetView> views;
  for (std::size_t i = 0; i < measured.stations.size(); ++i) {
    const std::string& name = measured.stations[i].name;
    const auto found = targets.sightings.find(name);
    views.push_back(
        {name,
         found == targets.sightings.end() ? std::vector<TargetSighting>() : found->second,
         measured.reference().rig_from_object(i)});
  }
  return views;
}

std::vector<PointTie> target_ties(const ScanTargets& targets, const MeasuredViews& measured) {
  const std::vector<TargetView> views = target_views(targets, measured);
  return ties_of(match_targets(views, targets.set), views);
}

}  // namespace frangia
