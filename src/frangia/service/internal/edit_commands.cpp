#include <algorithm>
#include <filesystem>
#include <map>
#include <utility>

#include "frangia/core/atomic_file.h"
#include "frangia/core/error.h"
#include "frangia/core/make_folder.h"
#include "frangia/files/mesh_formats.h"
#include "frangia/files/write_mesh.h"
#include "frangia/files/zip_folder.h"
#include "frangia/service/export_size.h"
#include "frangia/service/internal/implementation.h"

namespace frangia {

std::vector<ExportEntry> exports_of(const ProjectFolder& project) {
  std::vector<ExportEntry> files;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(project.exports(), error)) {
    const std::string name = entry.path().filename().string();
    if (entry.is_symlink() || !entry.is_regular_file(error) || is_temporary_file_name(name))
      continue;
    files.push_back({name, static_cast<std::size_t>(entry.file_size(error))});
  }
  std::sort(files.begin(), files.end(), [](const ExportEntry& a, const ExportEntry& b) {
    return a.name < b.name;
  });
  return files;
}

nlohmann::ordered_json Service::Implementation::start_edit(CommandArguments& arguments) {
  const EditStep step{arguments.text("operation"), arguments.text_or("value", "")};
  arguments.check_all_read();
  check_step(step);
  return started_edit(
      [step](SurfaceModel& model, const Run& run) { return model.apply(step, run); });
}
nlohmann::ordered_json Service::Implementation::start_preview(CommandArguments& arguments) {
  const EditStep step{arguments.text("operation"), arguments.text_or("value", "")};
  arguments.check_all_read();
  check_step(step);
  return started_edit(
      "preview", [step](SurfaceModel& model, const Run& run) { return model.preview(step, run); });
}
nlohmann::ordered_json Service::Implementation::drop_preview(CommandArguments& arguments) {
  arguments.check_all_read();
  return started_edit("preview",
                      [](SurfaceModel& model, const Run&) { return model.drop_preview(); });
}
nlohmann::ordered_json Service::Implementation::start_select_component(
    CommandArguments& arguments) {
  const std::size_t triangle = arguments.whole("triangle", 0, UINT32_MAX);
  arguments.check_all_read();
  return started_edit([triangle](SurfaceModel& model, const Run& run) {
    return model.select_component_of(triangle, run);
  });
}
nlohmann::ordered_json Service::Implementation::start_undo(CommandArguments& arguments) {
  arguments.check_all_read();
  return started_edit([](SurfaceModel& model, const Run& run) { return model.undo(run); });
}
nlohmann::ordered_json Service::Implementation::start_redo(CommandArguments& arguments) {
  arguments.check_all_read();
  return started_edit([](SurfaceModel& model, const Run& run) { return model.redo(run); });
}
nlohmann::ordered_json Service::Implementation::start_fit(CommandArguments& arguments) {
  const std::string kind = arguments.text("kind");
  arguments.check_all_read();
  require(kind == "plane" || kind == "cylinder" || kind == "sphere",
          "kind: is plane, cylinder or sphere");
  return started_edit([kind](SurfaceModel& model, const Run& run) { return model.fit(kind, run); });
}

nlohmann::ordered_json Service::Implementation::start_zip(const ProjectFolder& project) {
  require(opened().scan_complete, "there is no complete scan to put into a zip; scan first");
  return started("export", [this, project](const Run& run) {
    run.stage("files");
    make_folder(project.exports());
    const std::string name = project.name + " scan";
    zip_folder(project.scan, name, project.exports() / (name + ".zip"), run);
    change([&](OpenProject& opened) { opened.exports = exports_of(project); });
  });
}

namespace {

/// What is written where.
struct ExportRequest {
  std::string format;         ///< ending of the file, or "zip"
  WriteOptions options;       ///< of the format
  std::size_t triangles = 0;  ///< at most; 0: all
};

ExportRequest export_arguments(CommandArguments& arguments) {
  static const std::map<std::string, DxfVariant> kVariants = {
      {"faces", DxfVariant::Faces}, {"polyface", DxfVariant::Polyface}, {"mesh", DxfVariant::Mesh}};
  ExportRequest request;
  request.format = arguments.text("format");
  const auto variant = kVariants.find(arguments.text_or("dxf", "faces"));
  const std::string stl = arguments.text_or("stl", "binary");
  request.triangles = arguments.whole_or("triangles", 0, 0, UINT32_MAX);
  arguments.check_all_read();
  require(variant != kVariants.end(), "dxf: is faces, polyface or mesh");
  require(stl == "binary" || stl == "ascii", "stl: is binary or ascii");
  request.options.dxf.variant = variant->second;
  request.options.stl.ascii = stl == "ascii";
  require(request.format == "zip" || (request.format.find('/') == std::string::npos &&
                                      find_mesh_format("x." + request.format) != nullptr),
          "there is no such format; choose one of the list");
  return request;
}

}  // namespace

// NOLINTNEXTLINE(readability-make-member-function-const): one of the table of commands
nlohmann::ordered_json Service::Implementation::estimate_export(CommandArguments& arguments) {
  const ExportRequest request = export_arguments(arguments);
  require(request.format != "zip", "format: the size of a zip is known when it is written");
  const SurfacePtr shown = surface();
  require(shown != nullptr, "there is no surface to export; reconstruct it first");
  const Mesh& mesh = shown->picture->mesh();
  const std::size_t all = mesh.triangles.size();
  const std::size_t triangles = request.triangles == 0 ? all : std::min(all, request.triangles);
  return {{"triangles", triangles},
          {"bytes", export_size(mesh, request.format, triangles, request.options)}};
}

nlohmann::ordered_json Service::Implementation::start_export(CommandArguments& arguments) {
  const ProjectFolder project = folder();
  const ExportRequest request = export_arguments(arguments);
  if (request.format == "zip") return start_zip(project);
  return started("export", [this, project, request](const Run& run) {
    require(model_ != nullptr, "there is no surface to export; reconstruct it first");
    require(!model_->mesh().triangles.empty(),
            "the surface has no triangles to export; undo, or scan again");
    run.stage("files");
    make_folder(project.exports());
    const auto path = project.exports() / (project.name + "." + request.format);
    if (request.triangles > 0 && model_->mesh().triangles.size() > request.triangles) {
      EditState reduced{.mesh = model_->mesh(), .selection = {}};
      apply_step(reduced, {"decimate-to", std::to_string(request.triangles)}, run);
      write_mesh(path, reduced.mesh, request.options, run);
    } else {
      write_mesh(path, model_->mesh(), request.options, run);
    }
    change([&](OpenProject& opened) { opened.exports = exports_of(project); });
  });
}
nlohmann::ordered_json Service::Implementation::started_edit(
    std::function<SurfacePtr(SurfaceModel&, const Run&)> work) {
  return started_edit("edit", std::move(work));
}
nlohmann::ordered_json Service::Implementation::started_edit(
    const char* kind, std::function<SurfacePtr(SurfaceModel&, const Run&)> work) {
  static_cast<void>(folder());
  return started(kind, [this, work = std::move(work)](const Run& run) {
    require(model_ != nullptr, "there is no surface to edit; reconstruct it first");
    show_surface(work(*model_, run), run);
  });
}
void Service::Implementation::show_surface(const SurfacePtr& surface, const Run& run) {
  change([&](OpenProject& opened) {
    opened.surface = surface;
    opened.surface_loading = false;
  });
  const SurfacePtr refined = model_->refine(run);
  if (refined) change([&](OpenProject& opened) { opened.surface = refined; });
}
void Service::Implementation::load_surface(const ProjectFolder& project, const Run& run) {
  drop_model();
  model_ = std::make_unique<SurfaceModel>(project, revision_, run);
  show_surface(model_->snapshot(), run);
}
void Service::Implementation::drop_model() {
  if (model_) revision_ = model_->revision();
  model_.reset();
}
}  // namespace frangia
