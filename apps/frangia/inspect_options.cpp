#include "inspect_options.h"

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/core/text.h"
#include "frangia/report/report_pictures.h"

#include "allow_memory.h"
#include "check_can_write.h"
#include "inspect_outputs.h"
#include "inspect_plan.h"
#include "option_values.h"
#include "picture_file.h"
#include "usage.h"

namespace frangia {
namespace {

/// Checks before the work that the options of the alignment and the outputs go together.
void check_alignment(const InspectArguments& arguments, const InspectionPlan& plan) {
  require_usage(plan.align.empty() || !plan.reference.empty(),
                "--align needs a --reference to align the mesh to; give one");
  require_usage(
      arguments.outputs.empty() || !plan.reference.empty() || plan.thickness,
      "-o writes the mesh with its deviations or its thickness; give a --reference to measure "
      "against, or --thickness");
  require_usage(!arguments.fail_out_of_tolerance || !plan.reference.empty(),
                "--fail-out-of-tolerance needs a --reference to measure against; give one");
  require_usage(plan.start == 0 || plan.align == "best-fit" || plan.align == "datum",
                "--start chooses a pose of --align best-fit; add it");
  require_usage(arguments.points.size() % 6 == 0,
                "--points takes six numbers: X,Y,Z on the mesh and X,Y,Z on the reference");
  require_usage(plan.align != "points" || plan.points.size() >= 3,
                "--align points needs --points three times or more, or [[points]] of a --plan");
  require_usage(plan.points.empty() || !plan.align.empty(),
                "--points are for --align best-fit, datum or points; add one");
  for (const auto& path : arguments.outputs) {
    check_deviation_output(path);
    if (plan.reference.empty() && lowercase_extension(path) != ".ply") {
      throw Error(ErrorKind::Input,
                  fmt::format("{}: the thickness alone is written as .ply", path.string()));
    }
  }
}

}  // namespace

void check_inspect_arguments(const InspectArguments& arguments, const InspectionPlan& plan) {
  require_usage(!arguments.meshes.empty() || !arguments.write_plan.empty(),
                "MESH is required: name the measured mesh, or a file for --write-plan");
  if (!arguments.write_plan.empty()) check_can_write(arguments.write_plan);
  if (arguments.meshes.empty()) return;
  if (!arguments.report.empty() && !plan.report.logo.empty())
    static_cast<void>(read_logo(plan.report.logo));
  const bool drawn = !arguments.picture.empty();
  const bool planned = !plan.features.empty() || !plan.sections.empty();
  require_usage(
      !plan.reference.empty() || drawn || arguments.features || plan.thickness || planned,
      "nothing to do: give a --reference to measure against, --features, --thickness, --plan, "
      "--section, or a --picture to draw");
  if (drawn) check_picture_output(arguments.picture);
  require_usage(arguments.qif.empty() || !plan.features.empty(),
                "--qif states the characteristics of a --plan; give one with [[features]]");
  for (const auto& path : {arguments.report, arguments.batch, arguments.qif})
    if (!path.empty()) check_can_write(path);
  if (!arguments.report.empty() && lowercase_extension(arguments.report) != ".html") {
    throw Error(ErrorKind::Input,
                fmt::format("{}: reports are pages of HTML; use a name that ends in .html",
                            arguments.report.string()));
  }
  check_alignment(arguments, plan);
  require_usage(
      plan.align != "datum" || !plan.datums.empty(),
      "--align datum needs a --plan whose `datums` name one to three of its [[features]]");
}

namespace {

void add_alignment_options(CLI::App& verb, InspectArguments& arguments) {
  verb.add_option(
          "--align",
          arguments.align,
          "move the mesh onto the reference first: best-fit, from any start or from "
          "--points; datum, by the datums of the --plan; points, by --points alone; none, as "
          "it stands, with its overlap")
      ->check(one_of({kAlignments.begin(), kAlignments.end()}));
  verb.add_option("--points",
                  arguments.points,
                  "the same place on mesh and reference, mm: X,Y,Z,X,Y,Z; three times or more")
      ->delimiter(',')
      ->expected(6)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->allow_extra_args(false);
  verb.add_option(
          "--start",
          arguments.start,
          "of the poses that --align best-fit lists because they fit alike, the one to take")
      ->check(from_to(1, 1000));
  verb.add_option("--tolerance",
                  arguments.tolerance_mm,
                  "tolerance of the deviations, mm: T for plus and minus T, or LOWER,UPPER; 0.1 "
                  "by default")
      ->transform(a_length())
      ->delimiter(',')
      ->expected(1, 2);
}

/// How the deviations are measured and judged.
void add_measure_options(CLI::App& verb, InspectArguments& arguments) {
  verb.add_option("-o,--output",
                  arguments.outputs,
                  "write the aligned mesh with its deviations: .ply with deviation_mm (and "
                  "thickness_mm), .csv, other formats with colors; may repeat")
      ->allow_extra_args(false);
  verb.add_flag("--fail-out-of-tolerance",
                arguments.fail_out_of_tolerance,
                "end with exit code 1 when the part is out of tolerance");
  verb.add_option("--expansion",
                  arguments.expansion_ppm_per_k,
                  "coefficient of thermal expansion of the part, 1e-6/K")
      ->check(zero_or_more());
  verb.add_option("--temperature-u",
                  arguments.temperature_u_k,
                  "standard uncertainty of the difference of its temperature from 20 degrees, K")
      ->check(zero_or_more());
  verb.add_flag("--features",
                arguments.features,
                "find planes, cylinders, spheres, cones and tori, and the lines and circles where "
                "they meet, with the uncertainty of their sizes");
  verb.add_flag("--thickness",
                arguments.thickness,
                "measure the distance from each vertex to the opposite wall");
  verb.add_option("--scan",
                  arguments.scan,
                  "the scan of the mesh: completeness counts what its views can measure, and "
                  "features hold the covariance of its rig");
  verb.add_option("--within",
                  arguments.within_mm,
                  "a point of the reference is covered by mesh within this distance, mm")
      ->transform(length_above_zero())
      ->capture_default_str();
  verb.add_option(
          "--max-angle",
          arguments.max_angle_deg,
          "a view can measure surfaces whose normal is within this angle of camera and projector, "
          "degrees")
      ->check(from_to(1.0, 90.0))
      ->capture_default_str();
}

void add_picture_options(CLI::App& verb, InspectArguments& arguments) {
  verb.add_option(
      "--picture", arguments.picture, "draw the mesh into this .png, with a color scale");
  verb.add_option("--width", arguments.width_px, "of the picture without its scale, pixels")
      ->check(from_to(16, 16'384))
      ->capture_default_str();
  verb.add_option("--height", arguments.height_px, "of the picture, pixels")
      ->check(from_to(16, 16'384))
      ->capture_default_str();
  verb.add_option(
          "--show",
          arguments.show,
          "what its colors show: deviation, thickness, sigma, views (their number), marks, or "
          "shape for none")
      ->check(one_of({"deviation", "thickness", "sigma", "views", "marks", "shape"}))
      ->capture_default_str();
  verb.add_option(
          "--from", arguments.from_deg, "direction of the viewer: azimuth,elevation, degrees")
      ->delimiter(',')
      ->expected(2)
      ->capture_default_str();
  verb.add_option("--scale",
                  arguments.scale_mm,
                  "deviation or sigma at the end of the color scale, mm; by default 1.5 times the "
                  "tolerance, or 0.1 for sigma")
      ->transform(length_above_zero());
  verb.add_flag("!--no-legend", arguments.legend, "leave out the color scale");
}

}  // namespace

void add_inspect_options(CLI::App& verb, InspectArguments& arguments) {
  verb.add_option("MESH", arguments.meshes, "the measured mesh; several for --batch");
  auto* plan =
      verb.add_option("--plan",
                      arguments.plan,
                      "inspection.toml: reference, alignment, tolerances, features and sections of "
                      "a part");
  verb.add_option("--plan-from",
                  arguments.plan_from,
                  "make the plan of the dimensions and tolerances (PMI) of this STEP AP242 file")
      ->excludes(plan);
  verb.add_option("--write-plan",
                  arguments.write_plan,
                  "write the plan, with what else the options state, as inspection.toml; needs no "
                  "MESH");
  verb.add_option("--report",
                  arguments.report,
                  "write a report as one .html page, and .json and .csv files of the same name");
  verb.add_option("--qif",
                  arguments.qif,
                  "write the characteristics of the plan and their features as QIF 3.0 results");
  verb.add_option("--batch",
                  arguments.batch,
                  "inspect several meshes by the plan and write a table with mean, Cp and Cpk: "
                  ".csv, or .html with trends");
  verb.add_option("--section",
                  arguments.sections,
                  "cut by a plane such as z=60; --report writes it as DXF and SVG; may repeat")
      ->check(a_section())
      ->allow_extra_args(false);
  verb.add_flag("--blade",
                arguments.blade,
                "the sections are profiles of a blade: chord, thickness, edge radii, stagger");
  verb.add_option(
      "--reference",
      arguments.reference,
      "the reference, in the frame of the mesh unless --align finds its pose: a mesh, or a "
      "CAD model (.step, .iges), to whose faces deviations are measured");
  verb.add_option(
          "--units",
          arguments.unit_mm,
          "unit of the reference: um, mm (default), cm, m, in, ft, or its length; CAD files "
          "state theirs")
      ->transform(unit_length());
  add_alignment_options(verb, arguments);
  add_measure_options(verb, arguments);
  add_picture_options(verb, arguments);
  add_allow_memory(verb, arguments.read);
  verb.add_option("--allow-time",
                  arguments.allow_time_s,
                  "processor time that reading a CAD reference may take, s; a large one may take "
                  "20 s for each MB")
      ->check(above_zero())
      ->capture_default_str();
}

}  // namespace frangia
