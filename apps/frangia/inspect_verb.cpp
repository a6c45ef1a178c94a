#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "frangia/report/qif_results.h"

#include "exit_codes.h"
#include "inspect_batch.h"
#include "inspect_comparison.h"
#include "inspect_mesh.h"
#include "inspect_options.h"
#include "inspect_picture.h"
#include "inspect_plan.h"
#include "inspect_reference.h"
#include "option_values.h"
#include "print_text.h"
#include "usage.h"
#include "verbs.h"

namespace frangia {
namespace {

/// The decision about the part, by its deviations and its characteristics.
Conformity verdict_of_part(const InspectedPart& part) {
  InspectionReport report;
  if (part.comparison) report.surface = part.comparison->verdict;
  report.characteristics = part.characteristics;
  return verdict_of(report);
}

/// Writes what the arguments ask for and names it in the answer. The names of the files, in the
/// order in which they are told.
std::vector<std::string> write_files(const InspectArguments& arguments,
                                     const InspectionPlan& plan,
                                     const InspectedPart& part,
                                     InspectAnswer& answer,
                                     Terminal& terminal) {
  const Run run = terminal.run();
  std::vector<std::string> written;
  if (!arguments.picture.empty()) {
    draw_picture(arguments, part, run);
    written.push_back(arguments.picture.string());
  }
  for (const auto& path : arguments.outputs) {
    write_deviations(path, arguments, part, run);
    written.push_back(path.string());
  }
  if (!arguments.report.empty()) {
    for (std::string& path : write_report(arguments, plan, part, answer, terminal.warnings(), run))
      written.push_back(std::move(path));
  }
  if (!arguments.qif.empty()) {
    write_report_text(arguments.qif,
                      qif_of({part.named_features, part.characteristics, verdict_of_part(part)}));
    written.push_back(arguments.qif.string());
    answer.json["qif"] = arguments.qif.string();
  }
  if (!arguments.picture.empty()) answer.json["picture"] = arguments.picture.string();
  if (!arguments.report.empty()) answer.json["report"] = arguments.report.string();
  return written;
}

void inspect(InspectArguments arguments, Terminal& terminal) {
  const Run run = terminal.run();
  const InspectionPlan plan = plan_of(arguments);
  apply_plan(plan, arguments);
  if (arguments.show == "deviation" && arguments.reference.empty() && arguments.thickness)
    arguments.show = "thickness";
  arguments.mesh = arguments.meshes.front();
  check_inspect_arguments(arguments, plan);
  if (!arguments.batch.empty()) {
    inspect_batch(std::move(arguments), plan, terminal);
    return;
  }
  require_usage(arguments.meshes.size() == 1,
                "several meshes are inspected by --plan and --batch; name one mesh, or add these");
  InspectAnswer answer;
  const std::optional<Reference> reference = read_reference(arguments, run);
  const InspectedPart part = inspect_mesh(arguments, plan, reference, answer, run);
  const std::vector<std::string> written = write_files(arguments, plan, part, answer, terminal);
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
  add_inspect_options(*verb, *arguments);
  verb->callback([arguments, &terminal] { inspect(*arguments, terminal); });
}

}  // namespace frangia
