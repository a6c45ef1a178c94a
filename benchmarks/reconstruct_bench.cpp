// The whole chain, from PNG files to a mesh, beside the time that reading its PNGs takes on one
// core.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <vector>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "frangia/core/angles.h"
#include "frangia/core/parallel.h"
#include "frangia/core/random.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/frames/png.h"
#include "frangia/reconstruct/reconstruct.h"
#include "frangia/simulate/default_patterns.h"
#include "frangia/simulate/parts.h"
#include "frangia/simulate/rig_presets.h"
#include "frangia/simulate/simulate_scan.h"

#include "performance_target.h"

namespace frangia {
namespace {

constexpr int kViews = 8;

/// Processor time of all threads of this program, in seconds.
double processor_s() {
  timespec now{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// The folder of benchmark data: `FRANGIA_BENCH_DATA`, which `./run bench` sets, or the system's
/// temporary folder.
std::filesystem::path data_folder() {
  const char* const folder = std::getenv("FRANGIA_BENCH_DATA");  // NOLINT(concurrency-mt-unsafe)
  return folder != nullptr ? std::filesystem::path(folder) : std::filesystem::temp_directory_path();
}

/// Adds what a real camera has in its unlit pixels, too, and what PNG files cannot compress: a
/// black level of 6 counts and noise of 1 count.
void add_black_level(const std::filesystem::path& path, std::uint64_t seed) {
  constexpr double kBlackLevel_counts = 6.0;
  constexpr double kNoise_counts = 1.0;
  constexpr std::size_t kNoiseSamples = 1U << 16U;
  std::vector<float> noise_counts(kNoiseSamples);
  for (std::size_t i = 0; i < kNoiseSamples; ++i) {
    const double normal = normal_from(hash(seed, i));
    noise_counts[i] = static_cast<float>(kBlackLevel_counts + kNoise_counts * normal);
  }
  Frame frame = read_png(path);
  const auto pixels = std::get<Image<std::uint8_t>>(frame).pixels();
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const float noise = noise_counts[hash(seed + 1, i) % kNoiseSamples];
    const long counts = std::lround(static_cast<float>(pixels[i]) + noise);
    pixels[i] = static_cast<std::uint8_t>(std::clamp(counts, 0L, 255L));
  }
  write_png(path, frame);
}

/// How much of the field of the camera the part fills.
struct Framing {
  const char* folder;  ///< of the scan, in that of the data
  double focal_px;     ///< the longer, the larger the part
};
constexpr Framing kTypical{"chain-scan", 4800.0};
constexpr Framing kFilled{"filled-scan", 7300.0};  // the bust reaches all borders

/// Eight views of 5 Mpx with twelve frames each, rendered when the folder does not hold them yet.
Scan large_scan(const Framing& framing) {
  const std::filesystem::path folder = data_folder() / framing.folder;
  if (std::filesystem::exists(folder / "scan.toml")) return read_scan(folder);
  Scan plan;
  plan.folder = folder;
  plan.name = "bust";
  plan.rig = rig_preset("digital");
  plan.rig.reference().model = {.width_px = 2560,
                                .height_px = 2048,
                                .focal_px = {framing.focal_px, framing.focal_px},
                                .principal_point_px = {1308.7, 1007.1},
                                .distortion = {-0.09, 0.05, 4e-4, -3e-4, 0.0}};
  plan.patterns = default_patterns(plan.rig);
  for (int i = 0; i < kViews; ++i)
    plan.views.push_back({kTwoPi * i / kViews, fmt::format("views/{:03}", i), 0});
  Scan scan = simulate_scan(make_part("bust"), plan);
  const std::filesystem::path unfinished = folder / "simulation-not-finished";
  std::filesystem::rename(folder / "scan.toml", unfinished);
  std::vector<std::filesystem::path> frames;
  for (const ScanView& view : scan.views) {
    for (const auto& entry : std::filesystem::directory_iterator(folder / view.folder))
      frames.push_back(entry.path());
  }
  std::sort(frames.begin(), frames.end());
  parallel_chunks(
      frames.size(), 1, [&](std::size_t i, std::size_t) { add_black_level(frames[i], i); });
  std::filesystem::rename(unfinished, folder / "scan.toml");
  return scan;
}

/// Reads every frame of a scan on the calling thread; the seconds that takes.
double read_pngs_s(const Scan& scan) {
  const Stopwatch watch;
  for (const ScanView& view : scan.views) {
    for (const Pattern& pattern : scan.patterns) {
      for (int frame = 0; frame < pattern.frame_count(); ++frame)
        benchmark::DoNotOptimize(
            read_png(scan.folder / view.folder / frame_file_name(pattern, frame)));
    }
  }
  return watch.seconds();
}

/// Each repeat times the reading and the chain one after the other, so that both meet the same load
/// of the machine; the ratio is that of the shortest times. `processor_ratio` compares processor
/// times, which depend less on the load of the machine; `busy_cores` are the cores that the chain
/// kept busy.
void measure_chain(benchmark::State& state, const Framing& framing, double most_ratio) {
  const Scan scan = large_scan(framing);
  double read_s = 1e9;
  double read_processor_s = 1e9;
  double chain_s = 1e9;
  double chain_processor_s = 1e9;
  std::size_t triangles = 0;
  for (auto iteration : state) {
    static_cast<void>(iteration);
    state.PauseTiming();
    const double processor_before_reading_s = processor_s();
    read_s = std::min(read_s, read_pngs_s(scan));
    read_processor_s = std::min(read_processor_s, processor_s() - processor_before_reading_s);
    state.ResumeTiming();
    const double processor_before_s = processor_s();
    const Stopwatch watch;
    triangles = reconstruct(scan).mesh.triangles.size();
    chain_s = std::min(chain_s, watch.seconds());
    chain_processor_s = std::min(chain_processor_s, processor_s() - processor_before_s);
  }
  state.counters["triangles"] = static_cast<double>(triangles);
  state.counters["read_one_core_s"] = read_s;
  state.counters["chain_s"] = chain_s;
  state.counters["read_processor_s"] = read_processor_s;
  state.counters["chain_processor_s"] = chain_processor_s;
  state.counters["busy_cores"] = chain_processor_s / chain_s;
  state.counters["processor_ratio"] = chain_processor_s / read_processor_s;
  state.counters["ratio"] = chain_s / read_s;
  PerformanceTarget target;
  target.at_most("chain over reading its PNGs on one core", chain_s / read_s, most_ratio, "x");
  target.label(state);
}

void reconstruct_scan(benchmark::State& state) {
  measure_chain(state, kTypical, 2.3);
}
void reconstruct_filled_scan(benchmark::State& state) {
  measure_chain(state, kFilled, 2.4);
}
BENCHMARK(reconstruct_scan)->Unit(benchmark::kSecond)->Iterations(3)->UseRealTime();
BENCHMARK(reconstruct_filled_scan)->Unit(benchmark::kSecond)->Iterations(3)->UseRealTime();

}  // namespace
}  // namespace frangia
