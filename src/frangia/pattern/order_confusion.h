#pragma once

#include <span>

#include "frangia/pattern/fringe_sequence.h"

namespace frangia {

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

}  // namespace frangia
