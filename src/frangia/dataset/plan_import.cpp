#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <set>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/core/parallel.h"
#include "frangia/dataset/import_frames.h"
#include "frangia/dataset/internal/import_patterns.h"
#include "frangia/dataset/name_template.h"
#include "frangia/rig/read_rig.h"

namespace frangia {
namespace {

namespace fs = std::filesystem;

/// A file that fits the template.
struct NamedFile {
  fs::path path;
  std::string name;  ///< relative to the folder
  NameFields fields;
  std::size_t pages = 1;
};

/// One image of a file.
struct NamedImage {
  std::size_t file = 0;  ///< index into the files
  std::size_t page = 0;
};

/// The images of one view and pattern, by their numbers.
using ImageSequence = std::map<int, NamedImage>;

[[noreturn]] void refuse_import(const std::string& sentence) {
  throw Error(ErrorKind::Input, sentence);
}

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

/// The images among the files of a folder, or else of its subfolders: those with the most frequent
/// extension.
std::vector<std::string> images_below(const fs::path& folder, bool raw) {
  for (int depth = 0; depth <= 1; ++depth) {
    std::map<std::string, std::vector<std::string>> by_extension;
    for (const std::string& name : files_below(folder, depth)) {
      if (has_image_extension(name) || (raw && depth == 0))
        by_extension[fs::path(name).extension().string()].push_back(name);
    }
    const auto most = std::max_element(
        by_extension.begin(), by_extension.end(), [](const auto& a, const auto& b) {
          return a.second.size() < b.second.size();
        });
    if (most != by_extension.end()) return most->second;
  }
  refuse_import(fmt::format("{}: holds no images; name a folder with images", folder.string()));
}

/// The files that fit the template.
std::vector<NamedFile> matching_files(const fs::path& folder,
                                      const NameTemplate& names,
                                      const std::vector<std::string>& patterns) {
  std::vector<NamedFile> files;
  const std::vector<std::string> all = files_below(folder, names.depth());
  for (const std::string& name : all) {
    const std::vector<NameFields> readings = names.match(name, patterns);
    if (readings.empty()) continue;
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
    const auto example = std::find_if(
        all.begin(), all.end(), [](const std::string& name) { return has_image_extension(name); });
    const bool any = example != all.end();
    refuse_import(fmt::format("{}: the template \"{}\" fits none of {}{}; correct `names`",
                              folder.string(),
                              names.text(),
                              files_text(all.size()),
                              any ? fmt::format(", such as {}", *example) : ""));
  }
  return files;
}

/// What distinguishes images of one scan that do not fit each other.
std::string kind_of(const ImageInfo& image) {
  return fmt::format("{} x {} pixels, {} bits{}",
                     image.width_px,
                     image.height_px,
                     image.bits,
                     image.channels == 3 ? " of three channels" : "");
}

/// Opens every file, several at a time: number of pages, and one size and depth for all.
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
  plan.image = infos.front();
  for (std::size_t i = 0; i < files.size(); ++i) {
    files[i].pages = infos[i].pages;
    const ImageInfo& image = infos[i];
    if (image.width_px != plan.image.width_px || image.height_px != plan.image.height_px ||
        image.bits != plan.image.bits || image.channels != plan.image.channels) {
      refuse_import(
          fmt::format("{} has {}, but {} has {}; frames of a scan have one size and depth",
                      files[i].path.string(),
                      kind_of(image),
                      files.front().path.string(),
                      kind_of(plan.image)));
    }
    if (image.jpeg_quality) {
      const int lowest = plan.jpeg_quality > 0 ? plan.jpeg_quality : *image.jpeg_quality;
      plan.jpeg_quality = std::min(lowest, *image.jpeg_quality);
    }
  }
  if (plan.image.channels == 3 && plan.options.color.from == GreyFrom::Nothing &&
      has_color(ImageFile(files.front().path, plan.options.files).read())) {
    refuse_import(fmt::format("{}: is a colour image; set `color` to red, green, blue or luminance",
                              files.front().path.string()));
  }
}

/// The images of each view and pattern. A page is a further frame of its file.
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

/// "cam_01.png to cam_42.png".
std::string range_text(const ImageSequence& sequence, const std::vector<NamedFile>& files) {
  const std::string first = files[sequence.begin()->second.file].name;
  const std::string last = files[sequence.rbegin()->second.file].name;
  return first == last ? first : fmt::format("{} to {}", first, last);
}

/// The size that scan3d-capture writes beside its images.
std::optional<ProjectorSize> size_beside(const fs::path& folder) {
  std::ifstream file(folder / "projector_info.txt");
  ProjectorSize size{};
  if (!(file >> size[0] >> size[1]) || size[0] < 1 || size[1] < 1 || size[0] > 65535 ||
      size[1] > 65535)
    return std::nullopt;
  return size;
}

/// The rig of the options, or one whose sizes alone are known.
void find_rig(ImportPlan& plan, const Run& run) {
  const ImportOptions& options = plan.options;
  if (!options.rig.empty()) {
    plan.rig = read_rig(options.rig, run, RigContent::StartValues);
    plan.rig_has_projector = true;
    return;
  }
  PinholeModel model;
  std::optional<ProjectorSize> size = options.projector_px;
  if (!size) size = size_beside(plan.folder);
  plan.rig_has_projector = size.has_value();
  // Without a size, a file of patterns is not checked against it.
  model.width_px = size ? (*size)[0] : 1;
  model.height_px = size ? (*size)[1] : 1;
  const Eigen::Vector2d unknown = Eigen::Vector2d::Constant(std::nan(""));
  model.focal_px = model.principal_point_px = unknown;
  plan.rig.camera.model.focal_px = plan.rig.camera.model.principal_point_px = unknown;
  plan.rig.projector.position_mm.setConstant(std::nan(""));
  plan.rig.projector.rotation.setConstant(std::nan(""));
  plan.rig.projector.model = model;
}

ProjectorSize projector_size(const ImportPlan& plan) {
  const auto* const model = std::get_if<PinholeModel>(&plan.rig.projector.model);
  if (!plan.rig_has_projector || model == nullptr) {
    refuse_import(
        fmt::format("the layout {} needs the size of the projector; set `projector`, such as "
                    "1024x768",
                    plan.options.layout));
  }
  return {model->width_px, model->height_px};
}

/// The names of the patterns in natural order; empty without {pattern}.
std::vector<std::string> pattern_names(const std::map<std::string, ImageSequence>& view) {
  std::vector<std::string> names;
  for (const auto& [name, sequence] : view) {
    if (!name.empty()) names.push_back(name);
  }
  std::sort(names.begin(), names.end(), is_before_in_natural_order);
  return names;
}

/// The frames of each pattern that the options describe.
std::vector<std::size_t> frames_per_pattern(const std::map<std::string, ImageSequence>& view,
                                            const std::vector<std::string>& names,
                                            const ImportOptions& options) {
  std::vector<std::size_t> counts;
  for (const std::string& name : names)
    counts.push_back(view.at(name).size());
  if (!names.empty()) return counts;
  const std::size_t all = view.begin()->second.size();
  const std::size_t patterns = std::max(options.fringes.size(), options.period_px.size());
  if (patterns > 0 && all % patterns != 0) {
    refuse_import(
        fmt::format("{} images cannot be shared evenly by {} patterns; set `patterns` to "
                    "a file that describes them",
                    all,
                    patterns));
  }
  return std::vector<std::size_t>(patterns, patterns > 0 ? all / patterns : 0);
}

/// Assigns the images of one view to the frames of the plan's patterns.
class FrameAssigner {
 public:
  FrameAssigner(ImportPlan& plan, const std::vector<NamedFile>& files)
      : plan_(plan), files_(files) {}

  void assign(std::size_t view, const std::map<std::string, ImageSequence>& images) {
    if (images.begin()->first.empty()) {
      assign_sequence(view, images.begin()->second);
    } else {
      assign_patterns(view, images);
    }
  }
  /// Layout of a sequence that another program made; not set for the user's own patterns.
  const ImportLayout* layout = nullptr;

 private:
  void add(const NamedImage& image, std::size_t pattern, std::size_t frame, std::size_t view) {
    plan_.frames.push_back({files_[image.file].path, image.page, pattern, frame, view});
  }
  /// Images that are numbered through all patterns.
  void assign_sequence(std::size_t view, const ImageSequence& images) {
    require_consecutive(images, "", files_);
    std::vector<std::optional<std::pair<std::size_t, std::size_t>>> places;
    if (layout != nullptr) {
      places = layout->images;
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
      const auto frames = static_cast<std::size_t>(described.frame_count());
      if (found->second.size() != frames) {
        refuse_import(
            fmt::format("pattern \"{}\" has {} frames, but {} {} found, {}; a file is "
                        "missing or surplus, or the pattern is described wrongly",
                        described.name,
                        frames,
                        found->second.size(),
                        found->second.size() == 1 ? "was" : "were",
                        range_text(found->second, files_)));
      }
      std::size_t frame = 0;
      for (const auto& [number, image] : found->second)
        add(image, pattern, frame++, view);
    }
  }

  ImportPlan& plan_;
  const std::vector<NamedFile>& files_;
};

void check_views(const ImportPlan& plan) {
  const std::size_t angles = plan.options.angles_rad.size();
  if (angles != 0 && angles != plan.views) {
    refuse_import(fmt::format("`angles` lists {}, but the folder has {} view{}; list one for each",
                              angles,
                              plan.views,
                              plan.views == 1 ? "" : "s"));
  }
  if (angles == 0 && plan.views > 1 && plan.rig.turntable) {
    refuse_import(
        fmt::format("the folder has {} views on a turntable; set `angles` to theirs", plan.views));
  }
  const CameraModel& camera = plan.rig.camera.model;
  if (!plan.options.rig.empty() &&
      (camera.width_px != plan.image.width_px || camera.height_px != plan.image.height_px)) {
    refuse_import(fmt::format("the images have {} x {} pixels, but camera.size_px in {} is {} x {}",
                              plan.image.width_px,
                              plan.image.height_px,
                              plan.options.rig.string(),
                              camera.width_px,
                              camera.height_px));
  }
}

}  // namespace

ImportPlan plan_import(const fs::path& source, const ImportOptions& options, const Run& run) {
  ImportPlan plan;
  plan.options = options;
  const bool is_file = fs::is_regular_file(source);
  if (!is_file && !fs::is_directory(source))
    refuse_import(fmt::format("{}: is neither a folder nor an image file", source.string()));
  plan.folder = is_file && source.has_parent_path() ? source.parent_path() : source;
  if (is_file && !source.has_parent_path()) plan.folder = ".";
  const KnownLayout* const known = options.layout.empty() ? nullptr : find_layout(options.layout);
  if (!options.layout.empty() && known == nullptr)
    refuse_import(fmt::format("`layout` is \"{}\", which is unknown", options.layout));
  find_rig(plan, run);
  if (!options.patterns.empty())
    plan.patterns = read_patterns_file(options.patterns, plan.rig, run);
  plan.names = options.names;
  if (plan.names.empty() && known != nullptr) plan.names = known->names;
  if (plan.names.empty() && is_file) plan.names = guess_name_template({source.filename().string()});
  if (plan.names.empty()) {
    plan.names = guess_name_template(images_below(plan.folder, options.files.raw.has_value()));
    plan.guessed = true;
  }
  std::vector<std::string> described;
  for (const Pattern& pattern : plan.patterns)
    described.push_back(pattern.name);
  std::vector<NamedFile> files = matching_files(plan.folder, NameTemplate(plan.names), described);
  check_images(files, plan, run);
  const auto views = sequences_of(files);
  plan.views = views.size();
  check_views(plan);
  FrameAssigner assigner(plan, files);
  ImportLayout layout;
  const auto& first = views.begin()->second;
  if (known != nullptr) {
    if (!first.begin()->first.empty())
      refuse_import("a `layout` has no names of patterns; leave {pattern} out of `names`");
    layout = make_layout(*known, first.begin()->second.size(), projector_size(plan));
    plan.patterns = layout.patterns;
    assigner.layout = &layout;
  } else if (options.patterns.empty()) {
    const std::vector<std::string> names = pattern_names(first);
    plan.patterns = patterns_from_options(options,
                                          names,
                                          frames_per_pattern(first, names, options),
                                          plan.rig,
                                          plan.rig_has_projector);
  }
  std::size_t view = 0;
  for (const auto& [number, images] : views)
    assigner.assign(view++, images);
  return plan;
}

}  // namespace frangia
