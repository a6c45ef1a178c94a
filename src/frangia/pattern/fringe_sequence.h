#pragma once

#include <span>
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

/// Returns the probability, averaged over the field, that noise leads the most likely order of the
/// finest fringes to a wrong one, when every map has noise `sigma_rad`.
///
/// The phases of two orders differ in each map by a wrapped difference. What remains of these
/// differences after the best common shift is the distance of the two orders: noise confuses them
/// when its component along the distance exceeds half of it. The probabilities of all orders add.
///
/// @shape    `fringes` over the field, one count per map, in any order
/// @units    rad
/// @errors   Error(Input) when empty, or unless every count is above 0 and at most 1e5
[[nodiscard]] double confusion_probability(std::span<const double> fringes, double sigma_rad);

/// Returns whether maps with these fringe counts determine the order of the finest fringes: beats,
/// beats of beats, or any other combination, with a probability of confusion below 1e-3 at a noise
/// of 0.05 rad in every map.
[[nodiscard]] bool determines_order(std::span<const double> fringes);

/// Plans `maps` fringe counts of which the finest is `fringes` and the coarsest at least `lowest`,
/// whose combination determines the order with the least probability of confusion. Whole counts
/// are searched one map at a time until none improves, from several starts.
///
/// @units    rad
/// @errors   Error(Input) unless 2 <= maps <= 16, 2 <= fringes <= 1000 and 1 <= lowest < fringes,
///           or when the best counts exceed `max_wrong_order`
/// @source   Towers, Towers and Jones 2005 for optimum multi-frequency selection
[[nodiscard]] SequencePlan plan_beats(
    double fringes, int maps, double lowest, double sigma_rad, double max_wrong_order = 1e-6);

/// Plans `maps` fringe counts of nearly the same high frequency whose combination determines the
/// order: the narrowest band below `fringes`, in steps of 2 % of it, that keeps the probability of
/// a wrong order.
///
/// Indirect light averages out over fine fringes. No map of such a sequence is coarse, so indirect
/// light reaches neither the phase nor its order, and it is nearly the same in all maps.
///
/// @units    rad
/// @errors   Error(Input) as `plan_beats`, or when no band above half of `fringes` suffices
/// @source   Gupta and Nayar 2012, Micro phase shifting
[[nodiscard]] SequencePlan plan_narrow_band(double fringes,
                                            int maps,
                                            double sigma_rad,
                                            double max_wrong_order = 1e-6);

}  // namespace frangia
