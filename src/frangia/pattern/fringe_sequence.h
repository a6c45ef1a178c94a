#pragma once

#include <string>
#include <vector>

namespace frangia {

/// Returns the fringe counts over the field, coarse to fine, of a multi-frequency sequence that
/// determines the order of the finest fringes.
///
/// doubling               1, 2, 4 ... fringes (Müller 1995)
/// negative-exponential   N, N - 1, N - 2, N - 4 ... down to half of N (Huntley and Saldner 1997)
/// heterodyne             three counts, whose beats have one fringe and about sqrt(N) fringes
///                        (Reich, Ritter and Thesing 1997)
/// @errors   Error(Input) for an unknown name, or a count that is not from 1 to 1e6
[[nodiscard]] std::vector<double> fringe_sequence(const std::string& name, double fringes);

/// Returns the probability that a phase with standard deviation `sigma_rad` is wrong by more than
/// half a fringe.
[[nodiscard]] double wrong_order_probability(double sigma_rad);

/// Returns the standard deviation for which `wrong_order_probability` is `probability`.
///
/// @units    rad
[[nodiscard]] double sigma_for_wrong_order_probability(double probability);

/// The fringe counts of a multi-frequency sequence and its reliability.
struct SequencePlan {
  std::vector<double> fringes;  ///< fringe counts over the field, coarse to fine
  double wrong_order = 0.0;     ///< probability of a wrong order, summed over all steps
};

/// Plans the shortest geometric sequence from one fringe to `fringes` whose probability of a wrong
/// order is below `max_wrong_order` when each map has noise `sigma_rad`.
///
/// @errors   Error(Input) when the noise requires a ratio below 1.1, or for a count that is not
///          from 1 to 1e6
[[nodiscard]] SequencePlan plan_sequence(double fringes,
                                         double sigma_rad,
                                         double max_wrong_order = 1e-6);

}  // namespace frangia
