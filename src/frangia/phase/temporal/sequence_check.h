#pragma once

#include <span>
#include <string>
#include <vector>

#include "frangia/core/enum_names.h"

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
};

/// How well the patterns of one direction agree with each other.
struct SequenceCheck {
  bool decided = false;     ///< the frames suffice to tell agreement from chance
  bool consistent = true;   ///< the patterns agree, or the frames do not decide it
  double misfit_rad = 0.0;  ///< median distance of the phases from those of one place of the field
  double chance_rad = 0.0;  ///< the same for phases that have nothing to do with each other
  double agreement = 0.0;   ///< of a Gray code: share of the pixels and borders that fit
  double fitted_rad = 0.0;  ///< the misfit with the best of `fits`
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

}  // namespace frangia
