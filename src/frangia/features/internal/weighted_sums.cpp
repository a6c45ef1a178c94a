#include "frangia/features/internal/weighted_sums.h"

#include <algorithm>
#include <cmath>

#include "frangia/core/statistics.h"
#include "frangia/geometry/robust_gauss_newton.h"

namespace frangia {

PointWeights::PointWeights(const FeaturePoints& points, std::span<const std::uint32_t> chosen) {
  if (points.noise_mm.empty() || chosen.empty()) return;
  constexpr std::size_t kEnough = 2000;  // for a median
  const std::size_t step = std::max<std::size_t>(1, chosen.size() / kEnough);
  std::vector<double> some;
  for (std::size_t i = 0; i < chosen.size(); i += step)
    some.push_back(points.noise_mm[chosen[i]]);
  const double usual = median_in_place(std::span<double>(some));
  noise_ = &points.noise_mm;
  usual_variance_ = usual * usual;
}

void ShapeSums::add(const ShapeSums& other) {
  if (other.count > 0) {
    low = count > 0 ? std::min(low, other.low) : other.low;
    high = count > 0 ? std::max(high, other.high) : other.high;
  }
  hessian += other.hessian;
  gradient += other.gradient;
  shared += other.shared;
  noise += other.noise;
  weight += other.weight;
  slope += other.slope;
  count += other.count;
  squares += other.squares;
}

double ShapeSums::robust_factor() const {
  constexpr double kMost = 2.0;  // residuals that are not those of one shape
  return slope > 0.0 ? std::clamp(weight / slope, 1.0, kMost) : kMost;
}

void add_point(ShapeSums& sums,
               const FeaturePoints& points,
               std::uint32_t point,
               const Shape& shape,
               const PointWeights& weights,
               double gate_mm,
               bool robust) {
  const ShapeDistance at = distance_to(shape, points.points_mm[point]);
  const double r = at.distance_mm;
  if (!(std::abs(r) < gate_mm) || !at.derivatives.allFinite()) return;
  const double certain = weights.of(point);
  const double weight = robust ? certain * tukey_weight(r, gate_mm) : certain;
  sums.weight += weight;
  sums.slope += robust ? certain * tukey_slope(r, gate_mm) : certain;
  sums.low = sums.count > 0 ? std::min(sums.low, r) : r;
  sums.high = sums.count > 0 ? std::max(sums.high, r) : r;
  ++sums.count;
  sums.squares += r * r;
  sums.hessian.noalias() += weight * at.derivatives * at.derivatives.transpose();
  sums.gradient += weight * r * at.derivatives;
  if (!points.systematic_mm.empty())
    sums.shared += weight * points.systematic_mm[point] * at.derivatives;
  if (!points.noise_mm.empty()) {
    const double scaled = weight * points.noise_mm[point];
    sums.noise.noalias() += scaled * scaled * at.derivatives * at.derivatives.transpose();
  }
}

}  // namespace frangia
