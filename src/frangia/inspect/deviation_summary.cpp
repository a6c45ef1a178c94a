#include "frangia/inspect/deviation_summary.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/core/error.h"
#include "frangia/core/median.h"
#include "frangia/inspect/internal/vertex_use.h"

namespace frangia {
namespace {

double u_of(const Deviations& deviations, std::size_t vertex) {
  return deviations.u_mm.empty() ? 0.0 : static_cast<double>(deviations.u_mm[vertex]);
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

DeviationSummary summarize(const Mesh& mesh, const Deviations& deviations) {
  DeviationSummary summary;
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
    if (!(summary.min_mm <= value)) {
      summary.min_mm = value;
      summary.min_at_mm = mesh.vertices_mm[i].cast<double>();
    }
    if (!(summary.max_mm >= value)) {
      summary.max_mm = value;
      summary.max_at_mm = mesh.vertices_mm[i].cast<double>();
    }
    if (!deviations.u_mm.empty() && std::isfinite(deviations.u_mm[i]))
      known_u.push_back(deviations.u_mm[i]);
  }
  if (summary.area_mm2 > 0.0) {
    summary.mean_mm = sum / summary.area_mm2;
    summary.rms_mm = std::sqrt(squares / summary.area_mm2);
  }
  if (!known_u.empty())
    summary.median_u_mm = static_cast<double>(median_in_place(std::span<float>(known_u)));
  return summary;
}

std::string left_out_text(const DeviationSummary& summary) {
  std::vector<std::string> parts;
  for (std::size_t i = 1; i < kDeviationStatuses; ++i) {
    std::string name(name_of(static_cast<DeviationStatus>(i)));
    std::replace(name.begin(), name.end(), '_', ' ');
    if (summary.count.at(i) > 0) parts.push_back(fmt::format("{} {}", summary.count.at(i), name));
  }
  return parts.empty() ? "none" : fmt::format("{}", fmt::join(parts, ", "));
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
