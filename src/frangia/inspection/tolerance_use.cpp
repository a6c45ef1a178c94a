#include "frangia/inspection/tolerance_use.h"

#include <algorithm>
#include <cmath>

namespace frangia {
namespace {

int rank_of(const MeasuredCharacteristic& row) {
  if (!row.limits) return 3;
  if (row.conformity == Conformity::Out) return 0;
  return row.conformity == Conformity::Undecided ? 1 : 2;
}

}  // namespace

double tolerance_used(const MeasuredCharacteristic& row) {
  if (!row.limits) return kMissing;
  const ToleranceLimits& limits = *row.limits;
  if (!std::isfinite(limits.lower)) return row.value / limits.upper;
  const double middle = 0.5 * (limits.lower + limits.upper);
  return std::abs(row.value - middle) / (limits.upper - middle);
}

std::vector<MeasuredCharacteristic> worst_first(std::vector<MeasuredCharacteristic> rows) {
  const auto used = [](const MeasuredCharacteristic& row) {
    const double share = tolerance_used(row);
    return std::isfinite(share) ? share : 1.0;
  };
  std::stable_sort(rows.begin(), rows.end(), [&](const auto& a, const auto& b) {
    if (rank_of(a) != rank_of(b)) return rank_of(a) < rank_of(b);
    return used(a) > used(b);
  });
  return rows;
}

}  // namespace frangia
