#include "import_table.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/core/angles.h"

#include "counted.h"
#include "text_table.h"

namespace frangia {
namespace {

/// The parameters of a pattern in a few words.
std::string parameters_of(const Pattern& pattern) {
  if (pattern.kind == PatternKind::White) return "full light";
  if (pattern.kind == PatternKind::Ambient) return "no light of the projector";
  if (pattern.kind == PatternKind::Line) return "laser line";
  if (pattern.kind == PatternKind::Ramp) return counted(pattern.levels.size(), "level");
  const char* const lines = pattern.direction == FringeDirection::Horizontal ? "rows" : "columns";
  if (pattern.kind == PatternKind::Gray) {
    return fmt::format("{} of {}, stripes of {:g} px{}",
                       counted(pattern.bits, "bit"),
                       lines,
                       pattern.stripe_px,
                       pattern.inverted == InvertedFrames::None ? "" : ", with inverses");
  }
  std::vector<std::string> shifts;
  for (const double shift : pattern.shifts_rad)
    shifts.push_back(fmt::format("{:.6g}", deg_from_rad(shift)));
  constexpr std::size_t kShownShifts = 4;
  if (shifts.size() > kShownShifts) {
    shifts = {shifts[0], shifts[1], shifts[2], "...", shifts.back()};
  }
  return fmt::format(
      "fringes over {}, {:.6g} {}, shifts {}°",
      lines,
      pattern.fringes_per_degree > 0.0 ? pattern.fringes_per_degree : pattern.period_px,
      pattern.fringes_per_degree > 0.0 ? "per degree" : "px",
      fmt::join(shifts, ", "));
}

}  // namespace

std::string import_table(const ImportPlan& plan) {
  TextColumn name{"pattern", {}, false};
  TextColumn frames{"frames", {}};
  TextColumn first{"first", {}, false};
  TextColumn last{"last", {}, false};
  TextColumn parameters{"shows", {}, false};
  const auto file_of = [&](const ImportedFrame& frame) {
    const std::string file = frame.file.lexically_relative(plan.folder).generic_string();
    return frame.page > 0 ? fmt::format("{} image {}", file, frame.page) : file;
  };
  for (std::size_t i = 0; i < plan.patterns.size(); ++i) {
    const auto is_shown = [&](const ImportedFrame& frame) {
      return frame.pattern == i && frame.view == 0 && frame.camera == 0;
    };
    const auto begin = std::find_if(plan.frames.begin(), plan.frames.end(), is_shown);
    const auto end = std::find_if(plan.frames.rbegin(), plan.frames.rend(), is_shown);
    name.values.push_back(plan.patterns[i].name);
    frames.values.push_back(fmt::format("{}", plan.patterns[i].frame_count()));
    first.values.push_back(file_of(*begin));
    last.values.push_back(file_of(*end));
    parameters.values.push_back(parameters_of(plan.patterns[i]));
  }
  return text_table({name, frames, first, last, parameters});
}

}  // namespace frangia
