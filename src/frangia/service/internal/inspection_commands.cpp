#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "frangia/core/durable_file.h"
#include "frangia/core/error.h"
#include "frangia/core/open_below.h"
#include "frangia/geometry/transform_mesh.h"
#include "frangia/inspection/write_inspection_plan.h"
#include "frangia/report/qif_results.h"
#include "frangia/report/write_report.h"
#include "frangia/service/internal/implementation.h"
#include "frangia/service/internal/rig_json.h"
#include "frangia/service/internal/shown_inspection.h"

namespace frangia {
namespace {

constexpr std::size_t kMostPlanBytes = 500'000;

/// A plan without the files that it names: no name that arrives from a page or with a folder is
/// opened. The reference is the one that was sent.
InspectionPlan without_files(InspectionPlan plan) {
  plan.file.clear();
  plan.reference.clear();
  plan.report.logo.clear();
  return plan;
}

/// The plan with the reference of the project, as it is inspected by and kept in the folder.
InspectionPlan with_reference(InspectionPlan plan,
                              const ProjectFolder& project,
                              const ProjectReference& reference) {
  if (!reference.name.empty())
    plan.reference = project.reference(reference.format, reference.number);
  return plan;
}

/// Whether a plan measures something without a reference.
bool measures_alone(const InspectionPlan& plan) {
  return !plan.features.empty() || !plan.sections.empty() || plan.thickness;
}

/// Whether a surface was made of the scan of its project, and no step has moved it since: its
/// features then hold what the calibration of the rig does to all of them.
bool lies_as_scanned(const SurfaceSnapshot& surface) {
  const auto done = surface.steps.begin() + static_cast<std::ptrdiff_t>(surface.done);
  return !surface.summary->empty() &&
         std::none_of(surface.steps.begin(), done, [](const EditStep& step) {
           return step.operation == "align" || step.operation == "mirror";
         });
}

}  // namespace

bool has_current_inspection(const OpenProject& project) {
  if (!project.surface || !project.surface->inspection) return false;
  const ProjectReference& reference = project.reference;
  return project.surface->inspection->asked.basis ==
         inspection_basis(project.plan.value_or(usual_plan()), reference.name, reference.number);
}

void read_plan_of(const ProjectFolder& folder, OpenProject& project) {
  std::error_code ignored;
  try {
    const auto path = folder.plan();
    if (!std::filesystem::exists(path, ignored)) return;
    const std::string text = read_below(folder.derived, path.filename(), kMostPlanBytes);
    project.plan = without_files(parse_inspection_plan(text, path.filename()));
  } catch (const Error& error) {
    project.plan_fault = error.what();
  }
}

nlohmann::ordered_json Service::Implementation::set_plan(CommandArguments& arguments) {
  const std::string text = toml_text(arguments.object("plan"), "frangia-inspection");
  arguments.check_all_read();
  return keep_plan(text);
}

nlohmann::ordered_json Service::Implementation::open_plan(CommandArguments& arguments) {
  const std::string text = arguments.text("text");
  arguments.check_all_read();
  return keep_plan(text);
}

nlohmann::ordered_json Service::Implementation::keep_plan(const std::string& text) {
  require(text.size() <= kMostPlanBytes, "a plan has at most 500 kB; choose another file");
  const InspectionPlan plan = without_files(parse_inspection_plan(text, "the plan"));
  const OpenProject project = opened();
  write_inspection_plan(project.folder.plan(),
                        with_reference(plan, project.folder, project.reference));
  change([&](OpenProject& now) {
    now.plan = plan;
    now.plan_fault.clear();
  });
  return nlohmann::ordered_json::object();
}

nlohmann::ordered_json Service::Implementation::start_inspect(CommandArguments& arguments) {
  const ProjectFolder project = folder();
  const bool features = arguments.flag("features");
  arguments.check_all_read();
  const InspectionPlan plan = opened().plan.value_or(usual_plan());
  constexpr const char* kNone =
      "there is nothing to inspect; choose a reference to compare with, or add features to the "
      "plan";
  require(
      features || measures_alone(plan) || !opened().reference.name.empty() || awaits_reference(),
      kNone);
  return started_view(
      "inspect",
      [this, project, plan, features](const SurfaceModel& model, int count, const Run& run) {
        const ProjectReference reference = opened().reference;  // a job before may have set it
        InspectionPlan wanted = with_reference(plan, project, reference);
        require(features || measures_alone(wanted) || !wanted.reference.empty(), kNone);
        if (wanted.reference.empty()) {
          wanted.align.clear();
        } else if (wanted.align.empty()) {
          wanted.align = "none";
        }
        // Where several poses fit alike, the page lists them and shows the first.
        if (wanted.align == "best-fit" || wanted.align == "datum")
          wanted.start = std::max<std::size_t>(wanted.start, 1);
        if (opened().plan)
          write_inspection_plan(project.plan(), with_reference(plan, project, reference));
        const bool measures = features || !wanted.features.empty();
        InspectionRequest asked{std::move(wanted),
                                reference.name,
                                inspection_basis(plan, reference.name, reference.number),
                                features,
                                nullptr};
        if (measures && lies_as_scanned(*model.snapshot()) && opened().scan_complete)
          asked.scan = std::make_shared<const Scan>(read_scan(project.scan, run));
        SurfaceModel inspected = model.inspected(asked, count, run);
        write_series_results(project, inspected.snapshot()->inspection->found, asked.plan);
        return inspected;
      });
}

nlohmann::ordered_json Service::Implementation::next_part(CommandArguments& arguments) {
  const std::string name = arguments.text("name");
  arguments.check_all_read();
  require_idle();
  const OpenProject now = opened();
  require(now.folder.scan != now.folder.folder,
          "the next part needs a project; this is a plain scan folder");
  // The serial number may have been stated since the inspection.
  if (has_current_inspection(now) && now.lock)
    write_series_results(now.folder,
                         now.surface->inspection->found,
                         now.plan.value_or(now.surface->inspection->asked.plan));
  const ProjectFolder next = library_.create(name);
  try {
    prepare_next_part(now.folder, now.plan, next);
    write_stations(next, planned_stations(std::max<std::size_t>(now.stations.size(), 1)));
  } catch (...) {
    std::error_code ignored;
    std::filesystem::remove_all(next.folder, ignored);  // created above, holds nothing else
    throw;
  }
  refresh_projects();
  open(next);
  return Json::object();
}

void Service::Implementation::print_page(const ProjectFolder& project,
                                         const std::string& page,
                                         const std::filesystem::path& pdf,
                                         const Run& run) const {
  const auto file = project.in_derived("report.part.html");
  write_text_file(file, page);
  run.stage("report");
  std::error_code ignored;
  try {
    options_.print_page(file, pdf, run.stop);
  } catch (...) {
    std::filesystem::remove(file, ignored);
    throw;
  }
  std::filesystem::remove(file, ignored);
  run.check();
}

nlohmann::ordered_json Service::Implementation::start_report(CommandArguments& arguments) {
  static constexpr std::array<std::string_view, 5> kFormats{"html", "pdf", "csv", "qif", "toml"};
  const ProjectFolder project = folder();
  const std::string format = arguments.text_or("format", "html");
  const std::string language = arguments.text_or("language", "en");
  arguments.check_all_read();
  require(std::find(kFormats.begin(), kFormats.end(), format) != kFormats.end(),
          "format: is html, pdf, csv, qif or toml");
  require(std::find(kReportLanguages.begin(), kReportLanguages.end(), language) !=
              kReportLanguages.end(),
          "language: is en, de or it");
  const SurfacePtr shown = surface();
  require(format == "toml" || (shown && shown->inspection),
          "there is no inspection to report; inspect the surface first");
  require(format == "toml" || has_current_inspection(opened()),
          "the plan or the reference has changed; inspect again");
  require(format != "pdf" || options_.print_page,
          "this program makes no PDF files; write the report as HTML and print it");
  return started("report", [this, project, format, language](const Run& run) {
    const SurfaceModel& model =
        model_of(project, "there is no surface yet; reconstruct it first", run);
    const OpenProject now = opened();
    const ExportOrigin origin{model.snapshot()->version, versions_of(project)->revision};
    if (format == "toml") {
      InspectionPlan plan = now.plan.value_or(usual_plan());
      plan.reference = now.reference.name;
      const auto write = [&](const std::filesystem::path& file) {
        write_text_file(file, inspection_plan_text(plan, {}));
      };
      return put_export(project, "inspection.toml", std::nullopt, write, run);
    }
    const auto inspection = model.snapshot()->inspection;
    require(inspection != nullptr, "the surface has changed; inspect it again");
    Inspection part = inspection->found;
    part.mesh = part.alignment
                    ? transform_mesh(model.mesh(), part.alignment->pose.reference_from_mesh)
                    : model.mesh();
    const auto write = [&](const std::filesystem::path& file) {
      if (format == "csv") return write_text_file(file, csv_of(part.characteristics));
      if (format == "qif")
        return write_text_file(file,
                               qif_of({part.named_features, part.characteristics, part.verdict}));
      InspectionPlan plan = inspection->asked.plan;
      plan.file.clear();
      if (now.plan) {  // the head of the report changes nothing that was measured
        plan.part = now.plan->part;
        plan.report = now.plan->report;
      }
      // A plan that states another language than English was written for its readers.
      if (plan.report.language == ReportFields{}.language) plan.report.language = language;
      const ReportSources sources{.reference = plan.reference,
                                  .reference_name = inspection->asked.reference,
                                  .scan = inspection->asked.scan.get(),
                                  .version = "Frangia " + options_.version};
      InspectionReport report = report_of(part, plan, sources, run);
      report.mesh = project.name;
      if (format == "html") return write_text_file(file, html_of(report));
      print_page(project, html_of(report), file, run);
    };
    put_export(project, project.name + " report." + format, origin, write, run);
  });
}

}  // namespace frangia
