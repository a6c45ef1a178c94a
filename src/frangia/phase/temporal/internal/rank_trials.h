#pragma once

#include <vector>

#include "frangia/phase/temporal/check_sequence.h"
#include "frangia/phase/temporal/internal/sequence_sample.h"
#include "frangia/phase/temporal/internal/sequence_trials.h"

namespace frangia {

/// A hypothesis and how well the phases fit it.
struct RankedTrial {
  SequenceTrial trial;
  double misfit_rad = 0.0;
};

/// Hypotheses about starts in quarter turns, directions, orders, periods and exchanged patterns.
[[nodiscard]] std::vector<SequenceTrial> all_trials(const SequenceSample& sample);

/// Sorts trials by their misfit and keeps those that fit decisively better than scan.toml, and
/// than unrelated phases. Equal trials are kept once.
[[nodiscard]] std::vector<RankedTrial> ranked(const SequenceSample& sample,
                                              std::vector<RankedTrial> trials,
                                              double max_misfit_rad,
                                              const SequenceCheckOptions& options);

/// Computes the misfits of trials and ranks them.
[[nodiscard]] std::vector<RankedTrial> fitting(const SequenceSample& sample,
                                               std::vector<SequenceTrial> trials,
                                               double max_misfit_rad,
                                               const SequenceCheckOptions& options);

/// Adds starts that are no multiples of a quarter turn, if none of `found` leaves noise alone.
[[nodiscard]] std::vector<RankedTrial> with_free_starts(const SequenceSample& sample,
                                                        std::vector<RankedTrial> found);

/// Of trials that fit and do not split the surface, the one with the most evidence, and those that
/// it does not beat by 100 : 1.
[[nodiscard]] std::vector<RankedTrial> plausible(const SequenceSample& sample,
                                                 std::vector<RankedTrial> fitting,
                                                 bool absolute);

}  // namespace frangia
