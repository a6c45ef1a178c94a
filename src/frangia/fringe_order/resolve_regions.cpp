#include "frangia/fringe_order/resolve_regions.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include "frangia/core/angles.h"
#include "frangia/core/missing.h"
#include "frangia/core/statistics.h"
#include "frangia/range/triangulate.h"

namespace frangia {
namespace {

/// Minimum number of laser line points on a region.
constexpr std::size_t kMinCrossings = 3;

/// Largest median distance of the laser line's points from the order of their region, in fringes. A
/// few neighbouring points lie equally far from some order by chance, such as those of light that
/// is not the line: they count where the distance is that of a calibrated sheet.
double most_departure(std::size_t crossings) {
  constexpr std::size_t kFew = 20;
  constexpr double kOfFew = 0.1;
  constexpr double kOfMany = 0.25;  // so far a sheet may be from where the rig states it
  return crossings < kFew ? kOfFew : kOfMany;
}

/// The order to add to each region, where known.
using Orders = std::vector<std::optional<int>>;

/// Pixels closer than this to another region may be mixed: two pixels of a border can each see both
/// sides.
constexpr int kBorderPx = 2;

/// Whether a pixel lies so close to another region that it may see that region's surface too.
bool at_border(const Image<std::int32_t>& region, std::size_t i) {
  const auto row = static_cast<std::size_t>(region.width());
  const int x = static_cast<int>(i % row);
  const int y = static_cast<int>(i / row);
  const std::int32_t own = region(x, y);
  for (int v = std::max(0, y - kBorderPx); v <= std::min(region.height() - 1, y + kBorderPx); ++v) {
    for (int u = std::max(0, x - kBorderPx); u <= std::min(region.width() - 1, x + kBorderPx);
         ++u) {
      if (region(u, v) >= 0 && region(u, v) != own) return true;
    }
  }
  return false;
}

ResolvedPhase with_orders(const RelativePhase& relative, const Orders& orders) {
  ResolvedPhase out;
  out.phase = {relative.pattern,
               relative.phase_rad,
               relative.sigma_rad,
               relative.status,
               relative.systematic_rad};
  const bool has_systematic = !relative.systematic_rad.empty();
  std::vector<UnresolvedRegion> unresolved(orders.size());
  const auto labels = relative.region.pixels();
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] < 0) continue;
    const auto region = static_cast<std::size_t>(labels[i]);
    float& phase = out.phase.phase_rad.pixels()[i];
    float& sigma = out.phase.sigma_rad.pixels()[i];
    if (at_border(relative.region, i)) {
      out.phase.status.pixels()[i] = PixelStatus::MixedPixel;
    } else if (orders[region]) {
      phase = static_cast<float>(phase + kTwoPi * *orders[region]);
      continue;
    } else {
      unresolved[region].pixel.push_back(static_cast<std::uint32_t>(i));
      unresolved[region].phase_rad.push_back(phase);
      unresolved[region].sigma_rad.push_back(sigma);
      if (has_systematic)
        unresolved[region].systematic_rad.push_back(relative.systematic_rad.pixels()[i]);
      out.phase.status.pixels()[i] = PixelStatus::Unresolved;
    }
    phase = kMissing;
    sigma = kMissing;
    if (has_systematic) out.phase.systematic_rad.pixels()[i] = kMissing;
  }
  for (UnresolvedRegion& region : unresolved) {
    if (!region.pixel.empty()) out.unresolved.push_back(std::move(region));
  }
  return out;
}

struct LaserCrossing {
  int region;
  double fringes;  ///< to add, not yet rounded
};

/// Compares the expected phase of a profile point with the relative phase at its sub-pixel
/// position, interpolated between two measured pixels of one region.
std::optional<LaserCrossing> crossing_of(const RelativePhase& phase,
                                         const ProfilePoint& point,
                                         const Projector& projector) {
  const double expected = phase_at(point.point_mm, phase.pattern, projector);
  if (std::isnan(expected)) return {};
  const int x = static_cast<int>(std::floor(point.pixel.x()));
  const int y = static_cast<int>(std::floor(point.pixel.y()));
  const double fx = point.pixel.x() - x;
  const double fy = point.pixel.y() - y;
  const int u = fx > 0.0 ? x + 1 : x;
  const int v = fy > 0.0 ? y + 1 : y;
  if (x < 0 || y < 0 || u >= phase.region.width() || v >= phase.region.height()) return {};
  const int region = phase.region(x, y);
  if (region < 0 || phase.region(u, v) != region) return {};
  // Near a border, the laser line may lie on the other region's surface.
  const auto row = static_cast<std::size_t>(phase.region.width());
  if (at_border(phase.region, static_cast<std::size_t>(y) * row + static_cast<std::size_t>(x))) {
    return {};
  }
  // Profile points have one integer coordinate, so fx or fy is zero.
  const double share = fx + fy;
  const double here = (1.0 - share) * phase.phase_rad(x, y) + share * phase.phase_rad(u, v);
  return LaserCrossing{region, (expected - here) / kTwoPi};
}

std::optional<int> vote(const std::vector<double>& fringes, const FringeOrderOptions& options) {
  if (fringes.size() < kMinCrossings) return {};
  std::map<int, int> votes;
  for (const double value : fringes)
    ++votes[static_cast<int>(std::lround(value))];
  const auto winner = std::max_element(
      votes.begin(), votes.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  if (winner->second < options.min_agreement * static_cast<double>(fringes.size())) return {};
  std::vector<double> departures;
  for (const double value : fringes)
    departures.push_back(std::abs(value - winner->first));
  if (median_in_place(std::span<double>(departures)) > most_departure(fringes.size())) return {};
  return winner->first;
}

}  // namespace

ResolvedPhase resolve_by_laser_sheet(const RelativePhase& phase,
                                     const std::vector<ProfilePoint>& profile,
                                     const Projector& projector,
                                     const FringeOrderOptions& options) {
  std::vector<std::vector<double>> fringes(static_cast<std::size_t>(phase.region_count));
  for (const ProfilePoint& point : profile) {
    if (const auto crossing = crossing_of(phase, point, projector)) {
      fringes[static_cast<std::size_t>(crossing->region)].push_back(crossing->fringes);
    }
  }
  Orders orders;
  for (const auto& offsets : fringes)
    orders.push_back(vote(offsets, options));
  return with_orders(phase, orders);
}

ResolvedPhase resolve_by_distance(const RelativePhase& phase,
                                  const Rig& rig,
                                  const Image<Eigen::Vector2f>& rays,
                                  double distance_mm) {
  std::vector<std::vector<double>> fringes(static_cast<std::size_t>(phase.region_count));
  const auto labels = phase.region.pixels();
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] < 0) continue;
    const Eigen::Vector2f ray = rays.pixels()[i];
    const Eigen::Vector3d point = distance_mm * Eigen::Vector3d(ray.x(), ray.y(), 1.0);
    const double expected = phase_at(point, phase.pattern, rig.projector);
    if (std::isnan(expected)) continue;
    fringes[static_cast<std::size_t>(labels[i])].push_back(
        (expected - phase.phase_rad.pixels()[i]) / kTwoPi);
  }
  Orders orders;
  for (auto& offsets : fringes) {
    orders.emplace_back();
    if (offsets.empty()) continue;
    orders.back() = static_cast<int>(std::lround(median_in_place(std::span<double>(offsets))));
  }
  return with_orders(phase, orders);
}

}  // namespace frangia
