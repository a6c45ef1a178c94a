#include "frangia/simulate/internal/simulated_bench.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "frangia/core/angles.h"
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

const Image<float>& lit(const Image<float>& picture) {
  static const Image<float> kDark(2, 2, 0.0F);
  return picture.empty() ? kDark : picture;
}

/// The pictures that are on the screen during an exposure; the one that most of it sees is the
/// picture.
void add_pictures(const SimulatedBench& bench, Shot& shot) {
  const double begin_s = bench.clock_s;
  const double end_s = begin_s + 1e-3 * bench.camera.exposure_ms;
  double most = 0.0;
  for (std::size_t i = 0; i < bench.pictures.size(); ++i) {
    const TimedPicture& one = bench.pictures[i];
    const double from_s = i == 0 ? begin_s : std::max(begin_s, one.from_s);
    const double to_s =
        i + 1 < bench.pictures.size() ? std::min(end_s, bench.pictures[i + 1].from_s) : end_s;
    const double share = std::max(0.0, to_s - from_s) / (end_s - begin_s);
    if (share == 0.0) continue;
    shot.before.emplace_back(&lit(one.picture), share);
    if (share <= most) continue;
    most = share;
    shot.picture = &lit(one.picture);
    shot.projector = one.picture.empty() ? 0.0 : 1.0;
  }
  if (shot.before.size() > 1) shot.projector = 1.0;
  std::erase_if(shot.before, [&](const auto& one) { return one.first == shot.picture; });
}

/// Light of the room during an exposure, over its mean: that of a lamp that flickers with twice
/// the frequency of the mains.
double room_light(const SimulatedBench& bench) {
  if (bench.mains_hz == 0.0) return 1.0;
  const double exposure_s = 1e-3 * bench.camera.exposure_ms;
  const double half = kTwoPi * bench.mains_hz * exposure_s;
  const double middle_s = bench.clock_s + 0.5 * exposure_s;
  return 1.0 + bench.room_flicker * std::sin(half) / half *
                   std::cos(2.0 * kTwoPi * bench.mains_hz * middle_s);
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
  if (digital) add_pictures(bench, shot);
  if (!bench.line_light && !bench.fringe_light) shot.projector = 0.0;
  if (bench.line_light) shot.projector = 1.0;
  shot.lamp = bench.scene->options.ambient * (room_light(bench) - 1.0);
  shot.light = faults.light * bench.camera.exposure_ms / bench.reference_exposure_ms;
  shot.gain = std::pow(10.0, bench.camera.gain_db / 20.0);
  shot.black_counts = bench.camera.black_level_counts;
  shot.clips_at_counts = bench.clips_at_counts;
  return shot;
}

}  // namespace

/// The light of one pose of the part.
struct BenchCamera::Light {
  Light(const SimulatedBench& bench, int view_of)
      : scene(bench.scene),
        table_rad(bench.table_rad),
        projector_mm(scene->rig.projector.position_mm),
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
  Eigen::Vector3d projector_mm;  ///< which moves while it warms up
  int view;
  ViewRenderer renderer;
  std::vector<LitRow> rows;
};

Frame BenchCamera::capture(const SimulatedBench& bench,
                           const FrameLabel& label,
                           const FrameFaults& faults) {
  const bool same = light_ && light_->scene == bench.scene && light_->view == label.view &&
                    light_->table_rad == bench.table_rad &&
                    light_->projector_mm == bench.scene->rig.projector.position_mm;
  if (!same) {
    light_.reset();  // frees the large cache before the next one is made
    light_ = std::make_shared<Light>(bench, label.view);
  }
  const std::vector<Shot> shots{shot_of(bench, label, faults)};
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
