#include <algorithm>
#include <cctype>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/dataset/internal/import_images.h"

namespace frangia {
namespace {

/// The reference camera: that of the options, or else the only one that the rig does not name, or
/// the first.
std::string reference_camera(const ImportPlan& plan, const std::vector<std::string>& names) {
  const std::string& given = plan.options.reference;
  if (!given.empty()) {
    if (std::find(names.begin(), names.end(), given) == names.end()) {
      refuse_import(fmt::format(
          "`reference` is \"{}\", but the cameras are {}", given, fmt::join(names, ", ")));
    }
    return given;
  }
  if (plan.options.rig.empty()) return names.front();
  std::vector<std::string> unnamed;
  std::copy_if(names.begin(), names.end(), std::back_inserter(unnamed), [&](const auto& name) {
    return std::none_of(plan.rig.cameras.begin(),
                        plan.rig.cameras.end(),
                        [&](const PosedCamera& posed) { return posed.camera.name == name; });
  });
  if (unnamed.size() != 1) {
    refuse_import(
        fmt::format("{} of the cameras {} are not in more_cameras of {}, but the reference camera "
                    "alone has no name there; correct the names, or set `reference`",
                    unnamed.size(),
                    fmt::join(names, ", "),
                    plan.options.rig.string()));
  }
  return unnamed.front();
}

void check_camera_name(const std::string& name) {
  const bool plain = std::all_of(name.begin(), name.end(), [](unsigned char letter) {
    return std::isalnum(letter) != 0 || letter == '-' || letter == '_';
  });
  if (plain && name != "rejected") return;
  refuse_import(fmt::format(
      "a camera is called \"{}\"; it names a folder: use letters, digits, - and _ only", name));
}

/// Brings `plan.cameras` into the order of the rig, which must hold all of them and no others.
void order_by_rig(ImportPlan& plan) {
  if (plan.options.rig.empty()) return;
  for (const ImportedCamera& camera : plan.cameras) {
    const bool known = std::any_of(
        plan.rig.cameras.begin(), plan.rig.cameras.end(), [&](const PosedCamera& posed) {
          return posed.camera.name == camera.name;
        });
    if (known || &camera == &plan.cameras.front()) continue;
    refuse_import(fmt::format(
        "{} has no camera \"{}\"; add it to more_cameras", plan.options.rig.string(), camera.name));
  }
  std::vector<ImportedCamera> ordered{plan.cameras.front()};
  for (std::size_t i = 1; i < plan.rig.cameras.size(); ++i) {
    const std::string& name = plan.rig.cameras[i].camera.name;
    const auto found = std::find_if(plan.cameras.begin() + 1,
                                    plan.cameras.end(),
                                    [&](const auto& camera) { return camera.name == name; });
    if (found == plan.cameras.end()) {
      refuse_import(
          fmt::format("{} has a camera \"{}\", of which there are no images; put {{camera}} into "
                      "`names`, or remove it from the rig",
                      plan.options.rig.string(),
                      name));
    }
    ordered.push_back(*found);
  }
  plan.cameras = std::move(ordered);
}

}  // namespace

std::vector<std::vector<NamedFile>> files_of_cameras(std::vector<NamedFile> files,
                                                     ImportPlan& plan) {
  std::vector<std::string> names;
  for (const NamedFile& file : files) {
    if (std::find(names.begin(), names.end(), file.fields.camera) == names.end())
      names.push_back(file.fields.camera);
  }
  std::sort(names.begin(), names.end(), is_before_in_natural_order);
  const bool named = !names.front().empty();
  const std::string reference = named ? reference_camera(plan, names) : "";
  plan.cameras = {{reference, {}}};
  for (const std::string& name : names) {
    if (named) check_camera_name(name);
    if (name != reference) plan.cameras.push_back({name, {}});
  }
  order_by_rig(plan);
  std::vector<std::vector<NamedFile>> out(plan.cameras.size());
  for (NamedFile& file : files) {
    const auto camera =
        std::find_if(plan.cameras.begin(), plan.cameras.end(), [&](const ImportedCamera& one) {
          return one.name == file.fields.camera;
        });
    out[static_cast<std::size_t>(camera - plan.cameras.begin())].push_back(std::move(file));
  }
  return out;
}

}  // namespace frangia
