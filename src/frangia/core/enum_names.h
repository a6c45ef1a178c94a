#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/error.h"

namespace frangia {

// What users call the values of an enum. Its table stands beside the enum and is found by
// argument-dependent lookup; program, service, Python and files have no names of their own:
//
//   enum class DxfVariant { Faces, Polyface };
//   [[nodiscard]] constexpr auto names_of(DxfVariant /*any*/) {
//     return EnumNames<DxfVariant, 2>{{{DxfVariant::Faces, "faces"}, ...}};
//   }

/// A value of an enum and its name.
template <typename Enum>
struct EnumName {
  Enum value;             ///< one value of the enum
  std::string_view name;  ///< what users call it
};

/// All values of an enum with their names, in the order in which they are listed to users.
template <typename Enum, std::size_t Count>
using EnumNames = std::array<EnumName<Enum>, Count>;

/// An enum that has a table of names.
template <typename Enum>
concept NamedEnum = requires(Enum value) {
  names_of(value);
};

/// The name of `value`; empty for a value that is not in the table.
template <NamedEnum Enum>
[[nodiscard]] constexpr std::string_view name_of(Enum value) {
  for (const auto& [known, name] : names_of(value))
    if (known == value) return name;
  return {};
}

/// The value that `name` stands for.
///
/// @missing  nullopt: no value has this name
template <NamedEnum Enum>
[[nodiscard]] constexpr std::optional<Enum> find_named(std::string_view name) {
  for (const auto& [value, known] : names_of(Enum{}))
    if (known == name) return value;
  return std::nullopt;
}

/// The names of all values.
template <NamedEnum Enum>
[[nodiscard]] std::vector<std::string> all_names() {
  std::vector<std::string> names;
  for (const auto& [value, name] : names_of(Enum{}))
    names.emplace_back(name);
  return names;
}

/// The names of all values in a sentence: "a, b or c".
template <NamedEnum Enum>
[[nodiscard]] std::string listed_names() {
  const std::vector<std::string> names = all_names<Enum>();
  std::string text = names.front();
  for (std::size_t i = 1; i < names.size(); ++i)
    text += (i + 1 < names.size() ? ", " : " or ") + names[i];
  return text;
}

/// The value that `name` stands for.
///
/// @throws  Error(Input) for another name: "KEY is "NAME"; use a, b or c"
template <NamedEnum Enum>
[[nodiscard]] Enum value_named(std::string_view key, std::string_view name) {
  if (const auto value = find_named<Enum>(name)) return *value;
  throw Error(ErrorKind::Input,
              fmt::format("{} is \"{}\"; use {}", key, name, listed_names<Enum>()));
}

}  // namespace frangia
