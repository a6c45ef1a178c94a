#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "frangia/inspect/surface_verdict.h"

namespace frangia {

/// A parameter of a clause: a number, a place in the frame of the reference, or a name.
using ClauseValue = std::variant<double, Eigen::Vector3d, std::string>;

/// A part of the sentence about a verdict: what it says, with its parameters, and the English
/// text. Another language words it by `id` and `values`.
struct VerdictClause {
  std::string_view id;  ///< such as "out_at"; docs/inspection.md lists them with their values
  /// Names with units and the values; NaN where one is not known.
  std::vector<std::pair<std::string_view, ClauseValue>> values;
  std::string text;  ///< in English
};

/// The sentence about a surface, clause by clause: the decision, its reason and what to do, and
/// what is not judged.
[[nodiscard]] std::vector<VerdictClause> clauses_of(const SurfaceVerdict& verdict);

/// What a verdict about a mesh without sigma lacks.
[[nodiscard]] VerdictClause no_uncertainty_clause();

/// The clauses as one sentence.
[[nodiscard]] std::string sentence_of(const std::vector<VerdictClause>& clauses);

}  // namespace frangia
