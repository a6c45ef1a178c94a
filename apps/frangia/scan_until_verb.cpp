#include "scan_until_verb.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "frangia/acquisition/capture_scan.h"
#include "frangia/acquisition/plan_setup.h"
#include "frangia/core/error.h"
#include "frangia/inspection/inspection_plan.h"
#include "frangia/scan_plan/scan_until.h"

#include "exit_codes.h"
#include "option_names.h"
#include "print_text.h"

namespace frangia {
namespace {

void print_rounds(const ScanUntil& done, const Scan& plan, Terminal& terminal) {
  terminal.finish();
  if (terminal.json) {
    nlohmann::ordered_json rounds = nlohmann::ordered_json::array();
    for (const ScanRound& round : done.rounds) {
      rounds.push_back({{"stations", round.stations},
                        {"needs", name_of(round.reach.need)},
                        {"decidable_share", round.reach.decidable_share},
                        {"decidable", round.reach.decidable}});
    }
    print_json({{"scan", plan.folder.string()},
                {"verdict", name_of(done.found.verdict)},
                {"stop", with_flags(text_of(done.stop))},
                {"rounds", rounds},
                {"warnings", terminal.warnings()}});
    return;
  }
  std::string text;
  for (const ScanRound& round : done.rounds) {
    text += fmt::format("{} stations: {} of the nominal area decided, needs {}\n",
                        round.stations,
                        share_text(round.reach.decidable_share),
                        name_of(round.reach.need));
  }
  for (const VerdictReason& reason : done.found.reasons)
    text += reason.text() + "\n";
  write_output(text + with_flags(text_of(done.stop)) + "\n");
  terminal.print_written(plan.folder.string());
}

}  // namespace

void scan_until_decided(const Scan& plan,
                        const std::filesystem::path& inspection_plan,
                        RigDevices& devices,
                        const FolderLock& lock,
                        const CaptureOptions& options,
                        Terminal& terminal) {
  const Run run = terminal.run();
  const InspectionPlan inspection = read_inspection_plan(inspection_plan);
  if (inspection.reference.empty()) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: names no reference, which the scan is compared with; add it",
                            inspection_plan.string()));
  }
  const InspectionReference reference =
      read_inspection_reference(inspection.reference, {.unit_mm = inspection.unit_mm}, run);
  const auto capture = [&](const Scan& round, int setup) {
    CaptureOptions own = options;
    own.setup = setup;
    run.stage("scan");
    const CaptureReport report = capture_scan(plan_setup(round, setup), devices, lock, own, run);
    if (!report.skipped.empty()) terminal.exit_code = DeviceFault;
    return read_scan(plan.folder, run);
  };
  print_rounds(scan_until(plan, capture, reference, inspection, 4, run), plan, terminal);
}

}  // namespace frangia
