#include "frangia/uncertainty/uncertainty_budget.h"

#include <array>
#include <cmath>
#include <cstddef>

#include "frangia/core/missing.h"

namespace frangia {
namespace {

using Correlation = ErrorCorrelation;
using Part = UncertaintyPart;
using Term = UncertaintyTerm;

/// In the order of `UncertaintyTerm`.
constexpr std::array kTerms = {
    UncertaintyTermInfo{Term::CameraNoise,
                        "camera_noise",
                        "shot noise and read noise of the camera",
                        Part::Noise,
                        Correlation::None},
    UncertaintyTermInfo{Term::LateralLocalization,
                        "lateral_localization",
                        "position of a pixel on the surface",
                        Part::Noise,
                        Correlation::View},
    UncertaintyTermInfo{Term::Speckle,
                        "speckle",
                        "grain of laser light on a rough surface",
                        Part::Noise,
                        Correlation::View},
    UncertaintyTermInfo{Term::Registration,
                        "registration",
                        "differences between the views after registration",
                        Part::Noise,
                        Correlation::View},
    UncertaintyTermInfo{Term::Harmonics,
                        "harmonics",
                        "response of projector and camera that was not corrected",
                        Part::Systematic,
                        Correlation::View},
    UncertaintyTermInfo{Term::StepErrors,
                        "step_errors",
                        "phase steps that differ from the nominal ones",
                        Part::Systematic,
                        Correlation::AllViews},
    UncertaintyTermInfo{Term::Flicker,
                        "flicker",
                        "light or exposure that changes between frames",
                        Part::Systematic,
                        Correlation::View},
    UncertaintyTermInfo{Term::Quantization,
                        "quantization",
                        "whole counts of the frames",
                        Part::Noise,
                        Correlation::None},
    UncertaintyTermInfo{Term::IndirectLight,
                        "indirect_light",
                        "light that reaches a point by way of other parts of the surface",
                        Part::Systematic,
                        Correlation::AllViews},
    UncertaintyTermInfo{Term::Calibration,
                        "calibration",
                        "uncertainty of the parameters of the rig",
                        Part::Systematic,
                        Correlation::AllViews},
    UncertaintyTermInfo{Term::Turntable,
                        "turntable",
                        "axis and angles of the turntable that the views do not determine",
                        Part::Systematic,
                        Correlation::View},
    UncertaintyTermInfo{Term::Resolution,
                        "resolution",
                        "edges and creases that points and voxels do not resolve",
                        Part::Noise,
                        Correlation::AllViews},
    UncertaintyTermInfo{Term::Temperature,
                        "temperature",
                        "thermal expansion of the part",
                        Part::Systematic,
                        Correlation::AllViews}};

}  // namespace

std::span<const UncertaintyTermInfo> uncertainty_terms() {
  return kTerms;
}

const UncertaintyTermInfo& info_of(UncertaintyTerm term) {
  return kTerms.at(static_cast<std::size_t>(term));
}

double root_sum_square(std::span<const double> terms) {
  double squares = 0.0;
  for (const double term : terms)
    squares += term * term;
  return std::sqrt(squares);
}

double SigmaParts::combined() const {
  return std::sqrt(noise * noise + systematic * systematic);
}

SigmaParts sigma_of_mean(std::span<const WeightedSigma> observations) {
  double weights = 0.0;
  double variance = 0.0;
  double systematic = 0.0;
  for (const WeightedSigma& one : observations) {
    weights += one.weight;
    variance += one.weight * one.weight * one.sigma.noise * one.sigma.noise;
    systematic += one.weight * one.sigma.systematic;
  }
  if (!(weights > 0.0)) return {kMissing, kMissing};
  return {std::sqrt(variance) / weights, systematic / weights};
}

}  // namespace frangia
