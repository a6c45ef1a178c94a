#include "frangia/service/project_folder.h"

#include <algorithm>
#include <chrono>
#include <optional>
#include <system_error>

#include <fmt/format.h>

#include "frangia/core/durable_file.h"
#include "frangia/core/error.h"
#include "frangia/core/folder_lock.h"
#include "frangia/core/open_below.h"
#include "frangia/core/read_file.h"
#include "frangia/service/internal/project_names.h"

namespace frangia {
namespace {

constexpr const char* kProjectFile = "project.json";
constexpr const char* kBin = ".bin";
constexpr const char* kDeleted = ".deleted";  // in the bin: what is being deleted
constexpr const char* kProjectText = "{\"format\": \"frangia-project\", \"version\": 1}\n";

bool is_file(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(path, ignored);
}

std::int64_t newest_s(const ProjectFolder& project) {
  std::int64_t newest = 0;
  for (const auto& path :
       {project.folder, project.scan, project.derived, project.versions(), project.stations()})
    newest = std::max(newest, modified_s(path));
  return newest;
}

bool is_project(const std::filesystem::path& folder) {
  return is_file(folder / kProjectFile) || is_file(folder / "scan.toml");
}

std::string notes_of(const ProjectFolder& project) {
  constexpr std::uint64_t kMostNoteBytes = 10'000;
  try {
    const auto file = project.notes();
    return is_file(file) ? read_text_file(file, kMostNoteBytes) : std::string();
  } catch (const Error&) {
    return {};
  }
}

/// Copies regular files with their times and folders, not links, and not the lock of another
/// process.
void copy_folder(const std::filesystem::path& from,
                 const std::filesystem::path& to,
                 const Run& run) {
  make_folder(to);
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(from, error)) {
    run.check();
    const auto target = to / entry.path().filename();
    if (entry.is_symlink() || entry.path().filename() == FolderLock::kFileName) continue;
    if (entry.is_directory()) {
      copy_folder(entry.path(), target, run);
    } else if (entry.is_regular_file()) {
      std::filesystem::copy_file(entry.path(), target, error);
      if (!error) std::filesystem::last_write_time(target, entry.last_write_time(), error);
    }
    if (error) break;
  }
  if (error) {
    throw Error(ErrorKind::File,
                fmt::format("{}: cannot be copied: {}", from.string(), error.message()));
  }
}

/// Nobody else has a project open, or captures into its scan folder, while this lives.
class Alone {
 public:
  /// @errors   as FolderLock
  explicit Alone(const ProjectFolder& project) : project_(project.derived) {
    std::error_code ignored;
    if (project.scan != project.derived && std::filesystem::is_directory(project.scan, ignored))
      scan_.emplace(project.scan);
  }

 private:
  FolderLock project_;
  std::optional<FolderLock> scan_;
};

/// A project that holds a link is listed by its name: opening it says which one.
ProjectEntry entry_of(const std::filesystem::path& folder) {
  try {
    const ProjectFolder project = project_in(folder);
    return {project.name,
            newest_s(project),
            is_file(project.in_scan("scan.toml")),
            is_file(project.versions()) || is_file(project.in_derived("surface.ply")),
            modified_s(project.thumbnail()),
            notes_of(project)};
  } catch (const Error&) {
    return {.name = folder.filename().string(), .modified_s = modified_s(folder)};
  }
}

}  // namespace

std::int64_t modified_s(const std::filesystem::path& path) {
  std::error_code error;
  const auto time = std::filesystem::last_write_time(path, error);
  if (error) return 0;
  const auto system = std::chrono::file_clock::to_sys(time);
  return std::chrono::duration_cast<std::chrono::seconds>(system.time_since_epoch()).count();
}

std::filesystem::path ProjectFolder::cloud(std::size_t station) const {
  return in_derived(std::filesystem::path("clouds") / fmt::format("{:03}.bin", station));
}

std::filesystem::path ProjectFolder::reference(const std::string& format, int number) const {
  return in_derived(number == 0 ? fmt::format("reference.{}", format)
                                : fmt::format("reference-{}.{}", number, format));
}

std::filesystem::path ProjectFolder::in_folder(const std::filesystem::path& inner) const {
  return path_below(folder, inner);
}

std::filesystem::path ProjectFolder::in_scan(const std::filesystem::path& inner) const {
  return path_below(folder, scan.lexically_relative(folder) / inner);
}

std::filesystem::path ProjectFolder::in_derived(const std::filesystem::path& inner) const {
  return path_below(folder, derived.lexically_relative(folder) / inner);
}

FileDescriptor ProjectFolder::open_in_derived(const std::filesystem::path& inner,
                                              OpenFor use) const {
  return open_below(folder, derived.lexically_relative(folder) / inner, use);
}

std::string ProjectFolder::read_json(const std::filesystem::path& inner,
                                     std::uint64_t max_bytes) const {
  return read_json_below(folder, derived.lexically_relative(folder) / inner, max_bytes);
}

ProjectFolder project_in(const std::filesystem::path& folder) {
  std::error_code error;
  const auto real = std::filesystem::canonical(folder, error);
  if (error || !is_project(real)) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: is not a project or a scan folder; it holds neither {} nor "
                            "scan.toml",
                            folder.string(),
                            kProjectFile));
  }
  ProjectFolder project{real.filename().string(), real, real, real};
  if (is_file(real / kProjectFile)) {
    project.scan = path_below(real, "scan");
  } else {
    project.derived = path_below(real, "derived");
  }
  return project;
}

std::vector<ProjectEntry> ProjectLibrary::list() const {
  std::vector<ProjectEntry> entries;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(root_, error)) {
    if (entry.is_symlink() || !entry.is_directory(error) || !is_project(entry.path())) continue;
    entries.push_back(entry_of(entry.path()));
  }
  std::sort(entries.begin(), entries.end(), [](const ProjectEntry& a, const ProjectEntry& b) {
    return a.modified_s != b.modified_s ? a.modified_s > b.modified_s : a.name < b.name;
  });
  return entries;
}

ProjectFolder ProjectLibrary::find(const std::string& name) const {
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(root_, error)) {
    if (entry.path().filename().string() != name || entry.is_symlink()) continue;
    return project_in(entry.path());
  }
  throw Error(ErrorKind::Input, "there is no project of this name; choose one of the list");
}

void check_project_name(const std::string& name) {
  constexpr std::size_t kLongest = 60;
  const bool plain = std::none_of(name.begin(), name.end(), [](char letter) {
    return static_cast<unsigned char>(letter) < ' ' || letter == '\x7f' || letter == '/' ||
           letter == '\\';
  });
  if (plain && !name.empty() && name.size() <= kLongest && name.front() != '.' &&
      name.front() != ' ' && name.front() != '-' && name.back() != ' ')
    return;
  throw Error(ErrorKind::Input,
              fmt::format("a project's name has 1 to {} letters, no slash, and begins with a "
                          "letter or a digit; write another one",
                          kLongest));
}

std::filesystem::path ProjectLibrary::free_folder(const std::string& name) const {
  check_project_name(name);
  auto folder = root_ / name;
  std::error_code ignored;
  if (std::filesystem::exists(std::filesystem::symlink_status(folder, ignored))) {
    throw Error(ErrorKind::Input,
                fmt::format("there is a project {} already; write another name", name));
  }
  return folder;
}

void ProjectLibrary::rename(const std::string& name, const std::string& to) const {
  const ProjectFolder project = find(name);
  const auto folder = free_folder(to);
  const Alone alone(project);
  move_folder(project.folder, folder);
}

void ProjectLibrary::duplicate(const std::string& name,
                               const std::string& copy,
                               const Run& run,
                               bool open_here) const {
  const ProjectFolder project = find(name);
  const auto folder = free_folder(copy);
  std::optional<Alone> alone;
  try {
    if (!open_here) alone.emplace(project);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::File) throw;  // where nobody may write, nobody changes it
  }
  const auto unfinished = root_ / ".copy";
  std::error_code ignored;
  std::filesystem::remove_all(unfinished, ignored);
  try {
    copy_folder(project.folder, unfinished, run);
    move_folder(unfinished, folder);
  } catch (...) {
    std::filesystem::remove_all(unfinished, ignored);
    throw;
  }
}

void ProjectLibrary::discard(const std::string& name) const {
  const ProjectFolder project = find(name);
  const auto into = path_below(root_, kBin);  // a link would lead out
  make_folder(into);
  const Alone alone(project);
  move_folder(project.folder, free_name(into, name));
}

std::filesystem::path ProjectLibrary::bin() const {
  return root_ / kBin;
}

std::vector<std::string> ProjectLibrary::discarded() const {
  std::vector<std::string> names;
  std::error_code error;
  if (std::filesystem::is_symlink(bin(), error)) return names;
  for (const auto& entry : std::filesystem::directory_iterator(bin(), error)) {
    if (!entry.is_symlink() && is_project(entry.path()))
      names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string ProjectLibrary::take_back(const std::string& name) const {
  const std::vector<std::string> names = discarded();
  if (std::find(names.begin(), names.end(), name) == names.end())
    throw Error(ErrorKind::Input, "there is no deleted project of this name");
  const auto folder = free_name(root_, name);
  move_folder(bin() / name, folder);
  return folder.filename().string();
}

DiscardedProjects ProjectLibrary::in_bin() const {
  DiscardedProjects found{discarded(), 0};
  for (const std::string& name : found.names) {
    std::error_code error;
    std::filesystem::recursive_directory_iterator entry(bin() / name, error);
    for (; !error && entry != std::filesystem::end(entry); entry.increment(error)) {
      std::error_code unknown;
      if (!entry->is_symlink(unknown) && entry->is_regular_file(unknown)) {
        const auto size = entry->file_size(unknown);
        if (!unknown) found.bytes += size;
      }
    }
  }
  return found;
}

void ProjectLibrary::empty_bin(const std::vector<std::string>& names, const Run& run) const {
  const std::vector<std::string> known = discarded();
  for (const std::string& name : names) {
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw Error(ErrorKind::Input, "there is no deleted project of this name");
  }
  const auto below = path_below(root_, kBin);
  const auto away = path_below(below, kDeleted);
  const auto remove = [&] {
    std::error_code error;
    std::filesystem::remove_all(away, error);
    if (error) {
      throw Error(ErrorKind::File,
                  fmt::format("{}: cannot be deleted: {}", away.string(), error.message()));
    }
  };
  remove();
  for (std::size_t i = 0; i < names.size(); ++i) {
    run.check();
    move_folder(below / names[i], away);
    remove();
    run.report(static_cast<double>(i + 1) / static_cast<double>(names.size()));
  }
}

ProjectFolder ProjectLibrary::create(const std::string& name) const {
  check_project_name(name);
  make_folder(root_);
  const auto folder = root_ / name;
  std::error_code error;
  if (!std::filesystem::create_directory(folder, error)) {
    if (error) {
      throw Error(ErrorKind::File,
                  fmt::format("{}: cannot be created: {}", folder.string(), error.message()));
    }
    throw Error(ErrorKind::Input,
                fmt::format("there is a project {} already; write another name", name));
  }
  write_text_file(folder / kProjectFile, kProjectText);
  return project_in(folder);
}

}  // namespace frangia
