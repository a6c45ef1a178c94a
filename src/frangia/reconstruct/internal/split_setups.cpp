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

std::vector<MeasuredSetup> split_setups(MeasuredViews all, const std::vector<int>& numbers) {
  std::map<int, std::vector<std::size_t>> views;
  for (std::size_t i = 0; i < numbers.size(); ++i)
    views[numbers[i]].push_back(i);
  std::vector<MeasuredSetup> setups;
  if (views.size() < 2) {
    setups.push_back({numbers.empty() ? 0 : numbers.front(), std::move(all), {}, {}});
    return setups;
  }
  for (const auto& [number, which] : views) {
    MeasuredSetup setup{number, {}, {}, {}};
    setup.measured.coarsest = all.coarsest;
    setup.measured.unwrapped_spatially = all.unwrapped_spatially;
    for (std::size_t i = 0; i < which.size(); ++i) {
      const View view = all.views.load(which[i]);
      setup.measured.points += measured_points(view);
      setup.measured.views.add(view);
      setup.measured.more.resize(all.more.size());
      for (std::size_t camera = 0; camera < all.more.size(); ++camera) {
        const View other = all.more[camera].load(which[i]);
        setup.measured.points += measured_points(other);
        setup.measured.more[camera].add(other);
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

}  // namespace frangia
