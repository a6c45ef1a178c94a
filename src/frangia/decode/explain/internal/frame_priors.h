#pragma once

namespace frangia {

/// Odds of a structural fault before the data.
inline constexpr double kPriorFault = 0.01;
/// Log of the odds of 100 : 1 from which on something is named, as `Explanation::is_decided`.
inline constexpr double kNamedLogOdds = 4.605;
/// Prior standard deviation of the gain of a frame, of lamp and exposure.
inline constexpr double kPriorGain = 0.03;
/// Prior standard deviation of the share of steady light in the mean counts: light of the room, on
/// which the gains of the projector do not act.
inline constexpr double kPriorSteadyShare = 0.3;
/// Gain of a frame, and its logarithm, beyond which it is at fault; less is flicker.
inline constexpr double kStructuralGain = 0.1;
/// Prior standard deviation of the light of another lamp over the counts of the brightest frame.
inline constexpr double kPriorLamp = 0.3;
/// Light of another lamp, over that of the brightest frame, below which none is named: flicker of a
/// projector, which the light of the room does not share, looks like it.
inline constexpr double kStructuralLamp = 0.02;
/// Prior standard deviation of the steps of a projector that does not show the shifts of scan.toml.
inline constexpr double kPriorStep_rad = 0.15;
/// Witnesses in what a hypothesis leaves beyond the noise: it may be one smooth field.
inline constexpr double kFieldWitnesses = 50.0;

/// Prior standard deviation of harmonic n over that of the fringes: 0.35 for the second one is
/// that of gamma 2.6; binary fringes have 1/n.
[[nodiscard]] constexpr double prior_harmonic(int order) {
  return order == 2 ? 0.35 : 1.0 / order;
}

}  // namespace frangia
