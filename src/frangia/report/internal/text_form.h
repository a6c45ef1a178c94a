#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace frangia::report {

/// A place for a value in the form of a text: {0} to {9}, or {A} to {J} for a name, which stays as
/// it is in every language.
struct Place {
  std::size_t index = 0;
  bool is_name = false;

  /// Its place among the values of a text, the names behind the others.
  [[nodiscard]] std::size_t slot() const { return index + (is_name ? 10U : 0U); }
};

/// The values of a text by `Place::slot`.
using Values = std::array<std::string_view, 20>;

/// The place that a form begins with; it has three characters.
[[nodiscard]] std::optional<Place> place_at(std::string_view form);

/// How many characters of a form are no place for a value.
[[nodiscard]] std::size_t fixed_of(std::string_view form);

/// What a value of a text may be.
enum class ValueKind {
  Any,    ///< also empty, or a sentence
  Clause  ///< neither empty nor of several clauses, "a; b"
};

/// Whether a text has a form; then its values, each as short as possible. A text with so many
/// separators that the search takes too long has none.
[[nodiscard]] bool has_form(std::string_view form,
                            std::string_view text,
                            ValueKind kind,
                            Values& values);

}  // namespace frangia::report
