#include <filesystem>
#include <memory>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "frangia/files/read_mesh.h"
#include "frangia/frames/png.h"
#include "frangia/inspect/shade_mesh.h"
#include "frangia/inspect/surface_coverage.h"
#include "frangia/inspect/surface_error.h"
#include "frangia/scan/scan_folder.h"

#include "verbs.h"

namespace frangia {
namespace {

struct InspectArguments {
  std::filesystem::path mesh;
  std::filesystem::path reference;
  std::filesystem::path scan;
  std::filesystem::path picture;
  double scale_mm = 0.1;
  double within_mm = 0.2;
};

SurfaceCoverage coverage_of(const InspectArguments& arguments,
                            const RayScene& reference,
                            const RayScene& mesh,
                            const Run& run) {
  const CoverageOptions options{.within_mm = arguments.within_mm};
  if (arguments.scan.empty()) return surface_coverage(reference, mesh, options, run);
  const Scan scan = read_scan(arguments.scan, run);
  std::vector<Eigen::Isometry3d> poses;
  for (const ScanView& view : scan.views)
    poses.push_back(scan.rig.rig_from_object(view.angle_rad));
  return surface_coverage(reference, mesh, SeenFrom{scan.rig, poses}, options, run);
}

void draw(const InspectArguments& arguments,
          const Mesh& mesh,
          const RayScene& reference,
          const Run& run) {
  ShadeOptions shade;
  shade.values = vertex_errors_mm(mesh, reference, run);
  shade.value_min = static_cast<float>(-arguments.scale_mm);
  shade.value_max = static_cast<float>(arguments.scale_mm);
  shade.color_map = ColorMap::Diverging;
  write_png(arguments.picture, shade_mesh(mesh, shade, run));
}

void print_result(const SurfaceError& error,
                  const SurfaceCoverage& coverage,
                  const InspectArguments& arguments,
                  Terminal& terminal) {
  terminal.finish();
  if (terminal.json) {
    const nlohmann::ordered_json json{{"vertices", error.count},
                                      {"rms_mm", error.rms_mm},
                                      {"mean_mm", error.mean_mm},
                                      {"bias_mm", error.bias_mm},
                                      {"p95_mm", error.p95_mm},
                                      {"p99_mm", error.p99_mm},
                                      {"max_mm", error.max_mm},
                                      {"covered", coverage.share},
                                      {"covered_within_mm", arguments.within_mm}};
    fmt::print("{}\n", json.dump(2));
    return;
  }
  fmt::print(
      "{} vertices: RMS {:.4f} mm, bias {:+.4f}, 95 % within {:.4f}, 99 % within {:.4f}, all "
      "within {:.4f}\n",
      error.count,
      error.rms_mm,
      error.bias_mm,
      error.p95_mm,
      error.p99_mm,
      error.max_mm);
  fmt::print("{:.1f} % of the {} has mesh within {} mm\n",
             100.0 * coverage.share,
             arguments.scan.empty() ? "reference" : "reference that the scan's views could measure",
             arguments.within_mm);
}

void inspect(const InspectArguments& arguments, Terminal& terminal) {
  const Run run = terminal.run();
  const Mesh mesh = read_mesh(arguments.mesh);
  const RayScene reference(read_mesh(arguments.reference));
  const RayScene mesh_scene(mesh);
  const SurfaceError error = surface_error(mesh, reference, {}, run);
  const SurfaceCoverage coverage = coverage_of(arguments, reference, mesh_scene, run);
  if (!arguments.picture.empty()) draw(arguments, mesh, reference, run);
  print_result(error, coverage, arguments, terminal);
}

}  // namespace

void add_inspect_verb(CLI::App& program, Terminal& terminal) {
  auto arguments = std::make_shared<InspectArguments>();
  CLI::App* verb = program.add_subcommand("inspect", "measure a mesh against a reference");
  verb->footer(
      "example:\n  frangia inspect bust.ply --reference bust-scan/truth.ply --scan bust-scan "
      "--picture bust.png");
  verb->add_option("MESH", arguments->mesh, "the measured mesh: .ply, .stl or .obj")->required();
  verb->add_option("--reference", arguments->reference, "the true shape, in the same frame")
      ->required();
  verb->add_option("--scan",
                   arguments->scan,
                   "count only what the views of this scan could measure as to be covered");
  verb->add_option("--within", arguments->within_mm, "a place is covered with mesh this near, mm")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  verb->add_option("--picture", arguments->picture, "draw the deviations as colors into this .png");
  verb->add_option("--scale", arguments->scale_mm, "deviation of the strongest color, mm")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  verb->callback([arguments, &terminal] { inspect(*arguments, terminal); });
}

}  // namespace frangia
