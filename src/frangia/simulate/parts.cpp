#include "frangia/simulate/parts.h"

#include <array>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/core/error.h"

namespace frangia {
namespace {

using Maker = Mesh (*)(const Run&);

/// A maker that is too fast to be cancelled.
template <Mesh (*make)()>
Mesh make_at_once(const Run& /*run*/) {
  return make();
}

constexpr std::array<std::pair<std::string_view, Maker>, 8> kParts{
    {{"shaft", make_at_once<make_shaft>},
     {"blade", make_at_once<make_blade>},
     {"bust", make_bust},
     {"ball-bar", make_at_once<make_ball_bar>},
     {"plate", make_at_once<make_plate>},
     {"bracket", make_at_once<make_bracket>},
     {"groove", make_at_once<make_groove>},
     {"gear", make_at_once<make_gear>}}};

}  // namespace

std::vector<std::string> part_names() {
  std::vector<std::string> names;
  names.reserve(kParts.size());
  for (const auto& part : kParts)
    names.emplace_back(part.first);
  return names;
}

Mesh make_part(std::string_view name, const Run& run) {
  for (const auto& part : kParts) {
    if (part.first == name) return part.second(run);
  }
  throw Error(ErrorKind::Input,
              fmt::format("there is no built-in part \"{}\"; choose one of {}",
                          name,
                          fmt::join(part_names(), ", ")));
}

}  // namespace frangia
