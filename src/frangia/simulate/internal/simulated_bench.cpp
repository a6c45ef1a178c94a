#include "frangia/simulate/internal/simulated_bench.h"

#include <cmath>
#include <utility>

#include "frangia/core/parallel.h"
#include "frangia/core/random.h"

namespace frangia {
namespace {

/// The current illumination as a pattern of one frame.
Pattern pattern_on(const SimulatedBench& bench) {
  Pattern shown;
  shown.shifts_rad = {0.0};
  if (bench.line_light) shown.kind = PatternKind::Line;
  shown.fringes_per_degree = bench.fringes_per_degree;
  return shown;
}

Shot shot_of(const SimulatedBench& bench, const FrameLabel& label, const FrameFaults& faults) {
  Shot shot;
  std::uint64_t seed = noise_stream(bench.scene->options.seed,
                                    static_cast<std::size_t>(label.view),
                                    label.pattern,
                                    static_cast<std::size_t>(label.frame));
  if (label.attempt > 0) seed = hash(seed, 0x5E70U + static_cast<std::uint64_t>(label.attempt));
  // All exposures of a bracket share the piezo's position and have independent noise.
  const double shift = bench.piezo_rad + bench.drift_rad_per_view * label.view +
                       bench.jitter_rad * normal_from(hash(seed, 1)) +
                       faults.motion_rad * normal_from(hash(seed, 2));
  shot.stream = label.exposure > 0 ? hash(seed, static_cast<std::uint64_t>(label.exposure)) : seed;
  shot.cos_shift = std::cos(shift);
  shot.sin_shift = std::sin(shift);
  const bool digital = !bench.scene->rig.projector.is_angular();
  if (digital) shot.picture = &bench.picture;
  const bool is_on =
      bench.line_light || (bench.fringe_light && !(digital && bench.picture.empty()));
  shot.projector = is_on ? 1.0 : 0.0;
  shot.light = faults.light * bench.camera.exposure_ms / bench.reference_exposure_ms;
  shot.gain = std::pow(10.0, bench.camera.gain_db / 20.0);
  shot.black_counts = bench.camera.black_level_counts;
  return shot;
}

}  // namespace

/// The light of one pose of the part.
struct BenchCamera::Light {
  Light(const SimulatedBench& bench, int view_of)
      : scene(bench.scene),
        table_rad(bench.table_rad),
        view(view_of),
        renderer(*scene,
                 bench.rig_from_part(static_cast<std::size_t>(view)),
                 static_cast<std::size_t>(view)),
        rows(static_cast<std::size_t>(scene->rays.height())) {
    parallel_rows(scene->rays.height(),
                  [&](int y) { rows[static_cast<std::size_t>(y)] = renderer.sample_row(y); });
  }

  std::shared_ptr<const SimulatedScene> scene;
  double table_rad;
  int view;
  ViewRenderer renderer;
  std::vector<LitRow> rows;
};

Frame BenchCamera::capture(const SimulatedBench& bench,
                           const FrameLabel& label,
                           const FrameFaults& faults) {
  const bool same = light_ && light_->scene == bench.scene && light_->view == label.view &&
                    light_->table_rad == bench.table_rad;
  if (!same) {
    light_.reset();  // frees the large cache before the next one is made
    light_ = std::make_shared<Light>(bench, label.view);
  }
  std::vector<Shot> shots{shot_of(bench, label, faults)};
  static const Image<float> kDark(2, 2, 0.0F);
  if (shots.front().picture != nullptr && bench.picture.empty()) shots.front().picture = &kDark;
  const int width = bench.scene->rays.width();
  const int height = bench.scene->rays.height();
  FrameStack stack{pattern_on(bench), {}, bench.scene->known_rig.reference().white_level};
  const bool bytes = bench.scene->options.bits == 8;
  stack.frames.push_back(bytes ? Frame(Image<std::uint8_t>(width, height, Uninitialized{}))
                               : Frame(Image<std::uint16_t>(width, height, Uninitialized{})));
  parallel_rows(height, [&](int y) {
    const auto& row = light_->rows[static_cast<std::size_t>(y)];
    if (bytes) {
      light_->renderer.fill_row<std::uint8_t>(y, row, shots, stack);
    } else {
      light_->renderer.fill_row<std::uint16_t>(y, row, shots, stack);
    }
  });
  Frame frame = std::move(stack.frames.front());
  return frame;
}

}  // namespace frangia
