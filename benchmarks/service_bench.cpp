// The live preview of the operator's app: from the frames of a recorded set to points, and to the
// message that a browser receives. Rendering and reading of frames are left out.

#include <ctime>
#include <filesystem>
#include <memory>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>

#include "frangia/dataset/read_frames.h"
#include "frangia/rig/read_rig.h"
#include "frangia/service/example_rigs.h"
#include "frangia/service/live_preview.h"
#include "frangia/simulate/parts.h"
#include "frangia/simulate/simulate_scan.h"

#include "performance_target.h"
#include "support/temporary_folder.h"

namespace frangia {
namespace {

/// One view of the app's simulated rig.
struct RecordedSet {
  Rig rig;
  std::vector<FrameStack> stacks;
  Image<Eigen::Vector2f> rays;
  LiveSettings settings;
};

/// The rig that "Try the simulated rig" writes, with a camera of another width and shape.
Rig app_rig(const std::filesystem::path& folder, int width_px, int height_px) {
  write_simulated_rig(folder / "rig.toml", "bust");
  Rig rig = read_rig(folder / "rig.toml");
  CameraModel& model = rig.reference().model;
  const double scale = static_cast<double>(width_px) / model.width_px;
  model.width_px = width_px;
  model.height_px = height_px;
  model.focal_px *= scale;
  model.principal_point_px = (model.principal_point_px.array() + 0.5) * scale - 0.5;
  return rig;
}

RecordedSet record(int width_px, int height_px, bool finest_alone) {
  const testing::TemporaryFolder folder;
  RecordedSet set;
  set.rig = app_rig(folder.path(), width_px, height_px);
  set.rays = rays_of(set.rig.reference().model);
  std::vector<Pattern> patterns = patterns_of(set.settings.capture, set.rig);
  if (finest_alone) patterns = {patterns.back()};
  Scan plan;
  plan.folder = folder.path() / "scan";
  plan.rig = set.rig;
  plan.patterns = patterns;
  plan.views = {{0.0, "views/000"}};
  const Scan scan = simulate_scan(make_part("bust"), plan);
  set.stacks = read_frames(scan, 0);
  return set;
}

/// Processor time of all threads of this program, in seconds.
double processor_s() {
  timespec now{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// A frame of the newest set replaces its predecessor, is decoded and packed as the preview does
/// it.
void preview(benchmark::State& state, const RecordedSet& set, double wanted_per_s) {
  LiveSnapshot snapshot;
  snapshot.frame = std::make_shared<const Frame>(set.stacks.back().frames.back());
  std::size_t points = 0;
  const double processor_before_s = processor_s();
  const Stopwatch all;
  for ([[maybe_unused]] auto _ : state) {
    auto decode =
        std::make_shared<LiveDecode>(decode_live(set.stacks, set.rig, set.rays, set.settings));
    points = decode->points;
    snapshot.decode = std::move(decode);
    benchmark::DoNotOptimize(encode_live(snapshot, LiveLayer::Depth, set.rig));
  }
  const auto previews = static_cast<double>(state.iterations());
  const double spent_ms = 1e3 * all.seconds() / previews;
  // Depends less on what else loads the machine.
  state.counters["processor_ms"] = 1e3 * (processor_s() - processor_before_s) / previews;
  PerformanceTarget target;
  target.at_most("frame to message", spent_ms, 1e3 / wanted_per_s, "ms");
  target.label(state);
  state.counters["previews_per_s"] = 1e3 / spent_ms;
  state.counters["points"] = static_cast<double>(points);
}

void preview_simulated_rig(benchmark::State& state) {
  static const RecordedSet set = record(640, 512, false);
  preview(state, set, 5.0);
}
BENCHMARK(preview_simulated_rig)->Unit(benchmark::kMillisecond)->UseRealTime();

void preview_four_frames_1_3_mpx(benchmark::State& state) {
  static const RecordedSet set = record(1280, 1024, true);
  preview(state, set, 8.0);
}
BENCHMARK(preview_four_frames_1_3_mpx)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace frangia
