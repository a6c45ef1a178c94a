#include <algorithm>
#include <cctype>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/dataset/internal/import_images.h"

namespace frangia {
namespace {

/// Refuses a gap in the numbers of a sequence.
void require_consecutive(const ImageSequence& sequence,
                         const std::string& pattern,
                         const std::vector<NamedFile>& files) {
  int expected = sequence.begin()->first;
  for (const auto& [number, image] : sequence) {
    if (number != expected) {
      refuse_import(fmt::format("{}frame number {} is missing before {}; restore the file",
                                pattern.empty() ? "" : fmt::format("pattern \"{}\": ", pattern),
                                expected,
                                files[image.file].path.string()));
    }
    ++expected;
  }
}

/// The images of a sequence but those of these numbers.
ImageSequence without(const std::vector<int>& numbers, ImageSequence sequence) {
  for (const int number : numbers)
    sequence.erase(number);
  return sequence;
}

/// "cam_01.png to cam_42.png".
std::string range_text(const ImageSequence& sequence, const std::vector<NamedFile>& files) {
  if (sequence.empty()) return "all are left out by `skip`";
  const std::string first = files[sequence.begin()->second.file].name;
  const std::string last = files[sequence.rbegin()->second.file].name;
  return first == last ? first : fmt::format("{} to {}", first, last);
}

/// Assigns the images of one view to the frames of the plan's patterns.
class FrameAssigner {
 public:
  FrameAssigner(ImportPlan& plan,
                std::size_t camera,
                const std::vector<NamedFile>& files,
                const ImportLayout* layout)
      : plan_(plan), camera_(camera), files_(files), layout_(layout) {}

  void assign(std::size_t view, const std::map<std::string, ImageSequence>& images) {
    if (images.begin()->first.empty()) {
      assign_sequence(view, images.begin()->second);
    } else {
      assign_patterns(view, images);
    }
  }

 private:
  void add(const NamedImage& image, std::size_t pattern, std::size_t frame, std::size_t view) {
    plan_.frames.push_back({files_[image.file].path, image.page, pattern, frame, view, camera_});
  }
  void leave_out(const ImageSequence& images) {
    for (const int number : plan_.options.skip) {
      const auto skipped = images.find(number);
      if (skipped != images.end()) plan_.left_out.push_back(files_[skipped->second.file].path);
    }
  }
  /// Images that are numbered through all patterns.
  void assign_sequence(std::size_t view, const ImageSequence& all) {
    require_consecutive(all, "", files_);
    const ImageSequence images = without(plan_.options.skip, all);
    leave_out(all);
    std::vector<std::optional<std::pair<std::size_t, std::size_t>>> places;
    if (layout_ != nullptr) {
      places = layout_->images;
    } else {
      for (std::size_t pattern = 0; pattern < plan_.patterns.size(); ++pattern) {
        const auto frames = static_cast<std::size_t>(plan_.patterns[pattern].frame_count());
        for (std::size_t frame = 0; frame < frames; ++frame)
          places.emplace_back(std::pair{pattern, frame});
      }
    }
    if (places.size() != images.size()) {
      refuse_import(
          fmt::format("the patterns have {} frames, but {} {} found, {}; a file is missing "
                      "or surplus, or the patterns are described wrongly",
                      places.size(),
                      images.size(),
                      images.size() == 1 ? "was" : "were",
                      range_text(images, files_)));
    }
    std::size_t at = 0;
    for (const auto& [number, image] : images) {
      const auto& place = places[at++];
      if (place) {
        add(image, place->first, place->second, view);
      } else {
        plan_.left_out.push_back(files_[image.file].path);
      }
    }
  }
  void assign_patterns(std::size_t view, const std::map<std::string, ImageSequence>& images) {
    for (std::size_t pattern = 0; pattern < plan_.patterns.size(); ++pattern) {
      const Pattern& described = plan_.patterns[pattern];
      const auto found = images.find(described.name);
      if (found == images.end()) {
        refuse_import(
            fmt::format("{}: no file shows the pattern \"{}\"; correct its name or `names`",
                        plan_.folder.string(),
                        described.name));
      }
      require_consecutive(found->second, described.name, files_);
      const ImageSequence images_of = without(plan_.options.skip, found->second);
      leave_out(found->second);
      const auto frames = static_cast<std::size_t>(described.frame_count());
      if (images_of.size() != frames) {
        refuse_import(
            fmt::format("pattern \"{}\" has {} frames, but {} {} found, {}; a file is "
                        "missing or surplus, or the pattern is described wrongly",
                        described.name,
                        frames,
                        images_of.size(),
                        images_of.size() == 1 ? "was" : "were",
                        range_text(images_of, files_)));
      }
      std::size_t frame = 0;
      for (const auto& [number, image] : images_of)
        add(image, pattern, frame++, view);
    }
  }

  ImportPlan& plan_;
  std::size_t camera_;
  const std::vector<NamedFile>& files_;
  const ImportLayout* layout_;
};

}  // namespace

void assign_frames(ImportPlan& plan,
                   std::size_t view,
                   std::size_t camera,
                   const std::map<std::string, ImageSequence>& images,
                   const std::vector<NamedFile>& files,
                   const ImportLayout* layout) {
  FrameAssigner(plan, camera, files, layout).assign(view, images);
}

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
