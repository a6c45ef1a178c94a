#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#include "frangia/core/angles.h"
#include "frangia/core/pixel_buffer.h"
#include "frangia/pattern/fringe_sequence.h"
#include "frangia/phase/algorithm/published_algorithms.h"
#include "frangia/phase/spatial/unwrap_spatially.h"
#include "frangia/phase/wrap/decode_sequence.h"
#include "frangia/phase/wrap/wrap_phase.h"

#include "support/benchmark_scene.h"

namespace frangia {
namespace {

/// All figures are for one core.
const tbb::global_control& one_core() {
  static const tbb::global_control control(tbb::global_control::max_allowed_parallelism, 1);
  return control;
}

void per_pixel(benchmark::State& state, double pixels) {
  state.counters["ns_per_px"] = benchmark::Counter(
      pixels * 1e-9, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

/// Side of a square image of some megapixels, in multiples of 100: OpenCV's decoder accepts only
/// sizes that are products of small primes.
int side_of(std::int64_t megapixels) {
  return 100 * static_cast<int>(std::ceil(10.0 * std::sqrt(static_cast<double>(megapixels))));
}

template <typename T>
void write_raw(const std::filesystem::path& path, const Image<T>& image) {
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(image.pixels().data()),  // NOLINT: bytes of pixels
             static_cast<std::streamsize>(image.pixels().size() * sizeof(T)));
}

/// Writes frames, wrapped, unwrapped and true phase for tools/bench_peers.py, as raw files in the
/// folder that FRANGIA_BENCH_DATA names.
void write_for_peers(const FrameStack& stack, const WrappedPhase& wrapped) {
  const char* folder = std::getenv("FRANGIA_BENCH_DATA");  // NOLINT(concurrency-mt-unsafe)
  if (folder == nullptr) return;
  const std::filesystem::path path(folder);
  const int side = wrapped.phase_rad.width();
  for (std::size_t k = 0; k < stack.frames.size(); ++k) {
    write_raw(path / ("frame-" + std::to_string(k) + ".u8"),
              std::get<Image<std::uint8_t>>(stack.frames[k]));
  }
  write_raw(path / "wrapped.f32", wrapped.phase_rad);
  const RelativePhase unwrapped = unwrap_spatially(wrapped);
  write_raw(path / "unwrapped.f32", unwrapped.phase_rad);
  write_raw(path / "region.i32", unwrapped.region);
  Image<float> truth(side, side);
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      truth(x, y) =
          static_cast<float>(testing::benchmark_phase((x + 0.5) / side, (y + 0.5) / side));
    }
  }
  write_raw(path / "truth.f32", truth);
}

void decode(benchmark::State& state, const char* name) {
  static_cast<void>(one_core());
  const int side = side_of(state.range(0));
  const FrameStack stack = testing::benchmark_frames(side, side);
  const PhaseAlgorithm algorithm = make_algorithm(name, stack.pattern.shifts_rad);
  WrappedPhase map = wrap_phase(stack, algorithm, testing::kBenchmarkNoise);
  for (auto iteration : state) {
    static_cast<void>(iteration);
    map = wrap_phase(stack,
                     algorithm,
                     testing::kBenchmarkNoise,
                     {},
                     std::move(map));  // reuses the map, as in a loop over views
  }
  per_pixel(state, static_cast<double>(side) * side);
}
BENCHMARK_CAPTURE(decode, schwider, "schwider")
    ->Arg(1)
    ->Arg(5)
    ->Arg(20)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(decode, carre, "carre")->Arg(20)->Unit(benchmark::kMillisecond);

/// Decoding into memory that is touched for the first time, as in a single call.
void decode_cold(benchmark::State& state, const char* name) {
  static_cast<void>(one_core());
  const int side = side_of(state.range(0));
  const FrameStack stack = testing::benchmark_frames(side, side);
  const PhaseAlgorithm algorithm = make_algorithm(name, stack.pattern.shifts_rad);
  for (auto iteration : state) {
    static_cast<void>(iteration);
    WrappedPhase map = wrap_phase(stack, algorithm, testing::kBenchmarkNoise);
    state.PauseTiming();
    map = {};
    release_cached_pixels();
    state.ResumeTiming();
  }
  per_pixel(state, static_cast<double>(side) * side);
}
BENCHMARK_CAPTURE(decode_cold, schwider, "schwider")->Arg(20)->Unit(benchmark::kMillisecond);

/// Frames of a map of `fringes` over a display as wide as the image. Bands of identical rows save
/// time.
FrameStack sequence_frames(int side, double fringes) {
  FrameStack band = testing::benchmark_frames(
      side, side / 10, [&](double u, double /*v*/) { return kTwoPi * fringes * u; });
  band.pattern = {
      .name = "map", .period_px = side / fringes, .shifts_rad = band.pattern.shifts_rad};
  for (Frame& frame : band.frames) {
    const auto& rows = std::get<Image<std::uint8_t>>(frame).pixels();
    Image<std::uint8_t> whole(side, side, Uninitialized{});
    for (std::size_t i = 0; i < 10; ++i) {
      std::copy(rows.begin(),
                rows.end(),
                whole.pixels().begin() + static_cast<std::ptrdiff_t>(i) * std::ssize(rows));
    }
    frame = std::move(whole);
  }
  return band;
}

/// Decodes seven maps of four frames to absolute phase in one pass.
void decode_maps(benchmark::State& state, const char* name) {
  static_cast<void>(one_core());
  const int side = side_of(state.range(0));
  Projector display;
  display.model = PinholeModel{.width_px = side, .height_px = side, .focal_px = {1.0, 1.0}};
  std::vector<FrameStack> stacks;
  for (const double fringes : fringe_sequence(name, 64.0))
    stacks.push_back(sequence_frames(side, fringes));
  std::vector<SequenceFrames> maps;
  maps.reserve(stacks.size());
  for (const FrameStack& stack : stacks)
    maps.push_back({&stack, least_squares(stack.pattern.shifts_rad)});
  AbsolutePhase phase = decode_sequence(maps, testing::kBenchmarkNoise, display);
  for (auto iteration : state) {
    static_cast<void>(iteration);
    phase = decode_sequence(maps, testing::kBenchmarkNoise, display, {}, std::move(phase));
  }
  state.counters["maps"] = static_cast<double>(maps.size());
  state.counters["measured"] =
      static_cast<double>(std::count(
          phase.status.pixels().begin(), phase.status.pixels().end(), PixelStatus::Measured)) /
      static_cast<double>(phase.status.pixels().size());
  per_pixel(state, static_cast<double>(side) * side);
}
BENCHMARK_CAPTURE(decode_maps, doubling, "doubling")
    ->Arg(1)
    ->Arg(5)
    ->Arg(20)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(decode_maps, negative_exponential, "negative-exponential")
    ->Arg(20)
    ->Unit(benchmark::kMillisecond);

void unwrap_space(benchmark::State& state) {
  static_cast<void>(one_core());
  const int side = side_of(state.range(0));
  const FrameStack stack = testing::benchmark_frames(side, side);
  const WrappedPhase wrapped = wrap_phase(
      stack, make_algorithm("schwider", stack.pattern.shifts_rad), testing::kBenchmarkNoise);
  if (state.range(0) == 20) write_for_peers(stack, wrapped);
  for (auto iteration : state) {
    static_cast<void>(iteration);
    state.PauseTiming();
    WrappedPhase copy = wrapped;
    state.ResumeTiming();
    benchmark::DoNotOptimize(unwrap_spatially(std::move(copy)));
  }
  per_pixel(state, static_cast<double>(side) * side);
}
BENCHMARK(unwrap_space)->Arg(1)->Arg(5)->Arg(20)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace frangia
