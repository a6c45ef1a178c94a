#include "frangia/rig/phase_range.h"

#include "frangia/core/angles.h"

namespace frangia {

PhaseRange phase_range(const Pattern& pattern, const Projector& projector) {
  if (const auto* angular = std::get_if<AngularModel>(&projector.model)) {
    const double rad_per_rad =
        kTwoPi * pattern.fringes_per_degree * deg_from_rad(1.0) / angular->pitch_scale;
    return {rad_per_rad * angular->field_min_rad, rad_per_rad * angular->field_max_rad};
  }
  const auto& pinhole = std::get<PinholeModel>(projector.model);
  const bool rows = pattern.direction == FringeDirection::Horizontal;
  const double size_px = rows ? pinhole.height_px : pinhole.width_px;
  const double rad_per_px = kTwoPi / pattern.period_px;
  return {-0.5 * rad_per_px, (size_px - 0.5) * rad_per_px};  // the centre of pixel k is at k
}

bool is_absolute(const Pattern& pattern, const Projector& projector) {
  return pattern.kind == PatternKind::Fringe &&
         phase_range(pattern, projector).width_rad() <= kTwoPi * (1.0 + 1e-9);
}

}  // namespace frangia
