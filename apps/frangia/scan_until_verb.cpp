#include "scan_until_verb.h"

#include <cmath>
#include <vector>

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

/// The characteristics that are not certain enough for their tolerance.
std::vector<DecidableCharacteristic> uncertain_ones(const ScanUntil& done, double share) {
  std::vector<DecidableCharacteristic> rows = decidable_characteristics(done.found, share);
  std::erase_if(rows, [](const DecidableCharacteristic& row) { return row.is_decidable; });
  return rows;
}

void print_rounds(const ScanUntil& done, const Scan& plan, double share, Terminal& terminal) {
  terminal.finish();
  const std::vector<DecidableCharacteristic> uncertain =
      done.stop == ScanStop::Decided ? std::vector<DecidableCharacteristic>{}
                                     : uncertain_ones(done, share);
  if (terminal.json) {
    nlohmann::ordered_json rounds = nlohmann::ordered_json::array();
    for (const ScanRound& round : done.rounds) {
      rounds.push_back({{"stations", round.stations},
                        {"needs", name_of(round.reach.need)},
                        {"decidable_share", round.reach.decidable_share},
                        {"decidable", round.reach.decidable}});
    }
    nlohmann::ordered_json names = nlohmann::ordered_json::array();
    for (const DecidableCharacteristic& row : uncertain)
      names.push_back(row.name);
    print_json({{"scan", plan.folder.string()},
                {"verdict", name_of(done.found.verdict)},
                {"stop", with_flags(text_of(done.stop))},
                {"rounds", rounds},
                {"uncertain", names},
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
  for (const DecidableCharacteristic& row : uncertain) {
    text += std::isfinite(row.u95) ? fmt::format("{}: U95 {:.4f} {}, wanted is {:.4f} at most\n",
                                                 row.name,
                                                 row.u95,
                                                 row.unit,
                                                 share * row.half_width)
                                   : fmt::format("{}: was not measured\n", row.name);
  }
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
  const auto capture = [&](const Scan& round) {
    run.stage("scan");
    const CaptureReport report = capture_scan(plan_setup(round, 0), devices, lock, options, run);
    if (!report.skipped.empty()) terminal.exit_code = DeviceFault;
    return read_scan(plan.folder, run);
  };
  print_rounds(scan_until(plan, capture, reference, inspection, 4, run),
               plan,
               inspection.surface.well_measured_share(),
               terminal);
}

}  // namespace frangia
