#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "frangia/cad/read_cad.h"
#include "frangia/core/base64.h"
#include "frangia/core/durable_file.h"
#include "frangia/core/error.h"
#include "frangia/core/open_below.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/files/mesh_formats.h"
#include "frangia/files/read_mesh.h"
#include "frangia/files/zip_folder.h"
#include "frangia/service/internal/implementation.h"
#include "frangia/service/internal/project_names.h"
#include "frangia/service/internal/surface_build.h"

namespace frangia {
namespace {

constexpr std::size_t kMostNotes = 4000;         // bytes: a page
constexpr std::size_t kMostThumbnail = 300'000;  // bytes: ten times that of a small picture
constexpr std::size_t kMostFileName = 120;
constexpr std::size_t kMostFileBytes = 512UL * 1024 * 1024;

void put_text(const std::filesystem::path& path, std::string_view text) {
  make_folder(path.parent_path());
  write_text_file(path, text);
}

/// The bytes of a PNG or JPEG picture in base64.
std::string thumbnail_of(const std::string& text) {
  std::string bytes = decode_base64(text).value_or("");
  const bool is_picture = bytes.starts_with("\x89PNG\r\n") || bytes.starts_with("\xFF\xD8\xFF");
  require(is_picture && bytes.size() <= kMostThumbnail,
          "picture: is a PNG or JPEG of at most 300 kB, in base64");
  return bytes;
}

/// The file that arrived for a project, under a name that ends as its readers want it.
class ArrivedFile {
 public:
  ArrivedFile(const ProjectFolder& project, const std::string& format)
      : path_(project.in_derived("arrived." + format)) {
    std::error_code error;
    std::filesystem::rename(project.reference_part(), path_, error);
    if (error) {
      throw Error(ErrorKind::File, "the file that arrived cannot be renamed: " + error.message());
    }
  }
  ArrivedFile(const ArrivedFile&) = delete;
  ArrivedFile& operator=(const ArrivedFile&) = delete;
  ArrivedFile(ArrivedFile&&) = delete;
  ArrivedFile& operator=(ArrivedFile&&) = delete;
  ~ArrivedFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

Mesh surface_in(const std::filesystem::path& file, const Run& run) {
  Mesh mesh = is_cad_file(file) ? read_cad(file, {}, run)->mesh() : read_mesh(file, run);
  require(!mesh.vertices_mm.empty(), "this file has no point; choose one with a surface or points");
  return mesh;
}

void unpack_scan(const ProjectFolder& project, const std::filesystem::path& file, const Run& run) {
  const auto unpacked = project.in_folder("scan-arriving");
  std::error_code ignored;
  std::filesystem::remove_all(unpacked, ignored);
  try {
    unzip_folder(file, "scan.toml", unpacked, run);
    static_cast<void>(read_scan(unpacked, run));
    move_folder(unpacked, project.in_folder("scan"));
  } catch (...) {
    std::filesystem::remove_all(unpacked, ignored);
    throw;
  }
}

}  // namespace

bool Service::Implementation::leave(const std::string& name) {
  {
    const std::lock_guard lock(mutex_);
    if (!project_ || project_->folder.folder != library_.find(name).folder) return false;
  }
  require_idle();
  stop_live();
  const std::lock_guard lock(mutex_);
  project_.reset();
  return true;
}

nlohmann::ordered_json Service::Implementation::rename_project(CommandArguments& arguments) {
  const std::string name = arguments.text("name");
  const std::string to = arguments.text("to");
  arguments.check_all_read();
  check_project_name(to);
  require_idle();
  const bool was_open = leave(name);
  try {
    library_.rename(name, to);
  } catch (...) {
    if (was_open) open(library_.find(name));
    throw;
  }
  refresh_projects();
  if (was_open) open(library_.find(to));
  return Json::object();
}

nlohmann::ordered_json Service::Implementation::duplicate_project(CommandArguments& arguments) {
  const std::string name = arguments.text("name");
  const std::string copy = arguments.text("copy");
  arguments.check_all_read();
  check_project_name(copy);
  const ProjectFolder project = library_.find(name);
  require_idle();
  const bool open_here = [&] {
    const std::lock_guard lock(mutex_);
    return project_ && project_->folder.folder == project.folder;
  }();
  return started("copy", [this, name, copy, open_here](const Run& run) {
    run.stage("files");
    library_.duplicate(name, copy, run, open_here);
    refresh_projects();
  });
}

nlohmann::ordered_json Service::Implementation::discard_project(CommandArguments& arguments) {
  const std::string name = arguments.text("name");
  arguments.check_all_read();
  require_idle();
  try {
    static_cast<void>(leave(name));
    library_.discard(name);
  } catch (...) {
    refresh_projects();
    throw;
  }
  refresh_projects();
  return Json::object();
}

nlohmann::ordered_json Service::Implementation::take_back_project(CommandArguments& arguments) {
  const std::string name = arguments.text("name");
  arguments.check_all_read();
  const std::string now = library_.take_back(name);
  refresh_projects();
  return {{"name", now}};
}

nlohmann::ordered_json Service::Implementation::empty_bin(CommandArguments& arguments) {
  const nlohmann::json& given = arguments.value("names");
  arguments.check_all_read();
  constexpr std::size_t kMostNames = 10'000;
  const bool texts =
      given.is_array() && !given.empty() && given.size() <= kMostNames &&
      std::all_of(given.begin(), given.end(), [](const auto& one) { return one.is_string(); });
  require(texts, "names: is a list of texts");
  const auto names = given.get<std::vector<std::string>>();
  const std::vector<std::string> known = library_.discarded();
  for (const std::string& name : names) {
    require(std::find(known.begin(), known.end(), name) != known.end(),
            "there is no deleted project of this name");
  }
  return started("empty", [this, names](const Run& run) {
    run.stage("files");
    try {
      library_.empty_bin(names, run);
    } catch (...) {
      refresh_projects();
      throw;
    }
    refresh_projects();
  });
}

nlohmann::ordered_json Service::Implementation::set_notes(CommandArguments& arguments) {
  const std::string name = arguments.text("name");
  const std::string text = arguments.text("text");
  arguments.check_all_read();
  require(text.size() <= kMostNotes, "text: notes have at most 4000 bytes; shorten them");
  put_text(library_.find(name).notes(), text);
  refresh_projects();
  return Json::object();
}

/// Keeps a small picture of the open project, which a browser drew: to look at a project is no
/// change of it, so that its date stays.
nlohmann::ordered_json Service::Implementation::set_thumbnail(CommandArguments& arguments) {
  const std::string bytes = thumbnail_of(arguments.text("picture"));
  arguments.check_all_read();
  const ProjectFolder project = folder();
  std::error_code unknown;
  const auto changed = std::filesystem::last_write_time(project.derived, unknown);
  put_text(project.thumbnail(), bytes);
  std::error_code ignored;
  if (!unknown) std::filesystem::last_write_time(project.derived, changed, ignored);
  refresh_projects();
  return Json::object();
}

std::string Service::Implementation::thumbnail(const std::string& name) const {
  const ProjectFolder project = library_.find(name);
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(project.thumbnail(), ignored)) return {};
  return read_below(
      project.folder, project.thumbnail().lexically_relative(project.folder), kMostThumbnail);
}

/// The file that arrived becomes the surface of the open project, or its scan; it has neither yet.
nlohmann::ordered_json Service::Implementation::open_file(CommandArguments& arguments) {
  const std::string format = arguments.text("format");
  const std::size_t bytes = arguments.whole("bytes", 1, kMostFileBytes);
  const std::string name = arguments.text_or("name", "");
  arguments.check_all_read();
  require(name.size() <= kMostFileName, "name: has at most 120 letters; shorten it");
  const std::filesystem::path named = "file." + format;
  const bool is_plain = !format.empty() && std::all_of(format.begin(), format.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
  });
  const bool is_scan = format == "zip";
  require(is_plain && (is_scan || is_cad_file(named) || find_mesh_format(named) != nullptr),
          "format: the app opens meshes, STEP and IGES files, and zip archives of a scan folder");
  const OpenProject project = opened();
  require(project.folder.scan != project.folder.folder && !project.scan_begun &&
              !project.scan_complete && project.versions && project.versions->current == 0,
          "this project has a scan or a surface; open the file in a project of its own");
  require_idle(project.open_job);  // which reads nothing of an empty project
  stop_live();
  std::error_code error;
  const auto present = std::filesystem::file_size(project.folder.reference_part(), error);
  require(!error && present == bytes, "the file has not arrived completely; send it again");
  // The next file may arrive while the job waits: this one has its name.
  const auto file = std::make_shared<const ArrivedFile>(project.folder, format);
  return started(
      "open",
      [this, folder = project.folder, file, is_scan, name, key = arguments.key()](const Run& run) {
        run.stage("files");
        if (!is_scan) {
          const Mesh mesh =
              naming(file->path(), name, [&] { return surface_in(file->path(), run); });
          return add_version(
              folder,
              key,
              [&](const std::filesystem::path& into) { write_given_surface(into, mesh, run); },
              run);
        }
        naming(file->path(), name, [&] { unpack_scan(folder, file->path(), run); });
        std::error_code ignored;
        std::filesystem::remove(folder.stations(), ignored);
        const auto stations = read_stations(folder, run);
        change([&](OpenProject& now) {
          now.stations = stations;
          now.scan_complete = true;
          now.scan_begun = true;
        });
        refresh_projects();
      });
}

}  // namespace frangia
