#include <cmath>
#include <cstdint>

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
