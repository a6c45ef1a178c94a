#pragma once

#include <string>
#include <vector>

namespace frangia {

/// Numbers of fringes over the field, coarse to fine, that tell the finest one's order.
///
/// doubling               1, 2, 4 ... fringes (Müller 1995)
/// negative-exponential   fringes less 0, 1, 2, 4 ... half of them (Huntley and Saldner 1997)
/// heterodyne             three numbers, whose beats have one fringe and about their square root
///                        (Reich, Ritter and Thesing 1997)
/// errors   Error(Input) for an unknown name or fewer than 1 fringe
[[nodiscard]] std::vector<double> fringe_sequence(const std::string& name, double fringes);

/// The probability that a phase of this sigma is more than half a fringe off.
[[nodiscard]] double wrong_order_probability(double sigma_rad);

/// The sigma whose probability of that is `probability`.
[[nodiscard]] double sigma_for_wrong_order_probability(double probability);

struct SequencePlan {
  std::vector<double> fringes;  ///< over the field, coarse to fine
  double wrong_order = 0.0;     ///< probability over all steps, at the given sigma
};

/// The fewest maps, evenly spaced in their ratio, that lead from one fringe to `fringes` with less
/// than this probability of a wrong order, when each map has noise `sigma_rad`.
///
/// errors   Error(Input) when the noise is so large that no ratio above 1.1 will do
[[nodiscard]] SequencePlan plan_sequence(double fringes,
                                         double sigma_rad,
                                         double max_wrong_order = 1e-6);

}  // namespace frangia
