#include "frangia/scan_plan/scan_need.h"

#include <algorithm>
#include <cmath>

namespace frangia {
namespace {

double half_width_of(const ToleranceLimits& limits) {
  if (!std::isfinite(limits.lower)) return 0.5 * limits.upper;
  return 0.5 * (limits.upper - limits.lower);
}

ScanNeed need_of_surface(const SurfaceVerdict& verdict) {
  if (verdict.conformity != Conformity::Undecided) return ScanNeed::Nothing;
  switch (verdict.reason) {
    case UndecidedReason::NotMeasured:
      return ScanNeed::Coverage;
    case UndecidedReason::Systematic:
      return ScanNeed::Calibration;
    case UndecidedReason::None:
    case UndecidedReason::Noise:
    case UndecidedReason::NearLimit:
      break;
  }
  return ScanNeed::Noise;
}

/// What an inspection needs most.
ScanNeed need_of(const Inspection& part, const std::vector<DecidableCharacteristic>& rows) {
  if (part.verdict == Conformity::Out) return ScanNeed::Nothing;
  const ScanNeed surface =
      part.surface ? need_of_surface(part.surface->verdict) : ScanNeed::Nothing;
  if (surface != ScanNeed::Nothing) return surface;
  ScanNeed need = ScanNeed::Nothing;
  for (const DecidableCharacteristic& row : rows) {
    if (row.is_decidable) continue;
    if (!std::isfinite(row.u95)) return ScanNeed::Coverage;
    need = ScanNeed::Noise;
  }
  return need;
}

}  // namespace

std::vector<DecidableCharacteristic> decidable_characteristics(const Inspection& part,
                                                               double max_uncertainty_share) {
  std::vector<DecidableCharacteristic> rows;
  for (const MeasuredCharacteristic& row : part.characteristics) {
    if (!row.limits) continue;
    const double half_width = half_width_of(*row.limits);
    rows.push_back(
        {row.name, row.unit, half_width, row.u95, row.u95 <= max_uncertainty_share * half_width});
  }
  return rows;
}

ScanReach reach_of(const Inspection& part, double max_uncertainty_share) {
  const auto rows = decidable_characteristics(part, max_uncertainty_share);
  ScanReach reach{.need = need_of(part, rows)};
  if (part.surface) reach.decidable_share = part.surface->verdict.coverage;
  for (const DecidableCharacteristic& row : rows)
    reach.decidable += row.is_decidable ? 1 : 0;
  return reach;
}

bool decides_more(const ScanReach& one, const ScanReach& other) {
  constexpr double kClear = 0.005;  // of the nominal area
  if (one.need == ScanNeed::Nothing) return other.need != ScanNeed::Nothing;
  return one.decidable > other.decidable ||
         (one.decidable == other.decidable && one.decidable_share > other.decidable_share + kClear);
}

}  // namespace frangia
