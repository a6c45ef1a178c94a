#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/core/read_file.h"
#include "frangia/dataset/import_frames.h"
#include "frangia/dataset/internal/import_images.h"
#include "frangia/dataset/internal/import_patterns.h"
#include "frangia/dataset/name_template.h"
#include "frangia/frames/grey_image.h"
#include "frangia/rig/read_rig.h"
#include "frangia/rig/rig_covariance.h"

namespace frangia {
namespace {

namespace fs = std::filesystem;

/// The size that scan3d-capture writes into the folder of its images.
std::optional<ProjectorSize> size_beside(const fs::path& folder) {
  constexpr std::uint64_t kMostBytes = 1000;
  const fs::path file = folder / "projector_info.txt";
  if (!fs::exists(file)) return std::nullopt;
  std::istringstream text(read_text_file(file, kMostBytes));
  ProjectorSize size{};
  if (!(text >> size[0] >> size[1]) || size[0] < 1 || size[1] < 1 || size[0] > 65535 ||
      size[1] > 65535)
    return std::nullopt;
  return size;
}

/// The rig of the options, or one whose sizes alone are known.
void find_rig(ImportPlan& plan, const Run& run) {
  const ImportOptions& options = plan.options;
  if (!options.rig.empty()) {
    plan.rig = read_rig(options.rig, run, RigContent::StartValues);
    auto& calibration = plan.rig.calibration;
    if (calibration && !calibration->covariance_file.empty()) {
      const fs::path file = options.rig.parent_path() / calibration->covariance_file;
      calibration->covariance = read_rig_covariance(file, plan.rig);
    }
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
  plan.rig.reference().model.focal_px = plan.rig.reference().model.principal_point_px = unknown;
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
  const auto kept = [&](const ImageSequence& images) {
    return static_cast<std::size_t>(
        std::count_if(images.begin(), images.end(), [&](const auto& image) {
          return std::find(options.skip.begin(), options.skip.end(), image.first) ==
                 options.skip.end();
        }));
  };
  std::vector<std::size_t> counts;
  for (const std::string& name : names)
    counts.push_back(kept(view.at(name)));
  if (!names.empty()) return counts;
  const std::size_t all = kept(view.begin()->second);
  const std::size_t patterns = std::max(options.fringes.size(), options.period_px.size());
  if (patterns > 0 && all % patterns != 0) {
    refuse_import(
        fmt::format("{} images cannot be shared evenly by {} patterns; set `patterns` to "
                    "a file that describes them",
                    all,
                    patterns));
  }
  const std::size_t each = patterns > 0 ? all / patterns : 0;
  counts.assign(patterns, each);
  return counts;
}

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
  if (plan.options.rig.empty()) return;
  for (std::size_t i = 0; i < plan.cameras.size(); ++i) {
    const CameraModel& camera = plan.rig.cameras[i].camera.model;
    const ImageInfo& image = plan.cameras[i].image;
    if (camera.width_px == image.width_px && camera.height_px == image.height_px) continue;
    refuse_import(fmt::format("the images{} have {} x {} pixels, but {}.size_px in {} is {} x {}",
                              i == 0 ? "" : fmt::format(" of camera \"{}\"", plan.cameras[i].name),
                              image.width_px,
                              image.height_px,
                              i == 0 ? "camera" : "more_cameras",
                              plan.options.rig.string(),
                              camera.width_px,
                              camera.height_px));
  }
}

/// Decides by which orientation the images of a camera are turned, and notes it.
void orient_images(ImportPlan& plan, std::size_t index, const Run& run) {
  ImportedCamera& camera = plan.cameras[index];
  ImageInfo& image = camera.image;
  if (image.orientation == 1) return;
  const bool exchanged = exchanges_sides(image.orientation);
  const int shown_width_px = exchanged ? image.height_px : image.width_px;
  const int shown_height_px = exchanged ? image.width_px : image.height_px;
  const std::string what =
      fmt::format("the frames{} have the EXIF orientation {}",
                  index == 0 ? "" : fmt::format(" of camera \"{}\"", camera.name),
                  image.orientation);
  FrameOrientation wanted = plan.options.orientation;
  if (wanted == FrameOrientation::ByRig && plan.options.rig.empty())
    wanted = FrameOrientation::Stored;
  if (wanted == FrameOrientation::ByRig) {
    const CameraModel& model = plan.rig.cameras[index].camera.model;
    const bool stored = model.width_px == image.width_px && model.height_px == image.height_px;
    const bool shown = model.width_px == shown_width_px && model.height_px == shown_height_px;
    if (stored && shown) {
      refuse_import(fmt::format(
          "{}: programs show them turned, and the rig's size fits both ways; set `orientation` to "
          "stored if {} was calibrated with the pixels as the files store them, or to shown if "
          "with "
          "pictures that were turned, as cv2.imread does",
          what,
          plan.options.rig.string()));
    }
    wanted = shown ? FrameOrientation::Shown : FrameOrientation::Stored;
  }
  if (wanted == FrameOrientation::Stored) {
    run.note(what + "; they are imported as stored, not turned");
    return;
  }
  camera.turned = image.orientation;
  image.width_px = shown_width_px;
  image.height_px = shown_height_px;
  run.note(what + "; they are imported turned, as programs show them");
}

/// Opens the images of all cameras. They may differ in size, not in depth.
void check_cameras(std::vector<std::vector<NamedFile>>& files, ImportPlan& plan, const Run& run) {
  for (std::size_t i = 0; i < files.size(); ++i) {
    check_images(files[i], plan, run);
    plan.cameras[i].image = plan.image;
    orient_images(plan, i, run);
  }
  plan.image = plan.cameras.front().image;
  for (const ImportedCamera& camera : plan.cameras) {
    if (camera.image.bits == plan.image.bits && camera.image.channels == plan.image.channels)
      continue;
    refuse_import(fmt::format(
        "the images of camera \"{}\" have {} bits and {} channel{}, those of camera \"{}\" {} and "
        "{}; frames of a scan have one depth",
        camera.name,
        camera.image.bits,
        camera.image.channels,
        camera.image.channels == 1 ? "" : "s",
        plan.cameras.front().name,
        plan.image.bits,
        plan.image.channels));
  }
}

/// The plan up to the names of its files: folder, rig, patterns that a file describes.
ImportPlan start_plan(const fs::path& source,
                      const ImportOptions& options,
                      const KnownLayout* known,
                      const Run& run) {
  ImportPlan plan;
  plan.options = options;
  const bool is_file = fs::is_regular_file(source);
  if (!is_file && !fs::is_directory(source))
    refuse_import(fmt::format("{}: is neither a folder nor an image file", source.string()));
  plan.folder = is_file && source.has_parent_path() ? source.parent_path() : source;
  if (is_file && !source.has_parent_path()) plan.folder = ".";
  find_rig(plan, run);
  if (!options.patterns.empty()) {
    DescribedFrames described = read_patterns_file(options.patterns, plan.rig, run);
    plan.patterns = std::move(described.patterns);
    if (described.board) {
      if (const auto* board = std::get_if<Board>(&*described.board)) plan.board = *board;
      if (const auto* artifact = std::get_if<Artifact>(&*described.board))
        plan.artifact = *artifact;
    }
  }
  plan.names = options.names;
  if (plan.names.empty() && known != nullptr) plan.names = known->names;
  if (plan.names.empty() && is_file) plan.names = guess_name_template({source.filename().string()});
  if (plan.names.empty()) {
    plan.names = guess_name_template(images_below(plan.folder, options.files.raw.has_value()));
    plan.guessed = true;
  }
  return plan;
}

}  // namespace

ImportPlan plan_import(const fs::path& source, const ImportOptions& options, const Run& run) {
  const KnownLayout* const known = options.layout.empty() ? nullptr : find_layout(options.layout);
  if (!options.layout.empty() && known == nullptr)
    refuse_import(fmt::format(R"(`layout` is "{}", which is unknown)", options.layout));
  ImportPlan plan = start_plan(source, options, known, run);
  std::vector<std::string> described;
  for (const Pattern& pattern : plan.patterns)
    described.push_back(pattern.name);
  std::vector<std::vector<NamedFile>> files =
      files_of_cameras(matching_files(plan.folder, NameTemplate(plan.names), described, run), plan);
  check_cameras(files, plan, run);
  std::vector<std::map<int, std::map<std::string, ImageSequence>>> of_cameras;
  for (std::size_t i = 0; i < files.size(); ++i) {
    of_cameras.push_back(sequences_of(files[i]));
    if (of_cameras[i].size() == of_cameras[0].size()) continue;
    refuse_import(fmt::format(
        R"(camera "{}" has {} views, but camera "{}" has {}; each camera takes all views)",
        plan.cameras[i].name,
        of_cameras[i].size(),
        plan.cameras[0].name,
        of_cameras[0].size()));
  }
  const auto& views = of_cameras.front();
  plan.views = views.size();
  check_views(plan);
  ImportLayout layout;
  const auto& first = views.begin()->second;
  if (known != nullptr) {
    if (!first.begin()->first.empty())
      refuse_import("a `layout` has no names of patterns; leave {pattern} out of `names`");
    layout = make_layout(*known, first.begin()->second.size(), projector_size(plan));
    plan.patterns = layout.patterns;
  } else if (options.patterns.empty()) {
    const std::vector<std::string> names = pattern_names(first);
    plan.patterns = patterns_from_options(options,
                                          names,
                                          frames_per_pattern(first, names, options),
                                          plan.rig,
                                          plan.rig_has_projector);
  }
  for (std::size_t camera = 0; camera < files.size(); ++camera) {
    std::size_t view = 0;
    for (const auto& [number, images] : of_cameras[camera]) {
      assign_frames(
          plan, view++, camera, images, files[camera], known != nullptr ? &layout : nullptr);
    }
  }
  return plan;
}

}  // namespace frangia
