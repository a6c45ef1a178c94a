#include "frangia/inspect/internal/out_guard.h"

#include <algorithm>
#include <numbers>
#include <set>
#include <span>
#include <tuple>
#include <vector>

#include "frangia/core/statistics.h"

namespace frangia::inspect {
namespace {

/// Number of cells of 3 x 3 x 3 over the part that hold patches: regions over which a systematic
/// error is taken to be alike.
std::size_t regions_of(const SurfacePatches& patches) {
  Eigen::AlignedBox3f box;
  for (const auto& center : patches.center_mm)
    box.extend(center);
  const Eigen::Vector3f side = box.sizes().cwiseMax(1e-6F * box.sizes().maxCoeff());
  std::set<std::tuple<int, int, int>> cells;
  for (const auto& center : patches.center_mm) {
    const Eigen::Vector3f cell = (3.0F * (center - box.min()).cwiseQuotient(side)).cwiseMin(2.5F);
    cells.emplace(
        static_cast<int>(cell.x()), static_cast<int>(cell.y()), static_cast<int>(cell.z()));
  }
  return cells.size();
}

}  // namespace

OutGuard out_guard_of(const SurfacePatches& patches) {
  OutGuard guard;
  double area = 0.0;
  std::size_t measured = 0;
  std::vector<double> noises;
  std::vector<double> systematics;
  for (std::size_t i = 0; i < patches.size(); ++i) {
    if (!patches.is_measured(i) || patches.at_edge[i] != 0) continue;
    area += patches.area_mm2[i];
    ++measured;
    if (!std::isfinite(patches.u_mm(i))) continue;
    noises.push_back(static_cast<double>(patches.noise_mm[i]));
    systematics.push_back(static_cast<double>(patches.systematic_mm[i]));
  }
  if (measured == 0) return guard;
  const double disk = 0.25 * std::numbers::pi * patches.diameter_mm * patches.diameter_mm;
  guard.independent =
      std::clamp<std::size_t>(static_cast<std::size_t>(std::ceil(area / disk)), 1, measured);
  guard.together = guard_band_of_many(guard.independent);
  guard.noise = guard_band_of_many(2 * guard.independent);
  guard.systematic = guard_band_of_many(2 * regions_of(patches));
  const double noise = median_in_place(std::span<double>(noises));
  const double systematic = median_in_place(std::span<double>(systematics));
  guard.split = guard.noise * noise + guard.systematic * systematic <
                guard.together * std::hypot(noise, systematic);
  return guard;
}

}  // namespace frangia::inspect
