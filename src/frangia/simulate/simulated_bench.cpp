#include "frangia/simulate/simulated_bench.h"

#include <cmath>
#include <utility>

#include "frangia/core/parallel.h"
#include "frangia/core/random.h"
#include "frangia/simulate/view_renderer.h"

namespace frangia {
namespace {

/// What lights the bench at this moment, as a pattern of one frame, and how much of it is on.
struct Shown {
  Pattern pattern;
  double shift_rad = 0.0;
  double share = 1.0;
};

Shown shown_on(const SimulatedBench& bench, const FrameId& id) {
  Shown shown;
  if (bench.scene->rig.projector.is_angular()) {
    if (bench.line_light) {
      shown.pattern.kind = PatternKind::Line;
      return shown;
    }
    shown.pattern.fringes_per_degree = bench.fringes_per_degree;
    shown.pattern.shifts_rad = {0.0};
    shown.shift_rad =
        bench.piezo_rad.value_or(0.0) + bench.drift_rad_per_view * static_cast<double>(id.view);
    shown.share = bench.fringe_light ? 1.0 : 0.0;
    return shown;
  }
  if (!bench.shown) {
    shown.pattern.period_px = 1.0;
    shown.pattern.shifts_rad = {0.0};
    shown.share = 0.0;
    return shown;
  }
  shown.pattern = *bench.shown;
  if (shown.pattern.kind == PatternKind::Fringe) {
    shown.shift_rad = shown.pattern.shifts_rad[static_cast<std::size_t>(bench.shown_frame)];
    shown.pattern.shifts_rad = {shown.shift_rad};
  }
  shown.share = bench.fringe_light ? 1.0 : 0.0;
  return shown;
}

Shot shot_of(const SimulatedBench& bench,
             const Shown& shown,
             const FrameId& id,
             const FrameFaults& faults) {
  Shot shot;
  shot.stream = noise_stream(
      bench.scene->options.seed, id.view, id.pattern, static_cast<std::size_t>(id.frame));
  // A frame of a bracket, and one of a set that was retaken, has noise of its own.
  if (id.exposure > 0) shot.stream = hash(shot.stream, static_cast<std::uint64_t>(id.exposure));
  if (id.set_attempt > 0) {
    shot.stream = hash(shot.stream, 0x5E70U + static_cast<std::uint64_t>(id.set_attempt));
  }
  const double shift = shown.shift_rad + bench.jitter_rad * normal_from(hash(shot.stream, 1)) +
                       faults.motion_rad * normal_from(hash(shot.stream, 2));
  shot.cos_shift = std::cos(shift);
  shot.sin_shift = std::sin(shift);
  shot.projector = shown.share;
  shot.exposure = faults.light * bench.camera.exposure_ms / bench.reference_exposure_ms;
  shot.gain = std::pow(10.0, bench.camera.gain_db / 20.0);
  shot.black_counts = bench.camera.black_level_counts;
  return shot;
}

}  // namespace

/// The light that comes back from one pose of the part.
struct BenchCamera::Light {
  Light(std::shared_ptr<const SimulatedScene> scene_of, double table_rad, std::size_t view_index)
      : scene(std::move(scene_of)),
        angle_rad(table_rad),
        view(view_index),
        renderer(*scene, scene->rig.rig_from_object(table_rad), view_index),
        rows(static_cast<std::size_t>(scene->rays.height())) {
    parallel_rows(scene->rays.height(),
                  [&](int y) { rows[static_cast<std::size_t>(y)] = renderer.row_of_samples(y); });
  }

  std::shared_ptr<const SimulatedScene> scene;
  double angle_rad;
  std::size_t view;
  ViewRenderer renderer;
  std::vector<std::vector<LightSample>> rows;
};

Frame BenchCamera::expose(const SimulatedBench& bench,
                          const FrameId& id,
                          const FrameFaults& faults) {
  const bool same = light_ && light_->scene == bench.scene && light_->view == id.view &&
                    light_->angle_rad == bench.table_rad;
  if (!same) {
    light_.reset();  // before the new one: the light of one pose is large
    light_ = std::make_shared<Light>(bench.scene, bench.table_rad, id.view);
  }
  const Shown shown = shown_on(bench, id);
  const std::vector<Shot> shots{shot_of(bench, shown, id, faults)};
  const int width = bench.scene->rays.width();
  const int height = bench.scene->rays.height();
  FrameStack stack{shown.pattern, {}, bench.scene->known_rig.camera.white_level};
  const bool bytes = bench.scene->options.bits == 8;
  stack.frames.push_back(bytes ? Frame(Image<std::uint8_t>(width, height))
                               : Frame(Image<std::uint16_t>(width, height)));
  parallel_rows(height, [&](int y) {
    const auto& row = light_->rows[static_cast<std::size_t>(y)];
    if (bytes) {
      light_->renderer.fill_row<std::uint8_t>(y, row, shots, stack);
    } else {
      light_->renderer.fill_row<std::uint16_t>(y, row, shots, stack);
    }
  });
  return std::move(stack.frames.front());
}

}  // namespace frangia
