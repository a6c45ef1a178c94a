#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "frangia/acceptance/certificate.h"
#include "frangia/core/durable_file.h"
#include "frangia/core/error.h"
#include "frangia/service/internal/implementation.h"
#include "frangia/service/internal/rig_json.h"

namespace frangia {
namespace {

constexpr std::size_t kMostName = 100;

/// What the reconstruction warned of.
std::vector<std::string> warnings_of(const nlohmann::json& summary) {
  std::vector<std::string> warnings;
  for (const auto& warning : summary.value("warnings", nlohmann::json::array()))
    warnings.push_back(warning.get<std::string>());
  return warnings;
}

std::string now_utc() {
  return fmt::format(
      "{:%Y-%m-%d %H:%M:%S} UTC",
      fmt::gmtime(std::chrono::system_clock::to_time_t(std::chrono::system_clock::now())));
}

}  // namespace

nlohmann::ordered_json Service::Implementation::set_acceptance(CommandArguments& arguments) {
  const bool ends = arguments.flag("end");
  nlohmann::json plan;
  if (!ends) plan = arguments.object("plan");
  arguments.check_all_read();
  const ProjectFolder project = folder();
  require(project.scan != project.folder, "a test needs a project; this is a plain scan folder");
  std::string text;
  if (!ends) {
    plan["source"] = name_of(AcceptanceSource::Scans);
    plan.erase("arrangements");
    text = toml_text(plan, "frangia-acceptance");
  }
  write_acceptance(project, text);
  change([&](OpenProject& now) { now.acceptance = read_acceptance(library_, project); });
  return Json::object();
}

nlohmann::ordered_json Service::Implementation::start_measure_arrangement(
    CommandArguments& arguments) {
  const std::string name = arguments.text("name");
  arguments.check_all_read();
  require(!name.empty() && name.size() <= kMostName, "name: has 1 to 100 bytes");
  const OpenProject now = opened();
  const ProjectFolder project = now.folder;
  require(now.acceptance.has_value(), "there is no acceptance test; state the artifact first");
  require(now.scan_complete && now.surface && !now.surface->summary->empty(),
          "the artifact is measured in the surface of a scan; scan it and build the surface first");
  require(now.surface->done == 0,
          "the surface was edited; an acceptance test measures what the scanner delivers: undo the "
          "edits, or build the surface again");
  return started("measure", [this, project, name](const Run& run) {
    const SurfaceModel& model =
        model_of(project, "there is no surface yet; reconstruct it first", run);
    const auto summary = nlohmann::json::parse(*model.snapshot()->summary);
    if (const std::string reason = summary.value("untrusted_reason", ""); !reason.empty()) {
      throw Error(
          ErrorKind::Numeric,
          fmt::format("the surface is not trustworthy: {}; scan the artifact again", reason));
    }
    measure_arrangement(
        project, opened().acceptance.value().plan, name, model.mesh(), warnings_of(summary), run);
    change([&](OpenProject& done) { done.acceptance = read_acceptance(library_, project); });
  });
}

nlohmann::ordered_json Service::Implementation::start_certificate(CommandArguments& arguments) {
  const std::string format = arguments.text_or("format", "pdf");
  arguments.check_all_read();
  require(format == "html" || format == "pdf", "format: is html or pdf");
  require(format != "pdf" || options_.print_page,
          "this program makes no PDF files; write the certificate as HTML and print it");
  const OpenProject now = opened();
  require(now.acceptance && !now.acceptance->arrangements.empty(),
          "no arrangement of the artifact was measured; measure one first");
  return started("report", [this, format, now](const Run& run) {
    const AcceptanceRecord& record = *now.acceptance;
    const std::vector<ArrangementResult> results = results_at_20(record);
    CertificateFacts facts;
    facts.created = now_utc();
    facts.version = "Frangia " + options_.version;
    facts.rig = now.rig ? now.folder.rig().string() : "";
    if (now.rig && now.rig->calibration) facts.calibrated = now.rig->calibration->date;
    if (is_simulated(now)) facts.warnings.emplace_back(kSimulatedCamera);
    for (const MeasuredArrangement& one : record.arrangements) {
      for (const std::string& warning : one.warnings)
        facts.warnings.push_back(fmt::format("{}: {}", one.result.name, warning));
    }
    const std::string page =
        certificate_html(record.plan, results, acceptance_result(record.plan, results), facts);
    const auto write = [&](const std::filesystem::path& file) {
      if (format == "html") return write_text_file(file, page);
      print_page(now.folder, page, file, run);
    };
    put_export(now.folder, now.folder.name + " certificate." + format, std::nullopt, write, run);
  });
}

}  // namespace frangia
