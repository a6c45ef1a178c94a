#include "frangia/service/internal/surface_versions.h"

#include <algorithm>
#include <charconv>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "frangia/core/durable_file.h"
#include "frangia/core/open_below.h"
#include "frangia/editor/edit_script.h"

namespace frangia {
namespace {

constexpr const char* kVersionsFormat = "frangia-versions";
constexpr int kVersionsFormatVersion = 1;
constexpr std::uint64_t kMostBytes = 64'000'000;

std::filesystem::path versions_folder(const ProjectFolder& project) {
  return project.in_derived("versions");
}

std::filesystem::path folder_of_version(const ProjectFolder& project, int number) {
  return project.in_derived(std::filesystem::path("versions") / fmt::format("{:03}", number));
}

/// The number in a name such as "012" or, between a beginning and an ending, "edits-12.json"; 0:
/// it is no such name.
int number_in(std::string_view name, std::string_view begin = "", std::string_view end = "") {
  if (name.size() <= begin.size() + end.size() || !name.starts_with(begin) || !name.ends_with(end))
    return 0;
  name = name.substr(begin.size(), name.size() - begin.size() - end.size());
  int number = 0;
  const auto [last, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  return error == std::errc() && last == name.data() + name.size() ? number : 0;
}

std::int64_t whole_from(const nlohmann::json& json,
                        const char* key,
                        std::int64_t least,
                        std::int64_t most) {
  const nlohmann::json& value = json.at(key);
  if (!value.is_number_integer() || value.get<double>() < static_cast<double>(least) ||
      value.get<double>() > static_cast<double>(most))
    throw Error(ErrorKind::Input, fmt::format("{} is no number from {} to {}", key, least, most));
  return value.get<std::int64_t>();
}

SurfaceVersion version_from(const nlohmann::json& json, int revision) {
  constexpr std::int64_t kLatest_s = 1'000'000'000'000;
  constexpr std::int64_t kMostSteps = 10'000'000;
  SurfaceVersion version;
  version.number = static_cast<int>(whole_from(json, "number", 1, SurfaceVersions::kMostVersions));
  version.previous =
      static_cast<int>(whole_from(json, "previous", 0, SurfaceVersions::kMostVersions));
  version.built_s = whole_from(json, "built_s", 0, kLatest_s);
  version.in_place = json.value("in_place", false);
  version.edits = static_cast<int>(whole_from(json, "edits", 0, revision));
  version.steps = static_cast<std::size_t>(whole_from(json, "steps", 0, kMostSteps));
  version.done = static_cast<std::size_t>(
      whole_from(json, "done", 0, static_cast<std::int64_t>(version.steps)));
  return version;
}

SurfaceVersions versions_from(const nlohmann::json& json) {
  if (json.value("format", "") != kVersionsFormat)
    throw Error(ErrorKind::Input, "its format is not frangia-versions");
  static_cast<void>(whole_from(json, "version", 1, kVersionsFormatVersion));
  SurfaceVersions versions;
  versions.revision =
      static_cast<int>(whole_from(json, "revision", 1, SurfaceVersions::kMostRevisions));
  versions.current =
      static_cast<int>(whole_from(json, "current", 1, SurfaceVersions::kMostVersions));
  for (const nlohmann::json& one : json.at("versions")) {
    versions.all.push_back(version_from(one, versions.revision));
    const std::size_t count = versions.all.size();
    if (count > 1 && versions.all[count - 2].number >= versions.all[count - 1].number)
      throw Error(ErrorKind::Input, "its versions are not in order");
  }
  if (versions.find(versions.current) == nullptr)
    throw Error(ErrorKind::Input, "its current version is none of them");
  for (const nlohmann::json& one : json.at("answered")) {
    AnsweredCommand answered;
    answered.key.id = one.at("id").get<std::string>();
    answered.key.digest = static_cast<std::uint32_t>(whole_from(one, "digest", 0, UINT32_MAX));
    answered.revision = static_cast<int>(whole_from(one, "revision", 0, versions.revision));
    versions.answered.push_back(std::move(answered));
  }
  return versions;
}

std::string text_of(const SurfaceVersions& versions) {
  nlohmann::ordered_json json{{"format", kVersionsFormat},
                              {"version", kVersionsFormatVersion},
                              {"revision", versions.revision},
                              {"current", versions.current}};
  json["versions"] = nlohmann::ordered_json::array();
  for (const SurfaceVersion& version : versions.all) {
    nlohmann::ordered_json one{{"number", version.number},
                               {"previous", version.previous},
                               {"built_s", version.built_s},
                               {"edits", version.edits},
                               {"steps", version.steps},
                               {"done", version.done}};
    if (version.in_place) one["in_place"] = true;
    json["versions"].push_back(std::move(one));
  }
  json["answered"] = nlohmann::ordered_json::array();
  for (const AnsweredCommand& one : versions.answered) {
    json["answered"].push_back(
        {{"id", one.key.id}, {"digest", one.key.digest}, {"revision", one.revision}});
  }
  return json.dump(1) + '\n';
}

/// What a program before there were versions left.
SurfaceVersions versions_in_place(const ProjectFolder& project) {
  SurfaceVersion version{.number = 1, .in_place = true};
  const VersionFiles files = files_of(project, version);
  std::error_code error;
  if (!std::filesystem::is_regular_file(files.surface(), error)) return {};
  version.built_s = std::max<std::int64_t>(0, modified_s(files.surface()));
  try {
    const EditScript script = read_edit_script(files.edits);
    version.steps = script.steps.size();
    version.done = script.done;
  } catch (const Error&) {  // NOLINT(bugprone-empty-catch): there are none, or the surface's reader
                            // says what is wrong with them
  }
  return {.current = 1, .all = {version}};
}

bool is_named(const SurfaceVersions& versions, int number, const std::string& edits) {
  const SurfaceVersion* version = versions.find(number);
  return version == nullptr || edits == fmt::format("edits-{}.json", version->edits);
}

/// Removes edits of other revisions of a version.
void remove_other_edits(const std::filesystem::path& folder,
                        const SurfaceVersions& versions,
                        int number) {
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    if (number_in(name, "edits-", ".json") == 0 || is_named(versions, number, name)) continue;
    std::filesystem::remove(entry.path(), error);
  }
}

}  // namespace

const SurfaceVersion* SurfaceVersions::find(int number) const {
  const auto found = std::find_if(
      all.begin(), all.end(), [&](const SurfaceVersion& one) { return one.number == number; });
  return found == all.end() ? nullptr : &*found;
}

SurfaceVersion* SurfaceVersions::find(int number) {
  return const_cast<SurfaceVersion*>(std::as_const(*this).find(number));  // NOLINT(*-const-cast)
}

const AnsweredCommand* SurfaceVersions::find(const CommandKey& key) const {
  if (key.id.empty()) return nullptr;
  const auto found = std::find_if(answered.begin(),
                                  answered.end(),
                                  [&](const AnsweredCommand& one) { return one.key.id == key.id; });
  return found == answered.end() ? nullptr : &*found;
}

void SurfaceVersions::answer(const CommandKey& key) {
  if (key.id.empty()) return;
  if (answered.size() >= kMostAnswered) answered.erase(answered.begin());
  answered.push_back({key, revision});
}

std::filesystem::path VersionFiles::setup_cloud(std::size_t joined) const {
  return path_below(folder, std::filesystem::path("clouds") / fmt::format("setup-{}.bin", joined));
}

VersionFiles files_of(const ProjectFolder& project, const SurfaceVersion& version) {
  return {version.in_place ? project.derived : folder_of_version(project, version.number),
          version.in_place && version.edits == 0 ? project.in_derived("edits.json")
                                                 : edits_file(project, version, version.edits)};
}

std::filesystem::path edits_file(const ProjectFolder& project,
                                 const SurfaceVersion& version,
                                 int revision) {
  const auto folder =
      version.in_place ? project.derived : folder_of_version(project, version.number);
  return path_below(folder, fmt::format("edits-{}.json", revision));
}

std::filesystem::path new_version_folder(const ProjectFolder& project) {
  return project.in_derived("versions/.new");
}

int next_version_number(const ProjectFolder& project, const SurfaceVersions& versions) {
  int last = versions.all.empty() ? 0 : versions.all.back().number;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(versions_folder(project), error))
    last = std::max(last, number_in(entry.path().filename().string()));
  return last + 1;
}

SurfaceVersions read_surface_versions(const ProjectFolder& project) {
  const auto file = project.versions();
  std::error_code error;
  if (!std::filesystem::exists(std::filesystem::symlink_status(file, error)))
    return versions_in_place(project);
  std::string why;
  try {
    const std::string text = project.read_json(file.filename(), kMostBytes);
    const nlohmann::json json = nlohmann::json::parse(text, nullptr, false);
    if (json.is_object()) return versions_from(json);
    why = "it is no JSON object";
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& fault) {
    why = fault.what();
  }
  throw Error(ErrorKind::Input,
              fmt::format("{}: does not state the surfaces of this project ({}); restore the file, "
                          "or rename it and build the surface again",
                          file.string(),
                          why));
}

std::string commit_surface_versions(const ProjectFolder& project, const SurfaceVersions& versions) {
  require(versions.revision <= SurfaceVersions::kMostRevisions &&
              versions.all.back().number <= SurfaceVersions::kMostVersions,
          "this project has been changed too often; begin another one");
  try {
    write_text_file(project.versions(), text_of(versions), Durability::Synced);
    return {};
  } catch (...) {
    int found = 0;
    std::string why = "it does not fit into the memory";
    try {
      found = read_surface_versions(project).revision;
    } catch (const std::exception& fault) {
      throw SurfaceUnknown(ErrorKind::File,
                           fmt::format("the change could not be written, and the project cannot be "
                                       "read ({}); check the disk and open the project again",
                                       fault.what()));
    }
    if (found != versions.revision) throw;
    try {
      throw;
    } catch (const Error& fault) {
      why = fault.what();
    } catch (...) {  // NOLINT(bugprone-empty-catch): `why` says it
    }
    return fmt::format(
        "the change is in the project, but the disk did not confirm it ({}); it may "
        "be lost when the power fails",
        why);
  }
}

void remove_leftovers(const ProjectFolder& project, const SurfaceVersions& versions) noexcept {
  try {
    std::error_code error;
    if (!std::filesystem::exists(project.versions(), error)) return;
    // Else a power cut brings the file back that names what is removed here.
    sync_to_disk(project.derived);
    std::filesystem::remove_all(new_version_folder(project), error);
    for (const SurfaceVersion& version : versions.all) {
      const VersionFiles files = files_of(project, version);
      remove_other_edits(files.folder, versions, version.number);
      if (!version.in_place) static_cast<void>(remove_temporary_files(files.folder));
    }
  } catch (const std::exception&) {  // NOLINT(bugprone-empty-catch): they only take space
  }
}

}  // namespace frangia
