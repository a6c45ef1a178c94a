#include "frangia/simulate/parts.h"

#include <array>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/core/error.h"

namespace frangia {
namespace {

using Maker = Mesh (*)();

constexpr std::array<std::pair<std::string_view, Maker>, 6> kParts{{{"shaft", make_shaft},
                                                                    {"blade", make_blade},
                                                                    {"bust", make_bust},
                                                                    {"ball-bar", make_ball_bar},
                                                                    {"plate", make_plate},
                                                                    {"bracket", make_bracket}}};

}  // namespace

std::vector<std::string> part_names() {
  std::vector<std::string> names;
  names.reserve(kParts.size());
  for (const auto& part : kParts)
    names.emplace_back(part.first);
  return names;
}

Mesh make_part(std::string_view name) {
  for (const auto& part : kParts) {
    if (part.first == name) return part.second();
  }
  throw Error(ErrorKind::Input,
              fmt::format("there is no built-in part \"{}\"; choose one of {}",
                          name,
                          fmt::join(part_names(), ", ")));
}

}  // namespace frangia
