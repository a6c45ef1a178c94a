#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace frangia::report {

/// A sentence of the library in English, German and Italian; {0}, {1} are values, the same in each.
struct FaultRow {
  std::array<std::string, 3> text;  ///< by language
  std::size_t fixed = 0;            ///< characters of the English sentence that are no value
};

/// The texts of web/src/messages/faults_*.ts, which the build compiles in.
[[nodiscard]] const std::vector<std::string_view>& fault_sources();

/// The rows of such a text.
///
/// @errors   Error(Input) for a row that has not three columns
[[nodiscard]] std::vector<FaultRow> parse_fault_rows(std::string_view source);

/// A sentence of the library in the language of a column, as the app words it; what has no row,
/// such as a name, stays, and so does a sentence of more than 1000 characters.
[[nodiscard]] std::string worded_fault(std::string_view sentence, std::size_t column);

}  // namespace frangia::report
