#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "frangia/diagnose/explanation.h"

namespace frangia {

/// A hypothesis and how well it predicts the data.
struct ScoredHypothesis {
  std::string text;           ///< what it states, as a clause
  double log_evidence = 0.0;  ///< natural logarithm, prices included
  double unexplained = 0.0;   ///< RMS beyond the noise, relative to the signal
  std::string remedy{};       ///< what to do if it is true
  /// Hypotheses with equal numbers predict the same data and form one class.
  std::size_t prediction = 0;
};

/// The share of samples that count as independent witnesses: 1 / (1 + (m - 1) rho), with the
/// correlation rho of the residuals within blocks of m neighbouring samples.
///
/// @shape    residuals of expectation 0 and equal variance; one block number per residual, equal
///           numbers side by side
/// @source   Kish 1965, the design effect of samples in clusters
[[nodiscard]] double effective_share(std::span<const double> residuals,
                                     std::span<const int> blocks);

/// The price of a parameter that was fitted to `effective_samples`, in log evidence.
///
/// @source   Schwarz 1978
[[nodiscard]] double price_of_parameter(double effective_samples);

/// The price of one of `count` possibilities that are equally likely before the data: "which
/// frame".
[[nodiscard]] double price_of_choice(std::size_t count);

/// Chooses the class of hypotheses with the most evidence. The evidence of a class is the sum over
/// its members.
///
/// @shape    at least one hypothesis
[[nodiscard]] Explanation choose(std::span<const ScoredHypothesis> hypotheses);

}  // namespace frangia
