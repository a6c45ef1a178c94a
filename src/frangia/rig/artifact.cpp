#include "frangia/rig/artifact.h"

#include <cmath>

#include <fmt/format.h>

#include "frangia/core/error.h"

namespace frangia {
namespace {

void require_length(const char* key, double value_mm, const char* meaning) {
  if (value_mm > 0.0 && std::isfinite(value_mm)) return;
  throw Error(ErrorKind::Input,
              fmt::format("board.{} is {}; give the {} in millimetres", key, value_mm, meaning));
}

void check_screen(const Screen& screen) {
  constexpr int kFewest = 16;  // columns or rows that still show a fringe
  if (screen.width_px < kFewest || screen.height_px < kFewest) {
    throw Error(ErrorKind::Input,
                fmt::format("board.size_px is [{}, {}]; give the columns and rows of the monitor",
                            screen.width_px,
                            screen.height_px));
  }
  require_length("pixel_mm", screen.pixel_mm, "distance between two pixels of the monitor");
}

void check_balls(const Balls& balls) {
  require_length("diameter_mm", balls.diameter_mm, "diameter of the balls");
  if (!balls.spacing_mm) return;
  require_length("spacing_mm", *balls.spacing_mm, "distance between the centers of the balls");
  if (*balls.spacing_mm > balls.diameter_mm) return;
  throw Error(
      ErrorKind::Input,
      fmt::format("board.spacing_mm is {:g}, but balls of diameter_mm = {:g} would overlap; "
                  "give the distance between their centers",
                  *balls.spacing_mm,
                  balls.diameter_mm));
}

}  // namespace

std::string name_of(const Artifact& artifact) {
  if (std::holds_alternative<Screen>(artifact)) return "screen";
  if (std::holds_alternative<Plate>(artifact)) return "plate";
  return std::get<Balls>(artifact).spacing_mm ? "ball-bar" : "ball";
}

void check_artifact(const Artifact& artifact) {
  if (const auto* screen = std::get_if<Screen>(&artifact)) check_screen(*screen);
  if (const auto* balls = std::get_if<Balls>(&artifact)) check_balls(*balls);
}

}  // namespace frangia
