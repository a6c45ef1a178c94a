#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "frangia/core/enum_names.h"
#include "frangia/frames/noise_model.h"
#include "frangia/phase/wrap/decode_sequence.h"
#include "frangia/rig/projector.h"

namespace frangia {

/// In which respect the frames of a pattern differ from scan.toml.
enum class SequenceFaultKind {
  Start,      ///< the phase of the first frame
  Direction,  ///< the sign of the shifts
  Order,      ///< the order of the frames
  Period,     ///< the period of the fringes
  Exchanged,  ///< the frames of two patterns are exchanged
  Inversion,  ///< a frame of a Gray code is inverted
  Code,       ///< Gray code and binary code
  Missing     ///< a frame of a Gray code is missing
};

/// What users call them.
[[nodiscard]] constexpr auto names_of(SequenceFaultKind /*any*/) {
  return EnumNames<SequenceFaultKind, 8>{{{SequenceFaultKind::Start, "start"},
                                          {SequenceFaultKind::Direction, "direction"},
                                          {SequenceFaultKind::Order, "order"},
                                          {SequenceFaultKind::Period, "period"},
                                          {SequenceFaultKind::Exchanged, "exchanged"},
                                          {SequenceFaultKind::Inversion, "inversion"},
                                          {SequenceFaultKind::Code, "code"},
                                          {SequenceFaultKind::Missing, "missing"}}};
}

/// A declaration that fits the frames where that of scan.toml does not.
struct SequenceFault {
  SequenceFaultKind kind = SequenceFaultKind::Start;  ///< what differs
  std::vector<std::string> patterns;                  ///< names of the patterns that differ
  /// What fits, after "the pattern fits": "a start of 180 degrees, not 0 degrees".
  std::string what;
  std::vector<std::string> same_as;  ///< other descriptions of the same frames
  /// The keys of scan.toml that would fit: "shifts_deg = [180, 270, 0, 90]".
  std::string keys;
  /// Two things differ, such as direction and start.
  bool is_compound = false;
  std::vector<double> shifts_rad{};  ///< of the pattern that fits, where they differ
  double scale = 1.0;                ///< of a period or stripe beside a code, over that declared
};

/// How well the patterns of one direction agree with each other.
struct SequenceCheck {
  bool decided = false;     ///< the frames suffice to tell agreement from chance
  bool consistent = true;   ///< the patterns agree, or the frames do not decide it
  double misfit_rad = 0.0;  ///< median distance of the phases from those of one place of the field
  double chance_rad = 0.0;  ///< the same for phases that have nothing to do with each other
  double agreement = 0.0;   ///< of a Gray code: share of the pixels and borders that fit
  double fitted_rad = 0.0;  ///< the misfit with the best of `fits`
  double fitted_agreement = 0.0;  ///< of a Gray code with the best of `fits`
  /// Share of the rows of pixels in which the two ends of the field meet on the object.
  double split_rows = 0.0;
  std::vector<std::string> patterns;  ///< names of the patterns that were compared
  /// By pattern that was compared: phase error that repeats with its own phase and that the coarser
  /// patterns contradict, RMS; 0 where they tell none.
  std::vector<double> ripples_rad{};
  /// What is wrong with the frames of one pattern by themselves, as a clause; it takes precedence
  /// over `fits`. If the patterns are consistent: at some of the pixels, which are left out.
  std::string finding;
  std::vector<SequenceFault> fits;  ///< declarations that fit equally well; empty if none is found
};

/// Formats the result of a check that found a disagreement as one clause without a full stop.
[[nodiscard]] std::string describe(const SequenceCheck& check);
/// Joins the clauses of all checks that found a disagreement; empty if none did.
[[nodiscard]] std::string describe(std::span<const SequenceCheck> checks);

/// Limits and sampling of `check_sequence`.
struct SequenceCheckOptions {
  std::size_t pixels = 60'000;   ///< sampled in whole rows
  std::size_t compared = 3000;   ///< sampled pixels whose distances are computed
  std::size_t rows = 24;         ///< in which the ends of the field are looked for
  std::size_t min_pixels = 300;  ///< fewer measured pixels decide nothing
  /// Misfit over chance above which patterns disagree. Sound scans, also real ones with harmonics
  /// of 0.2 rad, stay below 0.4; a wrong start of 90 degrees gives 0.55 and more
  /// (`./run figures sequence_faults`).
  double max_misfit = 0.5;
  /// The misfit of a declaration that fits, over that of scan.toml.
  double max_fitted = 0.6;
  /// Share of the rows in which the ends of the field may meet: at a depth edge that happens to
  /// show both.
  double max_split_rows = 0.25;
};

/// Compares the wrapped phases of the fringe patterns of one direction with each other.
///
/// All phases of a pixel belong to one place of the projector's field. The distance from the
/// nearest such combination is small if period, start, direction of shift and order of frames of
/// all patterns are those of scan.toml. If it is not, other declarations are tried, and those that
/// fit decisively better are returned.
///
/// Whether the frames of a pattern have its shifts is not asked here: `SequenceFrames::orders_rad`
/// holds what explains them, and the other patterns decide between equal explanations.
///
/// `determines_orders` states whether the patterns by themselves determine the absolute phase of
/// the finest one (`find_sequence_method`).
///
/// @shape    coarse to fine, all frames w x h
/// @missing  not decided for a single pattern with three frames, for too few measured pixels, and
///           where the phases of unrelated patterns would fit as well
[[nodiscard]] SequenceCheck check_sequence(std::span<const SequenceFrames> coarse_to_fine,
                                           const NoiseModel& noise,
                                           const Projector& projector,
                                           bool determines_orders,
                                           const WrapOptions& wrap = {},
                                           const SequenceCheckOptions& options = {});

}  // namespace frangia
