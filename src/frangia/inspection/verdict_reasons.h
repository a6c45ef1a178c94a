#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "frangia/inspect/surface_verdict.h"
#include "frangia/inspect/verdict_clause.h"
#include "frangia/inspection/measured_characteristics.h"
#include "frangia/uncertainty/conformity.h"

namespace frangia {

/// The decision about a part: out when the deviations or a characteristic are out, in when all are
/// in. `surface` is null without a reference.
[[nodiscard]] Conformity verdict_of(const SurfaceVerdict* surface,
                                    const std::vector<MeasuredCharacteristic>& characteristics);

/// A reason of the verdict about a part.
struct VerdictReason {
  std::string_view about;              ///< "surface" or "characteristics"
  std::vector<VerdictClause> clauses;  ///< the parts of its sentence

  [[nodiscard]] std::string text() const;  ///< in English, one sentence
};

/// Why the verdict about a part is what it is, what decided first. Empty without a reference and
/// characteristics with limits.
[[nodiscard]] std::vector<VerdictReason> verdict_reasons(
    const SurfaceVerdict* surface, const std::vector<MeasuredCharacteristic>& characteristics);

/// How much of its tolerance a value uses: 0 in the middle, 1 at a limit, more beyond; of an upper
/// limit alone the share of it.
///
/// @missing  NaN without a value or limits
[[nodiscard]] double tolerance_used(const MeasuredCharacteristic& row);

/// Rows with limits, the worst first: those that are out, undecided, in, each by the tolerance that
/// they use; then those without limits.
[[nodiscard]] std::vector<MeasuredCharacteristic> worst_first(
    std::vector<MeasuredCharacteristic> rows);

}  // namespace frangia
