#include <algorithm>
#include <array>
#include <cerrno>
#include <filesystem>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "frangia/core/durable_file.h"
#include "frangia/core/error.h"
#include "frangia/core/open_below.h"
#include "frangia/service/internal/implementation.h"
#include "frangia/service/internal/project_names.h"

namespace frangia {
namespace {

constexpr std::size_t kMostReferenceBytes = 512UL * 1024 * 1024;
constexpr std::size_t kMostNameBytes = 120;
constexpr const char* kReferenceName = "reference.json";
constexpr const char* kReferencePart = "reference.part";
constexpr const char* kReferenceJob = "reference";

/// Extensions of the files that may be references, without their dot.
constexpr std::array<std::string_view, 6> kReferenceFormats{
    "stl", "ply", "obj", "3mf", "step", "stp"};

void require_reference_format(const std::string& format) {
  const auto& known = kReferenceFormats;
  require(std::find(known.begin(), known.end(), format) != known.end(),
          "a reference is an STL, PLY, OBJ, 3MF or STEP file; choose another file");
}

/// Whether all bytes were written.
bool append(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ::ssize_t count = ::write(file, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

/// Names the reference, whose file is there: the commit point.
void commit_reference(const ProjectFolder& project, const ProjectReference& reference) {
  const nlohmann::json json{
      {"name", reference.name}, {"format", reference.format}, {"number", reference.number}};
  write_text_file(project.reference_name(),
                  json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n",
                  Durability::Synced);
}

/// Null for a mesh.
std::shared_ptr<const ReferenceFaces> faces_of(const InspectionReference& reference) {
  if (!reference.cad) return nullptr;
  auto known = std::make_shared<ReferenceFaces>();
  known->faces = reference.cad->faces();
  const std::size_t count = reference.scene.mesh().triangles.size();
  for (std::uint32_t triangle = 0; triangle < count; ++triangle)
    known->of_triangle.push_back(reference.cad->face_of(triangle));
  return known;
}

}  // namespace

ProjectReference reference_of(const ProjectFolder& project) {
  try {
    const auto json = nlohmann::json::parse(project.read_json(kReferenceName));
    ProjectReference known{json.at("name"), json.at("format"), json.value("number", 0)};
    require_reference_format(known.format);
    std::error_code ignored;
    if (std::filesystem::is_regular_file(project.reference(known.format, known.number), ignored))
      return known;
  } catch (const std::exception&) {  // NOLINT(bugprone-empty-catch): there is none
  }
  return {};
}

void Service::Implementation::add_to_reference(std::size_t offset, const std::string& bytes) const {
  const ProjectFolder project = folder();
  require(offset + bytes.size() <= kMostReferenceBytes,
          "a file has at most 512 MB; choose a smaller one");
  if (offset == 0) {
    make_folder(project.derived);
    std::error_code ignored;
    std::filesystem::remove(project.reference_part(), ignored);  // also what is no file
  }
  const FileDescriptor file = project.open_in_derived(kReferencePart, OpenFor::Appending);
  struct ::stat present {};
  require(::fstat(file.number(), &present) == 0 &&
              static_cast<std::uint64_t>(present.st_size) == offset,
          "the pieces of a file arrive in order; begin at 0");
  if (append(file.number(), bytes)) return;
  std::error_code ignored;
  std::filesystem::remove(project.reference_part(), ignored);
  throw Error(
      ErrorKind::File,
      fmt::format("{}: cannot be written; is the disk full?", project.reference_part().string()));
}

nlohmann::ordered_json Service::Implementation::start_set_reference(CommandArguments& arguments) {
  const ProjectFolder project = folder();
  const ProjectReference before = opened().reference;
  ProjectReference wanted{arguments.text("name"), arguments.text("format"), before.number + 1};
  const std::size_t bytes = arguments.whole("bytes", 1, kMostReferenceBytes);
  arguments.check_all_read();
  require_reference_format(wanted.format);
  require(!wanted.name.empty() && wanted.name.size() <= kMostNameBytes,
          "name: has 1 to 120 letters; shorten it");
  require_idle();
  std::error_code error;
  const auto present = std::filesystem::file_size(project.reference_part(), error);
  require(!error && present == bytes, "the file has not arrived completely; send it again");
  // Pieces of the next reference may arrive while the job waits for the disk: this one has its
  // name.
  const auto file = project.reference(wanted.format, wanted.number);
  std::filesystem::rename(project.reference_part(), file, error);
  if (error) {
    throw Error(
        ErrorKind::File,
        fmt::format(
            "{}: cannot be renamed: {}", project.reference_part().string(), error.message()));
  }
  return started(kReferenceJob, [this, project, before, wanted](const Run& /*run*/) {
    keep_reference(project, before, wanted);
  });
}

void Service::Implementation::keep_reference(const ProjectFolder& project,
                                             const ProjectReference& before,
                                             ProjectReference wanted) {
  const auto file = project.reference(wanted.format, wanted.number);
  std::error_code ignored;
  try {
    sync_to_disk(file);
    commit_reference(project, wanted);
  } catch (...) {
    if (reference_of(project) == before) {  // otherwise the disk did not confirm the last step
      std::filesystem::remove(file, ignored);
    } else {
      change([&](OpenProject& opened) { std::swap(opened.reference, wanted); });
    }
    throw;
  }
  change([&](OpenProject& opened) {
    std::swap(opened.reference, wanted);
    opened.reference_picture.reset();
    opened.reference_faces.reset();
  });
  std::filesystem::remove(project.reference(before.format, before.number), ignored);
}

nlohmann::ordered_json Service::Implementation::show_reference(CommandArguments& arguments) {
  const ProjectFolder project = folder();
  arguments.check_all_read();
  require(!opened().reference.name.empty(), "there is no reference to show; choose one");
  return started("open", [this, project](const Run& run) {
    const OpenProject now = opened();
    ReferenceOptions options;
    if (now.plan) options.unit_mm = now.plan->unit_mm;
    run.stage("reference");
    const auto file = project.reference(now.reference.format, now.reference.number);
    const InspectionReference read = naming(
        file, now.reference.name, [&] { return read_inspection_reference(file, options, run); });
    const auto picture = std::make_shared<const SurfacePicture>(read.scene.mesh(), 0, run);
    const auto faces = faces_of(read);
    change([&](OpenProject& opened) {
      if (opened.reference != now.reference) return;
      opened.reference_picture = picture;
      opened.reference_faces = faces;
    });
  });
}

PicturePtr Service::Implementation::reference_picture() const {
  const std::lock_guard lock(mutex_);
  return project_ ? project_->reference_picture : nullptr;
}

nlohmann::ordered_json Service::Implementation::reference_face(std::uint32_t triangle) const {
  std::shared_ptr<const ReferenceFaces> known;
  {
    const std::lock_guard lock(mutex_);
    if (project_) known = project_->reference_faces;
  }
  if (!known || triangle >= known->of_triangle.size()) return {};
  const std::uint32_t face = known->of_triangle[triangle];
  const std::optional<Shape>& shape = known->faces.at(face).shape;
  Json json{{"number", face + 1}, {"kind", nullptr}, {"diameter_mm", nullptr}};
  if (!shape) return json;
  json["kind"] = name_of(shape->kind);
  if (shape->kind != ShapeKind::Plane) json["diameter_mm"] = 2.0 * shape->radius_mm;
  return json;
}

bool Service::Implementation::awaits_reference() const {
  const std::vector<Job> jobs = queue_.jobs();
  return std::any_of(jobs.begin(), jobs.end(), [](const Job& job) {
    return job.kind == kReferenceJob &&
           (job.state == JobState::Waiting || job.state == JobState::Running);
  });
}

}  // namespace frangia
