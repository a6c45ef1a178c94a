#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "frangia/acceptance/acceptance_result.h"
#include "frangia/acceptance/certificate.h"
#include "frangia/acceptance/frame_checksums.h"
#include "frangia/core/durable_file.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/devices/device_settings.h"
#include "frangia/files/ply.h"
#include "frangia/reconstruct/reconstruct.h"
#include "frangia/report/inspection_report.h"

#include "accept_scans.h"
#include "exit_codes.h"
#include "fixed_text.h"
#include "json_number.h"
#include "print_text.h"
#include "text_table.h"
#include "verbs.h"

namespace frangia {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct AcceptArguments {
  fs::path plan;
  fs::path output;
  bool fail_out_of_tolerance = false;
};

Json json_of_ball(const MeasuredBall& ball) {
  return {{"diameter_mm", ball.diameter_mm},
          {"form_95_mm", ball.form_95_mm},
          {"form_all_mm", ball.form_all_mm},
          {"points", ball.points},
          {"seen", ball.seen}};
}

Json json_of_arrangement(const ArrangementResult& result) {
  Json json{{"name", result.name},
            {"scan", result.scan},
            {"files", result.frames},
            {"sha256", result.frames_sha256},
            {"balls", Json::array()}};
  for (const MeasuredBall& ball : result.measured.balls)
    json["balls"].push_back(json_of_ball(ball));
  const bool bar = result.measured.balls.size() == 2;
  json["spacing_mm"] = bar ? Json(result.measured.spacing_mm) : Json();
  json["length_mm"] = number_or_null(result.measured.length_mm);
  return json;
}

Json json_of_result(const AcceptanceResult& result,
                    const std::vector<ArrangementResult>& arrangements,
                    const CertificateFacts& facts) {
  Json json{{"created", facts.created},
            {"version", facts.version},
            {"verdict", result.judged ? Json(name_of(result.conformity)) : Json()},
            {"incomplete", result.incomplete},
            {"quantities", Json::array()},
            {"arrangements", Json::array()},
            {"warnings", facts.warnings}};
  for (const AcceptanceQuantity& quantity : result.quantities) {
    json["quantities"].push_back(
        {{"name", quantity.name},
         {"symbol", quantity.symbol},
         {"error_mm", quantity.error_mm},
         {"u95_mm", quantity.u95_mm},
         {"limit_mm", quantity.limit_mm ? Json(*quantity.limit_mm) : Json()},
         {"conformity", quantity.limit_mm ? Json(name_of(quantity.conformity)) : Json()},
         {"arrangement", quantity.arrangement + 1}});
  }
  for (const ArrangementResult& arrangement : arrangements)
    json["arrangements"].push_back(json_of_arrangement(arrangement));
  return json;
}

std::string quantity_table(const AcceptanceResult& result) {
  TextColumn name{"error", {}, false};
  TextColumn worst{"worst mm", {}};
  TextColumn u95{"U95 mm", {}};
  TextColumn limit{"limit mm", {}};
  TextColumn decision{"decision", {}, false};
  TextColumn arrangement{"arrangement", {}};
  for (const AcceptanceQuantity& quantity : result.quantities) {
    name.values.push_back(quantity.name);
    worst.values.push_back(quantity.is_form ? fixed_text(quantity.error_mm, 4)
                                            : signed_text(quantity.error_mm, 4));
    u95.values.push_back(fixed_text(quantity.u95_mm, 4));
    limit.values.push_back(quantity.limit_mm ? fixed_text(*quantity.limit_mm, 4) : "");
    decision.values.push_back(quantity.limit_mm ? std::string(name_of(quantity.conformity)) : "");
    arrangement.values.push_back(fmt::format("{}", quantity.arrangement + 1));
  }
  return text_table({name, worst, u95, limit, decision, arrangement});
}

/// The mesh of an arrangement and what is measured in it.
ArrangementResult measure_arrangement(const AcceptancePlan& plan,
                                      const Rig& rig,
                                      std::size_t i,
                                      const AcceptArguments& arguments,
                                      std::string& checksums,
                                      Terminal& terminal) {
  Run run = terminal.run();
  if (!terminal.verbose) run.on_note = nullptr;
  run.on_warning = [warn = run.on_warning, i](const std::string& sentence) {
    if (warn) warn(fmt::format("arrangement {}: {}", i + 1, sentence));
  };
  ArrangementResult result;
  result.name = plan.arrangements[i].name;
  const fs::path folder = acceptance_scan(plan, rig, i, arguments.output, terminal);
  result.scan = folder.string();
  const Scan scan = read_scan(folder, run);
  const Reconstruction surface = reconstruct(scan, {}, run);
  if (!surface.untrusted_reason.empty())
    run.warn("the result is not trustworthy: " + surface.untrusted_reason);
  write_ply(arguments.output / fmt::format("arrangement-{}.ply", i + 1), surface.mesh);
  run.stage("balls");
  try {
    result.measured =
        at_reference_temperature(measure_balls(surface.mesh, plan.artifact, run), plan);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::Input) throw;
    throw Error(error.kind(), fmt::format("{}: {}", folder.string(), error.what()));
  }
  const FrameChecksums frames = frame_checksums(folder, run);
  checksums += frames.list;
  result.frames = frames.files;
  result.frames_sha256 = frames.sha256;
  return result;
}

bool has_simulated_camera(const fs::path& rig) {
  std::vector<DeviceSettings> devices = read_device_settings(rig);
  return std::any_of(devices.begin(), devices.end(), [](DeviceSettings& device) {
    return device.device() == "camera" && device.text_or("driver", "") == "simulated";
  });
}

void accept(const AcceptArguments& arguments, Terminal& terminal) {
  const Run run = terminal.run();
  const AcceptancePlan plan = read_acceptance_plan(arguments.plan);
  Rig rig;
  CertificateFacts facts;
  if (plan.source != AcceptanceSource::Scans) {
    rig = acceptance_rig(plan, run);
    facts.rig = plan.rig.string();
    if (rig.calibration) facts.calibrated = rig.calibration->date;
  }
  fs::create_directories(arguments.output);
  std::vector<ArrangementResult> arrangements;
  std::string checksums;
  for (std::size_t i = 0; i < plan.arrangements.size(); ++i) {
    arrangements.push_back(measure_arrangement(plan, rig, i, arguments, checksums, terminal));
    if (terminal.quiet || terminal.json) continue;
    terminal.finish();
    print_text("arrangement {} of {}, {}: measured\n",
               i + 1,
               plan.arrangements.size(),
               plan.arrangements[i].name);
  }
  const AcceptanceResult result = acceptance_result(plan, arrangements);
  facts.created = fmt::format(
      "{:%Y-%m-%d %H:%M:%S} UTC",
      fmt::gmtime(std::chrono::system_clock::to_time_t(std::chrono::system_clock::now())));
  facts.version = "Frangia " FRANGIA_VERSION;
  facts.warnings = terminal.warnings();
  if (plan.source == AcceptanceSource::Devices && has_simulated_camera(plan.rig))
    facts.warnings.emplace_back(kSimulatedCamera);
  const Json json = json_of_result(result, arrangements, facts);
  const fs::path certificate = arguments.output / "certificate.html";
  write_text_file(arguments.output / "frames.sha256", checksums);
  write_text_file(arguments.output / "certificate.json", json.dump(2) + "\n");
  write_text_file(certificate, certificate_html(plan, arrangements, result, facts));
  if (arguments.fail_out_of_tolerance && result.conformity == Conformity::Out)
    terminal.exit_code = OutOfTolerance;
  terminal.finish();
  if (terminal.json) {
    print_json(json);
    return;
  }
  if (terminal.quiet) return;
  print_text("{}\n", sentence_of(result));
  for (const std::string& lack : result.incomplete)
    print_text("missing from a test after VDI/VDE 2634 part 3: {}\n", lack);
  write_output(quantity_table(result));
  terminal.print_written(certificate.string());
}

}  // namespace

void add_accept_verb(CLI::App& program, Terminal& terminal) {
  auto* verb =
      program.add_subcommand("accept", "test a scanner with a ball bar or ball, and certify it");
  verb->footer(
      "Example:\n"
      "  frangia accept examples/acceptance/ball-bar.toml -o acceptance\n"
      "The plan names the artifact, the limits, and whether scans exist, are captured by devices\n"
      "or are simulated. Repeat the same command to continue a test that was interrupted.");
  auto arguments = std::make_shared<AcceptArguments>();
  verb->add_option("plan,--plan", arguments->plan, "acceptance.toml")->required();
  verb->add_option("-o,--output",
                   arguments->output,
                   "folder for scans, meshes, certificate.html, certificate.json, frames.sha256")
      ->required();
  verb->add_flag("--fail-out-of-tolerance",
                 arguments->fail_out_of_tolerance,
                 "exit with code 1 if an error exceeds its limit");
  verb->callback([arguments, &terminal] { accept(*arguments, terminal); });
}

}  // namespace frangia
