#include <chrono>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "frangia/core/angles.h"
#include "frangia/dataset/read_frames.h"
#include "frangia/files/write_mesh.h"
#include "frangia/frames/map_picture.h"
#include "frangia/inspect/contact_sheet.h"
#include "frangia/inspect/render_mesh.h"
#include "frangia/inspect/surface_error.h"
#include "frangia/reconstruct/reconstruct.h"
#include "frangia/simulate/default_patterns.h"
#include "frangia/simulate/parts.h"
#include "frangia/simulate/rig_presets.h"
#include "frangia/simulate/simulate_scan.h"

#include "counted.h"
#include "print_text.h"
#include "show_file.h"
#include "verbs.h"

namespace frangia {
namespace {

struct DemoArguments {
  std::filesystem::path folder = "frangia-demo";
  bool open = false;
};

/// One part on one rig, its reconstruction and the measured errors.
struct DemoCase {
  std::string part;
  std::string rig;
  Reconstruction result;
  SurfaceError error;
  SurfaceCompleteness completeness;
  std::vector<Image<Rgb>> pictures;  ///< fringes, phase, mesh, error
};

constexpr int kViews = 8;
constexpr double kWithinMm = 0.2;
constexpr float kErrorScaleMm = 0.1F;

Scan plan_of(const DemoCase& demo_case, const std::filesystem::path& folder) {
  Scan plan;
  plan.folder = folder / (demo_case.part + "-scan");
  plan.name = demo_case.part;
  plan.rig = rig_preset(demo_case.rig);
  plan.patterns = default_patterns(plan.rig);
  for (int i = 0; i < kViews; ++i)
    plan.views.push_back({kTwoPi * i / kViews, fmt::format("views/{:03}", i)});
  return plan;
}

Image<Rgb> grey_picture(const Frame& frame, int white_level) {
  Image<Rgb> picture(width_of(frame), height_of(frame));
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      const float share =
          static_cast<float>(counts_at(frame, x, y)) / static_cast<float>(white_level);
      picture(x, y) = pixel_of(ColorMap::Gray, share);
    }
  }
  return picture;
}

/// The first fringe frame of a view and its wrapped phase, as in the paper's Fig. 3 and 4.
void picture_phase(const Scan& scan, DemoCase& demo_case, const Run& run) {
  const auto stacks = read_frames(scan, 0, run);
  const DecodedView decoded =
      decode_view(stacks, scan.rig, rays_of(scan.rig.reference().model), {}, run);
  const WrappedPhase& finest = decoded.directions.front().wrapped.back();
  for (const FrameStack& stack : stacks) {
    if (stack.pattern.name != finest.pattern.name) continue;
    demo_case.pictures.push_back(
        crop_to_content(grey_picture(stack.frames.front(), stack.white_level), 24));
  }
  constexpr float kHalfTurn = 3.14159265F;
  Image<float> phase = finest.phase_rad;
  Image<Rgb> picture = map_picture(phase, {-kHalfTurn, kHalfTurn}, ColorMap::Gray);
  for (std::size_t i = 0; i < phase.pixels().size(); ++i) {
    if (std::isnan(phase.pixels()[i])) picture.pixels()[i] = {0, 0, 0};
  }
  demo_case.pictures.push_back(crop_to_content(picture, 24));
}

void measure(const Scan& scan, const Mesh& truth, DemoCase& demo_case, const Run& run) {
  const RayScene truth_scene(truth);
  const RayScene mesh_scene(demo_case.result.mesh);
  std::vector<Eigen::Isometry3d> poses;
  for (const ScanView& view : scan.views)
    poses.push_back(scan.rig.rig_from_object(view.angle_rad));
  demo_case.error = surface_error(demo_case.result.mesh, truth_scene, {}, run);
  demo_case.completeness = surface_completeness(
      truth_scene, mesh_scene, MeasurementViews{scan.rig, poses}, {.within_mm = kWithinMm}, run);
  RenderOptions shade{.width_px = 720, .height_px = 720, .samples_across = 3};
  demo_case.pictures.push_back(render_mesh(demo_case.result.mesh, shade, run));
  shade.values = vertex_errors_mm(demo_case.result.mesh, truth_scene, run);
  shade.value_min = -kErrorScaleMm;
  shade.value_max = kErrorScaleMm;
  shade.color_map = ColorMap::Diverging;
  shade.value_label = "deviation, mm";
  demo_case.pictures.push_back(render_mesh(demo_case.result.mesh, shade, run));
}

void run_case(DemoCase& demo_case, const std::filesystem::path& folder, const Run& run) {
  run.stage("simulate");
  const Scan plan = plan_of(demo_case, folder);
  std::filesystem::remove_all(plan.folder);  // from an earlier demo; see claim_folder
  const Mesh truth = make_part(demo_case.part, run);
  const Scan scan = simulate_scan(truth, plan, {.samples_per_px = 4}, run);
  demo_case.result = reconstruct(scan, {}, run);
  run.stage("files");
  for (const char* ending : {"dxf", "ply", "stl"})
    write_mesh(folder / fmt::format("{}.{}", demo_case.part, ending), demo_case.result.mesh);
  run.stage("pictures");
  picture_phase(scan, demo_case, run);
  measure(scan, truth, demo_case, run);
  write_png(folder / (demo_case.part + ".png"), demo_case.pictures[2]);
}

void print_cases(const std::vector<DemoCase>& demo_cases, Terminal& terminal) {
  nlohmann::ordered_json json;
  for (const DemoCase& demo_case : demo_cases) {
    json["parts"].push_back({{"part", demo_case.part},
                             {"rig", demo_case.rig},
                             {"points", demo_case.result.points},
                             {"triangles", demo_case.result.mesh.triangles.size()},
                             {"rms_mm", demo_case.error.rms_mm},
                             {"p99_mm", demo_case.error.p99_mm},
                             {"max_mm", demo_case.error.max_mm},
                             {"completeness", demo_case.completeness.share}});
  }
  for (const auto& stage : terminal.stage_seconds())
    json["seconds"][stage.first] = stage.second;
  json["warnings"] = terminal.warnings();
  print_json(json);
}

void print_table(const std::vector<DemoCase>& demo_cases, Terminal& terminal) {
  print_text("{:<8}{:<10}{:>9}{:>11}{:>17}{:>11}{:>10}\n",
             "part",
             "rig",
             "points",
             "triangles",
             "error RMS, mm",
             "99 %, mm",
             "complete");
  for (const DemoCase& demo_case : demo_cases) {
    print_text("{:<8}{:<10}{:>9}{:>11}{:>17.4f}{:>11.4f}{:>8.1f} %\n",
               demo_case.part,
               demo_case.rig,
               demo_case.result.points,
               demo_case.result.mesh.triangles.size(),
               demo_case.error.rms_mm,
               demo_case.error.p99_mm,
               100.0 * demo_case.completeness.share);
  }
  print_text("(complete: share of the measurable surface that has mesh within {} mm)\n", kWithinMm);
  if (!terminal.verbose) return;
  for (const auto& [stage, seconds] : terminal.stage_seconds())
    print_text("  {:<10}{:7.2f} s\n", stage, seconds);
}

/// Creates the folder, or takes one that is empty or was marked by an earlier demo. The demo
/// deletes and overwrites only in a folder with its mark.
void claim_folder(const std::filesystem::path& folder) {
  const auto mark = folder / ".frangia-demo";
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    throw Error(ErrorKind::File,
                fmt::format("{}: cannot be created: {}", folder.string(), error.message()));
  }
  if (std::filesystem::exists(mark)) return;
  if (!std::filesystem::is_empty(folder)) {
    throw Error(
        ErrorKind::Input,
        fmt::format("{}: holds files that `frangia demo` did not write; name a new or empty "
                    "folder as `output`",
                    folder.string()));
  }
  std::ofstream out(mark);
  out << "frangia demo writes to this folder and deletes what it wrote before\n";
  if (!out.flush())
    throw Error(ErrorKind::File, fmt::format("{}: cannot be written", mark.string()));
}

void demo(const DemoArguments& arguments, Terminal& terminal) {
  const Run run = terminal.run();
  claim_folder(arguments.folder);
  std::vector<DemoCase> demo_cases(2);
  demo_cases[0].part = "bust";
  demo_cases[0].rig = "digital";
  demo_cases[1].part = "shaft";
  demo_cases[1].rig = "angular";
  std::vector<std::vector<Image<Rgb>>> rows;
  for (DemoCase& demo_case : demo_cases) {
    run.note(fmt::format(
        "{} on the {} rig, {}", demo_case.part, demo_case.rig, counted(kViews, "view")));
    run_case(demo_case, arguments.folder, run);
    rows.push_back(demo_case.pictures);
  }
  const auto sheet = arguments.folder / "demo.png";
  write_png(sheet, contact_sheet(rows, 420));
  terminal.finish();
  if (terminal.json) {
    print_cases(demo_cases, terminal);
  } else if (!terminal.quiet) {
    print_table(demo_cases, terminal);
    print_text("wrote meshes and pictures to {}; {} shows them all\n",
               arguments.folder.string(),
               sheet.string());
  }
  if (!arguments.open) return;
  if (!show_file(sheet))
    run.warn(fmt::format("{}: xdg-open cannot show it; open it yourself", sheet.string()));
}

}  // namespace

void add_demo_verb(CLI::App& program, Terminal& terminal) {
  auto arguments = std::make_shared<DemoArguments>();
  CLI::App* verb = program.add_subcommand(
      "demo", "scan two parts on simulated rigs and measure the errors, in about a minute");
  verb->footer("example:\n  frangia demo --open");
  verb->add_option("-o,--output",
                   arguments->folder,
                   "folder to write to, new or empty or of an earlier demo")
      ->capture_default_str();
  verb->add_flag("--open", arguments->open, "show the picture at the end");
  verb->callback([arguments, &terminal] { demo(*arguments, terminal); });
}

}  // namespace frangia
