#include "frangia/dataset/internal/read_pattern.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/core/angles.h"
#include "frangia/rig/rig.h"

namespace frangia {
namespace {

constexpr std::size_t kMinShifts = 3;

/// A text that file names begin with.
std::string file_name_part(TomlReader& reader, std::string_view key) {
  std::string name = reader.text(key);
  const bool plain =
      !name.empty() && name.front() != '.' &&
      std::none_of(name.begin(), name.end(), [](unsigned char letter) {
        return letter == '/' || letter == '\\' || letter == '@' || std::iscntrl(letter) != 0;
      });
  if (!plain) {
    std::replace_if(
        name.begin(),
        name.end(),
        [](unsigned char letter) { return std::iscntrl(letter) != 0; },
        '?');
    reader.fail(
        key,
        fmt::format("is \"{}\"; file names begin with it: use letters, digits, - and _ only",
                    name));
  }
  return name;
}

/// Whether the fringes of a pattern are those of an interferometer.
bool is_angular(const Rig& rig, const Pattern& pattern) {
  return rig.projector.is_angular() && pattern.source == PatternSource::Projector;
}

void read_fringes(TomlReader& reader, const Rig& rig, Pattern& pattern) {
  if (is_angular(rig, pattern)) {
    pattern.fringes_per_degree = reader.positive("fringes_per_degree");
  } else {
    pattern.period_px = reader.positive("period_px");
  }
  for (const double shift_deg : reader.numbers("shifts_deg")) {
    pattern.shifts_rad.push_back(rad_from_deg(shift_deg));
  }
  if (pattern.shifts_rad.size() < kMinShifts) {
    reader.fail("shifts_deg", fmt::format("must hold at least {} shifts", kMinShifts));
  }
}

/// One of the words; the first where the key is absent.
std::size_t read_word(TomlReader& reader,
                      std::string_view key,
                      const std::vector<std::string>& words) {
  if (!reader.has(key)) return 0;
  const std::string found = reader.text(key);
  const auto at = std::find(words.begin(), words.end(), found);
  if (at == words.end()) {
    reader.fail(key,
                fmt::format(R"(is "{}"; it must be "{}")", found, fmt::join(words, R"(" or ")")));
  }
  return static_cast<std::size_t>(at - words.begin());
}

/// true and false are "after" and "none".
InvertedFrames read_inverted(TomlReader& reader) {
  constexpr std::array kValues{
      InvertedFrames::None, InvertedFrames::After, InvertedFrames::Alternating};
  if (reader.is_boolean("inverted"))
    return reader.boolean("inverted") ? InvertedFrames::After : InvertedFrames::None;
  return kValues.at(read_word(reader, "inverted", {"none", "after", "alternating"}));
}

void read_gray(TomlReader& reader, const Rig& rig, Pattern& pattern) {
  constexpr int kMaxBits = 24;
  pattern.kind = PatternKind::Gray;
  if (pattern.source == PatternSource::Screen)
    reader.fail("kind", "is \"gray\" on a screen; show fringes with a period of the screen's size");
  const auto* model = std::get_if<PinholeModel>(&rig.projector.model);
  if (model == nullptr) reader.fail("kind", "is \"gray\", which an angular projector cannot show");
  pattern.bits = reader.integer("bits", 1, kMaxBits);
  pattern.inverted = read_inverted(reader);
  pattern.is_binary = read_word(reader, "code", {"gray", "binary"}) == 1;
  if (read_word(reader, "order", {"msb-first", "lsb-first"}) == 1)
    pattern.order = BitOrder::LeastSignificantFirst;
  if (reader.has("stripe_px")) pattern.stripe_px = reader.positive("stripe_px");
  pattern.offset_px = reader.number_or("offset_px", 0.0);
  if (pattern.offset_px < 0.0) reader.fail("offset_px", "must be 0 or above");
  const bool rows = pattern.direction == FringeDirection::Horizontal;
  const int side = rows ? model->height_px : model->width_px;
  if (std::ldexp(pattern.stripe_px, pattern.bits) < (side + pattern.offset_px) * (1.0 - 1e-9)) {
    reader.fail("bits",
                fmt::format("is {}, too few to number the projector's {} {}",
                            pattern.bits,
                            side,
                            rows ? "rows" : "columns"));
  }
}

void read_ramp(TomlReader& reader, Pattern& pattern) {
  pattern.kind = PatternKind::Ramp;
  pattern.levels = reader.numbers("levels");
  const bool rises =
      std::is_sorted(pattern.levels.begin(), pattern.levels.end(), std::less_equal<>());
  if (pattern.levels.size() < 3 || !rises || pattern.levels.front() != 0.0 ||
      pattern.levels.back() != 1.0)
    reader.fail("levels", "must be at least three rising shares of full light, from 0 to 1");
}

void read_exposures(TomlReader& reader, Pattern& pattern) {
  if (!reader.has("exposures_ms")) return;
  pattern.exposures_ms = reader.numbers("exposures_ms");
  const bool positive = std::all_of(pattern.exposures_ms.begin(),
                                    pattern.exposures_ms.end(),
                                    [](double exposure) { return exposure > 0.0; });
  if (pattern.exposures_ms.empty() || !positive)
    reader.fail("exposures_ms", "must hold at least one exposure, each above 0");
  if (pattern.kind != PatternKind::Fringe && pattern.kind != PatternKind::Gray)
    reader.fail("exposures_ms", R"(is for patterns of kind "fringe" and "gray" only)");
}

void read_direction(TomlReader& reader, const Rig& rig, Pattern& pattern) {
  if (!reader.has("direction")) return;
  pattern.direction = reader.named<FringeDirection>("direction");
  if (pattern.direction == FringeDirection::Horizontal && is_angular(rig, pattern))
    reader.fail("direction", "is \"horizontal\", but an angular projector's fringes are vertical");
}

}  // namespace

Pattern read_pattern(TomlReader reader, const Rig& rig, const Run& run) {
  Pattern pattern;
  pattern.name = file_name_part(reader, "name");
  if (read_word(reader, "source", {"projector", "screen"}) == 1)
    pattern.source = PatternSource::Screen;
  read_direction(reader, rig, pattern);
  const std::string kind = reader.text("kind");
  if (kind == "fringe") {
    read_fringes(reader, rig, pattern);
  } else if (kind == "line") {
    pattern.kind = PatternKind::Line;
    if (!rig.laser_sheet && has_geometry(rig))
      reader.fail("kind", "is \"line\", but rig.toml has no [line] with the laser sheet's plane");
  } else if (kind == "gray") {
    read_gray(reader, rig, pattern);
  } else if (kind == "ramp") {
    read_ramp(reader, pattern);
  } else if (kind == "white") {
    pattern.kind = PatternKind::White;
  } else if (kind == "ambient") {
    pattern.kind = PatternKind::Ambient;
  } else {
    reader.fail("kind",
                fmt::format(R"(is "{}"; it must be "fringe", "line", "gray", "ramp", "white" or )"
                            R"("ambient")",
                            kind));
  }
  read_exposures(reader, pattern);
  reader.warn_of_unused_keys(run);
  return pattern;
}

namespace {

void read_grid(TomlReader& reader, const char* key, Board& board) {
  constexpr double kMost = 1000.0;
  const std::vector<double> counts = reader.numbers(key, 2);
  for (const double count : counts) {
    if (!(count >= 3.0 && count <= kMost) || count != std::floor(count))
      reader.fail(key, "must be two whole numbers, along x and y, from 3 to 1000");
  }
  board.columns = static_cast<int>(counts[0]);
  board.rows = static_cast<int>(counts[1]);
}

std::optional<Artifact> read_artifact(TomlReader& reader, const std::string& kind) {
  constexpr double kMostPixels = 65535.0;
  if (kind == "screen") {
    const std::vector<double> size = reader.numbers("size_px", 2);
    for (const double side : size) {
      if (!(side >= 1.0 && side <= kMostPixels) || side != std::floor(side))
        reader.fail("size_px", "must be two whole numbers, columns and rows of the monitor");
    }
    return Screen{
        static_cast<int>(size[0]), static_cast<int>(size[1]), reader.positive("pixel_mm")};
  }
  if (kind == "plate") return Plate{};
  if (kind == "ball") return Balls{reader.positive("diameter_mm"), {}};
  if (kind == "ball-bar")
    return Balls{reader.positive("diameter_mm"), reader.positive("spacing_mm")};
  return {};
}

}  // namespace

BoardOrArtifact read_board(TomlReader reader, const Run& run) {
  Board board;
  const std::string kind = reader.text("kind");
  if (const std::optional<Artifact> artifact = read_artifact(reader, kind)) {
    check_artifact(*artifact);
    reader.warn_of_unused_keys(run);
    return *artifact;
  }
  if (kind == "checkerboard") {
    read_grid(reader, "corners", board);
    board.square_mm = reader.positive("square_mm");
  } else if (kind == "circles") {
    board.kind = BoardKind::Circles;
    read_grid(reader, "circles", board);
    board.square_mm = reader.positive("spacing_mm");
    if (reader.has("diameter_mm")) board.diameter_mm = reader.positive("diameter_mm");
  } else if (kind == "charuco") {
    board.kind = BoardKind::Charuco;
    read_grid(reader, "corners", board);
    board.square_mm = reader.positive("square_mm");
    if (reader.has("marker_mm")) board.marker_mm = reader.positive("marker_mm");
    board.dictionary = reader.text("dictionary");
    if (reader.has("first_id")) board.first_id = reader.integer("first_id", 0, 249);
    if (reader.has("legacy_layout")) board.legacy_layout = reader.boolean("legacy_layout");
  } else {
    reader.fail(
        "kind",
        fmt::format(R"(is "{}"; it must be "checkerboard", "charuco", "circles", "screen", )"
                    R"("plate", "ball" or "ball-bar")",
                    kind));
  }
  check_board(board);
  reader.warn_of_unused_keys(run);
  return board;
}

}  // namespace frangia
