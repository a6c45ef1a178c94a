#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>

#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#include "frangia/core/angles.h"
#include "frangia/phase/published_algorithms.h"
#include "frangia/phase/unwrap_in_space.h"
#include "frangia/phase/wrap_phase.h"

#include "support/benchmark_scene.h"

namespace frangia {
namespace {

/// All figures are of one core.
const tbb::global_control& one_core() {
  static const tbb::global_control control(tbb::global_control::max_allowed_parallelism, 1);
  return control;
}

void per_pixel(benchmark::State& state, double pixels) {
  state.counters["ns_per_px"] = benchmark::Counter(
      pixels * 1e-9, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

template <typename T>
void write_raw(const std::filesystem::path& path, const Image<T>& image) {
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(image.pixels().data()),  // NOLINT: bytes of pixels
             static_cast<std::streamsize>(image.pixels().size() * sizeof(T)));
}

/// For tools/bench_peers.py: frames, wrapped, unwrapped and true phase as raw files in the folder
/// that FRANGIA_BENCH_DATA names.
void write_for_peers(const FrameStack& stack, const WrappedPhase& wrapped) {
  const char* folder = std::getenv("FRANGIA_BENCH_DATA");
  if (folder == nullptr) return;
  const std::filesystem::path path(folder);
  const int side = wrapped.phase_rad.width();
  for (std::size_t k = 0; k < stack.frames.size(); ++k) {
    write_raw(path / ("frame-" + std::to_string(k) + ".u8"),
              std::get<Image<std::uint8_t>>(stack.frames[k]));
  }
  write_raw(path / "wrapped.f32", wrapped.phase_rad);
  const RelativePhase unwrapped = unwrap_in_space(wrapped);
  write_raw(path / "unwrapped.f32", unwrapped.phase_rad);
  write_raw(path / "region.i32", unwrapped.region);
  Image<float> truth(side, side);
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x)
      truth(x, y) =
          static_cast<float>(testing::benchmark_phase((x + 0.5) / side, (y + 0.5) / side));
  }
  write_raw(path / "truth.f32", truth);
}

void decode(benchmark::State& state, const char* name) {
  static_cast<void>(one_core());
  const auto side = static_cast<int>(std::sqrt(static_cast<double>(state.range(0)) * 1e6));
  const FrameStack stack = testing::benchmark_frames(side, side);
  const PhaseAlgorithm algorithm = make_algorithm(name, stack.pattern.shifts_rad);
  WrappedPhase map = wrap_phase(stack, algorithm, {0.5, 0.02});
  for (auto iteration : state) {
    static_cast<void>(iteration);
    map = wrap_phase(stack, algorithm, {0.5, 0.02}, {}, std::move(map));  // as from view to view
  }
  per_pixel(state, static_cast<double>(side) * side);
}
BENCHMARK_CAPTURE(decode, schwider, "schwider")
    ->Arg(1)
    ->Arg(5)
    ->Arg(20)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(decode, carre, "carre")->Arg(20)->Unit(benchmark::kMillisecond);

void unwrap_space(benchmark::State& state) {
  static_cast<void>(one_core());
  const auto side = static_cast<int>(std::sqrt(static_cast<double>(state.range(0)) * 1e6));
  const FrameStack stack = testing::benchmark_frames(side, side);
  const WrappedPhase wrapped =
      wrap_phase(stack, make_algorithm("schwider", stack.pattern.shifts_rad), {0.5, 0.02});
  if (state.range(0) == 20) write_for_peers(stack, wrapped);
  for (auto iteration : state) {
    static_cast<void>(iteration);
    state.PauseTiming();
    WrappedPhase copy = wrapped;
    state.ResumeTiming();
    benchmark::DoNotOptimize(unwrap_in_space(std::move(copy)));
  }
  per_pixel(state, static_cast<double>(side) * side);
}
BENCHMARK(unwrap_space)->Arg(1)->Arg(5)->Arg(20)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace frangia
