#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "frangia/core/durable_file.h"
#include "frangia/inspection/write_inspection_plan.h"
#include "frangia/report/inspection_json.h"
#include "frangia/report/qif_results.h"
#include "frangia/report/write_report.h"

#include "counted.h"
#include "exit_codes.h"
#include "inspect_batch.h"
#include "inspect_options.h"
#include "inspect_outputs.h"
#include "inspect_picture.h"
#include "inspect_plan.h"
#include "inspect_text.h"
#include "option_values.h"
#include "part_inspector.h"
#include "print_text.h"
#include "usage.h"
#include "verbs.h"

namespace frangia {
namespace {

/// Writes the files that the arguments ask for and names them in the JSON. Returns their names, in
/// the order in which the program prints them.
std::vector<std::string> write_files(const InspectArguments& arguments,
                                     const InspectionPlan& plan,
                                     const Inspection& part,
                                     const Scan* scan,
                                     nlohmann::ordered_json& json,
                                     Terminal& terminal) {
  const Run run = terminal.run();
  std::vector<std::string> written;
  if (!arguments.picture.empty()) {
    draw_picture(arguments, part, run);
    written.push_back(arguments.picture.string());
  }
  for (const auto& path : arguments.outputs) {
    write_deviations(path, part, arguments.scale_mm, run);
    written.push_back(path.string());
  }
  if (!arguments.report.empty()) {
    const ReportSources sources{.mesh = arguments.meshes.front(),
                                .reference = plan.reference,
                                .scan = scan,
                                .version = "Frangia " FRANGIA_VERSION,
                                .warnings = terminal.sentences(),
                                .scale_mm = arguments.scale_mm};
    for (std::string& path : write_report(arguments.report, part, plan, sources, run))
      written.push_back(std::move(path));
  }
  if (!arguments.qif.empty()) {
    write_text_file(arguments.qif,
                    qif_of({part.named_features, part.characteristics, part.verdict}));
    written.push_back(arguments.qif.string());
    json["qif"] = arguments.qif.string();
  }
  if (!arguments.picture.empty()) json["picture"] = arguments.picture.string();
  if (!arguments.report.empty()) json["report"] = arguments.report.string();
  return written;
}

/// What was written where no mesh is inspected.
void print_plan(const InspectArguments& arguments, const InspectionPlan& plan, Terminal& terminal) {
  terminal.finish();
  if (terminal.json) {
    print_json({{"plan", arguments.write_plan.string()},
                {"features", plan.features.size()},
                {"characteristics", plan.characteristics.size()},
                {"warnings", terminal.warnings()}});
    return;
  }
  terminal.print_written(fmt::format("{}: {} and {}",
                                     arguments.write_plan.string(),
                                     counted(plan.features.size(), "feature"),
                                     counted(plan.characteristics.size(), "characteristic")));
}

void inspect(InspectArguments arguments, Terminal& terminal) {
  const Run run = terminal.run();
  const InspectionPlan plan = plan_of(arguments, run);
  if (arguments.show == "deviation" && plan.reference.empty() && plan.thickness)
    arguments.show = "thickness";
  check_inspect_arguments(arguments, plan);
  if (!arguments.write_plan.empty())
    write_inspection_plan(std::filesystem::absolute(arguments.write_plan), plan);
  if (arguments.meshes.empty()) {
    print_plan(arguments, plan, terminal);
    return;
  }
  if (!arguments.batch.empty()) {
    inspect_batch(arguments, plan, terminal);
    return;
  }
  require_usage(arguments.meshes.size() == 1,
                "several meshes are inspected by --plan and --batch; name one mesh, or add these");
  const PartInspector inspector(arguments, plan, run);
  const Inspection part = inspector.inspect(arguments.meshes.front(), run);
  auto json = nlohmann::ordered_json::parse(inspection_json(part));
  const std::vector<std::string> written =
      write_files(arguments, plan, part, inspector.scan(), json, terminal);
  terminal.finish();
  for (const auto& [stage, seconds] : terminal.stage_seconds())
    json["seconds"][stage] = seconds;
  if (arguments.fail_out_of_tolerance && part.verdict == Conformity::Out)
    terminal.exit_code = OutOfTolerance;
  if (terminal.json) {
    print_json(json);
  } else {
    write_output(inspection_text(part, arguments.features));
  }
  if (!arguments.write_plan.empty()) terminal.print_written(arguments.write_plan.string());
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
      "  frangia inspect --plan-from part.stp --write-plan inspection.toml\n"
      "  frangia inspect a.ply b.ply --plan inspection.toml --batch batch.html");
  add_inspect_options(*verb, *arguments);
  verb->callback([arguments, &terminal] { inspect(*arguments, terminal); });
}

}  // namespace frangia
