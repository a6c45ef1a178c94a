#include "plan_scan_verb.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "frangia/core/angles.h"
#include "frangia/core/statistics.h"
#include "frangia/files/ply.h"
#include "frangia/frames/png.h"
#include "frangia/inspect/render_mesh.h"
#include "frangia/rig/read_rig.h"
#include "frangia/scan_plan/plan_scan.h"
#include "frangia/simulate/rig_presets.h"

#include "allow_memory.h"
#include "check_can_write.h"
#include "counted.h"
#include "fixed_text.h"
#include "json_number.h"
#include "option_values.h"
#include "picture_file.h"
#include "print_text.h"
#include "text_table.h"
#include "usage.h"

namespace frangia {
namespace {

struct PlanScanArguments {
  std::filesystem::path reference;
  std::string rig = "digital";
  std::filesystem::path plan;
  std::vector<double> tolerance_mm;
  std::filesystem::path output;
  std::filesystem::path picture;
  std::vector<double> from_deg{35.0, 20.0};
  int views = 0;
  std::vector<double> tilts_deg;
  bool no_search = false;
  bool quick = false;
  ReadOptions read;
  ScanPlanOptions options;
};

InspectionPlan inspection_plan_of(const PlanScanArguments& arguments) {
  InspectionPlan plan;
  if (!arguments.plan.empty()) plan = read_inspection_plan(arguments.plan);
  const std::vector<double>& tolerance = arguments.tolerance_mm;
  if (tolerance.size() == 1) plan.tolerance_mm = {-tolerance[0], tolerance[0]};
  if (tolerance.size() == 2) plan.tolerance_mm = {tolerance[0], tolerance[1]};
  plan.tolerance().check();
  return plan;
}

/// The command that scans a setup as planned.
std::string scan_command(const ScanRecipe& recipe, std::size_t setup) {
  std::string text = fmt::format(
      "frangia scan RIG -o SCAN --views {} --shifts {}", recipe.stations, recipe.shifts);
  std::string periods;
  for (const double period : recipe.periods_px)
    periods += fmt::format("{}{:.4g}", periods.empty() ? "" : ",", period);
  if (!periods.empty()) text += " --periods " + periods;
  if (recipe.exposure > 1.0) text += " --exposure bracket";
  if (setup > 0) {
    text += fmt::format(
        " --setup {}   (tilted by {:.0f} degrees)", setup, deg_from_rad(recipe.tilts_rad[setup]));
  }
  return text;
}

std::string tried_table(const ScanPlan& plan, const Rig& rig) {
  TextColumn recipe{"scan", {}, false};
  TextColumn frames{"frames", {}, true};
  TextColumn share{"decidable", {}, true};
  TextColumn rows{"characteristics", {}, true};
  TextColumn need{"needs", {}, false};
  for (const TriedRecipe& tried : plan.tried) {
    recipe.values.push_back(tried.recipe.text());
    frames.values.push_back(fmt::format("{}", tried.recipe.frames(rig)));
    share.values.push_back(share_text(tried.reach.decidable_share));
    rows.values.push_back(
        plan.characteristics.empty()
            ? ""
            : fmt::format("{} of {}", tried.reach.decidable, plan.characteristics.size()));
    need.values.push_back(tried.fault.empty() ? std::string(name_of(tried.reach.need))
                                              : tried.fault);
  }
  return text_table({recipe, frames, share, rows, need});
}

std::string plan_text(const ScanPlan& plan, const Rig& rig) {
  std::string text = tried_table(plan, rig);
  text += plan.suffices
              ? fmt::format("a part without errors is in by {}\n", plan.recipe.text())
              : fmt::format("this rig does not decide all of it; most by {}\n", plan.recipe.text());
  if (!plan.suffices || plan.predicted.verdict == Conformity::In) {
    for (const VerdictReason& reason : plan.predicted.reasons)
      text += reason.text() + "\n";
  }
  for (const DecidableCharacteristic& row : plan.characteristics) {
    text += fmt::format("{}: predicted U95 {} {} for a half-width of {}{}\n",
                        row.name,
                        fixed_text(row.u95, 4),
                        row.unit,
                        fixed_text(row.half_width, 4),
                        row.is_decidable ? "" : ": this rig cannot decide it");
  }
  for (std::size_t setup = 0; setup < plan.recipe.tilts_rad.size(); ++setup)
    text += scan_command(plan.recipe, setup) + "\n";
  return text;
}

nlohmann::ordered_json json_of_recipe(const ScanRecipe& recipe, const Rig& rig) {
  std::vector<double> tilts_deg;
  for (const double tilt : recipe.tilts_rad)
    tilts_deg.push_back(deg_from_rad(tilt));
  return {{"tilts_deg", tilts_deg},
          {"stations", recipe.stations},
          {"shifts", recipe.shifts},
          {"periods_px", recipe.periods_px},
          {"exposure", recipe.exposure},
          {"frames", recipe.frames(rig)}};
}

nlohmann::ordered_json json_of_plan(const ScanPlan& plan, const Rig& rig) {
  nlohmann::ordered_json json{{"suffices", plan.suffices},
                              {"needs", name_of(plan.need)},
                              {"recipe", json_of_recipe(plan.recipe, rig)}};
  const SurfaceInspection& surface = plan.predicted.surface.value();
  const SurfaceVerdict& verdict = surface.verdict;
  json["surface"] = {{"decidable_share", verdict.coverage},
                     {"not_measured_share", verdict.share_of(PatchDecision::NotMeasured)},
                     {"median_u95_mm", number_or_null(kNormal95 * surface.summary.median_u_mm)},
                     {"decidable_mm", number_or_null(verdict.decidable_mm)},
                     {"sentence", sentence_of(verdict)}};
  json["characteristics"] = nlohmann::ordered_json::array();
  for (const DecidableCharacteristic& row : plan.characteristics) {
    json["characteristics"].push_back({{"name", row.name},
                                       {"unit", row.unit},
                                       {"half_width", row.half_width},
                                       {"u95", number_or_null(row.u95)},
                                       {"decidable", row.is_decidable}});
  }
  json["tried"] = nlohmann::ordered_json::array();
  for (const TriedRecipe& tried : plan.tried) {
    json["tried"].push_back({{"recipe", json_of_recipe(tried.recipe, rig)},
                             {"needs", name_of(tried.reach.need)},
                             {"decidable_share", tried.reach.decidable_share},
                             {"decidable", tried.reach.decidable},
                             {"fault", tried.fault}});
  }
  return json;
}

void draw_map(const PlanScanArguments& arguments, const ScanPlan& plan, const Run& run) {
  const SurfaceRule& rule = plan.predicted.surface.value().verdict.rule;
  const double half_mm = 0.5 * (rule.limits.upper - rule.limits.lower);
  RenderOptions options;
  options.values = plan.map.u95_mm;
  options.value_max = static_cast<float>(2.0 * rule.well_measured_share() * half_mm);
  options.value_label = "predicted U95, mm";
  options.value_limits = {rule.well_measured_share() * half_mm};
  options.azimuth_rad = rad_from_deg(arguments.from_deg[0]);
  options.elevation_rad = rad_from_deg(arguments.from_deg[1]);
  run.stage("picture");
  write_png(arguments.picture, render_mesh(plan.map.mesh, options, run));
}

void plan_a_scan(PlanScanArguments arguments, Terminal& terminal) {
  const Run run = terminal.run();
  if (!arguments.picture.empty()) check_picture_output(arguments.picture);
  if (!arguments.output.empty()) check_can_write(arguments.output);
  const InspectionPlan plan = inspection_plan_of(arguments);
  const Rig rig = std::filesystem::path(arguments.rig).has_extension()
                      ? read_rig(arguments.rig, run)
                      : rig_preset(arguments.rig);
  const InspectionReference reference = read_inspection_reference(
      arguments.reference, {.unit_mm = plan.unit_mm, .read = arguments.read}, run);
  ScanPlanOptions& options = arguments.options;
  options.scan.divisor = arguments.quick ? 0 : 1;
  options.search = !arguments.no_search;
  if (arguments.views > 0) options.start.stations = arguments.views;
  for (const double tilt : arguments.tilts_deg)
    options.start.tilts_rad.push_back(rad_from_deg(tilt));
  const ScanPlan found = plan_scan(reference, plan, rig, options, run);
  if (!arguments.output.empty()) {
    const VertexProperty u95{"u95_mm", found.map.u95_mm};
    write_ply(arguments.output, found.map.mesh, {&u95, 1});
  }
  if (!arguments.picture.empty()) draw_map(arguments, found, run);
  terminal.finish();
  if (terminal.json) {
    nlohmann::ordered_json json = json_of_plan(found, rig);
    json["warnings"] = terminal.warnings();
    print_json(json);
    return;
  }
  write_output(plan_text(found, rig));
  for (const auto& path : {arguments.output, arguments.picture})
    if (!path.empty()) terminal.print_written(path.string());
}

void add_assumptions(CLI::App& verb, VirtualScanOptions& scan) {
  verb.add_option("--reflectance",
                  scan.reflectance,
                  "of the darkest surface, relative to the white that the exposure is right for")
      ->check(from_to(0.01, 1.0))
      ->capture_default_str();
  verb.add_option("--gloss", scan.gloss, "strength of highlights, relative to diffuse white")
      ->check(zero_or_more())
      ->capture_default_str();
  verb.add_option("--ambient", scan.ambient, "light of the room, as a share of white")
      ->check(from_to(0.0, 0.9))
      ->capture_default_str();
  verb.add_option("--full-well",
                  scan.full_well_e,
                  "electrons of a white pixel, where rig.toml states no noise of the camera")
      ->check(above_zero())
      ->capture_default_str();
  verb.add_option("--read-noise", scan.read_e, "electrons, as --full-well")
      ->check(zero_or_more())
      ->capture_default_str();
  verb.add_option("--seed", scan.seed, "of the noise")->capture_default_str();
}

}  // namespace

void add_plan_scan_verb(CLI::App& plan, Terminal& terminal) {
  CLI::App* verb = plan.add_subcommand(
      "scan", "plan setups, stations, exposures and patterns that decide the tolerances of a part");
  verb->footer(
      "Example:\n"
      "  frangia plan scan part.step --rig rig.toml --plan inspection.toml --picture u95.png\n"
      "The part is scanned in software by the rig and its covariance, and inspected.");
  auto arguments = std::make_shared<PlanScanArguments>();
  verb->add_option("PART", arguments->reference, "the nominal part: .step, .iges, or a mesh")
      ->required();
  verb->add_option("--rig", arguments->rig, "name of a rig, or a rig.toml")->capture_default_str();
  verb->add_option("--plan", arguments->plan, "inspection.toml: what is to be decided");
  verb->add_option("--tolerance",
                   arguments->tolerance_mm,
                   "tolerance of the surface, mm: T for plus and minus T, or LOWER,UPPER; 0.1 by "
                   "default")
      ->transform(a_length())
      ->delimiter(',')
      ->expected(1, 2);
  verb->add_option("-o,--output",
                   arguments->output,
                   "write the nominal surface with the predicted u95_mm as .ply; NaN: not seen");
  verb->add_option("--picture", arguments->picture, "draw the predicted U95 into this .png");
  verb->add_option(
          "--from", arguments->from_deg, "direction of the viewer: azimuth,elevation, degrees")
      ->delimiter(',')
      ->expected(2)
      ->capture_default_str();
  verb->add_option("--views", arguments->views, "turntable stations to begin with")
      ->check(from_to(1, 360));
  verb->add_option("--setups",
                   arguments->tilts_deg,
                   "tilts of the part in further setups to begin with, degrees, such as 180")
      ->delimiter(',')
      ->check(from_to(-360.0, 360.0));
  verb->add_flag("--no-search", arguments->no_search, "predict what the first scan reaches alone");
  verb->add_flag(
      "--quick",
      arguments->quick,
      "predict with few pixels of the cameras: in seconds, but up to four times too uncertain");
  add_assumptions(*verb, arguments->options.scan);
  add_allow_memory(*verb, arguments->read);
  verb->callback([arguments, &terminal] { plan_a_scan(*arguments, terminal); });
}

}  // namespace frangia
