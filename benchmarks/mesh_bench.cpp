// Edits of a scan of two million triangles, and CGAL's decimation of the same mesh. `./run bench`
// makes the scan; otherwise FRANGIA_BENCH_DATA names the folder of scan.ply.
#include <cstddef>
#include <ctime>
#include <utility>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_ratio_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/GarlandHeckbert_policies.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>
#include <benchmark/benchmark.h>

#include "frangia/editor/edit_history.h"
#include "frangia/files/read_mesh.h"
#include "frangia/files/write_mesh.h"
#include "frangia/geometry/boundary.h"
#include "frangia/geometry/components.h"
#include "frangia/geometry/hausdorff_distance.h"
#include "frangia/mesh/decimate.h"
#include "frangia/mesh/fill_holes.h"
#include "frangia/mesh/make_manifold.h"
#include "frangia/mesh/mesh_findings.h"

#include "mesh_scan.h"
#include "performance_target.h"

namespace frangia {
namespace {

constexpr double kShare = 0.1;  // of the triangles after decimation

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

void fill_50_small_holes(benchmark::State& state) {
  static const Mesh kHoled = with_holes(scan(state), 50, 0.8);
  state.counters["holes"] = static_cast<double>(boundary_loops(kHoled).size());
  with_scan(state, kHoled, 1.0, [](Mesh mesh) {
    benchmark::DoNotOptimize(fill_holes(std::move(mesh), {.up_to_mm = 3.0}));
  });
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

/// The result of a decimation.
struct Decimated {
  double seconds = 0.0;
  double hausdorff_mm = 0.0;  ///< distance from the scan
};

/// Measures a decimated mesh: its non-manifold edges and its distance from the scan.
Decimated measure(benchmark::State& state, const Mesh& scan, const Mesh& few, double seconds) {
  const double hausdorff_mm = hausdorff_distance_mm(RayScene(scan), RayScene(few), 0.1);
  state.counters["left"] = static_cast<double>(few.triangles.size());
  state.counters["non_manifold"] = static_cast<double>(count_non_manifold_edges(few));
  state.counters["hausdorff_mm"] = hausdorff_mm;
  return {seconds, hausdorff_mm};
}

/// The result of CGAL, whose benchmark runs first.
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

/// CGAL's decimation to a share of the triangles, and the seconds that it took.
Mesh decimated_by_cgal(const Mesh& mesh, double share, double& seconds) {
  namespace sms = CGAL::Surface_mesh_simplification;
  using Policies = sms::GarlandHeckbert_plane_policies<Surface, Kernel>;
  Surface surface = surface_of(mesh);
  const Stopwatch watch;
  const Policies policies(surface);
  sms::Count_ratio_stop_predicate<Surface> stop(share);
  sms::edge_collapse(
      surface,
      stop,
      CGAL::parameters::get_cost(policies.get_cost()).get_placement(policies.get_placement()));
  seconds = watch.seconds();
  return mesh_of(surface);
}

void decimate_to_tenth_by_cgal(benchmark::State& state) {
  const Mesh& mesh = scan(state);
  Mesh few;
  double seconds = 0.0;
  for (auto iteration : state) {
    static_cast<void>(iteration);
    few = decimated_by_cgal(mesh, kShare, seconds);
  }
  if (few.empty()) return;
  cgal() = measure(state, mesh, few, seconds);
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
  const Decimated own = measure(state, mesh, few, seconds);
  write_mesh(data_path("tenth.ply"), few);
  PerformanceTarget target;
  target.at_most("memory", state.counters["memory_meshes"], kMeshes, "meshes");
  target.at_most("non-manifold", state.counters["non_manifold"], 0.0, "edges");
  if (cgal().seconds > 0.0) {
    target.at_most("time", own.seconds / cgal().seconds, 0.25, "of CGAL's");
    target.at_most("Hausdorff", own.hausdorff_mm, cgal().hausdorff_mm, "mm, CGAL's");
  }
  target.label(state);
}

/// Processor time for a million and a half triangles is compared: the guard is sequential, the
/// verification is not.
void decimate_within_a_tolerance(benchmark::State& state) {
  constexpr double kTolerance_mm = 0.03;
  constexpr double kMost_s = 15.0;  // for kTriangles
  constexpr double kTriangles = 1.5e6;
  const Mesh& mesh = scan(state);
  Mesh few;
  double processor_s = 0.0;
  for (auto iteration : state) {
    static_cast<void>(iteration);
    const std::clock_t begin = std::clock();
    few = decimate(mesh, {.tolerance_mm = kTolerance_mm});
    processor_s = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  }
  if (few.empty()) return;
  const Decimated own = measure(state, mesh, few, processor_s);
  PerformanceTarget target;
  target.at_most("processor time",
                 processor_s,
                 kMost_s * static_cast<double>(mesh.triangles.size()) / kTriangles,
                 "s");
  target.at_most("Hausdorff", own.hausdorff_mm, kTolerance_mm, "mm");
  // Edges, of which CGAL counts its share, are three for two triangles.
  const double share =
      static_cast<double>(few.triangles.size()) / static_cast<double>(mesh.triangles.size());
  double cgal_s = 0.0;
  const Mesh of_cgal = decimated_by_cgal(mesh, share, cgal_s);
  const double cgal_mm = measure(state, mesh, of_cgal, cgal_s).hausdorff_mm;
  state.counters["cgal_left"] = static_cast<double>(of_cgal.triangles.size());
  state.counters["left"] = static_cast<double>(few.triangles.size());
  state.counters["cgal_hausdorff_mm"] = cgal_mm;
  state.counters["hausdorff_mm"] = own.hausdorff_mm;
  target.at_most(
      "Hausdorff", own.hausdorff_mm, 1.05 * cgal_mm, "mm, 1.05 times CGAL's at that count");
  target.label(state);
}

/// Undo and redo of a step.
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
BENCHMARK(decimate_within_a_tolerance)->Apply(once);
BENCHMARK_CAPTURE(undo_and_redo, decimate, EditStep{"decimate-to", "200000"})->Apply(once);
BENCHMARK_CAPTURE(undo_and_redo, remove_islands, EditStep{"remove-islands", "3mm"})->Apply(once);
BENCHMARK_CAPTURE(undo_and_redo, fill_holes, EditStep{"fill-holes", "3mm"})->Apply(once);
BENCHMARK_CAPTURE(undo_and_redo, smooth, EditStep{"smooth", "1"})->Apply(once);

}  // namespace
}  // namespace frangia
