#include "frangia/report/internal/fault_rows.h"

#include <algorithm>
#include <cctype>
#include <optional>

#include "frangia/core/error.h"
#include "frangia/report/internal/text_form.h"

namespace frangia::report {
namespace {

constexpr std::size_t kMostDepth = 12;         // of sentences in sentences
constexpr std::size_t kMostCharacters = 1000;  // of a sentence; a longer one is a user's text

/// Reads a string of TypeScript in single or double quotes; `at` is its first quote, and then
/// behind it.
std::string quoted_text(std::string_view source, std::size_t& at) {
  const char quote = source[at++];
  std::string text;
  while (at < source.size() && source[at] != quote) {
    if (source[at] == '\\') ++at;
    if (at < source.size()) text += source[at++];
  }
  ++at;
  return text;
}

/// All rows; those with the most characters of their own first, because what begins or ends with a
/// value would also fit longer sentences.
const std::vector<FaultRow>& all_rows() {
  static const std::vector<FaultRow> rows = [] {
    std::vector<FaultRow> all;
    for (const std::string_view source : fault_sources()) {
      for (FaultRow& row : parse_fault_rows(source))
        all.push_back(std::move(row));
    }
    std::stable_sort(all.begin(), all.end(), [](const FaultRow& a, const FaultRow& b) {
      return a.fixed > b.fixed;
    });
    return all;
  }();
  return rows;
}

std::string worded(std::string_view sentence, std::size_t column, std::size_t depth);

std::optional<std::string> by_row(std::string_view sentence,
                                  std::size_t column,
                                  std::size_t depth) {
  for (const FaultRow& row : all_rows()) {
    Values values;
    const std::string_view english = row.text[0];
    if (row.fixed == 0 || !has_form(english, sentence, ValueKind::Any, values)) continue;
    const bool leads_with_name = english.starts_with("{0}: ");  // of a file or a feature: it stays
    std::string text;
    std::string_view form = row.text.at(column);
    while (!form.empty()) {
      const auto place = place_at(form);
      if (place) {
        const std::string_view value = values.at(place->slot());
        text += leads_with_name && place->index == 0 ? std::string(value)
                                                     : worded(value, column, depth + 1);
      } else {
        text += form.front();
      }
      form.remove_prefix(place ? 3 : 1);
    }
    return text;
  }
  return std::nullopt;
}

/// What precedes a sentence: the file, the feature, the key.
std::size_t prefix_end(std::string_view sentence) {
  constexpr std::size_t kLongest = 120;
  const std::size_t colon = sentence.find(": ");
  const std::size_t semicolon = sentence.find(';');
  const bool found =
      colon != std::string_view::npos && colon > 0 && colon <= kLongest && semicolon > colon;
  return found && colon + 2 < sentence.size() ? colon : std::string_view::npos;
}

std::string worded(std::string_view sentence, std::size_t column, std::size_t depth) {
  const bool has_letter = std::any_of(sentence.begin(), sentence.end(), [](char c) {
    return std::isalpha(static_cast<unsigned char>(c)) != 0;
  });
  if (!has_letter || depth > kMostDepth) return std::string(sentence);
  if (const auto whole = by_row(sentence, column, depth)) return *whole;
  const std::size_t colon = prefix_end(sentence);
  if (colon != std::string_view::npos) {
    const std::string_view rest = sentence.substr(colon + 2);
    if (const auto row = by_row(rest, column, depth))
      return std::string(sentence.substr(0, colon)) + ": " + *row;
  }
  // A sentence may go on with one of another row, which begins with its sign.
  for (std::size_t i = 1; i + 1 < sentence.size(); ++i) {
    const char sign = sentence[i];
    if ((sign != ';' && sign != ':' && sign != ',') || sentence[i + 1] != ' ') continue;
    const auto tail = by_row(sentence.substr(i), column, depth);
    const auto head = by_row(sentence.substr(0, i), column, depth);
    if (tail || head) {
      return (head ? *head : worded(sentence.substr(0, i), column, depth + 1)) +
             (tail ? *tail
                   : std::string(sentence.substr(i, 2)) +
                         worded(sentence.substr(i + 2), column, depth + 1));
    }
  }
  if (colon == std::string_view::npos) return std::string(sentence);
  return std::string(sentence.substr(0, colon)) + ": " +
         worded(sentence.substr(colon + 2), column, depth + 1);
}

}  // namespace

std::vector<FaultRow> parse_fault_rows(std::string_view source) {
  constexpr std::string_view kBegin = "'fault.";
  std::vector<FaultRow> rows;
  for (std::size_t at = source.find(kBegin); at != std::string_view::npos;
       at = source.find(kBegin, at)) {
    static_cast<void>(quoted_text(source, at));  // its name
    FaultRow row;
    for (std::string& text : row.text) {
      at = source.find_first_of("'\"]", at);
      require(at != std::string_view::npos && source[at] != ']',
              "a row of the sentences has not three languages");
      text = quoted_text(source, at);
    }
    row.fixed = fixed_of(row.text[0]);
    rows.push_back(std::move(row));
  }
  return rows;
}

std::string worded_fault(std::string_view sentence, std::size_t column) {
  if (column == 0 || sentence.size() > kMostCharacters) return std::string(sentence);
  return worded(sentence, column, 0);
}

}  // namespace frangia::report
