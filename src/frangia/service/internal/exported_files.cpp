#include "frangia/service/internal/exported_files.h"

#include <algorithm>
#include <cstdint>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>

#include "frangia/core/durable_file.h"
#include "frangia/core/error.h"

namespace frangia {
namespace {

/// What tells a file from one that took its name later. It stays when the file is renamed.
struct FileStamp {
  std::uint64_t inode = 0;
  std::uint64_t bytes = 0;
  std::int64_t modified_ns = 0;

  bool operator==(const FileStamp&) const = default;
};

constexpr std::uint64_t kMostRecordBytes = 64'000'000;

struct ExportRecord {
  std::string name;
  FileStamp stamp;
  ExportOrigin origin;
};

std::optional<FileStamp> stamp_of(const std::filesystem::path& file) {
  constexpr std::int64_t kNanoseconds = 1'000'000'000;
  struct ::stat state {};
  if (::lstat(file.c_str(), &state) != 0 || !S_ISREG(state.st_mode)) return std::nullopt;
  return FileStamp{static_cast<std::uint64_t>(state.st_ino),
                   static_cast<std::uint64_t>(state.st_size),
                   state.st_mtim.tv_sec * kNanoseconds + state.st_mtim.tv_nsec};
}

std::filesystem::path records_file(const ProjectFolder& project) {
  return project.in_derived("exports.json");
}

/// What is recorded; nothing where that cannot be read: the files are there all the same.
std::vector<ExportRecord> read_records(const ProjectFolder& project) {
  std::vector<ExportRecord> records;
  std::error_code error;
  const auto file = records_file(project);
  if (!std::filesystem::is_regular_file(file, error)) return records;
  try {
    const std::string text = project.read_json(file.filename(), kMostRecordBytes);
    const nlohmann::json json = nlohmann::json::parse(text, nullptr, false);
    if (!json.is_object()) return {};
    for (const nlohmann::json& one : json.at("files")) {
      records.push_back({one.at("name").get<std::string>(),
                         {one.at("inode").get<std::uint64_t>(),
                          one.at("bytes").get<std::uint64_t>(),
                          one.at("modified_ns").get<std::int64_t>()},
                         {one.at("version").get<int>(), one.at("revision").get<int>()}});
    }
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception&) {
    return {};
  }
  return records;
}

void write_records(const ProjectFolder& project, const std::vector<ExportRecord>& records) {
  nlohmann::ordered_json json{{"format", "frangia-exports"}, {"version", 1}};
  json["files"] = nlohmann::ordered_json::array();
  for (const ExportRecord& one : records) {
    json["files"].push_back({{"name", one.name},
                             {"version", one.origin.version},
                             {"revision", one.origin.revision},
                             {"inode", one.stamp.inode},
                             {"bytes", one.stamp.bytes},
                             {"modified_ns", one.stamp.modified_ns}});
  }
  write_text_file(records_file(project),
                  json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n",
                  Durability::Synced);
}

/// A file that is removed unless it was renamed.
struct StagedFile {
  explicit StagedFile(std::filesystem::path file) : path(std::move(file)) {}
  StagedFile(const StagedFile&) = delete;
  StagedFile& operator=(const StagedFile&) = delete;
  StagedFile(StagedFile&&) = delete;
  StagedFile& operator=(StagedFile&&) = delete;
  ~StagedFile() {
    std::error_code ignored;
    std::filesystem::remove_all(path.parent_path(), ignored);
  }
  std::filesystem::path path;
};

}  // namespace

std::vector<ExportEntry> exports_of(const ProjectFolder& project) {
  std::vector<ExportEntry> files;
  const std::vector<ExportRecord> records = read_records(project);
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(project.exports(), error)) {
    const std::string name = entry.path().filename().string();
    const auto stamp = stamp_of(entry.path());
    if (!stamp || is_temporary_file_name(name)) continue;
    ExportEntry file{.name = name, .bytes = static_cast<std::size_t>(stamp->bytes)};
    for (const ExportRecord& record : records)
      if (record.name == name && record.stamp == *stamp) file.origin = record.origin;
    files.push_back(std::move(file));
  }
  std::sort(files.begin(), files.end(), [](const ExportEntry& a, const ExportEntry& b) {
    return a.name < b.name;
  });
  return files;
}

WrittenExport write_export(const ProjectFolder& project,
                           const std::string& name,
                           std::optional<ExportOrigin> origin,
                           const std::function<void(const std::filesystem::path&)>& write,
                           const Run& run) {
  const auto target = project.exports() / name;
  const StagedFile staged(project.in_derived(std::filesystem::path("exports") / ".new" / name));
  make_folder(staged.path.parent_path());
  write(staged.path);
  sync_to_disk(staged.path);
  const auto stamp = stamp_of(staged.path);
  if (!stamp) throw Error(ErrorKind::File, fmt::format("{}: is gone", staged.path.string()));
  WrittenExport written{.exports = exports_of(project)};
  if (origin) {
    std::vector<ExportRecord> records = read_records(project);
    std::erase_if(records, [&](const ExportRecord& one) {
      return stamp_of(project.exports() / one.name) != one.stamp;
    });
    records.push_back({name, *stamp, *origin});
    write_records(project, records);
  }
  std::erase_if(written.exports, [&](const ExportEntry& one) { return one.name == name; });
  const auto place = std::find_if(written.exports.begin(),
                                  written.exports.end(),
                                  [&](const ExportEntry& one) { return one.name > name; });
  written.exports.insert(place, {name, static_cast<std::size_t>(stamp->bytes), origin});
  const auto folder = project.exports();
  run.check();  // the last one; what follows the rename cannot fail
  std::error_code error;
  std::filesystem::rename(staged.path, target, error);
  if (error) {
    throw Error(ErrorKind::File,
                fmt::format("{}: cannot be written: {}", target.string(), error.message()));
  }
  try {
    sync_to_disk(folder);
  } catch (const std::exception&) {
    written.unconfirmed = true;
  }
  return written;
}

}  // namespace frangia
