#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "frangia/features/find_features.h"
#include "frangia/files/write_mesh.h"
#include "frangia/geometry/transform_mesh.h"

#include "allow_memory.h"
#include "exit_codes.h"
#include "inspect_alignment.h"
#include "inspect_arguments.h"
#include "inspect_comparison.h"
#include "inspect_features.h"
#include "inspect_picture.h"
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
  require(arguments.outputs.empty() || !arguments.reference.empty(),
          "-o writes the mesh with its deviations; give a --reference to measure them against");
  require(!arguments.fail_out_of_tolerance || !arguments.reference.empty(),
          "--fail-out-of-tolerance needs a --reference to measure against; give one");
  static_cast<void>(alignment.band());
  require(alignment.start == 0 || alignment.align == "best-fit",
          "--start chooses a pose of --align best-fit; add it");
  for (const auto& path : arguments.outputs) {
    check_deviation_output(path);
  }
}

Mesh read_reference(const InspectArguments& arguments, const Run& run) {
  Mesh reference = read_surface(arguments.reference, run, arguments.read);
  if (arguments.unit_mm == 1.0) return reference;
  for (auto& vertex : reference.vertices_mm)
    vertex *= static_cast<float>(arguments.unit_mm);
  return reference;
}

void inspect(const InspectArguments& arguments, Terminal& terminal) {
  const Run run = terminal.run();
  const bool drawn = !arguments.picture.empty();
  require(!arguments.reference.empty() || drawn || arguments.features,
          "nothing to do: give a --reference to measure against, --features, or a --picture to "
          "draw");
  if (drawn) check_picture_output(arguments.picture);
  check_alignment(arguments);
  Mesh mesh = read_surface(arguments.mesh, run, arguments.read);
  if (drawn) check_shown(arguments, mesh);
  std::optional<RayScene> reference;
  if (!arguments.reference.empty()) reference.emplace(read_reference(arguments, run), run);
  InspectAnswer answer;
  std::optional<Alignment> alignment;
  if (!arguments.alignment.align.empty()) {
    alignment = align(mesh, *reference, arguments.alignment, run);
    add_alignment(answer.json, *alignment);
    answer.text += alignment_text(*alignment);
    mesh = transform_mesh(std::move(mesh), alignment->pose.reference_from_mesh);
  }
  if (arguments.features) {
    const std::vector<Feature> features = find_features(mesh, {}, run);
    add_features(answer.json, features);
    answer.text += feature_table(features);
  }
  std::optional<Comparison> comparison;
  if (reference) {
    comparison = compare_with(arguments, mesh, *reference, alignment, run);
    add_statistics(answer, arguments, mesh, *reference, run);
    add_deviations(answer, *comparison);
  }
  if (drawn) draw_picture(arguments, mesh, comparison, run);
  for (const auto& path : arguments.outputs)
    write_deviations(path, arguments, mesh, *comparison, run);
  if (drawn) answer.json["picture"] = arguments.picture.string();
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
}

}  // namespace

void add_inspect_verb(CLI::App& program, Terminal& terminal) {
  auto arguments = std::make_shared<InspectArguments>();
  CLI::App* verb = program.add_subcommand("inspect", "measure a mesh against a reference");
  verb->footer(
      "example:\n  frangia inspect bust.ply --reference bust-scan/truth.ply --scan bust-scan "
      "--picture bust.png\n"
      "  frangia inspect blade.ply --reference nominal.stl --align best-fit -o aligned.ply\n"
      "  frangia inspect shaft.ply --features");
  verb->add_option("MESH", arguments->mesh, "the measured mesh")->required();
  verb->add_option("--reference",
                   arguments->reference,
                   "the reference mesh, in the frame of the mesh unless --align finds its pose");
  verb->add_option("--units",
                   arguments->unit_mm,
                   "unit of the reference: um, mm (default), cm, m, in, ft, or its length")
      ->transform(unit_length());
  add_alignment_options(*verb, arguments->alignment);
  verb->add_option("-o,--output",
                   arguments->outputs,
                   "write the aligned mesh with its deviations: .ply with deviation_mm, .csv, "
                   "other formats with colors; may repeat")
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
  verb->add_option("--scan",
                   arguments->scan,
                   "completeness counts only what the views of this scan can measure");
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
          "what its colors show: deviation, sigma, views (their number), marks, or shape for "
          "none")
      ->check(one_of({"deviation", "sigma", "views", "marks", "shape"}))
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
