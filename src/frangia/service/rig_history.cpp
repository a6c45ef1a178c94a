#include "frangia/service/rig_history.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/durable_file.h"
#include "frangia/core/error.h"
#include "frangia/core/open_below.h"
#include "frangia/core/read_file.h"
#include "frangia/devices/device_settings.h"
#include "frangia/rig/read_rig.h"
#include "frangia/service/example_rigs.h"
#include "frangia/service/internal/project_names.h"
#include "frangia/simulate/parts.h"

namespace frangia {
namespace {

constexpr const char* kHistory = "rigs";
constexpr const char* kWhy = "before.txt";
bool holds_file(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(std::filesystem::symlink_status(path, ignored));
}

/// Where a rig and what belongs to it are.
struct RigPlace {
  std::filesystem::path rig;
  std::filesystem::path residuals;
  std::filesystem::path report;

  [[nodiscard]] std::filesystem::path truth() const { return true_rig_beside(rig); }
  [[nodiscard]] std::filesystem::path beside(const std::string& name) const {
    return rig.parent_path() / name;
  }
};

RigPlace place_of(const ProjectFolder& project) {
  static_cast<void>(project.in_folder("true-rig.toml"));  // through no link
  return {project.rig(),
          project.residuals(),
          project.in_derived(std::filesystem::path("exports") / "calibration.html")};
}

RigPlace place_in(const std::filesystem::path& folder) {
  return {folder / "rig.toml", folder / "residuals.json", folder / "calibration.html"};
}

/// The CSV file that a rig.toml names; empty without one, and where the rig cannot be read.
std::string covariance_of(const std::filesystem::path& rig) {
  try {
    const Rig read = read_rig(rig, {}, RigContent::StartValues);  // opens no other file
    const std::string name = read.calibration ? read.calibration->covariance_file : std::string();
    return std::filesystem::path(name).filename() == name ? name : std::string();
  } catch (const Error&) {
    return {};
  }
}

void copy_bytes(const std::filesystem::path& from, const std::filesystem::path& to) {
  constexpr std::uint64_t kMostRigBytes = 64'000'000;
  write_text_file(to, read_text_file(from, kMostRigBytes), Durability::Synced);
}

/// Copies what there is; what the source lacks goes at the destination. rig.toml comes last: it
/// names the others.
void copy_rig(const RigPlace& from, const RigPlace& to) {
  make_folder(to.rig.parent_path(), Durability::Synced);
  const std::string covariance = covariance_of(from.rig);
  if (!covariance.empty() && holds_file(from.beside(covariance)))
    copy_bytes(from.beside(covariance), to.beside(covariance));
  const std::array<std::pair<std::filesystem::path, std::filesystem::path>, 3> others = {
      {{from.truth(), to.truth()}, {from.residuals, to.residuals}, {from.report, to.report}}};
  for (const auto& [source, target] : others) {
    std::error_code ignored;
    if (holds_file(source)) {
      make_folder(target.parent_path());
      copy_bytes(source, target);
    } else {
      std::filesystem::remove(target, ignored);
    }
  }
  copy_bytes(from.rig, to.rig);
}

RigFigures figures_of(const std::filesystem::path& file) {
  RigFigures figures;
  try {
    for (DeviceSettings& device : read_device_settings(file)) {
      figures.drivers.push_back(device.text_or("driver", ""));
      figures.has_turntable = figures.has_turntable || device.device() == "turntable";
    }
    const Rig rig = read_rig(file, {}, RigContent::StartValues);
    figures.has_axis = rig.turntable.has_value();
    if (!rig.calibration) return figures;
    figures.date = rig.calibration->date;
    figures.poses = rig.calibration->poses;
    figures.point_sigma_mm = rig.calibration->point_sigma_mm;
  } catch (const Error&) {  // NOLINT(bugprone-empty-catch): restoring the rig reports the error
  }
  return figures;
}

std::filesystem::path inner_of(int number) {
  return std::filesystem::path(kHistory) / fmt::format("{:04}", number);
}

/// The number of a folder of the history; 0 for another one.
int number_of(const std::filesystem::path& folder) {
  const std::string name = folder.filename().string();
  int number = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  return error == std::errc() && end == name.data() + name.size() ? number : 0;
}

/// Numbers of the kept rigs, ascending.
std::vector<int> numbers_of(const ProjectFolder& project) {
  std::vector<int> numbers;
  std::error_code error;
  for (const auto& entry :
       std::filesystem::directory_iterator(project.in_derived(kHistory), error)) {
    const int number = number_of(entry.path());
    if (number > 0 && !entry.is_symlink() && holds_file(entry.path() / "rig.toml"))
      numbers.push_back(number);
  }
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

std::string change_before(const ProjectFolder& project, int number) {
  try {
    const std::string name = read_text_file(project.in_derived(inner_of(number) / kWhy));
    return std::string(name_of(find_named<RigChange>(name).value_or(RigChange::Restored)));
  } catch (const Error&) {
    return std::string(name_of(RigChange::Restored));
  }
}

/// Keeps the present rig. Of the rigs beyond the limit, `spared` is not removed.
void keep_but(const ProjectFolder& project, RigChange before, int spared) {
  const RigPlace present = place_of(project);
  if (!holds_file(present.rig)) return;
  const std::vector<int> numbers = numbers_of(project);
  if (before == RigChange::Geometry && !numbers.empty() &&
      change_before(project, numbers.back()) == name_of(before))
    return;
  const int number = numbers.empty() ? 1 : numbers.back() + 1;
  const auto unfinished = project.in_derived(std::filesystem::path(kHistory) / "new");
  std::filesystem::remove_all(unfinished);
  copy_rig(present, place_in(unfinished));
  write_text_file(unfinished / kWhy, name_of(before), Durability::Synced);
  move_folder(unfinished, project.in_derived(inner_of(number)));
  std::size_t kept = numbers.size() + 1;
  for (std::size_t i = 0; i < numbers.size() && kept > kMostKeptRigs; ++i) {
    if (numbers[i] == spared) continue;
    std::error_code ignored;
    std::filesystem::remove_all(project.in_derived(inner_of(numbers[i])), ignored);
    --kept;
  }
}

}  // namespace

std::vector<KeptRig> kept_rigs(const ProjectFolder& project) {
  std::vector<KeptRig> kept;
  try {
    for (const int number : numbers_of(project)) {
      const auto file = project.in_derived(inner_of(number) / "rig.toml");
      kept.push_back({.number = number,
                      .kept_s = modified_s(file),
                      .before = change_before(project, number),
                      .figures = figures_of(file)});
    }
  } catch (const Error&) {  // NOLINT(bugprone-empty-catch): a link, which whatever changes names
  }
  std::reverse(kept.begin(), kept.end());
  return kept;
}

void keep_rig(const ProjectFolder& project, RigChange before) {
  keep_but(project, before, 0);
}

void restore_rig(const ProjectFolder& project, int number) {
  const std::vector<int> numbers = numbers_of(project);
  if (std::find(numbers.begin(), numbers.end(), number) == numbers.end())
    throw Error(ErrorKind::Input, "there is no earlier rig of this number");
  const RigPlace kept = place_in(project.in_derived(inner_of(number)));
  static_cast<void>(read_rig(kept.rig, {}, RigContent::StartValues));
  keep_but(project, RigChange::Restored, number);
  copy_rig(kept, place_of(project));
}

std::vector<LibraryRig> RigLibrary::list() const {
  std::vector<LibraryRig> rigs;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(root_, error)) {
    const auto file = entry.path() / "rig.toml";
    if (entry.path().filename().string().starts_with('.')) continue;  // unfinished, or the bin
    if (entry.is_symlink() || !entry.is_directory(error) || !holds_file(file)) continue;
    rigs.push_back({entry.path().filename().string(), modified_s(file), figures_of(file)});
  }
  std::sort(rigs.begin(), rigs.end(), [](const LibraryRig& a, const LibraryRig& b) {
    return a.kept_s != b.kept_s ? a.kept_s > b.kept_s : a.name < b.name;
  });
  return rigs;
}

std::filesystem::path RigLibrary::find(const std::string& name) const {
  for (const LibraryRig& rig : list())
    if (rig.name == name) return root_ / rig.name;
  throw Error(ErrorKind::Input, "there is no kept rig of this name; choose one of the list");
}

void RigLibrary::keep(const ProjectFolder& project, const std::string& name) const {
  check_project_name(name);
  const RigPlace present = place_of(project);
  require(holds_file(present.rig), "this project has no rig");
  const auto folder = root_ / name;
  std::error_code ignored;
  if (std::filesystem::exists(std::filesystem::symlink_status(folder, ignored))) {
    throw Error(ErrorKind::Input,
                fmt::format("there is a kept rig {} already; write another name", name));
  }
  const auto unfinished = root_ / ".new";
  std::filesystem::remove_all(unfinished, ignored);
  try {
    copy_rig(present, place_in(unfinished));
    move_folder(unfinished, folder);
  } catch (...) {
    std::filesystem::remove_all(unfinished, ignored);
    throw;
  }
}

void RigLibrary::give(const std::string& name, const ProjectFolder& project) const {
  copy_rig(place_in(find(name)), place_of(project));
}

void RigLibrary::discard(const std::string& name) const {
  const auto folder = find(name);
  const auto bin = path_below(root_, ".bin");  // a link would lead out
  make_folder(bin);
  move_folder(folder, free_name(bin, name));
}

namespace {

bool is_plain_name(std::string_view name) {
  constexpr std::string_view kPlain =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-.:+@";
  return !name.empty() && name.front() != '.' &&
         name.find_first_not_of(kPlain) == std::string_view::npos;
}

/// Whether a text names a serial port or a video device, and cannot name a file.
bool is_device_node(std::string_view path) {
  constexpr std::array<std::string_view, 6> kPlaces = {"/dev/tty",
                                                       "/dev/video",
                                                       "/dev/serial/by-id/",
                                                       "/dev/serial/by-path/",
                                                       "/dev/v4l/by-id/",
                                                       "/dev/v4l/by-path/"};
  return std::any_of(kPlaces.begin(), kPlaces.end(), [&](std::string_view place) {
    return path.starts_with(place) && is_plain_name(path.substr(place.size()));
  });
}

std::string text_of(const SettingValue& value) {
  const auto* text = std::get_if<std::string>(&value);
  return text == nullptr ? std::string() : *text;
}

void check_setting(const DeviceSettings& device,
                   const std::string& key,
                   const SettingValue& value) {
  const std::string text = text_of(value);
  if (key == "folder")
    device.fail(key, "names a folder of this computer, which the app does not open for a browser");
  if (key == "part") {
    const auto parts = part_names();
    if (std::find(parts.begin(), parts.end(), text) == parts.end())
      device.fail(key, "must be a built-in part; the app opens no file for a browser");
  }
  if (key == "true_rig" && text != true_rig_beside("rig.toml").string())
    device.fail(key, "names a file of this computer, which the app does not open for a browser");
  if ((key == "port" || key == "path") && !is_device_node(text)) {
    device.fail(key,
                "must be a serial port or a video device, such as /dev/ttyUSB0 or /dev/video0");
  }
}

}  // namespace

void check_given_devices(std::span<const DeviceSettings> devices) {
  for (const DeviceSettings& device : devices) {
    for (const auto& [key, value] : device.values())
      check_setting(device, key, value);
  }
}

void write_given_rig(const ProjectFolder& project, const GivenRig& given) {
  const std::filesystem::path file = project.rig();
  const auto write = [](const std::filesystem::path& path, const std::string& text) {
    write_text_file(path, text);
  };
  write(file, given.rig);
  const Rig rig = read_rig(file, {}, RigContent::StartValues);  // opens no other file
  const std::vector<DeviceSettings> devices = read_device_settings(file);
  check_given_devices(devices);
  const std::string name = rig.calibration ? rig.calibration->covariance_file : std::string();
  if (name.empty()) return;
  if (!is_plain_name(name) || !name.ends_with(".csv") || name == file.filename()) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: calibration.covariance must name a CSV file beside rig.toml",
                            file.filename().string()));
  }
  if (given.covariance.empty()) {
    throw Error(ErrorKind::Input,
                fmt::format("this rig.toml belongs to {}, which holds the uncertainty of its "
                            "calibration; choose both files together",
                            name));
  }
  write(file.parent_path() / name, given.covariance);
  static_cast<void>(read_rig(file));
}

}  // namespace frangia
