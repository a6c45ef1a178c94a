#include "frangia/calibrate/board/measure_light.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/core/parallel.h"
#include "frangia/decode/select_stacks.h"

namespace frangia {
namespace {

std::vector<FrameStack> coded_stacks(std::span<const FrameStack> stacks,
                                     FringeDirection direction) {
  std::vector<FrameStack> chosen;
  for (const FrameStack& stack : stacks) {
    const PatternKind kind = stack.pattern.kind;
    const bool coded = kind == PatternKind::Fringe || kind == PatternKind::Gray;
    if (coded && stack.pattern.direction == direction) chosen.push_back(stack);
  }
  return chosen;
}

/// Projector pixels, or nominal psi in rad, per rad of phase.
double light_per_rad(const Pattern& pattern) {
  const double unit = 1.0 / (kTwoPi * pattern.fringes_per_unit());
  return pattern.fringes_per_degree > 0.0 ? rad_from_deg(unit) : unit;
}

void add_direction(std::span<const FrameStack> all,
                   std::vector<FrameStack> stacks,
                   int axis,
                   const Rig& display,
                   const MeasureLightOptions& options,
                   const Run& run,
                   std::vector<LightSite>& sites) {
  const bool absolute = is_absolute(plan_decoding(patterns_of(stacks), display, options.decode));
  Image<Eigen::Vector2f> rays;
  if (!absolute && options.use_laser_line && display.laser_sheet) {
    stacks.assign(all.begin(), all.end());
    rays = rays_of(display.reference().model);
  } else if (!absolute) {
    throw Error(ErrorKind::Input,
                fmt::format("the {} fringes have no absolute phase, which calibration needs; add "
                            "coarser fringes, of which the coarsest has one period over the field",
                            axis == 0 ? "vertical" : "horizontal"));
  }
  DecodeOptions decode = options.decode;
  decode.keep_maps = false;
  decode.fill.max_px = 0;
  const AbsolutePhase decoded =
      decode_view(stacks, display, rays, decode, run).directions.front().phase;
  const double scale = light_per_rad(decoded.pattern);
  parallel_chunks(sites.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      LightSite& site = sites[i];
      const auto x = static_cast<int>(site.camera_px.x());
      const auto y = static_cast<int>(site.camera_px.y());
      if (std::isnan(decoded.phase_rad(x, y))) continue;
      const PhaseAt phase =
          fit_phase_at(decoded.phase_rad, decoded.sigma_rad, site.camera_px, options.fit);
      site.light[axis] = scale * phase.phase_rad;
      site.sigma[axis] = scale * phase.sigma_rad;
      site.by_camera.row(axis) = scale * phase.gradient_rad_per_px.transpose();
    }
  });
}

}  // namespace

std::vector<LightSite> measure_light(std::span<const FrameStack> stacks,
                                     const Rig& display,
                                     const MeasureLightOptions& options,
                                     const Run& run) {
  std::vector<LightSite> sites;
  const int half = options.step_px / 2;
  for (int y = half; y < display.reference().model.height_px; y += options.step_px) {
    for (int x = half; x < display.reference().model.width_px; x += options.step_px) {
      sites.emplace_back();
      sites.back().camera_px = Eigen::Vector2d(x, y);
    }
  }
  for (const FringeDirection direction : {FringeDirection::Vertical, FringeDirection::Horizontal}) {
    const std::vector<FrameStack> chosen = coded_stacks(stacks, direction);
    const int axis = direction == FringeDirection::Vertical ? 0 : 1;
    if (!chosen.empty()) add_direction(stacks, chosen, axis, display, options, run, sites);
  }
  return sites;
}

}  // namespace frangia
