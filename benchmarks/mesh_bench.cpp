// The edits of a scan of two million triangles, and CGAL's decimation of the same. `./run bench`
// makes the scan; elsewhere FRANGIA_BENCH_DATA names the folder that holds scan.ply.
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_ratio_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/GarlandHeckbert_policies.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>
#include <benchmark/benchmark.h>

#include "frangia/editor/edit_history.h"
#include "frangia/editor/internal/select_by_geometry.h"
#include "frangia/files/read_mesh.h"
#include "frangia/files/write_mesh.h"
#include "frangia/geometry/boundary_loops.h"
#include "frangia/geometry/change_selection.h"
#include "frangia/geometry/connected_components.h"
#include "frangia/geometry/hausdorff_distance.h"
#include "frangia/mesh/decimate.h"
#include "frangia/mesh/fill_holes.h"
#include "frangia/mesh/make_manifold.h"
#include "frangia/mesh/mesh_findings.h"

#include "wanted.h"

namespace frangia {
namespace {

constexpr double kShare = 0.1;  // of the triangles that decimation leaves

std::filesystem::path data_path(const char* name) {
  const char* const folder = std::getenv("FRANGIA_BENCH_DATA");  // NOLINT(concurrency-mt-unsafe)
  return std::filesystem::path(folder == nullptr ? "out/bench/data" : folder) / name;
}
std::filesystem::path scan_path() {
  return data_path("scan.ply");
}

/// The scan; an empty mesh, and the benchmark skipped, when there is none.
const Mesh& scan(benchmark::State& state) {
  static const Mesh kScan = std::filesystem::exists(scan_path()) ? read_mesh(scan_path()) : Mesh();
  if (kScan.empty()) state.SkipWithError("there is no scan.ply; ./run bench makes it");
  state.counters["triangles"] = static_cast<double>(kScan.triangles.size());
  return kScan;
}

/// Bytes that a mesh takes.
double bytes_of(const Mesh& mesh) {
  return 12.0 * static_cast<double>(mesh.triangles.size()) +
         (12.0 + (mesh.normals.empty() ? 0.0 : 12.0) + (mesh.sigma_mm.empty() ? 0.0 : 4.0) +
          (mesh.views.empty() ? 0.0 : 2.0)) *
             static_cast<double>(mesh.vertices_mm.size());
}

/// The largest memory that the process had since the last call with `reset`, in bytes.
double peak_bytes(bool reset) {
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

constexpr double kMeshes = 6.0;  // the memory that an edit may take, with the mesh itself

/// Does `work` with a copy of the scan, counts its memory in meshes, and says whether it took at
/// most `wanted_s`; its seconds.
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

void load_ply(benchmark::State& state) {
  static_cast<void>(scan(state));
  for (auto iteration : state) {
    static_cast<void>(iteration);
    const Stopwatch watch;
    benchmark::DoNotOptimize(read_mesh(scan_path()));
    PerformanceTarget target;
    target.at_most("time", watch.seconds(), 1.0, "s");
    target.label(state);
  }
}

void list(benchmark::State& state) {
  with_scan(state, scan(state), 3.0, [](const Mesh& mesh) {
    benchmark::DoNotOptimize(mesh_findings(mesh));
  });
}

void remove_small_islands(benchmark::State& state) {
  with_scan(state, scan(state), 0.5, [](Mesh mesh) {
    benchmark::DoNotOptimize(remove_islands(std::move(mesh), 3.0));
  });
}

/// The scan with balls cut out of it, spread along it.
Mesh with_holes(const Mesh& mesh, std::size_t count, double radius_mm) {
  Selection gone(mesh.triangles.size());
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t t = (2 * i + 1) * mesh.triangles.size() / (2 * count);
    const Eigen::Vector3d middle = mesh.vertices_mm[mesh.triangles[t][0]].cast<double>();
    const Selection ball = select_by_ball(mesh, middle, radius_mm);
    for (std::size_t k = 0; k < gone.size(); ++k)
      gone[k] |= ball[k];
  }
  return keep_largest_components(make_manifold(delete_selected(mesh, gone)));
}

void fill_50_small_holes(benchmark::State& state) {
  static const Mesh kHoled = with_holes(scan(state), 50, 0.8);
  state.counters["holes"] = static_cast<double>(boundary_loops(kHoled).size());
  with_scan(state, kHoled, 1.0, [](Mesh mesh) {
    benchmark::DoNotOptimize(fill_holes(std::move(mesh), {.up_to_mm = 3.0}));
  });
}

/// A hole with about 2500 edges: its radius is found by trying.
const Mesh& with_large_hole(const Mesh& scan) {
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

void fill_one_large_hole(benchmark::State& state) {
  const Mesh& mesh = with_large_hole(scan(state));
  const auto loops = boundary_loops(mesh);
  std::size_t largest = 0;
  for (std::size_t i = 0; i < loops.size(); ++i)
    if (loops[i].edges.size() > loops[largest].edges.size()) largest = i;
  if (loops.empty()) return;
  state.counters["edges"] = static_cast<double>(loops[largest].edges.size());
  Mesh filled;
  with_scan(state, mesh, 4.0, [&](Mesh copy) {
    filled = fill_holes(std::move(copy), {.only = {largest}});
  });
  state.counters["holes_left_of_it"] =
      static_cast<double>(boundary_loops(filled).size()) - static_cast<double>(loops.size() - 1);
}

/// What decimation comes to.
struct Decimated {
  double seconds = 0.0;
  double gap_mm = 0.0;  ///< the Hausdorff distance between it and the scan
};

/// What is wrong with a decimated mesh: edges that are not manifold, and how far it lies from the
/// scan.
Decimated judge(benchmark::State& state, const Mesh& scan, const Mesh& few, double seconds) {
  const double gap_mm = hausdorff_distance_mm(RayScene(scan), RayScene(few), 0.1);
  state.counters["left"] = static_cast<double>(few.triangles.size());
  state.counters["non_manifold"] = static_cast<double>(count_non_manifold_edges(few));
  state.counters["hausdorff_mm"] = gap_mm;
  return {seconds, gap_mm};
}

/// The peer's, which runs first.
Decimated& cgal() {
  static Decimated of_cgal;
  return of_cgal;
}

using Kernel = CGAL::Simple_cartesian<double>;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;

Surface surface_of(const Mesh& mesh) {
  Surface surface;
  for (const Eigen::Vector3f& vertex : mesh.vertices_mm) {
    const Eigen::Vector3d p = vertex.cast<double>();
    surface.add_vertex(Kernel::Point_3(p.x(), p.y(), p.z()));
  }
  for (const auto& [a, b, c] : mesh.triangles)
    surface.add_face(Surface::Vertex_index(a), Surface::Vertex_index(b), Surface::Vertex_index(c));
  return surface;
}

Mesh mesh_of(Surface& surface) {
  surface.collect_garbage();
  Mesh mesh;
  mesh.vertices_mm.reserve(surface.number_of_vertices());
  for (const auto id : surface.vertices()) {
    const auto& p = surface.point(id);
    mesh.vertices_mm.emplace_back(Eigen::Vector3d(p.x(), p.y(), p.z()).cast<float>());
  }
  for (const auto face : surface.faces()) {
    Mesh::Triangle triangle{};
    std::size_t corner = 0;
    for (const auto id : surface.vertices_around_face(surface.halfedge(face)))
      triangle.at(corner++) = id;
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

void decimate_to_tenth_by_cgal(benchmark::State& state) {
  namespace sms = CGAL::Surface_mesh_simplification;
  using Policies = sms::GarlandHeckbert_plane_policies<Surface, Kernel>;
  const Mesh& mesh = scan(state);
  Mesh few;
  double seconds = 0.0;
  for (auto iteration : state) {
    static_cast<void>(iteration);
    state.PauseTiming();
    Surface surface = surface_of(mesh);
    const Stopwatch watch;
    state.ResumeTiming();
    const Policies policies(surface);
    sms::Count_ratio_stop_predicate<Surface> stop(kShare);
    sms::edge_collapse(
        surface,
        stop,
        CGAL::parameters::get_cost(policies.get_cost()).get_placement(policies.get_placement()));
    state.PauseTiming();
    seconds = watch.seconds();
    few = mesh_of(surface);
    state.ResumeTiming();
  }
  if (few.empty()) return;
  cgal() = judge(state, mesh, few, seconds);
  write_mesh(data_path("tenth-by-cgal.ply"), few);  // for MeshLab, in ./run figures
}

void decimate_to_tenth(benchmark::State& state) {
  const Mesh& mesh = scan(state);
  Mesh few;
  const double seconds = with_scan(state, mesh, 0.0, [&](Mesh copy) {
    const auto count =
        static_cast<std::size_t>(kShare * static_cast<double>(copy.triangles.size()));
    few = decimate(std::move(copy), {.triangles = count});
  });
  if (few.empty()) return;
  const Decimated own = judge(state, mesh, few, seconds);
  write_mesh(data_path("tenth.ply"), few);
  PerformanceTarget target;
  target.at_most("memory", state.counters["memory_meshes"], kMeshes, "meshes");
  target.at_most("non-manifold", state.counters["non_manifold"], 0.0, "edges");
  if (cgal().seconds > 0.0) {
    target.at_most("time", own.seconds / cgal().seconds, 0.25, "of CGAL's");
    target.at_most("Hausdorff", own.gap_mm, cgal().gap_mm, "mm, CGAL's");
  }
  target.label(state);
}

/// Undo and redo of a step that changes everything, both at once.
void undo_and_redo(benchmark::State& state, const EditStep& step) {
  EditHistory history(scan(state));
  history.apply(step);
  for (auto iteration : state) {
    static_cast<void>(iteration);
    const Stopwatch watch;
    history.undo();
    const double undo_s = watch.seconds();
    history.redo();
    PerformanceTarget target;
    target.at_most("undo", undo_s, 0.3, "s");
    target.at_most("redo", watch.seconds() - undo_s, 0.3, "s");
    target.label(state);
  }
  state.counters["delta_meshes"] = static_cast<double>(history.bytes()) / bytes_of(scan(state));
}

void once(benchmark::internal::Benchmark* benchmark) {
  benchmark->Unit(benchmark::kMillisecond)->UseRealTime()->Iterations(1);
}

BENCHMARK(load_ply)->Unit(benchmark::kMillisecond)->UseRealTime()->Iterations(3);
BENCHMARK(list)->Apply(once);
BENCHMARK(remove_small_islands)->Apply(once);
BENCHMARK(fill_50_small_holes)->Apply(once);
BENCHMARK(fill_one_large_hole)->Apply(once);
BENCHMARK(decimate_to_tenth_by_cgal)->Apply(once);
BENCHMARK(decimate_to_tenth)->Apply(once);
BENCHMARK_CAPTURE(undo_and_redo, decimate, EditStep{"decimate-to", "200000"})->Apply(once);
BENCHMARK_CAPTURE(undo_and_redo, remove_islands, EditStep{"remove-islands", "3mm"})->Apply(once);
BENCHMARK_CAPTURE(undo_and_redo, fill_holes, EditStep{"fill-holes", "3mm"})->Apply(once);
BENCHMARK_CAPTURE(undo_and_redo, smooth, EditStep{"smooth", "1"})->Apply(once);

}  // namespace
}  // namespace frangia
