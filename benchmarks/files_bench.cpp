#include <algorithm>
#include <filesystem>
#include <string>

#include <benchmark/benchmark.h>
#include <unistd.h>

#include "frangia/files/read_mesh.h"
#include "frangia/files/write_mesh.h"

#include "files/sample_meshes.h"
#include "performance_target.h"

namespace frangia {
namespace {

constexpr std::uint32_t kSide = 708;  // a million triangles

std::filesystem::path scratch(const std::string& extension) {
  const std::string name = "frangia-bench-" + std::to_string(::getpid()) + extension;
  return std::filesystem::temp_directory_path() / name;
}

/// Writes a million triangles; the rate is triangles per second. `wanted_s` is the time limit; 0:
/// none.
void write_million(benchmark::State& state,
                   const std::string& extension,
                   DxfVariant variant,
                   double wanted_s) {
  const Mesh mesh = testing::measured_sheet(kSide);
  const auto path = scratch(extension);
  double best_s = 1e9;
  for (auto iteration : state) {
    static_cast<void>(iteration);
    const Stopwatch watch;
    write_mesh(path, mesh, {.dxf = {variant}});
    best_s = std::min(best_s, watch.seconds());
  }
  state.SetItemsProcessed(state.iterations() * std::ssize(mesh.triangles));
  if (wanted_s > 0.0) {
    PerformanceTarget target;
    target.at_most("time", best_s, wanted_s, "s");
    target.label(state);
  }
  state.counters["bytes"] = static_cast<double>(std::filesystem::file_size(path));
  std::filesystem::remove(path);
}
BENCHMARK_CAPTURE(write_million, dxf_faces, ".dxf", DxfVariant::Faces, 2.5)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(write_million, dxf_polyface, ".dxf", DxfVariant::Polyface, 1.0)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(write_million, stl, ".stl", DxfVariant::Faces, 0.0)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(write_million, ply, ".ply", DxfVariant::Faces, 0.0)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(write_million, obj, ".obj", DxfVariant::Faces, 0.0)
    ->Unit(benchmark::kMillisecond);

/// Reads a million triangles.
void read_million(benchmark::State& state, const std::string& extension) {
  const Mesh mesh = testing::measured_sheet(kSide);
  const auto path = scratch(extension);
  write_mesh(path, mesh);
  for (auto iteration : state) {
    static_cast<void>(iteration);
    benchmark::DoNotOptimize(read_mesh(path));
  }
  state.SetItemsProcessed(state.iterations() * std::ssize(mesh.triangles));
  std::filesystem::remove(path);
}
BENCHMARK_CAPTURE(read_million, stl, ".stl")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(read_million, ply, ".ply")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(read_million, obj, ".obj")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace frangia
