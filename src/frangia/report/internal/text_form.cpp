#include "frangia/report/internal/text_form.h"

namespace frangia::report {
namespace {

/// Places of a literal that are tried: names of users may repeat what separates values.
constexpr int kMostTries = 20'000;

bool is_value(std::string_view text, ValueKind kind) {
  return kind == ValueKind::Any || (!text.empty() && text.find("; ") == std::string_view::npos);
}

bool matches(
    std::string_view form, std::string_view text, ValueKind kind, int& tries, Values& values) {
  while (!form.empty()) {
    const auto place = place_at(form);
    if (!place) {
      if (text.empty() || text.front() != form.front()) return false;
      form.remove_prefix(1);
      text.remove_prefix(1);
      continue;
    }
    form.remove_prefix(3);
    if (form.empty()) {
      values.at(place->slot()) = text;
      return is_value(text, kind);
    }
    const std::string_view literal = form.substr(0, form.find('{'));
    const std::size_t shortest = kind == ValueKind::Any ? 0 : 1;
    for (std::size_t at = text.find(literal, shortest); at != std::string_view::npos;
         at = text.find(literal, at + 1)) {
      if (!is_value(text.substr(0, at), kind) || tries-- <= 0) return false;
      if (!matches(form, text.substr(at), kind, tries, values)) continue;
      values.at(place->slot()) = text.substr(0, at);
      return true;
    }
    return false;
  }
  return text.empty();
}

}  // namespace

std::optional<Place> place_at(std::string_view form) {
  if (form.size() < 3 || form[0] != '{' || form[2] != '}') return std::nullopt;
  const bool is_name = form[1] >= 'A';
  return Place{static_cast<std::size_t>(form[1] - (is_name ? 'A' : '0')), is_name};
}

std::size_t fixed_of(std::string_view form) {
  std::size_t fixed = 0;
  while (!form.empty()) {
    const bool place = place_at(form).has_value();
    if (!place) ++fixed;
    form.remove_prefix(place ? 3 : 1);
  }
  return fixed;
}

bool has_form(std::string_view form, std::string_view text, ValueKind kind, Values& values) {
  int tries = kMostTries;
  return matches(form, text, kind, tries, values);
}

}  // namespace frangia::report
