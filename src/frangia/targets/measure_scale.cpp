#include "frangia/targets/measure_scale.h"

#include <algorithm>
#include <cmath>

namespace frangia {
namespace {

const Target* find_code(std::span<const Target> targets, int code) {
  const auto found = std::find_if(
      targets.begin(), targets.end(), [code](const Target& target) { return target.code == code; });
  return found == targets.end() ? nullptr : &*found;
}

}  // namespace

bool TargetScale::contradicts() const {
  if (distances < 2) return false;
  // The 99.9 % point of chi squared, by the cube root of Wilson & Hilferty 1931.
  const double freedom = static_cast<double>(distances) - 1.0;
  const double spread = 2.0 / (9.0 * freedom);
  constexpr double kPoint = 3.09;
  return chi_squared > freedom * std::pow(1.0 - spread + kPoint * std::sqrt(spread), 3);
}

std::optional<TargetScale> measure_scale(std::span<const Target> targets, const TargetSet& set) {
  TargetScale scale;
  double weights = 0.0;
  double sum = 0.0;
  std::vector<std::pair<double, double>> factors;  // with their variances
  for (const KnownTargetDistance& known : set.distances) {
    const Target* first = find_code(targets, known.first);
    const Target* second = find_code(targets, known.second);
    if (first == nullptr || second == nullptr) {
      scale.missing.push_back(known);
      continue;
    }
    const Eigen::Vector3d away = second->center_mm - first->center_mm;
    const double measured_mm = away.norm();
    const Eigen::Vector3d along = away / measured_mm;
    const double variance_mm2 =
        along.dot((first->covariance_mm2 + second->covariance_mm2) * along) +
        known.sigma_mm * known.sigma_mm;
    const double variance = variance_mm2 / (measured_mm * measured_mm);
    factors.emplace_back(known.distance_mm / measured_mm, variance);
    weights += 1.0 / variance;
    sum += factors.back().first / variance;
  }
  if (factors.empty()) return std::nullopt;
  scale.distances = factors.size();
  scale.factor = sum / weights;
  scale.sigma = std::sqrt(1.0 / weights);
  for (const auto& [factor, variance] : factors)
    scale.chi_squared += std::pow(factor - scale.factor, 2) / variance;
  return scale;
}

}  // namespace frangia
