#pragma once

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>

#include <benchmark/benchmark.h>

#include "frangia/editor/internal/select_by_geometry.h"
#include "frangia/files/read_mesh.h"
#include "frangia/geometry/boundary.h"
#include "frangia/geometry/components.h"
#include "frangia/geometry/selection.h"
#include "frangia/mesh/make_manifold.h"

#include "performance_target.h"

namespace frangia {

inline std::filesystem::path data_path(const char* name) {
  const char* const folder = std::getenv("FRANGIA_BENCH_DATA");  // NOLINT(concurrency-mt-unsafe)
  return std::filesystem::path(folder == nullptr ? "out/bench/data" : folder) / name;
}
inline std::filesystem::path scan_path() {
  return data_path("scan.ply");
}

/// The scan. Without a file the mesh is empty and the benchmark is skipped.
inline const Mesh& scan(benchmark::State& state) {
  static const Mesh kScan = std::filesystem::exists(scan_path()) ? read_mesh(scan_path()) : Mesh();
  if (kScan.empty()) state.SkipWithError("there is no scan.ply; ./run bench makes it");
  state.counters["triangles"] = static_cast<double>(kScan.triangles.size());
  return kScan;
}

/// The memory of a mesh in bytes.
inline double bytes_of(const Mesh& mesh) {
  return 12.0 * static_cast<double>(mesh.triangles.size()) +
         (12.0 + (mesh.normals.empty() ? 0.0 : 12.0) + (mesh.sigma_mm.empty() ? 0.0 : 4.0) +
          (mesh.views.empty() ? 0.0 : 2.0)) *
             static_cast<double>(mesh.vertices_mm.size());
}

/// The peak memory of the process since the last call with `reset`, in bytes.
inline double peak_bytes(bool reset) {
  if (reset) {
    std::ofstream("/proc/self/clear_refs") << "5";
  }
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    double kilobytes = 0.0;
    if (word == "VmHWM:" && status >> kilobytes) return 1024.0 * kilobytes;
  }
  return 0.0;
}

constexpr double kMeshes = 6.0;  // limit of the memory of an edit, in meshes, with the mesh itself

/// Runs `work` with a copy of the scan, measures its memory in meshes, and labels whether it met
/// `wanted_s`. Returns its duration in seconds.
template <typename Work>
double with_scan(benchmark::State& state, const Mesh& mesh, double wanted_s, const Work& work) {
  double seconds = 0.0;
  for (auto iteration : state) {
    static_cast<void>(iteration);
    state.PauseTiming();
    const double before = peak_bytes(true);
    Mesh copy = mesh;
    const Stopwatch watch;
    state.ResumeTiming();
    work(std::move(copy));
    state.PauseTiming();
    seconds = watch.seconds();
    const double meshes = (peak_bytes(false) - before) / bytes_of(mesh);
    state.counters["memory_meshes"] = meshes;
    PerformanceTarget target;
    if (wanted_s > 0.0) target.at_most("time", seconds, wanted_s, "s");
    target.at_most("memory", meshes, kMeshes, "meshes");
    target.label(state);
    state.ResumeTiming();
  }
  return seconds;
}

/// The scan with ball-shaped holes, distributed over its triangles.
inline Mesh with_holes(const Mesh& mesh, std::size_t count, double radius_mm) {
  Selection removed(mesh.triangles.size());
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t t = (2 * i + 1) * mesh.triangles.size() / (2 * count);
    const Eigen::Vector3d center = mesh.vertices_mm[mesh.triangles[t][0]].cast<double>();
    const Selection ball = select_by_ball(mesh, center, radius_mm);
    for (std::size_t k = 0; k < removed.size(); ++k)
      removed[k] |= ball[k];
  }
  return keep_largest_components(make_manifold(delete_selected(mesh, removed)));
}

/// The scan with a hole of about 2500 edges, found by increasing its radius.
inline const Mesh& with_large_hole(const Mesh& scan) {
  static const Mesh kHoled = [&] {
    Mesh best;
    double radius = 10.0;
    while (radius < 40.0) {
      best = with_holes(scan, 1, radius);
      std::size_t longest = 0;
      for (const BoundaryLoop& loop : boundary_loops(best))
        longest = std::max(longest, loop.edges.size());
      if (longest > 2500) break;
      radius *= 1.1;
    }
    return best;
  }();
  return kHoled;
}

}  // namespace frangia
