#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "frangia/pattern/pattern.h"
#include "frangia/phase/temporal/check_sequence.h"

namespace frangia {

/// A pattern of a sequence with other keys than scan.toml declares.
struct ChangedPattern {
  std::size_t map = 0;
  Pattern pattern;
  std::size_t frames_of = 0;  ///< map whose frames show it; `map` unless two are exchanged
};

/// A hypothesis about what the frames of a sequence really show.
struct SequenceTrial {
  SequenceFault fault;
  std::vector<ChangedPattern> changes;
};

/// Hypotheses about one pattern: other starts, shifts in the other direction, frames in another
/// order. Hypotheses with the same shifts modulo 360 degrees are one trial.
[[nodiscard]] std::vector<SequenceTrial> shift_trials(std::span<const Pattern> patterns,
                                                      std::size_t map);

/// Hypotheses about the period of one pattern: that of another one, and simple multiples.
[[nodiscard]] std::vector<SequenceTrial> period_trials(std::span<const Pattern> patterns,
                                                       std::size_t map);

/// The hypothesis that one pattern has another number of fringes per projector pixel or degree.
[[nodiscard]] SequenceTrial period_trial(std::span<const Pattern> patterns,
                                         std::size_t map,
                                         double per_unit);

/// The hypothesis that one pattern starts `start_rad` later than declared.
[[nodiscard]] SequenceTrial start_trial(std::span<const Pattern> patterns,
                                        std::size_t map,
                                        double start_rad);

/// Hypotheses about several patterns: two are exchanged, or all start later.
[[nodiscard]] std::vector<SequenceTrial> joint_trials(std::span<const Pattern> patterns);

}  // namespace frangia
