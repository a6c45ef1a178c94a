#include "frangia/reconstruct/watch_views.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/decode/check_view.h"
#include "frangia/decode/triangulate_view.h"
#include "frangia/registration/find_background.h"
#include "frangia/registration/find_turntable_top.h"
#include "frangia/registration/register_views.h"
#include "frangia/views/thin_view.h"
#include "frangia/views/view_store.h"

namespace frangia {
namespace {

constexpr double kMostPixels = 60'000.0;  ///< of a view: eight are compared in a second on one core
constexpr std::size_t kMostViews = 8;     ///< at 45 degrees from view to view they go all around

/// Whether an explanation is that something moved before the last view.
bool moved_at_last(const PoseExplanation& found, std::size_t last) {
  const bool moves = found.best == PoseCause::PartMoved || found.best == PoseCause::ViewMoved ||
                     found.best == PoseCause::Turned;
  return moves && found.decided && !found.views.empty() && found.views.back() == last;
}

std::string finding_of(const PoseExplanation& found, std::size_t view) {
  std::string what;
  if (found.best == PoseCause::Turned) {
    what = fmt::format("the table turned by {:.2g} degrees more or less, or the part on it",
                       std::abs(deg_from_rad(found.turned_rad)));
  } else if (std::isnan(found.moved_mm)) {
    what = "the part moved";
  } else {
    what = fmt::format("the part moved by {:.2g} mm", found.moved_mm);
  }
  return fmt::format(
      "{} before view {}; hold it fast, and begin again if it must not be in two parts",
      what,
      view + 1);
}

}  // namespace

ViewWatch::ViewWatch(const Rig& rig) : rig_(rig), thinned_(rig) {
  CameraModel& camera = thinned_.reference().model;
  step_ = thinning_step(camera, kMostPixels);
  camera = thinned(camera, step_);
}

WatchedView ViewWatch::compare(
    std::size_t view, double angle_rad, int setup, const DecodedView& decoded, const Run& run) {
  if (!rig_.turntable || rig_.projector.is_label) return {};
  if (rays_.empty()) rays_ = rays_of(rig_.reference().model);
  DecodedView own = decoded;
  const ViewFit fit = check_view(own, rig_, rays_, false);
  if (!fit.fits()) return {};
  const RangeGrid range = triangulate_view(own, fit, rig_, rays_, DirectionChoice::Fused).range;
  return compare(view, angle_rad, setup, range, own.directions.front().coarsest, run);
}

WatchedView ViewWatch::compare(std::size_t view,
                               double angle_rad,
                               int setup,
                               const RangeGrid& range,
                               const Pattern& pattern,
                               const Run& run) {
  if (!rig_.turntable || rig_.projector.is_label || range.depth_mm.empty()) return {};
  if (setup != setup_) seen_.clear();
  setup_ = setup;
  std::erase_if(seen_, [&](const Seen& one) { return one.view == view; });  // captured again
  if (seen_.size() == kMostViews) seen_.erase(seen_.begin());
  seen_.push_back({view, angle_rad, thinned(range, step_)});
  if (seen_.size() < 2) return {};
  ViewStore store;
  std::vector<Station> stations;
  for (const Seen& one : seen_) {
    store.add({.range = one.range,
               .rig_from_object = thinned_.rig_from_object(one.angle_rad),
               .edge_pixels = {}});
    stations.push_back({.angle_rad = one.angle_rad, .name = fmt::format("{}", one.view + 1)});
  }
  const CameraModel& camera = thinned_.reference().model;
  Run quiet;
  quiet.stop = run.stop;
  clip_background(store, camera, quiet);
  clip_turntable_top(store, camera, quiet);
  TurntableStations given{*thinned_.turntable, stations};
  if (thinned_.cameras.size() == 1) {
    given.rig = &thinned_;
    given.pattern = &pattern;
  }
  const PoseExplanation found = register_views(store, camera, given, {}, quiet).explanation;
  if (!moved_at_last(found, seen_.size() - 1)) return {};
  seen_.erase(seen_.begin(), seen_.end() - 1);  // what follows is compared with this view
  return {finding_of(found, view), found.moved_mm, found.moved_sigma_mm};
}

}  // namespace frangia
