#include "frangia/inspect/verdict_clause.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace frangia {
namespace {

using Clauses = std::vector<VerdictClause>;

std::string value_text(double value, double u95) {
  if (!std::isfinite(u95)) return fmt::format("{:+.4f} mm", value);
  return fmt::format("{:+.4f} mm, U95 {:.4f} mm", value, u95);
}

const SurfacePlace* worst_place(const SurfaceVerdict& verdict, PatchDecision decision) {
  const auto found =
      std::find_if(verdict.places.begin(), verdict.places.end(), [&](const SurfacePlace& place) {
        return place.decision == decision;
      });
  return found == verdict.places.end() ? nullptr : &*found;
}

void add_out(Clauses& clauses, const SurfaceVerdict& verdict) {
  const SurfacePlace* worst = worst_place(verdict, PatchDecision::Out);
  if (worst != nullptr && std::isfinite(worst->deviation_mm)) {
    clauses.push_back({"out_at",
                       {{"at_mm", worst->at_mm},
                        {"deviation_mm", worst->deviation_mm},
                        {"u95_mm", worst->u95_mm}},
                       fmt::format("out at {}: {}",
                                   place_text(worst->at_mm),
                                   value_text(worst->deviation_mm, worst->u95_mm))});
  } else if (worst != nullptr) {
    clauses.push_back(
        {"out_missing",
         {{"at_mm", worst->at_mm}},
         fmt::format("out at {}: surface was measured behind the nominal one, whose material is "
                     "missing",
                     place_text(worst->at_mm))});
  }
  const double share = verdict.share_of(PatchDecision::Out);
  clauses.push_back({"out_share",
                     {{"share", share}},
                     fmt::format("{} of the nominal area is out", share_text(share))});
}

std::string gap_text(const SurfaceVerdict& verdict) {
  return fmt::format(
      "the widest gap is {:.3g} mm at {}", verdict.gap_mm, place_text(verdict.gap_at_mm));
}

void add_in(Clauses& clauses, const SurfaceVerdict& verdict) {
  clauses.push_back({"in",
                     {{"share", verdict.coverage}},
                     fmt::format("in, over {} of the nominal area", share_text(verdict.coverage))});
  if (!(verdict.gap_mm > 0.0)) return;
  clauses.push_back(
      {"gap", {{"gap_mm", verdict.gap_mm}, {"at_mm", verdict.gap_at_mm}}, gap_text(verdict)});
}

/// What of the surface would have to be measured better: where the gap is too wide, or else the
/// tolerance that enough of it is good enough for.
void add_lacking(Clauses& clauses, const SurfaceVerdict& verdict) {
  const double wanted_mm = verdict.rule.max_gap_mm;
  if (verdict.gap_mm > wanted_mm) {
    clauses.push_back(
        {"gap_too_wide",
         {{"gap_mm", verdict.gap_mm}, {"at_mm", verdict.gap_at_mm}, {"wanted_mm", wanted_mm}},
         fmt::format("{}, wanted is {:.3g} mm at most", gap_text(verdict), wanted_mm)});
  } else if (std::isfinite(verdict.decidable_mm)) {
    clauses.push_back(
        {"decidable",
         {{"half_width_mm", verdict.decidable_mm}},
         fmt::format("it is good enough for a half-width of {:.3g} mm", verdict.decidable_mm)});
  }
}

void add_too_uncertain(Clauses& clauses, const SurfaceVerdict& verdict) {
  const SurfaceRule& rule = verdict.rule;
  const bool noise = verdict.reason == UndecidedReason::Noise;
  const double share = verdict.share_of(PatchDecision::NotWellMeasured);
  const double limit_mm =
      0.5 * rule.well_measured_share() * (rule.limits.upper - rule.limits.lower);
  clauses.push_back(
      {noise ? "too_noisy" : "too_systematic",
       {{"share", share}, {"u95_mm", limit_mm}, {"of_half_width", rule.well_measured_share()}},
       fmt::format("undecided: {} of the nominal area has a U95 above {:.4g} mm, {} of the "
                   "tolerance's half-width, {}",
                   share_text(share),
                   limit_mm,
                   share_text(rule.well_measured_share()),
                   noise ? "mostly noise" : "mostly calibration and alignment")});
  clauses.push_back(
      noise ? VerdictClause{"reduce_noise",
                            {},
                            "take more views, a longer exposure or a finer pattern"}
            : VerdictClause{"reduce_systematic",
                            {},
                            "calibrate again, or state a tolerance that this rig can decide"});
  add_lacking(clauses, verdict);
}

void add_near_limit(Clauses& clauses, const SurfaceVerdict& verdict) {
  const SurfacePlace* worst = worst_place(verdict, PatchDecision::NearLimit);
  const double share = verdict.share_of(PatchDecision::NearLimit);
  VerdictClause clause{
      "near_limit",
      {{"share", share}},
      fmt::format("undecided: {} of the nominal area lies within the uncertainty of a limit",
                  share_text(share))};
  if (worst != nullptr) {
    clause.id = "near_limit_at";
    clause.values.insert(clause.values.end(),
                         {{"at_mm", worst->at_mm},
                          {"deviation_mm", worst->deviation_mm},
                          {"u95_mm", worst->u95_mm}});
    clause.text += fmt::format(", such as {} with {}",
                               place_text(worst->at_mm),
                               value_text(worst->deviation_mm, worst->u95_mm));
  }
  clauses.push_back(std::move(clause));
  clauses.push_back({"reduce_uncertainty", {}, "measure with a smaller uncertainty"});
}

void add_not_measured(Clauses& clauses, const SurfaceVerdict& verdict) {
  const double share = verdict.share_of(PatchDecision::NotMeasured);
  const double poor = verdict.share_of(PatchDecision::NotWellMeasured);
  const double wanted = 1.0 - verdict.rule.min_coverage;
  clauses.push_back(
      {"not_measured",
       {{"share", share},
        {"poor_share", poor},
        {"wanted_share", wanted},
        {"gap_mm", verdict.gap_mm},
        {"at_mm", verdict.gap_at_mm},
        {"wanted_mm", verdict.rule.max_gap_mm}},
       fmt::format("undecided: {} of the nominal area was not measured and {} not well enough, "
                   "wanted is {} together at most; {}, wanted is {:.3g} mm at most",
                   share_text(share),
                   share_text(poor),
                   share_text(wanted),
                   gap_text(verdict),
                   verdict.rule.max_gap_mm)});
  clauses.push_back({"scan_more",
                     {},
                     "scan it from more stations or in another setup, or exclude it in the plan"});
}

void add_decision(Clauses& clauses, const SurfaceVerdict& verdict) {
  if (verdict.conformity == Conformity::Out) return add_out(clauses, verdict);
  if (verdict.conformity == Conformity::In) return add_in(clauses, verdict);
  switch (verdict.reason) {
    case UndecidedReason::Noise:
    case UndecidedReason::Systematic:
      return add_too_uncertain(clauses, verdict);
    case UndecidedReason::NearLimit:
      return add_near_limit(clauses, verdict);
    case UndecidedReason::NotMeasured:
    case UndecidedReason::None:
      break;
  }
  add_not_measured(clauses, verdict);
}

/// What is not judged along edges.
void add_edges(Clauses& clauses, const SurfaceVerdict& verdict) {
  if (!(verdict.edge_share > 0.0)) return;
  const double width_mm = verdict.rule.edge_mm.value_or(0.0);
  clauses.push_back({"edges",
                     {{"edge_mm", width_mm}, {"share", verdict.edge_share}},
                     fmt::format("not judged are strips of {:.2g} mm along edges, {} of the area",
                                 width_mm,
                                 share_text(verdict.edge_share))});
}

}  // namespace

VerdictClause no_uncertainty_clause() {
  return {"no_sigma",
          {},
          "the mesh states no sigma, so that no uncertainty is known and the limits alone decide; "
          "inspect the .ply of a reconstruction, which states it"};
}

std::vector<VerdictClause> clauses_of(const SurfaceVerdict& verdict) {
  Clauses clauses;
  add_decision(clauses, verdict);
  add_edges(clauses, verdict);
  if (!verdict.uncertainty_known) clauses.push_back(no_uncertainty_clause());
  return clauses;
}

std::string sentence_of(const std::vector<VerdictClause>& clauses) {
  std::string text;
  for (const VerdictClause& clause : clauses)
    text += (text.empty() ? "" : "; ") + clause.text;
  return text;
}

std::string sentence_of(const SurfaceVerdict& verdict) {
  return sentence_of(clauses_of(verdict));
}

std::string share_text(double share) {
  if (!(share > 0.0)) return "0 %";
  if (share >= 1.0 - 1e-12) return "100 %";
  const double tenths = std::clamp(std::round(1000.0 * share), 1.0, 999.0);
  return fmt::format("{:.1f} %", 0.1 * tenths);
}

std::string place_text(const Eigen::Vector3d& at_mm) {
  const auto text = [](double value) {  // without the sign of a zero
    return fmt::format("{:.2f}", std::abs(value) < 0.005 ? 0.0 : value);
  };
  return fmt::format("({}, {}, {}) mm", text(at_mm.x()), text(at_mm.y()), text(at_mm.z()));
}

}  // namespace frangia
