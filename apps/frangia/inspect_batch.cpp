#include "inspect_batch.h"

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "frangia/core/durable_file.h"
#include "frangia/core/error.h"
#include "frangia/core/text.h"
#include "frangia/report/batch.h"
#include "frangia/report/inspection_report.h"

#include "exit_codes.h"
#include "json_number.h"
#include "option_values.h"
#include "part_inspector.h"
#include "print_text.h"
#include "usage.h"

namespace frangia {

void inspect_batch(const InspectArguments& arguments,
                   const InspectionPlan& plan,
                   Terminal& terminal) {
  const Run run = terminal.run();
  require_usage(arguments.qif.empty(), "--qif states one part, not a batch; leave out --batch");
  require_usage(!plan.features.empty(),
                "--batch compares the characteristics of a --plan; give one with [[features]]");
  const PartInspector inspector(arguments, plan, run);
  std::vector<BatchPart> parts;
  bool out = false;
  for (const auto& mesh : arguments.meshes) {
    try {
      const Inspection part = inspector.inspect(mesh, run);
      out = out || part.verdict == Conformity::Out;
      parts.push_back({mesh.filename().string(),
                       part.characteristics,
                       part.verdict,
                       part.reasons.empty() ? "" : part.reasons.front().text()});
    } catch (const Error& error) {
      // One wrong file must not cost the others.
      if (error.kind() == ErrorKind::Cancelled || arguments.meshes.size() == 1) throw;
      run.warn(fmt::format("{} was not inspected: {}", mesh.filename().string(), error.what()));
      parts.push_back({mesh.filename().string(), {}, Conformity::Undecided, error.what(), false});
    }
  }
  const auto inspected = static_cast<std::size_t>(
      std::count_if(parts.begin(), parts.end(), [](const auto& part) { return part.inspected; }));
  if (inspected == 0) {
    throw Error(ErrorKind::Input,
                fmt::format("none of the {} meshes could be inspected; {}: {}",
                            parts.size(),
                            parts.front().name,
                            parts.front().reason));
  }
  const auto characteristics = batch_characteristics(parts);
  const std::string csv = batch_csv(parts, characteristics);
  const bool page = lowercase_extension(arguments.batch) == ".html";
  const std::string title = plan.part.empty() ? "Batch" : "Batch: " + plan.part;
  write_text_file(arguments.batch, page ? batch_html(title, parts, characteristics) : csv);
  terminal.finish();
  if (inspected < parts.size()) terminal.exit_code = BadInput;
  if (arguments.fail_out_of_tolerance && out) terminal.exit_code = OutOfTolerance;
  if (terminal.json) {
    nlohmann::ordered_json json;
    json["parts"] = parts.size();
    for (const BatchPart& part : parts) {
      json["verdicts"].push_back(
          {{"mesh", part.name},
           {"verdict", part.inspected ? nlohmann::ordered_json(name_of(part.verdict)) : nullptr},
           {"reason", part.reason}});
    }
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

}  // namespace frangia
