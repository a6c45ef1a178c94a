// Above 250 lines: half of it are the options and their help.
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "frangia/core/lowercase_extension.h"
#include "frangia/features/find_features.h"
#include "frangia/features/thermal_displacement.h"
#include "frangia/files/write_mesh.h"
#include "frangia/geometry/transform_mesh.h"
#include "frangia/pipeline/calibration_displacements.h"
#include "frangia/report/batch.h"
#include "frangia/report/planned_nominals.h"
#include "frangia/report/qif_results.h"

#include "allow_memory.h"
#include "check_can_write.h"
#include "exit_codes.h"
#include "inspect_alignment.h"
#include "inspect_arguments.h"
#include "inspect_comparison.h"
#include "inspect_datums.h"
#include "inspect_features.h"
#include "inspect_picture.h"
#include "inspect_plan.h"
#include "inspect_reference.h"
#include "inspect_report.h"
#include "json_number.h"
#include "option_values.h"
#include "picture_file.h"
#include "print_text.h"
#include "read_surface.h"
#include "verbs.h"

namespace frangia {
namespace {

/// Checks before the work that the options of the alignment go together.
void check_alignment(const InspectArguments& arguments) {
  const AlignmentArguments& alignment = arguments.alignment;
  require(alignment.align.empty() || !arguments.reference.empty(),
          "--align needs a --reference to align the mesh to; give one");
  require(arguments.outputs.empty() || !arguments.reference.empty() || arguments.thickness,
          "-o writes the mesh with its deviations or its thickness; give a --reference to measure "
          "against, or --thickness");
  require(!arguments.fail_out_of_tolerance || !arguments.reference.empty(),
          "--fail-out-of-tolerance needs a --reference to measure against; give one");
  static_cast<void>(alignment.band());
  require(alignment.start == 0 || alignment.align == "best-fit" || alignment.align == "datum",
          "--start chooses a pose of --align best-fit; add it");
  for (const auto& path : arguments.outputs) {
    check_deviation_output(path);
    if (arguments.reference.empty() && lowercase_extension(path) != ".ply") {
      throw Error(ErrorKind::Input,
                  fmt::format("{}: the thickness alone is written as .ply", path.string()));
    }
  }
}

/// Checks before the work what can be checked.
void check_arguments(const InspectArguments& arguments, const InspectionPlan& plan) {
  const bool drawn = !arguments.picture.empty();
  const bool planned = !plan.features.empty() || !plan.sections.empty();
  require(
      !arguments.reference.empty() || drawn || arguments.features || arguments.thickness || planned,
      "nothing to do: give a --reference to measure against, --features, --thickness, --plan, "
      "--section, or a --picture to draw");
  if (drawn) check_picture_output(arguments.picture);
  require(arguments.qif.empty() || !plan.features.empty(),
          "--qif states the characteristics of a --plan; give one with [[features]]");
  for (const auto& path : {arguments.report, arguments.batch, arguments.qif})
    if (!path.empty()) check_can_write(path);
  if (!arguments.report.empty() && lowercase_extension(arguments.report) != ".html") {
    throw Error(ErrorKind::Input,
                fmt::format("{}: reports are pages of HTML; use a name that ends in .html",
                            arguments.report.string()));
  }
  check_alignment(arguments);
  require(arguments.alignment.align != "datum" || !plan.datums.empty(),
          "--align datum needs a --plan whose `datums` name one to three of its [[features]]");
}

/// Finds what moves all features alike: the calibration of the rig and the temperature. The mesh
/// still has the frame of its scan.
void add_shared_errors(const InspectArguments& arguments, InspectedPart& part, const Run& run) {
  constexpr double kPerMillion = 1e-6;
  if (!arguments.scan.empty()) {
    part.shared_mm = calibration_displacements(part.mesh, read_scan(arguments.scan, run), run);
    part.knows_calibration = part.shared_mm.size() > 0;
  }
  if (!(arguments.expansion_ppm_per_k * arguments.temperature_u_k > 0.0)) return;
  const Eigen::MatrixXf thermal = thermal_displacement(
      part.mesh, kPerMillion * arguments.expansion_ppm_per_k, arguments.temperature_u_k);
  part.shared_mm.conservativeResize(part.shared_mm.rows() + 1, thermal.cols());
  part.shared_mm.bottomRows(1) = thermal;
}

/// Finds the features of the mesh and measures those of the plan.
void inspect_features(const InspectArguments& arguments,
                      InspectionPlan plan,
                      const std::optional<Reference>& reference,
                      InspectedPart& part,
                      InspectAnswer& answer,
                      const Run& run) {
  if (reference && reference->cad) {
    state_nominals(plan.features, reference->cad->faces(), arguments.plan);
  } else {
    check_without_cad(plan.features, arguments.plan);
  }
  if (!arguments.features && plan.features.empty()) return;
  run.stage("features");
  part.features = find_features(part.mesh, {.calibration_mm = &part.shared_mm}, run);
  std::vector<MeasuredFeature> measured;
  if (!plan.features.empty() || (reference && reference->cad))
    measured = with_points(part.mesh, part.features, run);
  if (reference) part.nominals = nominal_faces(*reference, measured);
  add_features(answer.json, part.features, part.nominals);
  if (arguments.features) answer.text += feature_table(part.features, part.nominals);
  if (plan.features.empty()) return;
  part.characteristics = measure_characteristics(plan, measured, run);
  part.named_features = named_features(plan, measured);
}

/// Inspects one mesh.
InspectedPart inspect_mesh(const InspectArguments& arguments,
                           const InspectionPlan& plan,
                           const std::optional<Reference>& reference,
                           InspectAnswer& answer,
                           const Run& run) {
  InspectedPart part;
  part.mesh = read_surface(arguments.mesh, run, arguments.read);
  if (!arguments.picture.empty()) check_shown(arguments, part.mesh);
  if (arguments.features || !plan.features.empty()) add_shared_errors(arguments, part, run);
  if (reference) add_reference(answer, *reference);
  if (!arguments.alignment.align.empty()) {
    DatumFit fit;
    if (arguments.alignment.align == "datum") {
      fit = align_by_datums(arguments, plan, part.mesh, *reference, run);
    } else {
      fit.alignment = align(part.mesh, reference->scene, arguments.alignment, run);
    }
    part.alignment = std::move(fit.alignment);
    add_alignment(answer.json, *part.alignment);
    answer.text += alignment_text(*part.alignment);
    if (!fit.residuals.empty()) add_datums(answer.json, fit.residuals);
    answer.text += datum_text(fit.residuals);
    part.mesh = transform_mesh(std::move(part.mesh), part.alignment->pose.reference_from_mesh);
  }
  inspect_features(arguments, plan, reference, part, answer, run);
  if (reference) {
    part.comparison = compare_with(arguments, part.mesh, *reference, part.alignment, run);
    add_statistics(answer, arguments, part.mesh, *reference, run);
    add_deviations(answer, *part.comparison);
  }
  if (arguments.thickness) {
    part.walls = measure_walls(part.mesh, run);
    add_thickness(answer, *part.walls);
  }
  part.sections =
      cut_sections(plan, part.mesh, reference ? &reference->scene : nullptr, part.comparison, run);
  add_results(answer, part);
  return part;
}

/// The decision about the part, by its deviations and its characteristics.
Conformity verdict_of_part(const InspectedPart& part) {
  InspectionReport report;
  if (part.comparison) report.deviation = part.comparison->summary;
  report.characteristics = part.characteristics;
  return verdict_of(report);
}

/// Inspects each mesh by the plan and writes the table.
void inspect_batch(InspectArguments arguments, const InspectionPlan& plan, Terminal& terminal) {
  const Run run = terminal.run();
  require(arguments.qif.empty(), "--qif states one part, not a batch; leave out --batch");
  require(!plan.features.empty(),
          "--batch compares the characteristics of a --plan; give one with [[features]]");
  const std::optional<Reference> reference = read_reference(arguments, run);
  std::vector<BatchPart> parts;
  bool out = false;
  for (const auto& mesh : arguments.meshes) {
    arguments.mesh = mesh;
    InspectAnswer answer;
    const InspectedPart part = inspect_mesh(arguments, plan, reference, answer, run);
    out = out || answer.verdict == Conformity::Out;
    parts.push_back({mesh.filename().string(), part.characteristics});
  }
  const auto characteristics = batch_characteristics(parts);
  const std::string csv = batch_csv(parts, characteristics);
  const bool page = lowercase_extension(arguments.batch) == ".html";
  const std::string title = plan.part.empty() ? "Batch" : "Batch: " + plan.part;
  write_report_text(arguments.batch, page ? batch_html(title, parts, characteristics) : csv);
  terminal.finish();
  if (arguments.fail_out_of_tolerance && out) terminal.exit_code = OutOfTolerance;
  if (terminal.json) {
    nlohmann::ordered_json json;
    json["parts"] = parts.size();
    for (const BatchCharacteristic& one : characteristics) {
      json["characteristics"].push_back({{"name", one.name},
                                         {"mean", number_or_null(one.mean)},
                                         {"standard_deviation", number_or_null(one.deviation)},
                                         {"cp", number_or_null(one.cp)},
                                         {"cpk", number_or_null(one.cpk)},
                                         {"cpk_lower_95", number_or_null(one.cpk_lower_95)}});
    }
    json["batch"] = arguments.batch.string();
    print_json(json);
  } else {
    write_output(csv);
  }
  terminal.print_written(arguments.batch.string());
}

void inspect(InspectArguments arguments, Terminal& terminal) {
  const Run run = terminal.run();
  const InspectionPlan plan = plan_of(arguments, run);
  apply_plan(plan, arguments);
  if (arguments.show == "deviation" && arguments.reference.empty() && arguments.thickness)
    arguments.show = "thickness";
  arguments.mesh = arguments.meshes.front();
  check_arguments(arguments, plan);
  if (!arguments.batch.empty()) {
    inspect_batch(std::move(arguments), plan, terminal);
    return;
  }
  require(arguments.meshes.size() == 1,
          "several meshes are inspected by --plan and --batch; name one mesh, or add these");
  InspectAnswer answer;
  const std::optional<Reference> reference = read_reference(arguments, run);
  const InspectedPart part = inspect_mesh(arguments, plan, reference, answer, run);
  const bool drawn = !arguments.picture.empty();
  if (drawn) draw_picture(arguments, part, run);
  for (const auto& path : arguments.outputs)
    write_deviations(path, arguments, part, run);
  std::vector<std::string> written;
  if (!arguments.report.empty())
    written = write_report(arguments, plan, part, answer, terminal.warnings(), run);
  if (!arguments.qif.empty()) {
    write_report_text(arguments.qif,
                      qif_of({part.named_features, part.characteristics, verdict_of_part(part)}));
    written.push_back(arguments.qif.string());
    answer.json["qif"] = arguments.qif.string();
  }
  if (drawn) answer.json["picture"] = arguments.picture.string();
  if (!arguments.report.empty()) answer.json["report"] = arguments.report.string();
  terminal.finish();
  for (const auto& [stage, seconds] : terminal.stage_seconds())
    answer.json["seconds"][stage] = seconds;
  if (arguments.fail_out_of_tolerance && answer.verdict == Conformity::Out)
    terminal.exit_code = OutOfTolerance;
  if (terminal.json) {
    print_json(answer.json);
  } else {
    write_output(answer.text);
  }
  if (drawn) terminal.print_written(arguments.picture.string());
  for (const auto& path : arguments.outputs)
    terminal.print_written(path.string());
  for (const std::string& path : written)
    terminal.print_written(path);
}

}  // namespace

void add_inspect_verb(CLI::App& program, Terminal& terminal) {
  auto arguments = std::make_shared<InspectArguments>();
  CLI::App* verb = program.add_subcommand("inspect", "measure a mesh against a reference");
  verb->footer(
      "example:\n  frangia inspect bust.ply --reference bust-scan/truth.ply --scan bust-scan "
      "--picture bust.png\n"
      "  frangia inspect blade.ply --reference nominal.stl --align best-fit -o aligned.ply\n"
      "  frangia inspect blade.ply --reference nominal.step --align best-fit --features\n"
      "  frangia inspect shaft.ply --features\n"
      "  frangia inspect shaft.ply --plan inspection.toml --report report.html\n"
      "  frangia inspect a.ply b.ply --plan inspection.toml --batch batch.html");
  verb->add_option("MESH", arguments->meshes, "the measured mesh; several for --batch")->required();
  verb->add_option("--plan",
                   arguments->plan,
                   "inspection.toml: reference, alignment, tolerances, features and sections of a "
                   "part");
  verb->add_option("--report",
                   arguments->report,
                   "write a report as one .html page, and .json and .csv files of the same name");
  verb->add_option("--qif",
                   arguments->qif,
                   "write the characteristics of the plan and their features as QIF 3.0 results");
  verb->add_option("--batch",
                   arguments->batch,
                   "inspect several meshes by the plan and write a table with mean, Cp and Cpk: "
                   ".csv, or .html with trends");
  verb->add_option("--section",
                   arguments->sections,
                   "cut by a plane such as z=60; --report writes it as DXF and SVG; may repeat")
      ->check(a_section())
      ->allow_extra_args(false);
  verb->add_flag("--blade",
                 arguments->blade,
                 "the sections are profiles of a blade: chord, thickness, edge radii, stagger");
  verb->add_option(
      "--reference",
      arguments->reference,
      "the reference, in the frame of the mesh unless --align finds its pose: a mesh, or a "
      "CAD model (.step, .iges), to whose faces deviations are measured");
  verb->add_option(
          "--units",
          arguments->unit_mm,
          "unit of the reference: um, mm (default), cm, m, in, ft, or its length; CAD files "
          "state theirs")
      ->transform(unit_length());
  add_alignment_options(*verb, arguments->alignment);
  verb->add_option("-o,--output",
                   arguments->outputs,
                   "write the aligned mesh with its deviations: .ply with deviation_mm (and "
                   "thickness_mm), .csv, other formats with colors; may repeat")
      ->allow_extra_args(false);
  verb->add_flag("--fail-out-of-tolerance",
                 arguments->fail_out_of_tolerance,
                 "end with exit code 1 when the part is out of tolerance");
  verb->add_option("--expansion",
                   arguments->expansion_ppm_per_k,
                   "coefficient of thermal expansion of the part, 1e-6/K")
      ->check(zero_or_more());
  verb->add_option("--temperature-u",
                   arguments->temperature_u_k,
                   "standard uncertainty of the difference of its temperature from 20 degrees, K")
      ->check(zero_or_more());
  verb->add_flag("--features",
                 arguments->features,
                 "find planes, cylinders, spheres, cones and tori, and the lines and circles where "
                 "they meet, with the uncertainty of their sizes");
  verb->add_flag("--thickness",
                 arguments->thickness,
                 "measure the distance from each vertex to the opposite wall");
  verb->add_option("--scan",
                   arguments->scan,
                   "the scan of the mesh: completeness counts what its views can measure, and "
                   "features hold the covariance of its rig");
  verb->add_option("--within",
                   arguments->within_mm,
                   "a point of the reference is covered by mesh within this distance, mm")
      ->transform(length_above_zero())
      ->capture_default_str();
  verb->add_option(
          "--max-angle",
          arguments->max_angle_deg,
          "a view can measure surfaces whose normal is within this angle of camera and projector, "
          "degrees")
      ->check(from_to(1.0, 90.0))
      ->capture_default_str();
  verb->add_option(
      "--picture", arguments->picture, "draw the mesh into this .png, with a color scale");
  verb->add_option("--width", arguments->width_px, "of the picture without its scale, pixels")
      ->check(from_to(16, 16'384))
      ->capture_default_str();
  verb->add_option("--height", arguments->height_px, "of the picture, pixels")
      ->check(from_to(16, 16'384))
      ->capture_default_str();
  verb->add_option(
          "--show",
          arguments->show,
          "what its colors show: deviation, thickness, sigma, views (their number), marks, or "
          "shape for none")
      ->check(one_of({"deviation", "thickness", "sigma", "views", "marks", "shape"}))
      ->capture_default_str();
  verb->add_option(
          "--from", arguments->from_deg, "direction of the viewer: azimuth,elevation, degrees")
      ->delimiter(',')
      ->expected(2)
      ->capture_default_str();
  verb->add_option("--scale",
                   arguments->scale_mm,
                   "deviation or sigma at the end of the color scale, mm; by default 1.5 times the "
                   "tolerance, or 0.1 for sigma")
      ->transform(length_above_zero());
  verb->add_flag("!--no-legend", arguments->legend, "leave out the color scale");
  add_allow_memory(*verb, arguments->read);
  verb->callback([arguments, &terminal] { inspect(*arguments, terminal); });
}

}  // namespace frangia
