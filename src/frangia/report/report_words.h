#pragma once

#include <span>
#include <string>
#include <string_view>

namespace frangia {

/// The words of a report in the language of its reader.
///
/// The report is composed in English. A catalogue has the English texts, with {0}, {1} for the
/// values in them, which are translated in turn, and {A}, {B} for names, which stay. A text without
/// a row stays.
class ReportWords {
 public:
  /// Words of a language; English leaves every text as it is.
  ///
  /// @errors   Error(Input) for a language that is none of `kReportLanguages`
  explicit ReportWords(std::string_view language = "en");

  /// The text in the language.
  [[nodiscard]] std::string operator()(std::string_view english) const;

  /// The name of a characteristic: what the program made of a name of the plan, such as "bore
  /// diameter", in the language; the name itself stays.
  [[nodiscard]] std::string name(std::string_view english) const;

  /// A sentence of clauses, "a; b; c", in the language: as a whole where it has a row, else clause
  /// by clause.
  [[nodiscard]] std::string sentence(std::string_view english) const;

  /// A warning of the library in the language, as the app words it; names in it stay.
  [[nodiscard]] std::string warning(std::string_view english) const;

  [[nodiscard]] const std::string& language() const { return language_; }  ///< its code

 private:
  [[nodiscard]] std::string translated(std::string_view english, bool whole) const;
  [[nodiscard]] std::string filled(std::string_view form,
                                   std::span<const std::string_view> values) const;

  std::string language_;
  std::size_t column_ = 0;  ///< of the catalogue; 0: English
};

}  // namespace frangia
