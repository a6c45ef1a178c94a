#include "frangia/reconstruct/internal/split_setups.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>

namespace frangia {
namespace {

std::size_t measured_points(const View& view) {
  const auto depth = view.range.depth_mm.pixels();
  return static_cast<std::size_t>(
      std::count_if(depth.begin(), depth.end(), [](float z) { return !std::isnan(z); }));
}

}  // namespace

std::vector<MeasuredSetup> split_setups(MeasuredViews all) {
  const std::vector<int>& numbers = all.setups;
  std::map<int, std::vector<std::size_t>> views;
  for (std::size_t i = 0; i < numbers.size(); ++i)
    views[numbers[i]].push_back(i);
  std::vector<MeasuredSetup> setups;
  if (views.size() < 2) {
    const int number = numbers.empty() ? 0 : numbers.front();
    setups.push_back({number, std::move(all), {}, {}});
    return setups;
  }
  for (const auto& [number, which] : views) {
    MeasuredSetup setup{number, {}, {}, {}};
    setup.measured.cameras.resize(all.cameras.size());
    setup.measured.coarsest = all.coarsest;
    setup.measured.unwrapped_spatially = all.unwrapped_spatially;
    for (std::size_t i = 0; i < which.size(); ++i) {
      for (std::size_t camera = 0; camera < all.cameras.size(); ++camera) {
        const View view = all.cameras[camera].load(which[i]);
        setup.measured.points += measured_points(view);
        setup.measured.cameras[camera].add(view);
      }
      setup.measured.stations.push_back(all.stations[which[i]]);
      for (UnresolvedViewRegion& part : all.unresolved) {
        if (part.view == which[i]) setup.measured.unresolved.push_back({i, std::move(part.region)});
      }
    }
    setups.push_back(std::move(setup));
  }
  return setups;
}

void add_outliers(std::set<std::string>& names, const MeasuredSetup& setup) {
  if (!setup.registration) return;
  for (const std::size_t view : setup.registration->outliers)
    names.insert(setup.measured.stations[view].name);
}

void mark_left_out(std::vector<ViewSummary>& summaries,
                   const MeasuredSetup& joined,
                   const std::set<std::string>& outliers) {
  std::set<std::string> used;
  for (const Station& station : joined.measured.stations)
    used.insert(station.name);
  for (ViewSummary& view : summaries) {
    if (!used.contains(view.name) || outliers.contains(view.name)) view.left_out = true;
  }
}

}  // namespace frangia
