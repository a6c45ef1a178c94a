#include "frangia/pipeline/internal/fringe_directions.h"

#include <algorithm>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/phase/unwrap_sequence.h"
#include "frangia/rig/phase_range.h"

namespace frangia {
namespace {

bool has_kind(std::span<const Pattern> patterns, PatternKind kind, FringeDirection direction) {
  return std::any_of(patterns.begin(), patterns.end(), [&](const Pattern& pattern) {
    return pattern.kind == kind && pattern.direction == direction;
  });
}

}  // namespace

bool is_absolute_direction(std::span<const Pattern> patterns,
                           FringeDirection direction,
                           const Projector& projector) {
  std::vector<Pattern> fringes;
  bool gray = false;
  bool code_alone = true;
  for (const Pattern& pattern : patterns) {
    code_alone = code_alone && pattern.kind != PatternKind::Fringe;
    if (pattern.direction != direction) continue;
    gray = gray || pattern.kind == PatternKind::Gray;
    if (pattern.kind == PatternKind::Fringe) fringes.push_back(pattern);
  }
  if (fringes.empty()) return gray && code_alone;
  if (gray) return true;
  std::stable_sort(fringes.begin(), fringes.end(), [](const Pattern& a, const Pattern& b) {
    return a.fringes_per_unit() < b.fringes_per_unit();
  });
  return is_absolute(fringes.front(), projector) || determine_absolute_phase(fringes, projector);
}

std::vector<FringeDirection> directions_to_decode(std::span<const Pattern> patterns,
                                                  const Projector& projector,
                                                  DirectionChoice choice) {
  constexpr auto kVertical = FringeDirection::Vertical;
  constexpr auto kHorizontal = FringeDirection::Horizontal;
  const bool fringes = has_kind(patterns, PatternKind::Fringe, kVertical) ||
                       has_kind(patterns, PatternKind::Fringe, kHorizontal);
  const PatternKind kind = fringes ? PatternKind::Fringe : PatternKind::Gray;
  const bool vertical = has_kind(patterns, kind, kVertical);
  const bool horizontal = has_kind(patterns, kind, kHorizontal);
  require(vertical || horizontal,
          "scan.toml has no pattern of kind \"fringe\" or \"gray\"; add one");
  if (choice == DirectionChoice::Vertical || choice == DirectionChoice::Horizontal) {
    const bool wants_vertical = choice == DirectionChoice::Vertical;
    if (!(wants_vertical ? vertical : horizontal)) {
      throw Error(ErrorKind::Input,
                  fmt::format("scan.toml has no {} {}; choose other `directions`",
                              wants_vertical ? "vertical" : "horizontal",
                              fringes ? "fringes" : "Gray code"));
    }
    return {wants_vertical ? kVertical : kHorizontal};
  }
  if (!vertical || !horizontal) return {vertical ? kVertical : kHorizontal};
  const bool vertical_absolute = is_absolute_direction(patterns, kVertical, projector);
  const bool horizontal_absolute = is_absolute_direction(patterns, kHorizontal, projector);
  if (vertical_absolute && horizontal_absolute) return {kVertical, kHorizontal};
  return {horizontal_absolute ? kHorizontal : kVertical};
}

}  // namespace frangia
