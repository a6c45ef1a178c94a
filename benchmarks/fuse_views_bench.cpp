#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <tuple>
#include <vector>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/files/ply.h"
#include "frangia/fusion/fuse_views.h"

#include "performance_target.h"
#include "support/analytic_views.h"

namespace frangia {
namespace {

constexpr double kDistance_mm = 650.0;

/// A sphere with bumps, observed from all sides: noise 0.02 mm, pixel spacing 120 mm / size.
/// source   the plot in docs/surface.md
struct Sphere {
  int size_px = 0;
  int views = 12;
  double radius_mm = 50.0;

  [[nodiscard]] CameraModel model() const {
    return testing::small_camera_model(size_px, 5.0 * size_px);
  }
  /// Voxels are two pixels wide.
  [[nodiscard]] double voxel_mm() const { return 240.0 / size_px; }
};

const ViewStore& views_of(const Sphere& sphere) {
  static std::map<std::tuple<int, int, double>, ViewStore> made;
  const std::tuple key{sphere.size_px, sphere.views, sphere.radius_mm};
  auto found = made.find(key);
  if (found == made.end()) {
    const auto shape = [&](const Eigen::Vector3d& p) {
      const double away = p.norm() - sphere.radius_mm;
      if (away > 3.0) return 0.6 * (away - 1.5);
      const double bumps = std::sin(0.25 * p.x()) * std::sin(0.25 * p.y()) * std::sin(0.25 * p.z());
      return 0.6 * (away - 1.5 * bumps);  // a lower bound of the distance, for sphere tracing
    };
    found =
        made.emplace(key,
                     testing::snapshots(
                         shape, sphere.model(), testing::all_around(sphere.views, kDistance_mm)))
            .first;
  }
  return found->second;
}

/// Returns a view as a range map: its points, and triangles between neighbours.
Mesh range_map(const View& view, const CameraModel& model) {
  constexpr float kLongest_mm = 1.0F;
  const Image<Eigen::Vector2f> rays = rays_of(model);
  const Eigen::Isometry3f object_from_rig = view.rig_from_object.inverse().cast<float>();
  const Image<float>& depth = view.range.depth_mm;
  Mesh mesh;
  Image<std::uint32_t> number(depth.width(), depth.height(), 0);
  for (int y = 0; y < depth.height(); ++y) {
    for (int x = 0; x < depth.width(); ++x) {
      if (!(depth(x, y) > 0.0F)) continue;
      mesh.vertices_mm.emplace_back(object_from_rig * (depth(x, y) * rays(x, y).homogeneous()));
      number(x, y) = static_cast<std::uint32_t>(mesh.vertices_mm.size());
    }
  }
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    if (a == 0 || b == 0 || c == 0) return;
    const auto length = [&](std::uint32_t from, std::uint32_t to) {
      return (mesh.vertices_mm[from - 1] - mesh.vertices_mm[to - 1]).norm();
    };
    if (std::max({length(a, b), length(b, c), length(c, a)}) < kLongest_mm)
      mesh.triangles.push_back({a - 1, b - 1, c - 1});
  };
  for (int y = 0; y + 1 < depth.height(); ++y) {
    for (int x = 0; x + 1 < depth.width(); ++x) {
      add(number(x, y), number(x, y + 1), number(x + 1, y));
      add(number(x + 1, y), number(x, y + 1), number(x + 1, y + 1));
    }
  }
  return mesh;
}

/// Keeps the range maps for tools/bench_merging.py, which passes them to MeshLab.
void keep_range_maps(const Sphere& sphere) {
  const char* folder = std::getenv("FRANGIA_BENCH_DATA");  // NOLINT(concurrency-mt-unsafe)
  if (folder == nullptr) return;
  const ViewStore& views = views_of(sphere);
  for (std::size_t i = 0; i < views.size(); ++i) {
    const auto path = std::filesystem::path(folder) / fmt::format("range-{:02}.ply", i);
    if (!std::filesystem::exists(path)) write_ply(path, range_map(views.load(i), sphere.model()));
  }
}

/// Fuses all views; the rate is in pixels per second.
void fuse(benchmark::State& state, const Sphere& sphere) {
  const ViewStore& views = views_of(sphere);
  const CameraModel model = sphere.model();
  std::size_t triangles = 0;
  std::vector<double> times_s;
  for (auto iteration : state) {
    static_cast<void>(iteration);
    const Stopwatch watch;
    triangles = fuse_views(views, model, {.voxel_mm = sphere.voxel_mm()}).triangles.size();
    times_s.push_back(watch.seconds());
  }
  const double least_s = *std::min_element(times_s.begin(), times_s.end());
  state.counters["triangles"] = static_cast<double>(triangles);
  state.counters["first_s"] = times_s[0];  // touches its memory for the first time
  state.counters["least_s"] = least_s;
  state.SetItemsProcessed(state.iterations() * sphere.views * sphere.size_px * sphere.size_px);
  if (sphere.size_px != 1200) return;
  PerformanceTarget target;
  target.at_most("a mesh at 0.2 mm, shortest time", least_s, 2.7, "s");
  target.label(state);
}

void fuse_twelve_views(benchmark::State& state) {
  const Sphere sphere{static_cast<int>(state.range(0))};
  fuse(state, sphere);
  if (sphere.size_px == 1200) keep_range_maps(sphere);
}
BENCHMARK(fuse_twelve_views)
    ->Arg(300)
    ->Arg(600)
    ->Arg(1200)
    ->Iterations(7)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

void fuse_by_views(benchmark::State& state) {
  fuse(state, {600, static_cast<int>(state.range(0))});
}
BENCHMARK(fuse_by_views)
    ->Arg(6)
    ->Arg(12)
    ->Arg(24)
    ->Arg(36)
    ->Arg(48)
    ->Iterations(3)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

/// By radius; the area grows with its square.
void fuse_by_radius(benchmark::State& state) {
  fuse(state, {600, 12, static_cast<double>(state.range(0))});
}
BENCHMARK(fuse_by_radius)
    ->Arg(15)
    ->Arg(25)
    ->Arg(35)
    ->Arg(45)
    ->Arg(55)
    ->Iterations(3)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
}  // namespace frangia
