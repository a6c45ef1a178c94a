#include "frangia/inspect/deviation_summary.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "frangia/core/error.h"
#include "frangia/core/median.h"
#include "frangia/inspect/internal/vertex_use.h"

namespace frangia {
namespace {

double u_of(const Deviations& deviations, std::size_t vertex) {
  return deviations.u_mm.empty() ? 0.0 : static_cast<double>(deviations.u_mm[vertex]);
}

/// The share of each conformity and the verdict about the part.
void decide(DeviationSummary& summary,
            const Deviations& deviations,
            const std::vector<double>& areas) {
  std::array<double, 3> area{};
  bool is_out = false;
  bool all_in = true;
  const std::size_t compared =
      summary.count.at(static_cast<std::size_t>(DeviationStatus::Compared));
  const double many = guard_band_of_many(compared);
  for (std::size_t i = 0; i < areas.size(); ++i) {
    if (deviations.status[i] != DeviationStatus::Compared) continue;
    const auto value = static_cast<double>(deviations.deviation_mm[i]);
    const double u = u_of(deviations, i);
    const Conformity one = conformity_of(value, u, summary.limits);
    area.at(static_cast<std::size_t>(one)) += areas[i];
    all_in = all_in && one == Conformity::In;
    is_out = is_out || conformity_of(value, u, summary.limits, many) == Conformity::Out;
  }
  if (compared == 0 || !(summary.area_mm2 > 0.0)) return;
  summary.verdict = all_in ? Conformity::In : Conformity::Undecided;
  if (is_out) summary.verdict = Conformity::Out;
  summary.in_share = area[0] / summary.area_mm2;
  summary.out_share = area[1] / summary.area_mm2;
  summary.undecided_share = area[2] / summary.area_mm2;
}

}  // namespace

std::vector<Conformity> conformities(const Deviations& deviations, const ToleranceLimits& limits) {
  std::vector<Conformity> decided(deviations.status.size(), Conformity::Undecided);
  for (std::size_t i = 0; i < decided.size(); ++i) {
    if (deviations.status[i] != DeviationStatus::Compared) continue;
    decided[i] =
        conformity_of(static_cast<double>(deviations.deviation_mm[i]), u_of(deviations, i), limits);
  }
  return decided;
}

DeviationSummary summarize(const Mesh& mesh,
                           const Deviations& deviations,
                           const ToleranceLimits& limits) {
  limits.check();
  DeviationSummary summary;
  summary.limits = limits;
  const std::vector<double> areas = vertex_areas(mesh);
  std::vector<float> known_u;
  double sum = 0.0;
  double squares = 0.0;
  for (std::size_t i = 0; i < areas.size(); ++i) {
    ++summary.count.at(static_cast<std::size_t>(deviations.status[i]));
    if (deviations.status[i] != DeviationStatus::Compared) continue;
    const auto value = static_cast<double>(deviations.deviation_mm[i]);
    summary.area_mm2 += areas[i];
    sum += areas[i] * value;
    squares += areas[i] * value * value;
    if (!(summary.min_mm <= value)) summary.min_mm = value;
    if (!(summary.max_mm >= value)) summary.max_mm = value;
    if (!deviations.u_mm.empty() && std::isfinite(deviations.u_mm[i]))
      known_u.push_back(deviations.u_mm[i]);
  }
  if (summary.area_mm2 > 0.0) {
    summary.mean_mm = sum / summary.area_mm2;
    summary.rms_mm = std::sqrt(squares / summary.area_mm2);
  }
  if (!known_u.empty())
    summary.median_u_mm = static_cast<double>(median_in_place(std::span<float>(known_u)));
  decide(summary, deviations, areas);
  return summary;
}

std::vector<float> deviation_histogram(const Mesh& mesh,
                                       const std::vector<float>& deviation_mm,
                                       double low,
                                       double high,
                                       std::size_t bins) {
  require(bins > 0 && low < high, "a histogram needs intervals, and a lower end below the upper");
  const std::vector<double> areas = vertex_areas(mesh);
  std::vector<double> sums(bins, 0.0);
  double total = 0.0;
  for (std::size_t i = 0; i < areas.size(); ++i) {
    const auto value = static_cast<double>(deviation_mm[i]);
    if (std::isnan(value)) continue;
    const double position = (value - low) / (high - low) * static_cast<double>(bins);
    const double inside = std::clamp(position, 0.0, static_cast<double>(bins) - 0.5);
    sums[static_cast<std::size_t>(inside)] += areas[i];
    total += areas[i];
  }
  std::vector<float> shares(bins, 0.0F);
  for (std::size_t i = 0; i < bins && total > 0.0; ++i)
    shares[i] = static_cast<float>(sums[i] / total);
  return shares;
}

}  // namespace frangia
