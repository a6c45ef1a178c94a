#include "frangia/dataset/internal/read_board.h"

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace frangia {
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
