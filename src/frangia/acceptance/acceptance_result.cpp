#include "frangia/acceptance/acceptance_result.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "frangia/core/error.h"

namespace frangia {
namespace {

constexpr double kReferenceTemperature = 20.0;  // ISO 1
constexpr std::size_t kArrangements = 7;        // VDI/VDE 2634 part 3, sphere spacing
constexpr std::size_t kBallPlaces = 3;          // the same, probing

/// Uncertainty of a length of the artifact at its temperature, k = 2.
double u95_of_length(const AcceptancePlan& plan, double length_mm) {
  const double thermal =
      2.0 * length_mm * plan.artifact.expansion_ppm_per_k * 1e-6 * plan.temperature_u_k;
  return std::hypot(plan.artifact.u95_mm, thermal);
}

class Gatherer {
 public:
  explicit Gatherer(AcceptanceQuantity quantity) : quantity_(std::move(quantity)) {}
  void add(double error_mm, std::size_t arrangement) {
    if (any_ && std::abs(error_mm) <= std::abs(quantity_.error_mm)) return;
    any_ = true;
    quantity_.error_mm = error_mm;
    quantity_.arrangement = arrangement;
  }
  [[nodiscard]] bool any() const { return any_; }
  /// Decides with limits on both sides, or on the upper one of a form.
  AcceptanceQuantity decided() {
    if (quantity_.limit_mm) {
      const ToleranceLimits limits{-*quantity_.limit_mm, *quantity_.limit_mm};
      quantity_.conformity = conformity_of(quantity_.error_mm, 0.5 * quantity_.u95_mm, limits);
    }
    return quantity_;
  }

 private:
  AcceptanceQuantity quantity_;
  bool any_ = false;
};

std::vector<std::string> lacks_of(const AcceptancePlan& plan,
                                  const std::vector<ArrangementResult>& results) {
  std::vector<std::string> lacks;
  const ReferenceArtifact& artifact = plan.artifact;
  const bool bar = artifact.diameters_mm.size() == 2;
  const std::size_t wanted = bar ? kArrangements : kBallPlaces;
  if (results.size() < wanted)
    lacks.push_back(fmt::format("{} of {} arrangements", results.size(), wanted));
  if (!bar) lacks.emplace_back("a ball bar: a single ball tests neither spacing nor length");
  if (bar && std::none_of(results.begin(), results.end(), [](const auto& result) {
        return std::isfinite(result.measured.length_mm);
      }))
    lacks.emplace_back("an arrangement in which both outer ends of the ball bar are seen");
  if (!plan.volume_mm) {
    lacks.emplace_back("the size of the measuring volume (volume_mm), which the artifact must fit");
    return lacks;
  }
  const double diagonal = plan.volume_mm->norm();
  for (const double diameter : artifact.diameters_mm) {
    if (diameter >= 0.02 * diagonal && diameter <= 0.2 * diagonal) continue;
    lacks.push_back(fmt::format("balls of {:.3g} to {:.3g} mm for this volume; {:g} mm was used",
                                0.02 * diagonal,
                                0.2 * diagonal,
                                diameter));
    break;
  }
  if (bar && artifact.spacing_mm < 0.3 * diagonal) {
    lacks.push_back(fmt::format("a spacing of at least {:.3g} mm for this volume; {:g} mm was used",
                                0.3 * diagonal,
                                artifact.spacing_mm));
  }
  return lacks;
}

}  // namespace

MeasuredArtifact at_reference_temperature(MeasuredArtifact measured, const AcceptancePlan& plan) {
  const double scale = 1.0 / (1.0 + plan.artifact.expansion_ppm_per_k * 1e-6 *
                                        (plan.temperature_c - kReferenceTemperature));
  for (MeasuredBall& ball : measured.balls)
    ball.diameter_mm *= scale;
  measured.spacing_mm *= scale;
  measured.length_mm *= scale;
  return measured;
}

AcceptanceResult acceptance_result(const AcceptancePlan& plan,
                                   const std::vector<ArrangementResult>& results) {
  if (results.empty()) throw Error(ErrorKind::Input, "no arrangement of the artifact was measured");
  const ReferenceArtifact& artifact = plan.artifact;
  const AcceptanceLimits& limits = plan.limits;
  const double u_form = 2.0 * 0.5 * artifact.form_mm;  // k = 2 of half the balls' own form
  const double diameter_mm =
      *std::max_element(artifact.diameters_mm.begin(), artifact.diameters_mm.end());
  Gatherer form({"probing form error of 95 % of the points",
                 "P_Form.Sph.D95%",
                 true,
                 0.0,
                 0,
                 u_form,
                 limits.probing_form_mm});
  Gatherer all({"probing form error of all points but 0.3 %", "PF", true, 0.0, 0, u_form, {}});
  Gatherer size({"probing size error",
                 "P_Size.Sph.All",
                 false,
                 0.0,
                 0,
                 u95_of_length(plan, diameter_mm),
                 limits.probing_size_mm});
  Gatherer spacing({"sphere-spacing error",
                    "SD",
                    false,
                    0.0,
                    0,
                    u95_of_length(plan, artifact.spacing_mm),
                    limits.sphere_spacing_mm});
  const bool bar = artifact.diameters_mm.size() == 2;
  const double length_mm =
      bar ? artifact.spacing_mm + 0.5 * (artifact.diameters_mm[0] + artifact.diameters_mm[1]) : 0.0;
  // The length holds one spacing and two radii, each with an uncertainty of its own.
  Gatherer length({"length measurement error",
                   "E",
                   false,
                   0.0,
                   0,
                   std::hypot(u95_of_length(plan, length_mm), artifact.u95_mm / std::sqrt(2.0)),
                   limits.length_mm});
  for (std::size_t i = 0; i < results.size(); ++i) {
    const MeasuredArtifact& measured = results[i].measured;
    for (std::size_t ball = 0; ball < measured.balls.size(); ++ball) {
      form.add(measured.balls[ball].form_95_mm, i);
      all.add(measured.balls[ball].form_all_mm, i);
      size.add(measured.balls[ball].diameter_mm - artifact.diameters_mm[ball], i);
    }
    if (!bar) continue;
    spacing.add(measured.spacing_mm - artifact.spacing_mm, i);
    if (std::isfinite(measured.length_mm)) length.add(measured.length_mm - length_mm, i);
  }
  AcceptanceResult out;
  out.quantities = {form.decided(), all.decided(), size.decided()};
  if (bar) {
    out.quantities.push_back(spacing.decided());
    if (length.any()) out.quantities.push_back(length.decided());
  }
  out.incomplete = lacks_of(plan, results);
  bool in = true;
  for (const AcceptanceQuantity& quantity : out.quantities) {
    if (!quantity.limit_mm) continue;
    out.judged = true;
    if (quantity.conformity == Conformity::Out) out.conformity = Conformity::Out;
    in = in && quantity.conformity == Conformity::In;
  }
  if (out.judged && in) out.conformity = Conformity::In;
  return out;
}

std::string sentence_of(const AcceptanceResult& result) {
  const std::string part = result.incomplete.empty() ? "" : " This is not a whole test.";
  if (!result.judged)
    return "The plan states no limits: the errors were measured and not judged." + part;
  switch (result.conformity) {
    case Conformity::In:
      return "The scanner keeps its limits, the uncertainty counted." + part;
    case Conformity::Out:
      return "The scanner exceeds its limits, the uncertainty counted." + part;
    case Conformity::Undecided:
      break;
  }
  return "Undecided: an error lies within its uncertainty of its limit." + part;
}

}  // namespace frangia
