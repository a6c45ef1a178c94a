#include "frangia/simulate/default_patterns.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>

#include <fmt/format.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/pattern/fringe_sequence.h"
#include "frangia/pattern/gray_code.h"
#include "frangia/rig/rig.h"

namespace frangia {
namespace {

/// A projector shows bright and dark on neighbouring pixels at best.
constexpr double kMinPeriod_px = 2.0;
/// Over the field, as in fringe_sequence.
constexpr double kMaxFringes = 1e6;

std::vector<double> even_shifts(int count) {
  std::vector<double> shifts;
  shifts.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i)
    shifts.push_back(kTwoPi * i / count);
  return shifts;
}

Pattern angular_pattern(const std::string& name, double fringes_per_degree, int shifts) {
  Pattern pattern;
  pattern.name = name;
  pattern.fringes_per_degree = fringes_per_degree;
  pattern.shifts_rad = even_shifts(shifts);
  return pattern;
}

std::vector<Pattern> angular_patterns(const Rig& rig, const PatternPlan& plan) {
  const double finest = plan.fringes_per_degree;
  const auto& field = std::get<AngularModel>(rig.projector.model);
  const double fringes =
      finest * deg_from_rad(field.field_max_rad - field.field_min_rad) / field.pitch_scale;
  if (!(finest > 0.0 && fringes <= kMaxFringes)) {
    throw Error(
        ErrorKind::Input,
        fmt::format("`fringes_per_degree` is {:g}; it must be above 0 and give at most {:g} "
                    "fringes over the projector's field",
                    finest,
                    kMaxFringes));
  }
  require(plan.direction.value_or(FringeDirection::Vertical) == FringeDirection::Vertical,
          "`direction` is for a digital projector, but the rig's projector is angular");
  require(plan.periods_px.empty(),
          "`periods_px` is for a digital projector, but the rig's projector is angular; set "
          "`fringes_per_degree` instead");
  if (rig.laser_sheet) {
    Pattern line;
    line.name = "line";
    line.kind = PatternKind::Line;
    return {angular_pattern("fringe", finest, plan.shifts), line};
  }
  // 1e-9 absorbs rounding: a field of exactly 32 fringes needs five doublings, not six.
  const int doublings = std::max(0, static_cast<int>(std::ceil(std::log2(fringes) - 1e-9)));
  std::vector<Pattern> patterns;
  for (int i = 0; i <= doublings; ++i) {
    patterns.push_back(angular_pattern(
        fmt::format("fringe{}", i), std::ldexp(finest, i - doublings), plan.shifts));
  }
  return patterns;
}

void require_period(double period_px) {
  if (std::isfinite(period_px) && period_px >= kMinPeriod_px) return;
  throw Error(
      ErrorKind::Input,
      fmt::format(
          "a fringe period is {:g} pixels; it must be at least {:g}", period_px, kMinPeriod_px));
}

/// Pixels of the projector across fringes of a direction.
double field_px(const PinholeModel& pinhole, FringeDirection direction) {
  return direction == FringeDirection::Vertical ? pinhole.width_px : pinhole.height_px;
}

std::vector<Pattern> pinhole_patterns(const PinholeModel& pinhole,
                                      FringeDirection direction,
                                      const PatternPlan& plan) {
  std::vector<double> periods = plan.periods_px;
  if (periods.empty()) {
    const double width = field_px(pinhole, direction);
    periods = {width, width / 8.0, width / 64.0};
  }
  std::sort(periods.begin(), periods.end(), std::greater<>());
  std::vector<Pattern> patterns;
  for (const double period : periods) {
    require_period(period);
    Pattern pattern;
    pattern.name = fmt::format("p{:g}", period);
    pattern.direction = direction;
    pattern.period_px = period;
    pattern.shifts_rad = even_shifts(plan.shifts);
    patterns.push_back(pattern);
  }
  return patterns;
}

/// A multi-frequency sequence over the whole field, for either kind of projector.
std::vector<Pattern> sequence_patterns(const Rig& rig,
                                       FringeDirection direction,
                                       const PatternPlan& plan) {
  const auto* pinhole = std::get_if<PinholeModel>(&rig.projector.model);
  std::vector<Pattern> patterns;
  const bool alone = plan.sequence == "gray-alone";
  const bool gray = alone || plan.sequence == "gray";
  require(
      !gray || pinhole != nullptr,
      "Gray code is for a digital projector, but the rig's projector is angular; choose another "
      "`sequence`");
  require(plan.periods_px.empty(), "set either `periods_px` or `sequence`, not both");
  for (const double fringes :
       gray ? std::vector<double>{plan.fringes} : fringe_sequence(plan.sequence, plan.fringes)) {
    const std::string name = fmt::format("f{:g}", fringes);
    if (pinhole != nullptr) {
      Pattern pattern{.name = name,
                      .direction = direction,
                      .period_px = field_px(*pinhole, direction) / fringes};
      require_period(pattern.period_px);
      pattern.shifts_rad = even_shifts(plan.shifts);
      patterns.push_back(pattern);
      continue;
    }
    const auto& field = std::get<AngularModel>(rig.projector.model);
    const double field_deg =
        deg_from_rad(field.field_max_rad - field.field_min_rad) / field.pitch_scale;
    patterns.push_back(angular_pattern(name, fringes / field_deg, plan.shifts));
  }
  if (gray)
    patterns.push_back(
        gray_code_for_fringes(patterns.front(),
                              field_px(*pinhole, direction),
                              plan.inverted ? InvertedFrames::After : InvertedFrames::None));
  if (alone) patterns.erase(patterns.begin());
  return patterns;
}

}  // namespace

std::vector<Pattern> default_patterns(const Rig& rig, const PatternPlan& plan) {
  require(plan.shifts >= 3, "`shifts` must be at least 3");
  const auto* pinhole = std::get_if<PinholeModel>(&rig.projector.model);
  const FringeDirection direction = plan.direction.value_or(measuring_direction(rig));
  std::vector<Pattern> patterns = !plan.sequence.empty() ? sequence_patterns(rig, direction, plan)
                                  : pinhole != nullptr ? pinhole_patterns(*pinhole, direction, plan)
                                                       : angular_patterns(rig, plan);
  for (Pattern& pattern : patterns)
    if (pattern.kind != PatternKind::Line) pattern.exposures_ms = plan.exposures_ms;
  if (plan.ramp > 0) {
    require(plan.ramp >= 3, "`ramp` must be at least 3 levels");
    Pattern ramp{.name = "ramp", .kind = PatternKind::Ramp};
    for (int i = 0; i < plan.ramp; ++i)
      ramp.levels.push_back(static_cast<double>(i) / (plan.ramp - 1));
    patterns.push_back(ramp);
  }
  if (plan.white) patterns.push_back({.name = "white", .kind = PatternKind::White});
  if (plan.dark) patterns.push_back({.name = "ambient", .kind = PatternKind::Ambient});
  return patterns;
}

std::vector<Pattern> calibration_patterns(const Rig& rig, const PatternPlan& plan) {
  const auto* projector = std::get_if<PinholeModel>(&rig.projector.model);
  require(projector != nullptr,
          "the rig's projector is angular, but a board calibrates a digital projector only");
  PatternPlan columns = plan;
  columns.direction = FringeDirection::Vertical;
  std::vector<Pattern> patterns = default_patterns(rig, columns);
  const double ratio = static_cast<double>(projector->height_px) / projector->width_px;
  for (std::size_t i = 0, count = patterns.size(); i < count; ++i) {
    Pattern across = patterns[i];
    if (across.kind != PatternKind::Fringe && across.kind != PatternKind::Gray) continue;
    patterns[i].name = fmt::format("columns-{}", i);
    across.name = fmt::format("rows-{}", i);
    across.direction = FringeDirection::Horizontal;
    across.period_px *= ratio;
    across.stripe_px *= ratio;
    across.offset_px *= ratio;
    patterns.push_back(across);
  }
  patterns.push_back({.name = "white", .kind = PatternKind::White});
  return patterns;
}

}  // namespace frangia
