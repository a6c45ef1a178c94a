// The verdict about a surface in words.
#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "frangia/inspect/surface_verdict.h"

namespace frangia {
namespace {

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

std::string out_text(const SurfaceVerdict& verdict) {
  const SurfacePlace* worst = worst_place(verdict, PatchDecision::Out);
  if (worst == nullptr) return "out";
  std::string text = fmt::format("out at {}: ", place_text(worst->at_mm));
  if (std::isfinite(worst->deviation_mm)) {
    text += value_text(worst->deviation_mm, worst->u95_mm);
  } else {
    text += "surface was measured behind the nominal one, whose material is missing";
  }
  const double share = verdict.share_of(PatchDecision::Out);
  return fmt::format("{}; {} of the nominal area is out", text, share_text(share));
}

std::string gap_text(const SurfaceVerdict& verdict) {
  return fmt::format(
      "the widest gap is {:.3g} mm at {}", verdict.gap_mm, place_text(verdict.gap_at_mm));
}

/// What is not judged along edges.
std::string edges_text(const SurfaceVerdict& verdict) {
  if (!(verdict.edge_share > 0.0)) return "";
  return fmt::format("; not judged are strips of {:.2g} mm along edges, {} of the area",
                     verdict.rule.edge_mm.value_or(0.0),
                     share_text(verdict.edge_share));
}

/// What of the surface would have to be measured better: where the gap is too wide, or else the
/// tolerance that enough of it is good enough for.
std::string lacking_text(const SurfaceVerdict& verdict) {
  if (verdict.gap_mm > verdict.rule.max_gap_mm)
    return fmt::format(
        "; {}, wanted is {:.3g} mm at most", gap_text(verdict), verdict.rule.max_gap_mm);
  if (!std::isfinite(verdict.decidable_mm)) return "";
  return fmt::format("; it is good enough for a half-width of {:.3g} mm", verdict.decidable_mm);
}

std::string too_uncertain(const SurfaceVerdict& verdict) {
  const SurfaceRule& rule = verdict.rule;
  return fmt::format(
      "undecided: {} of the nominal area has a U95 above {:.4g} mm, {} of the tolerance's "
      "half-width",
      share_text(verdict.share_of(PatchDecision::NotWellMeasured)),
      0.5 * rule.max_uncertainty_share * (rule.limits.upper - rule.limits.lower),
      share_text(rule.max_uncertainty_share));
}

/// The sentence without what is not judged.
std::string decided_text(const SurfaceVerdict& verdict) {
  if (verdict.conformity == Conformity::Out) return out_text(verdict);
  if (verdict.conformity == Conformity::In) {
    std::string text = fmt::format("in, over {} of the nominal area", share_text(verdict.coverage));
    if (verdict.gap_mm > 0.0) text += "; " + gap_text(verdict);
    return text;
  }
  switch (verdict.reason) {
    case UndecidedReason::Noise:
      return too_uncertain(verdict) +
             ", mostly noise; take more views, a longer exposure or a finer pattern" +
             lacking_text(verdict);
    case UndecidedReason::Systematic:
      return too_uncertain(verdict) +
             ", mostly calibration and alignment; calibrate again, or state a tolerance that this "
             "rig can decide" +
             lacking_text(verdict);
    case UndecidedReason::NearLimit: {
      const SurfacePlace* worst = worst_place(verdict, PatchDecision::NearLimit);
      std::string text =
          fmt::format("undecided: {} of the nominal area lies within the uncertainty of a limit",
                      share_text(verdict.share_of(PatchDecision::NearLimit)));
      if (worst != nullptr)
        text += fmt::format(", such as {} with {}",
                            place_text(worst->at_mm),
                            value_text(worst->deviation_mm, worst->u95_mm));
      return text + "; measure with a smaller uncertainty";
    }
    case UndecidedReason::NotMeasured:
    case UndecidedReason::None:
      break;
  }
  return fmt::format(
      "undecided: {} of the nominal area was not measured, wanted is {} at most, and {}, wanted is "
      "{:.3g} mm at most; scan it from more stations or in another setup, or exclude it in the "
      "plan",
      share_text(verdict.share_of(PatchDecision::NotMeasured)),
      share_text(1.0 - verdict.rule.min_coverage),
      gap_text(verdict),
      verdict.rule.max_gap_mm);
}

}  // namespace

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

std::string sentence_of(const SurfaceVerdict& verdict) {
  return decided_text(verdict) + edges_text(verdict);
}

}  // namespace frangia
