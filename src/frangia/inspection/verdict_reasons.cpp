#include "frangia/inspection/verdict_reasons.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>

namespace frangia {
namespace {

VerdictClause clause_of_worst(const MeasuredCharacteristic& worst) {
  if (!std::isfinite(worst.value))
    return {"not_found", {{"name", worst.name}}, fmt::format("{} was not measured", worst.name)};
  std::string text = fmt::format("the worst is {}: {:.4f} {}", worst.name, worst.value, worst.unit);
  if (std::isfinite(worst.u95)) text += fmt::format(", U95 {:.4f}", worst.u95);
  return {"worst",
          {{"name", worst.name}, {"value", worst.value}, {"unit", worst.unit}, {"u95", worst.u95}},
          std::move(text)};
}

/// How many of the rows with limits are in, out and undecided, and the worst of them.
std::optional<VerdictReason> reason_of_rows(const std::vector<MeasuredCharacteristic>& rows) {
  std::array<std::size_t, 3> count{};
  std::size_t limited = 0;
  for (const MeasuredCharacteristic& row : rows) {
    if (!row.limits) continue;
    ++limited;
    ++count.at(static_cast<std::size_t>(row.conformity));
  }
  if (limited == 0) return std::nullopt;
  const auto of = [&](Conformity conformity) {
    return count.at(static_cast<std::size_t>(conformity));
  };
  std::string text = fmt::format("{} of {} in", of(Conformity::In), limited);
  if (of(Conformity::Out) > 0) text += fmt::format(", {} out", of(Conformity::Out));
  if (of(Conformity::Undecided) > 0)
    text += fmt::format(", {} undecided", of(Conformity::Undecided));
  VerdictReason reason{"characteristics",
                       {{"counts",
                         {{"of", static_cast<double>(limited)},
                          {"in", static_cast<double>(of(Conformity::In))},
                          {"out", static_cast<double>(of(Conformity::Out))},
                          {"undecided", static_cast<double>(of(Conformity::Undecided))}},
                         std::move(text)}}};
  const MeasuredCharacteristic worst = worst_first(rows).front();
  if (worst.conformity != Conformity::In) reason.clauses.push_back(clause_of_worst(worst));
  const bool is_known =
      std::all_of(rows.begin(), rows.end(), [](const auto& row) { return row.uncertainty_known; });
  if (!is_known) reason.clauses.push_back(no_uncertainty_clause());
  return reason;
}

}  // namespace

Conformity verdict_of(const SurfaceVerdict* surface,
                      const std::vector<MeasuredCharacteristic>& characteristics) {
  const Conformity rows = overall(characteristics);
  if (surface == nullptr) return rows;
  const bool limited = std::any_of(characteristics.begin(),
                                   characteristics.end(),
                                   [](const auto& row) { return row.limits.has_value(); });
  const Conformity deviation = surface->conformity;
  if (!limited) return deviation;
  if (rows == Conformity::Out || deviation == Conformity::Out) return Conformity::Out;
  const bool both = rows == Conformity::In && deviation == Conformity::In;
  return both ? Conformity::In : Conformity::Undecided;
}

std::string VerdictReason::text() const {
  return fmt::format("{}: {}", about, sentence_of(clauses));
}

std::vector<VerdictReason> verdict_reasons(
    const SurfaceVerdict* surface, const std::vector<MeasuredCharacteristic>& characteristics) {
  std::vector<VerdictReason> reasons;
  if (auto rows = reason_of_rows(characteristics)) reasons.push_back(std::move(*rows));
  if (surface == nullptr) return reasons;
  const bool surface_decides = surface->conformity == verdict_of(surface, characteristics) &&
                               overall(characteristics) != Conformity::Out;
  reasons.insert(surface_decides ? reasons.begin() : reasons.end(),
                 {"surface", clauses_of(*surface)});
  return reasons;
}

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
