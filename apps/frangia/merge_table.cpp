#include "merge_table.h"

#include <cstddef>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "counted.h"
#include "text_table.h"

namespace frangia {

std::string readable_mm(double value_mm) {
  constexpr int kMostDecimals = 12;
  int decimals = 4;
  for (double least = 0.01; value_mm > 0.0 && value_mm < least && decimals < kMostDecimals;
       least /= 10.0)
    ++decimals;
  return fmt::format("{:.{}f}", value_mm, decimals);
}

std::string merge_table(const std::vector<MergedScan>& scans) {
  TextColumn name{"scan", {}, false};
  TextColumn points{"points", {}};
  TextColumn dropped{"dropped", {}};
  TextColumn noise{"noise mm", {}};
  TextColumn state{"", {}, false};
  for (const MergedScan& scan : scans) {
    name.values.push_back(scan.name);
    points.values.push_back(fmt::format("{}", scan.points));
    dropped.values.push_back(fmt::format("{}", scan.dropped.total()));
    noise.values.push_back(readable_mm(scan.noise_mm));
    state.values.emplace_back(scan.left_out ? "left out" : "");
  }
  return text_table({name, points, dropped, noise, state});
}

std::string dropped_text(const std::vector<MergedScan>& scans) {
  DroppedPoints all;
  std::size_t points_read = 0;
  for (const MergedScan& scan : scans) {
    points_read += scan.points_read;
    all.unconnected += scan.dropped.unconnected;
    all.hidden += scan.dropped.hidden;
    all.too_dense += scan.dropped.too_dense;
  }
  if (all.total() == 0) return {};
  std::vector<std::string> reasons;
  if (all.unconnected > 0)
    reasons.push_back(fmt::format("{} without a neighbour to connect to", all.unconnected));
  if (all.hidden > 0)
    reasons.push_back(fmt::format("{} hidden by their own scan or seen from behind", all.hidden));
  if (all.too_dense > 0)
    reasons.push_back(fmt::format("{} closer together than the resampling", all.too_dense));
  return fmt::format("dropped {} of {}: {}\n",
                     all.total(),
                     counted(points_read, "point"),
                     fmt::join(reasons, ", "));
}

}  // namespace frangia
