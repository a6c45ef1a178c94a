#include "frangia/dataset/internal/import_images.h"

#include <algorithm>
#include <cstddef>
#include <exception>
#include <optional>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/core/parallel.h"
#include "frangia/dataset/internal/import_patterns.h"

namespace frangia {
namespace {

namespace fs = std::filesystem;

constexpr int kMostFolders = 2;  // between a folder and its frames: views or cameras, and patterns

/// "1 file", "2 files".
std::string files_text(std::size_t count) {
  return fmt::format("{} file{}", count, count == 1 ? "" : "s");
}

/// The regular files below a folder, at most `depth` folders down, by their relative names.
std::vector<std::string> files_below(const fs::path& folder, int depth) {
  std::vector<std::string> names;
  for (auto entry = fs::recursive_directory_iterator(folder);
       entry != fs::recursive_directory_iterator();
       ++entry) {
    const std::string file = entry->path().filename().string();
    if (entry->is_directory()) {
      if (entry.depth() >= depth || file.front() == '.') entry.disable_recursion_pending();
    } else if (entry->is_regular_file() && file.front() != '.') {
      names.push_back(entry->path().lexically_relative(folder).generic_string());
    }
  }
  std::sort(names.begin(), names.end(), is_before_in_natural_order);
  return names;
}

/// What distinguishes images of one scan that do not fit each other.
std::string kind_of(const ImageInfo& image) {
  return fmt::format("{} x {} pixels, {} bits{}",
                     image.width_px,
                     image.height_px,
                     image.bits,
                     image.channels == 3 ? " of three channels" : "");
}

/// Numbers files whose names state no frame in the order of their names, where they are several of
/// one pattern.
void number_frames(std::vector<NamedFile>& files) {
  std::map<std::tuple<std::string, std::optional<int>, std::string>, std::vector<NamedFile*>>
      groups;
  for (NamedFile& file : files)
    groups[{file.fields.pattern, file.fields.view, file.fields.camera}].push_back(&file);
  for (auto& [key, group] : groups) {
    for (std::size_t i = 0; group.size() > 1 && i < group.size(); ++i)
      group[i]->fields.frame = static_cast<int>(i);
  }
}

}  // namespace

void refuse_import(const std::string& sentence) {
  throw Error(ErrorKind::Input, sentence);
}

std::vector<std::string> images_below(const fs::path& folder, bool raw) {
  // By depth and extension: a preview beside the folders of the frames is none of them.
  std::map<std::pair<std::ptrdiff_t, std::string>, std::vector<std::string>> kinds;
  for (const std::string& name : files_below(folder, kMostFolders)) {
    const std::ptrdiff_t depth = std::count(name.begin(), name.end(), '/');
    if (has_image_extension(name) || (raw && depth == 0))
      kinds[{depth, fs::path(name).extension().string()}].push_back(name);
  }
  const auto most = std::max_element(kinds.begin(), kinds.end(), [](const auto& a, const auto& b) {
    return a.second.size() < b.second.size();
  });
  if (most != kinds.end()) return most->second;
  refuse_import(fmt::format("{}: holds no images; name a folder with images", folder.string()));
}

std::vector<NamedFile> matching_files(const fs::path& folder,
                                      const NameTemplate& names,
                                      const std::vector<std::string>& patterns,
                                      const Run& run) {
  std::vector<NamedFile> files;
  std::vector<std::string> others;
  const std::vector<std::string> all = files_below(folder, names.depth());
  for (const std::string& name : all) {
    const std::vector<NameFields> readings = names.match(name, patterns);
    if (readings.empty()) {
      if (has_image_extension(name)) others.push_back(name);
      continue;
    }
    if (readings.size() > 1) {
      refuse_import(
          fmt::format("{} fits the template \"{}\" in two ways, as pattern \"{}\" frame "
                      "{} and as pattern \"{}\" frame {}; set `patterns`, or a template "
                      "with text between the fields",
                      (folder / name).string(),
                      names.text(),
                      readings[0].pattern,
                      readings[0].frame.value_or(0),
                      readings[1].pattern,
                      readings[1].frame.value_or(0)));
    }
    files.push_back({folder / name, name, readings.front()});
  }
  if (files.empty()) {
    refuse_import(fmt::format("{}: the template \"{}\" fits none of {}{}; correct `names`",
                              folder.string(),
                              names.text(),
                              files_text(all.size()),
                              others.empty() ? "" : fmt::format(", such as {}", others.front())));
  }
  if (!others.empty()) {
    run.note(fmt::format("{} with names that do not fit the template {} left out, such as {}",
                         others.size() == 1 ? "1 image" : fmt::format("{} images", others.size()),
                         others.size() == 1 ? "is" : "are",
                         others.front()));
  }
  if (names.has_any() && !names.has_frame()) number_frames(files);
  return files;
}

void check_images(std::vector<NamedFile>& files, ImportPlan& plan, const Run& run) {
  std::vector<ImageInfo> infos(files.size());
  std::vector<std::exception_ptr> errors(files.size());
  parallel_chunks(files.size(), 1, [&](std::size_t i, std::size_t) {
    try {
      run.check();
      infos[i] = ImageFile(files[i].path, plan.options.files).info();
    } catch (...) {
      errors[i] = std::current_exception();
    }
  });
  for (const std::exception_ptr& error : errors)
    if (error) std::rethrow_exception(error);
  const auto has_fringes = [&](std::size_t i) {
    return !is_light_alone(files[i].fields.pattern, plan.patterns);
  };
  std::size_t first = 0;
  while (first + 1 < files.size() && !has_fringes(first))
    ++first;
  plan.image = infos[first];
  for (std::size_t i = 0; i < files.size(); ++i) {
    files[i].pages = infos[i].pages;
    const ImageInfo& image = infos[i];
    // A white or ambient frame may be in colour beside grey frames.
    const bool same_kind =
        (image.bits == plan.image.bits && image.channels == plan.image.channels) ||
        (!has_fringes(i) && image.channels == 3 && image.bits <= 16);
    if (image.width_px != plan.image.width_px || image.height_px != plan.image.height_px ||
        !same_kind) {
      refuse_import(
          fmt::format("{} has {}, but {} has {}; frames of a scan have one size and depth",
                      files[i].path.string(),
                      kind_of(image),
                      files[first].path.string(),
                      kind_of(plan.image)));
    }
    if (image.orientation != plan.image.orientation) {
      refuse_import(fmt::format(
          "{} has the EXIF orientation {}, but {} has {}; take the frames of a scan with "
          "one orientation of the camera",
          files[i].path.string(),
          image.orientation,
          files[first].path.string(),
          plan.image.orientation));
    }
    if (image.jpeg_quality) {
      const int lowest = plan.jpeg_quality > 0 ? plan.jpeg_quality : *image.jpeg_quality;
      plan.jpeg_quality = std::min(lowest, *image.jpeg_quality);
    }
  }
  if (plan.image.channels == 3 && plan.options.color.from == GreyFrom::Nothing &&
      has_color(ImageFile(files[first].path, plan.options.files).read())) {
    refuse_import(fmt::format("{}: is a colour image; set `color` to red, green, blue or luminance",
                              files[first].path.string()));
  }
}

std::map<int, std::map<std::string, ImageSequence>> sequences_of(
    const std::vector<NamedFile>& files) {
  std::map<int, std::map<std::string, ImageSequence>> views;
  for (std::size_t i = 0; i < files.size(); ++i) {
    const NameFields& fields = files[i].fields;
    ImageSequence& sequence = views[fields.view.value_or(0)][fields.pattern];
    const bool paged = files[i].pages > 1;
    if (paged && fields.frame) {
      refuse_import(
          fmt::format("{}: holds {} images, but its name gives one frame; leave {{frame}} "
                      "out of `names`, or save each image as a file",
                      files[i].path.string(),
                      files[i].pages));
    }
    for (std::size_t page = 0; page < files[i].pages; ++page) {
      const int number = fields.frame.value_or(static_cast<int>(page));
      const auto [same, is_new] = sequence.emplace(number, NamedImage{i, page});
      if (is_new) continue;
      refuse_import(
          fmt::format("{} and {} are the same frame by the template; remove one or correct "
                      "`names`",
                      files[same->second.file].path.string(),
                      files[i].path.string()));
    }
  }
  return views;
}

}  // namespace frangia
