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

nlohmann::ordered_json Service::Implementation::start_export(CommandArguments& arguments) {
  const ProjectFolder project = folder();
  const std::string format = arguments.text("format");
  static const std::map<std::string, DxfVariant> kVariants = {
      {"faces", DxfVariant::Faces}, {"polyface", DxfVariant::Polyface}, {"mesh", DxfVariant::Mesh}};
  const auto variant = kVariants.find(arguments.text_or("dxf", "faces"));
  const std::size_t triangles = arguments.whole_or("triangles", 0, 0, UINT32_MAX);
  arguments.check_all_read();
  if (format == "zip") return start_zip(project);
  const std::string name = project.name + "." + format;
  require(format.find('/') == std::string::npos && find_mesh_format("x." + format) != nullptr,
          "there is no such format; choose one of the list");
  require(variant != kVariants.end(), "dxf: is faces, polyface or mesh");
  WriteOptions options;
  options.dxf.variant = variant->second;
  return started("export", [this, project, name, options, triangles](const Run& run) {
    require(model_ != nullptr, "there is no surface to export; reconstruct it first");
    run.stage("files");
    make_folder(project.exports());
    if (triangles > 0 && model_->mesh().triangles.size() > triangles) {
      EditState reduced{.mesh = model_->mesh(), .selection = {}};
      apply_step(reduced, {"decimate-to", std::to_string(triangles)}, run);
      write_mesh(project.exports() / name, reduced.mesh, options, run);
    } else {
      write_mesh(project.exports() / name, model_->mesh(), options, run);
    }
    change([&](OpenProject& opened) { opened.exports = exports_of(project); });
  });
}
nlohmann::ordered_json Service::Implementation::started_edit(
    std::function<SurfacePtr(SurfaceModel&, const Run&)> work) {
  static_cast<void>(folder());
  return started("edit", [this, work = std::move(work)](const Run& run) {
    require(model_ != nullptr, "there is no surface to edit; reconstruct it first");
    show_surface(work(*model_, run), run);
  });
}
void Service::Implementation::show_surface(const SurfacePtr& surface, const Run& run) {
  change([&](OpenProject& opened) { opened.surface = surface; });
  const SurfacePtr refined = model_->refine(run);
  if (refined) change([&](OpenProject& opened) { opened.surface = refined; });
}
void Service::Implementation::load_surface(const ProjectFolder& project, const Run& run) {
  drop_model();
  model_ = std::make_unique<SurfaceModel>(project, revision_, run);
  show_surface(model_->snapshot(), run);
}
void Service::Implementation::drop_model() {
  if (model_) revision_ = model_->snapshot()->selection_revision;
  model_.reset();
}
}  // namespace frangia
