#include <cmath>
#include <map>

#include <benchmark/benchmark.h>

#include "frangia/surface/paste_views.h"

#include "support/analytic_views.h"

namespace frangia {
namespace {

/// 12 views of a sphere of 50 mm with bumps, noise 0.02 mm, pixels 2.5 / size apart.
/// source   the data of the table in docs/surface.md
const ViewStore& bumpy_sphere(int size_px) {
  static std::map<int, ViewStore> made;
  auto found = made.find(size_px);
  if (found == made.end()) {
    const auto shape = [](const Eigen::Vector3d& p) {
      const double bumps = std::sin(0.25 * p.x()) * std::sin(0.25 * p.y()) * std::sin(0.25 * p.z());
      return 0.6 *
             (p.norm() - 50.0 - 1.5 * bumps);  // less than the distance, so as not to step over
    };
    found = made.emplace(size_px,
                         testing::snapshots(shape,
                                            testing::small_lens(size_px, 5.0 * size_px),
                                            testing::all_around(12, 650.0)))
                .first;
  }
  return found->second;
}

/// The whole of pasting; the rate is points a second. Voxels are two pixels wide.
void paste_views_per_point(benchmark::State& state) {
  const int size_px = static_cast<int>(state.range(0));
  const ViewStore& views = bumpy_sphere(size_px);
  const Lens lens = testing::small_lens(size_px, 5.0 * size_px);
  std::size_t triangles = 0;
  for (auto iteration : state) {
    static_cast<void>(iteration);
    triangles = paste_views(views, lens, {.voxel_mm = 240.0 / size_px}).triangles.size();
  }
  state.counters["triangles"] = static_cast<double>(triangles);
  state.SetItemsProcessed(state.iterations() * 12 * size_px * size_px);
}
BENCHMARK(paste_views_per_point)
    ->Arg(300)
    ->Arg(600)
    ->Arg(1200)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
}  // namespace frangia
