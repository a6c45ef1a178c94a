#include "frangia/phase/algorithm/read_algorithm.h"

#include <vector>

#include <fmt/format.h>

#include "frangia/core/angles.h"
#include "frangia/rig/toml_reader.h"

namespace frangia {

LinearAlgorithm read_algorithm(const std::filesystem::path& path, const Run& run) {
  const toml::table table = parse_toml(path, "frangia-algorithm");
  TomlReader reader(path, "", table);
  reader.ignore("format");
  reader.ignore("version");
  const std::string name = reader.text("name");
  std::vector<double> shifts_rad;
  for (const double shift : reader.numbers("shifts_deg"))
    shifts_rad.push_back(rad_from_deg(shift));
  const auto numerator = reader.numbers("numerator");
  const auto denominator = reader.numbers("denominator");
  reader.warn_of_unused_keys(run);
  try {
    return linear_algorithm(name, shifts_rad, numerator, denominator);
  } catch (const Error& error) {
    throw Error(error.kind(), fmt::format("{}: {}", path.string(), error.what()));
  }
}

}  // namespace frangia
