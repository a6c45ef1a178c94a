#include "frangia/inspect/surface_verdict.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <span>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/core/statistics.h"
#include "frangia/inspect/internal/out_guard.h"

namespace frangia {
namespace {

using Eigen::Vector3d;
using inspect::OutGuard;

constexpr std::size_t kMostPlaces = 24;

/// Largest U95, of the half-width, of a patch whose lack of a proof is due to its value: of a good
/// part, which is off by less than its U95, the guard band proves such a patch. A value beyond a
/// limit counts up to twice the share of a patch that is measured well: on a good part it would lie
/// at four standard uncertainties.
double near_share(const SurfaceRule& rule, bool is_beyond) {
  constexpr double kProvenOnGoodParts = 0.35;
  return is_beyond ? 2.0 * rule.well_measured_share()
                   : std::min(kProvenOnGoodParts, rule.max_uncertainty_share);
}

PatchDecision decide(const SurfacePatches& patches,
                     std::size_t i,
                     const SurfaceRule& rule,
                     const OutGuard& guard) {
  if (patches.missing[i] != 0) return PatchDecision::Out;
  if (patches.at_edge[i] != 0) return PatchDecision::AtEdge;
  if (!patches.is_measured(i)) return PatchDecision::NotMeasured;
  const auto value = static_cast<double>(patches.deviation_mm[i]);
  const double u = patches.u_mm(i);
  if (!std::isfinite(u)) return PatchDecision::NotWellMeasured;
  const double beyond = guard.guard_mm(static_cast<double>(patches.noise_mm[i]),
                                       static_cast<double>(patches.systematic_mm[i]));
  if (value < rule.limits.lower - beyond || value > rule.limits.upper + beyond)
    return PatchDecision::Out;
  const double share = 2.0 * kNormal95 * u / (rule.limits.upper - rule.limits.lower);
  if (share <= rule.max_uncertainty_share && conformity_of(value, u, rule.limits) == Conformity::In)
    return PatchDecision::In;
  const bool is_beyond = value < rule.limits.lower || value > rule.limits.upper;
  return share > near_share(rule, is_beyond) ? PatchDecision::NotWellMeasured
                                             : PatchDecision::NearLimit;
}

bool is_gap(PatchDecision decision) {
  return decision == PatchDecision::NotMeasured || decision == PatchDecision::NotWellMeasured;
}

bool is_decided(PatchDecision decision) {
  return !is_gap(decision) && decision != PatchDecision::AtEdge;
}

/// Distance of each patch, over the judged surface, from the nearest one that is decided; infinite
/// where none can be reached.
std::vector<double> gap_distances(const SurfacePatches& patches,
                                  const std::vector<PatchDecision>& decided) {
  using Step = std::pair<double, std::uint32_t>;
  std::priority_queue<Step, std::vector<Step>, std::greater<>> next;
  std::vector<double> distance(patches.size(), std::numeric_limits<double>::infinity());
  for (std::uint32_t i = 0; i < patches.size(); ++i) {
    if (!is_decided(decided[i])) continue;
    distance[i] = 0.0;
    next.emplace(0.0, i);
  }
  while (!next.empty()) {
    const auto [reached, i] = next.top();
    next.pop();
    if (reached > distance[i]) continue;
    for (const std::uint32_t k : patches.neighbors[i]) {
      // Strips along edges lack nothing: half of a step into or out of one counts.
      const double counts = 1.0 - 0.5 * (patches.at_edge[i] + patches.at_edge[k]);
      const double there =
          reached +
          counts * static_cast<double>((patches.center_mm[k] - patches.center_mm[i]).norm());
      if (there >= distance[k]) continue;
      distance[k] = there;
      next.emplace(there, k);
    }
  }
  return distance;
}

/// Finds the widest gap: its width is twice the largest distance of its patches.
void find_gap(SurfaceVerdict& verdict,
              const SurfacePatches& patches,
              const std::vector<PatchDecision>& decided,
              const std::vector<double>& distance) {
  for (std::size_t i = 0; i < patches.size(); ++i) {
    if (decided[i] == PatchDecision::AtEdge) continue;
    const double width = std::min(2.0 * distance[i], patches.size_mm);
    if (width <= verdict.gap_mm) continue;
    verdict.gap_mm = width;
    verdict.gap_at_mm = patches.center_mm[i].cast<double>();
  }
}

/// How bad a patch is among those of its decision.
double badness(const SurfacePatches& patches,
               std::size_t i,
               PatchDecision decision,
               const ToleranceLimits& limits,
               const std::vector<double>& distance) {
  if (decision == PatchDecision::NotWellMeasured) return patches.u_mm(i);
  if (decision == PatchDecision::NotMeasured) return distance[i];
  if (!patches.is_measured(i)) return 0.0;
  const auto value = static_cast<double>(patches.deviation_mm[i]);
  return std::max(limits.lower - value, value - limits.upper);
}

/// Connected parts of the surface that were decided alike, the worst first.
std::vector<SurfacePlace> places_of(const SurfacePatches& patches,
                                    const std::vector<PatchDecision>& decided,
                                    const ToleranceLimits& limits,
                                    const std::vector<double>& distance) {
  std::vector<SurfacePlace> places;
  std::vector<std::uint8_t> seen(patches.size(), 0);
  for (std::uint32_t first = 0; first < patches.size(); ++first) {
    if (seen[first] != 0 || decided[first] == PatchDecision::In ||
        decided[first] == PatchDecision::AtEdge)
      continue;
    SurfacePlace place;
    place.decision = decided[first];
    std::uint32_t worst = first;
    double most = -std::numeric_limits<double>::infinity();
    std::vector<std::uint32_t> stack{first};
    seen[first] = 1;
    while (!stack.empty()) {
      const std::uint32_t i = stack.back();
      stack.pop_back();
      place.area_mm2 += patches.area_mm2[i];
      place.missing = place.missing || patches.missing[i] != 0;
      const double bad = badness(patches, i, place.decision, limits, distance);
      if (bad > most) {
        most = bad;
        worst = i;
      }
      for (const std::uint32_t k : patches.neighbors[i]) {
        if (seen[k] != 0 || decided[k] != place.decision) continue;
        seen[k] = 1;
        stack.push_back(k);
      }
    }
    place.at_mm = patches.center_mm[worst].cast<double>();
    place.normal = patches.normal[worst].cast<double>();
    if (patches.is_measured(worst)) {
      place.deviation_mm = static_cast<double>(patches.deviation_mm[worst]);
      if (patches.uncertainty_known) place.u95_mm = kNormal95 * patches.u_mm(worst);
    }
    places.push_back(place);
  }
  const auto excess = [&](const SurfacePlace& place) {
    return std::isfinite(place.deviation_mm)
               ? std::max(limits.lower - place.deviation_mm, place.deviation_mm - limits.upper)
               : 0.0;
  };
  // Places that lack a measurement are sorted by size, for whichever reason they lack it.
  const auto rank = [](PatchDecision decision) {
    return is_gap(decision) ? PatchDecision::NotWellMeasured : decision;
  };
  std::stable_sort(places.begin(), places.end(), [&](const auto& a, const auto& b) {
    if (rank(a.decision) != rank(b.decision)) return rank(a.decision) < rank(b.decision);
    if (a.decision == PatchDecision::Out) return excess(a) > excess(b);
    return a.area_mm2 > b.area_mm2;
  });
  return places;
}

Extreme extreme_of(const SurfacePatches& patches, std::size_t i) {
  Extreme extreme;
  extreme.deviation_mm = static_cast<double>(patches.deviation_mm[i]);
  if (patches.uncertainty_known) extreme.u95_mm = kNormal95 * patches.u_mm(i);
  extreme.at_mm = patches.center_mm[i].cast<double>();
  extreme.normal = patches.normal[i].cast<double>();
  return extreme;
}

/// The half-width that proves a patch in, and what it has to do with the patch.
struct PatchNeed {
  double half_mm = 0.0;
  double off_mm = 0.0;  ///< its distance from the middle of the tolerance
  double u95_mm = 0.0;
  double area_mm2 = 0.0;

  /// Whether it lies near a limit of a half-width that does not prove it in.
  [[nodiscard]] bool is_near(double of_mm, const SurfaceRule& rule) const {
    return u95_mm <= near_share(rule, off_mm > of_mm) * of_mm;
  }
};

double decidable_of(const SurfacePatches& patches, const SurfaceRule& rule) {
  if (!patches.uncertainty_known) return kMissing;
  const double middle_mm = 0.5 * (rule.limits.lower + rule.limits.upper);
  std::vector<PatchNeed> needs;
  for (std::size_t i = 0; i < patches.size(); ++i) {
    if (!patches.is_measured(i) || !std::isfinite(patches.u_mm(i))) continue;
    const double u = patches.u_mm(i);
    const double off_mm = std::abs(static_cast<double>(patches.deviation_mm[i]) - middle_mm);
    needs.push_back({std::max(off_mm + kGuardBand * u, kNormal95 * u / rule.max_uncertainty_share),
                     off_mm,
                     kNormal95 * u,
                     patches.area_mm2[i]});
  }
  std::sort(needs.begin(), needs.end(), [](const PatchNeed& a, const PatchNeed& b) {
    return a.half_mm < b.half_mm;
  });
  double area_mm2 = 0.0;
  double half_mm = kMissing;
  for (const PatchNeed& need : needs) {
    const bool enough = area_mm2 >= rule.min_coverage * patches.total_area_mm2;
    area_mm2 += need.area_mm2;
    // Beyond the coverage, those count that would lie near a limit of this half-width.
    if (!enough || need.is_near(half_mm, rule)) half_mm = need.half_mm;
  }
  return area_mm2 >= rule.min_coverage * patches.total_area_mm2 ? half_mm
                                                                : static_cast<double>(kMissing);
}

void conclude(SurfaceVerdict& verdict, double noise_share) {
  const auto share = [&](PatchDecision decision) { return verdict.share_of(decision); };
  if (share(PatchDecision::Out) > 0.0) {
    verdict.conformity = Conformity::Out;
    return;
  }
  const bool covered =
      verdict.coverage >= verdict.rule.min_coverage && verdict.gap_mm <= verdict.rule.max_gap_mm;
  if (covered && !(share(PatchDecision::NearLimit) > 0.0) && verdict.patches > 0) {
    verdict.conformity = Conformity::In;
    return;
  }
  double largest = share(PatchDecision::NearLimit);
  verdict.reason = UndecidedReason::NearLimit;
  if (covered) return;
  const double poor = share(PatchDecision::NotWellMeasured);
  if (share(PatchDecision::NotMeasured) >= largest) {
    largest = share(PatchDecision::NotMeasured);
    verdict.reason = UndecidedReason::NotMeasured;
  }
  if (poor > largest) {
    verdict.reason =
        2.0 * noise_share > poor ? UndecidedReason::Noise : UndecidedReason::Systematic;
  }
}

}  // namespace

void SurfaceRule::check() const {
  limits.check();
  require(std::isfinite(min_feature_mm) && min_feature_mm >= 0.0,
          "min_feature_mm must be 0 or more");
  require(!edge_mm || (std::isfinite(*edge_mm) && *edge_mm >= 0.0), "edge_mm must be 0 or more");
  require(max_uncertainty_share > 0.0 && max_uncertainty_share <= 1.0,
          "max_uncertainty_share must be above 0, and 1 at most");
  require(min_coverage >= 0.0 && min_coverage <= 1.0, "min_coverage must be from 0 to 1");
  require(std::isfinite(max_gap_mm) && max_gap_mm >= 0.0, "max_gap_mm must be 0 or more");
}

double SurfaceRule::well_measured_share() const {
  constexpr double kWell = 0.25;
  return std::min(kWell, max_uncertainty_share);
}

double SurfaceVerdict::share_of(PatchDecision decision) const {
  return std::min(1.0, share.at(static_cast<std::size_t>(decision)));  // a sum that is rounded
}

SurfaceVerdict judge_surface(const SurfacePatches& patches, const SurfaceRule& rule) {
  rule.check();
  constexpr double kGapOverSize = 0.1;
  SurfaceVerdict verdict;
  verdict.rule = rule;
  verdict.rule.min_feature_mm = patches.diameter_mm;
  if (!(rule.max_gap_mm > 0.0)) verdict.rule.max_gap_mm = kGapOverSize * patches.size_mm;
  verdict.area_mm2 = patches.total_area_mm2;
  verdict.edge_share =
      patches.edge_area_mm2 / std::max(patches.edge_area_mm2 + patches.total_area_mm2, 1e-300);
  verdict.uncertainty_known = patches.uncertainty_known;
  verdict.noise_factor = patches.noise_factor;
  const OutGuard guard = inspect::out_guard_of(patches);
  verdict.independent = guard.independent;
  std::vector<PatchDecision> decided;
  std::vector<double> known_u;
  double noise_share = 0.0;
  std::size_t lowest = patches.size();
  std::size_t highest = patches.size();
  for (std::size_t i = 0; i < patches.size(); ++i) {
    decided.push_back(decide(patches, i, rule, guard));
    const double share = patches.area_mm2[i] / patches.total_area_mm2;
    verdict.share.at(static_cast<std::size_t>(decided.back())) += share;
    if (decided.back() == PatchDecision::NotWellMeasured &&
        patches.noise_mm[i] > patches.systematic_mm[i])
      noise_share += share;
    if (!patches.is_measured(i) || decided.back() == PatchDecision::AtEdge) continue;
    if (patches.uncertainty_known && std::isfinite(patches.u_mm(i)))
      known_u.push_back(patches.u_mm(i));
    if (is_gap(decided.back())) continue;
    ++verdict.patches;
    const float value = patches.deviation_mm[i];
    if (lowest == patches.size() || value < patches.deviation_mm[lowest]) lowest = i;
    if (highest == patches.size() || value > patches.deviation_mm[highest]) highest = i;
  }
  // A sum of many areas may exceed their total by the rounding of the last digits.
  verdict.coverage = std::max(0.0,
                              1.0 - verdict.share_of(PatchDecision::NotMeasured) -
                                  verdict.share_of(PatchDecision::NotWellMeasured));
  verdict.decidable_mm = decidable_of(patches, rule);
  if (lowest < patches.size()) verdict.lowest = extreme_of(patches, lowest);
  if (highest < patches.size()) verdict.highest = extreme_of(patches, highest);
  if (!known_u.empty()) verdict.median_u_mm = median_in_place(std::span<double>(known_u));
  const std::vector<double> distance = gap_distances(patches, decided);
  find_gap(verdict, patches, decided, distance);
  conclude(verdict, noise_share);
  verdict.places = places_of(patches, decided, rule.limits, distance);
  if (verdict.places.size() > kMostPlaces) verdict.places.resize(kMostPlaces);
  return verdict;
}

SurfaceVerdict judge_surface(const Mesh& mesh,
                             const Deviations& deviations,
                             const RayScene& reference,
                             const SurfaceRule& rule,
                             const Run& run) {
  rule.check();
  SurfaceRule chosen = rule;
  if (!chosen.edge_mm) chosen.edge_mm = default_edge_mm(mesh, reference.mesh());
  const SurfacePatches patches = surface_patches(
      mesh, deviations, reference, rule.min_feature_mm, rule.excluded, *chosen.edge_mm, run);
  if (rule.min_feature_mm > 0.0 && patches.diameter_mm > 1.001 * rule.min_feature_mm) {
    run.warn(fmt::format(
        "the surface is judged by patches of {:.3g} mm and not of {:.3g} mm, of which there would "
        "be too many; state a min_feature_mm of {:.3g} mm",
        patches.diameter_mm,
        rule.min_feature_mm,
        patches.diameter_mm));
  }
  return judge_surface(patches, chosen);
}

}  // namespace frangia
