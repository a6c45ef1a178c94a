#include <algorithm>
#include <filesystem>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/files/mesh_formats.h"
#include "frangia/files/write_mesh.h"
#include "frangia/files/zip_folder.h"
#include "frangia/service/export_size.h"
#include "frangia/service/internal/implementation.h"

namespace frangia {

nlohmann::ordered_json Service::Implementation::start_zip(const ProjectFolder& project) {
  require(opened().scan_complete, "there is no complete scan to put into a zip; scan first");
  return started("export", [this, project](const Run& run) {
    run.stage("files");
    const std::string name = project.name + " scan";
    const auto write = [&](const std::filesystem::path& file) {
      zip_folder(project.scan, name, file, run);
    };
    put_export(project, name + ".zip", std::nullopt, write, run);
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
  ExportRequest request;
  request.format = arguments.text("format");
  request.options.dxf.variant = arguments.named_or("dxf", DxfVariant::Faces);
  const std::string stl = arguments.text_or("stl", "binary");
  request.triangles = arguments.whole_or("triangles", 0, 0, UINT32_MAX);
  arguments.check_all_read();
  require(stl == "binary" || stl == "ascii", "stl: is binary or ascii");
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
    const SurfaceModel& model =
        model_of(project, "there is no surface to export; reconstruct it first", run);
    const Mesh& mesh = model.mesh();
    require(!mesh.triangles.empty(), "the surface has no triangles to export; undo, or scan again");
    run.stage("files");
    const ExportOrigin origin{model.snapshot()->version, versions_of(project)->revision};
    const auto write = [&](const std::filesystem::path& file) {
      if (request.triangles > 0 && mesh.triangles.size() > request.triangles) {
        EditState reduced{.mesh = mesh, .selection = {}};
        apply_step(reduced, {"decimate-to", std::to_string(request.triangles)}, run);
        write_mesh(file, reduced.mesh, request.options, run);
      } else {
        write_mesh(file, mesh, request.options, run);
      }
    };
    put_export(project, project.name + "." + request.format, origin, write, run);
  });
}

void Service::Implementation::put_export(
    const ProjectFolder& project,
    const std::string& name,
    std::optional<ExportOrigin> origin,
    const std::function<void(const std::filesystem::path&)>& write,
    const Run& run) {
  WrittenExport written = write_export(project, name, origin, write, run);
  {
    const std::lock_guard lock(mutex_);
    if (project_) project_->exports.swap(written.exports);
  }
  if (origin) queue_.set_revision(origin->revision);
  on_change_();
  if (!written.unconfirmed) return;
  throw Error(
      ErrorKind::File,
      fmt::format("{} is written, but the disk did not confirm it; check the disk: the file "
                  "may be lost when the power fails",
                  name));
}

}  // namespace frangia
