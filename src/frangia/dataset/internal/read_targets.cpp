#include "frangia/dataset/internal/read_targets.h"

#include <string>

#include <fmt/format.h>

namespace frangia {
namespace {

constexpr int kMostCodes = 249;  // of the largest dictionary

KnownTargetDistance read_distance(TomlReader reader, const Run& run) {
  KnownTargetDistance known;
  known.first = reader.integer("from", 0, kMostCodes);
  known.second = reader.integer("to", 0, kMostCodes);
  known.distance_mm = reader.positive("distance_mm");
  known.sigma_mm = reader.positive("sigma_mm");
  reader.warn_of_unused_keys(run);
  return known;
}

}  // namespace

TargetSet read_targets(TomlReader reader, const Run& run) {
  TargetSet targets;
  if (reader.has("diameter_mm")) targets.diameter_mm = reader.positive("diameter_mm");
  if (reader.has("disc")) {
    const std::string tone = reader.text("disc");
    if (tone != "dark" && tone != "light")
      reader.fail("disc", fmt::format(R"(is "{}"; it must be "dark" or "light")", tone));
    targets.tone = tone == "light" ? TargetTone::Light : TargetTone::Dark;
  }
  if (reader.has("dictionary")) targets.dictionary = reader.text("dictionary");
  if (reader.has("marker_mm")) targets.marker_mm = reader.positive("marker_mm");
  if (reader.has("sticker_mm")) targets.sticker_mm = reader.positive("sticker_mm");
  for (const TomlReader& distance : reader.tables("distance"))
    targets.distances.push_back(read_distance(distance, run));
  reader.warn_of_unused_keys(run);
  return targets;
}

}  // namespace frangia
