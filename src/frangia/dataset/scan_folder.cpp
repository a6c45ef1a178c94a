#include "frangia/dataset/scan_folder.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/angles.h"
#include "frangia/core/open_below.h"
#include "frangia/core/run.h"
#include "frangia/dataset/internal/read_pattern.h"
#include "frangia/frames/png.h"
#include "frangia/rig/read_rig.h"
#include "frangia/rig/rig.h"
#include "frangia/rig/toml_reader.h"

namespace frangia {
namespace {

constexpr double kMaxSide_px = 65535.0;

/// The length after which fringes of all periods repeat together; the longest period if there is
/// none within the largest projector.
double repeat_length(const std::vector<double>& periods) {
  constexpr double kTolerance = 0.01;  // of a fringe, for periods written with three digits
  const auto [finest, longest] = std::minmax_element(periods.begin(), periods.end());
  for (double count = std::ceil(*longest / *finest - kTolerance); *finest * count <= kMaxSide_px;
       ++count) {
    const double length = *finest * count;
    const bool all = std::all_of(periods.begin(), periods.end(), [&](double period) {
      return std::abs(length / period - std::round(length / period)) < kTolerance;
    });
    if (all) return length;
  }
  return *longest;
}

/// The field in one direction, in pixels or degrees; 0 without patterns in this direction.
double field_of(const std::vector<Pattern>& patterns, FringeDirection direction) {
  std::vector<double> periods;
  for (const Pattern& pattern : patterns) {
    if (pattern.direction != direction) continue;
    if (pattern.kind == PatternKind::Gray) return std::ldexp(pattern.stripe_px, pattern.bits);
    if (pattern.kind == PatternKind::Fringe) periods.push_back(1.0 / pattern.fringes_per_unit());
  }
  return periods.empty() ? 0.0 : repeat_length(periods);
}

int side_px(double field) {
  return static_cast<int>(std::ceil(std::min(field, kMaxSide_px) - 1e-6));
}

/// A rig of which nothing is known.
Rig unknown_rig() {
  Rig rig;
  const Eigen::Vector2d unknown = Eigen::Vector2d::Constant(std::nan(""));
  rig.reference().model.focal_px = rig.reference().model.principal_point_px = unknown;
  rig.projector.position_mm.setConstant(std::nan(""));
  rig.projector.rotation.setConstant(std::nan(""));
  PinholeModel model;
  model.focal_px = model.principal_point_px = unknown;
  rig.projector.model = model;
  return rig;
}

/// Makes an unknown projector angular if the patterns of scan.toml give their fringes per degree.
void choose_projector_model(TomlReader& scan_toml, Projector& projector) {
  const auto* pinhole = std::get_if<PinholeModel>(&projector.model);
  if (pinhole == nullptr || pinhole->width_px > 0) return;
  const std::vector<TomlReader> patterns = scan_toml.tables("pattern");
  const bool angular = std::any_of(patterns.begin(), patterns.end(), [](const TomlReader& pattern) {
    return pattern.has("fringes_per_degree");
  });
  if (angular) projector.model = AngularModel{};
}

/// Takes the camera's size and white level from the first frame of the first view.
///
/// @errors   as reading a frame
void take_camera_from_frames(Scan& scan, const Run& run) {
  // White and ambient frames may be in colour.
  const auto grey =
      std::find_if(scan.patterns.begin(), scan.patterns.end(), [](const Pattern& pattern) {
        return pattern.kind != PatternKind::White && pattern.kind != PatternKind::Ambient;
      });
  const Pattern& pattern = grey == scan.patterns.end() ? scan.patterns.front() : *grey;
  const std::filesystem::path path =
      scan.folder / scan.views.front().folder / frame_file_name(pattern, 0);
  const Frame frame = read_png(path);
  scan.rig.reference().model.width_px = width_of(frame);
  scan.rig.reference().model.height_px = height_of(frame);
  scan.rig.reference().white_level = frame.index() == 0 ? 255 : 65535;
  run.note(fmt::format("{}: there is no rig.toml: frames of {} x {} pixels, white_level {}",
                       scan.folder.string(),
                       width_of(frame),
                       height_of(frame),
                       scan.rig.reference().white_level));
}

/// Gives a projector of unknown size the field over which the patterns in each direction do not
/// repeat: the range of the Gray code, or the least common multiple of the periods.
void assume_field(Scan& scan, const Run& run) {
  const double columns = field_of(scan.patterns, FringeDirection::Vertical);
  const double rows = field_of(scan.patterns, FringeDirection::Horizontal);
  if (auto* angular = std::get_if<AngularModel>(&scan.rig.projector.model)) {
    if (angular->field_min_rad < angular->field_max_rad) return;
    constexpr double kMaxField_deg = 179.0;
    const double half_rad = 0.5 * rad_from_deg(std::min(columns, kMaxField_deg));
    *angular = {-half_rad, half_rad};
    return;
  }
  auto& model = std::get<PinholeModel>(scan.rig.projector.model);
  if (model.width_px > 0) return;
  model.width_px = side_px(columns);
  model.height_px = side_px(rows);
  run.note(fmt::format(
      "the projector's size is unknown: the field is taken as {:g} columns and {:g} rows, over "
      "which the patterns do not repeat",
      columns,
      rows));
}

constexpr int kMostCodes = 249;  // of the largest dictionary

KnownTargetDistance read_distance(TomlReader reader, const Run& run) {
  KnownTargetDistance known;
  known.first = reader.integer("from", 0, kMostCodes);
  known.second = reader.integer("to", 0, kMostCodes);
  known.distance_mm = reader.positive("distance_mm");
  known.sigma_mm = reader.positive("sigma_mm");
  reader.warn_of_unused_keys(run);
  return known;
}

/// Reads the `[targets]` table of scan.toml, without `check_targets`.
///
/// @errors   Error(Input) that names the key
TargetSet read_targets(TomlReader reader, const Run& run) {
  TargetSet targets;
  if (reader.has("diameter_mm")) targets.diameter_mm = reader.positive("diameter_mm");
  if (reader.has("disc")) targets.tone = reader.named<TargetTone>("disc");
  if (reader.has("dictionary")) targets.dictionary = reader.text("dictionary");
  if (reader.has("marker_mm")) targets.marker_mm = reader.positive("marker_mm");
  if (reader.has("sticker_mm")) targets.sticker_mm = reader.positive("sticker_mm");
  for (const TomlReader& distance : reader.tables("distance"))
    targets.distances.push_back(read_distance(distance, run));
  reader.warn_of_unused_keys(run);
  return targets;
}

constexpr int kMaxSetups = 1000;

/// A key of version 1 and the key that replaced it.
struct RenamedKey {
  std::string_view before;
  std::string_view now;
};

/// A scan whose setups are ignored is merged wrongly.
void refuse_renamed(const TomlReader& reader, std::initializer_list<RenamedKey> keys) {
  for (const RenamedKey& key : keys) {
    if (reader.has(key.before))
      reader.fail(key.before, fmt::format("is called {} now; rename it", key.now));
  }
}

/// Whether a name stays in its folder. The operating system would cut it off at a NUL character.
bool lies_inside(const std::filesystem::path& name) {
  return !name.empty() && !name.is_absolute() && name.native().find('\0') == std::string::npos &&
         std::find(name.begin(), name.end(), "..") == name.end();
}

ScanView read_view(TomlReader reader, const Scan& scan, bool only_view, const Run& run) {
  refuse_renamed(reader, {{"round", "setup"}});
  ScanView view;
  const bool needs_angle = scan.rig.turntable && !scan.board && !scan.artifact && !only_view;
  view.angle_rad =
      rad_from_deg(needs_angle ? reader.number("angle_deg") : reader.number_or("angle_deg", 0.0));
  view.folder = reader.text("folder");
  if (!lies_inside(view.folder)) {
    reader.fail("folder",
                fmt::format("is \"{}\"; it must be relative to the scan folder and lie inside it",
                            view.folder.c_str()));  // up to a NUL character
  }
  static_cast<void>(path_below(scan.folder, view.folder));
  if (reader.has("setup")) view.setup = reader.integer("setup", 0, kMaxSetups);
  reader.warn_of_unused_keys(run);
  return view;
}

/// A rotation typed by hand with two digits is accepted; the result is the nearest rotation.
Eigen::Matrix3d rough_rotation(TomlReader& reader, std::string_view key) {
  constexpr double kTolerance = 0.05;  // of R Rᵀ - I; 0.05 is an angle of about 2 degrees
  const auto rows = reader.rows(key, 3, 3);
  Eigen::Matrix3d matrix;
  for (int i = 0; i < 9; ++i)
    matrix(i / 3, i % 3) = rows[static_cast<std::size_t>(i / 3)][static_cast<std::size_t>(i % 3)];
  if ((matrix * matrix.transpose() - Eigen::Matrix3d::Identity()).norm() > kTolerance ||
      matrix.determinant() < 0.0) {
    reader.fail(
        key,
        "is not a rotation: its rows must be of unit length, at right angles, and right-handed");
  }
  return Eigen::Quaterniond(matrix).normalized().toRotationMatrix();
}

/// One `[[setup]]` table: the part pose of a setup.
void read_part_pose(TomlReader reader,
                    std::map<int, Eigen::Isometry3d>& part_poses,
                    const Run& run) {
  refuse_renamed(reader, {{"round", "number"}, {"shift_mm", "translation_mm"}});
  const int setup = reader.integer("number", 1, kMaxSetups);
  Eigen::Isometry3d part_pose = Eigen::Isometry3d::Identity();
  part_pose.linear() = rough_rotation(reader, "rotation");
  const std::vector<double> translation_mm = reader.numbers("translation_mm", 3);
  part_pose.translation() =
      Eigen::Vector3d(translation_mm[0], translation_mm[1], translation_mm[2]);
  if (!part_poses.emplace(setup, part_pose).second)
    reader.fail("number", fmt::format("is {} in two [[setup]] tables; remove one", setup));
  reader.warn_of_unused_keys(run);
}

/// A capture and a simulation write scan.toml last.
void require_complete(const std::filesystem::path& folder) {
  if (std::filesystem::exists(folder / "scan.toml")) return;
  const char* const verb = std::filesystem::exists(folder / "capture") ? "scan"
                           : std::filesystem::exists(folder / "simulation-not-finished")
                               ? "simulate"
                               : nullptr;
  if (verb == nullptr) return;
  throw Error(
      ErrorKind::Input,
      fmt::format("{}: the scan is not complete: run `frangia {}` again with the same options",
                  folder.string(),
                  verb));
}

/// The [frames] table.
FrameStorage read_frame_storage(TomlReader reader, const Rig& rig, const Run& run) {
  FrameStorage storage;
  if (reader.has("format")) {
    const std::string format = reader.text("format");
    if (format != "png" && format != "float")
      reader.fail("format", fmt::format(R"(is "{}"; it must be "png" or "float")", format));
    storage.is_float = format == "float";
  }
  if (storage.is_float) {
    storage.zero = reader.number_or("zero", 0.0);
    storage.full_scale = reader.number("full_scale");
    if (!(storage.full_scale > storage.zero)) reader.fail("full_scale", "must be above zero");
    if (rig.reference().white_level != kFloatWhiteLevel) {
      reader.fail("format",
                  fmt::format("is \"float\", for which camera.white_level in rig.toml must be {}, "
                              "not {}",
                              kFloatWhiteLevel,
                              rig.reference().white_level));
    }
  }
  storage.compression_counts2 = reader.number_or("compression_counts2", 0.0);
  if (storage.compression_counts2 < 0.0) reader.fail("compression_counts2", "must be 0 or above");
  reader.warn_of_unused_keys(run);
  return storage;
}

void require_distinct_names(const TomlReader& reader, const std::vector<Pattern>& patterns) {
  std::set<std::string> names;
  for (const Pattern& pattern : patterns) {
    if (!names.insert(pattern.name).second) {
      reader.fail("[[pattern]]",
                  fmt::format("has the name \"{}\" twice; rename one", pattern.name));
    }
  }
}

/// The frames of one folder must not count as two views: their noise would be taken to be smaller.
void require_distinct_folders(const TomlReader& reader, const std::vector<ScanView>& views) {
  std::set<std::filesystem::path> folders;
  for (const ScanView& view : views) {
    if (!folders.insert(view.folder.lexically_normal()).second) {
      reader.fail(
          "[[view]]",
          fmt::format("has the folder \"{}\" twice; give each view its own", view.folder.string()));
    }
  }
}

}  // namespace

std::string frame_file_name(const Pattern& pattern, int frame, int exposure) {
  if (!pattern.exposures_ms.empty())
    return fmt::format("{}-{}@{}.png", pattern.name, frame, exposure);
  return fmt::format("{}-{}.png", pattern.name, frame);
}

Scan read_scan(const std::filesystem::path& folder, const Run& run, RigContent content) {
  if (!std::filesystem::is_directory(folder)) {
    throw Error(
        ErrorKind::Input,
        fmt::format("{}: {}; name a scan, a folder that holds scan.toml",
                    folder.string(),
                    std::filesystem::exists(folder) ? "is not a folder" : "does not exist"));
  }
  require_complete(folder);
  const std::filesystem::path file = path_below(folder, "scan.toml");
  const toml::table table = parse_toml(file, "frangia-scan", kScanVersion);
  TomlReader reader(file, "", table);
  for (const auto* known : {"format", "version"})
    reader.ignore(known);
  refuse_renamed(reader, {{"round", "[[setup]]"}});
  Scan scan;
  scan.folder = folder;
  const bool has_rig = std::filesystem::exists(folder / "rig.toml");
  if (!has_rig && content == RigContent::Complete) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: is missing; triangulation needs a calibrated rig, only `frangia "
                            "decode` does not",
                            (folder / "rig.toml").string()));
  }
  scan.rig = has_rig || content != RigContent::PhaseOnly
                 ? read_rig(path_below(folder, "rig.toml"), run, content)
                 : unknown_rig();
  if (content == RigContent::PhaseOnly) choose_projector_model(reader, scan.rig.projector);
  if (reader.has("board")) {
    const BoardOrArtifact target = read_board(reader.table("board"), run);
    if (const auto* board = std::get_if<Board>(&target)) scan.board = *board;
    if (const auto* artifact = std::get_if<Artifact>(&target)) scan.artifact = *artifact;
  }
  if (reader.has("targets")) {
    scan.targets = read_targets(reader.table("targets"), run);
    try {
      check_targets(*scan.targets);
    } catch (const Error& error) {
      reader.fail("[targets]:", error.what());
    }
  }
  if (reader.has("frames")) scan.frames = read_frame_storage(reader.table("frames"), scan.rig, run);
  if (reader.has("name")) scan.name = reader.text("name");
  for (const TomlReader& pattern : reader.tables("pattern"))
    scan.patterns.push_back(read_pattern(pattern, scan.rig, run));
  const std::vector<TomlReader> views = reader.tables("view");
  for (const TomlReader& view : views)
    scan.views.push_back(read_view(view, scan, views.size() == 1, run));
  for (const TomlReader& setup : reader.tables("setup"))
    read_part_pose(setup, scan.part_poses, run);
  if (scan.patterns.empty()) reader.fail("[[pattern]]", "is missing; a scan needs at least one");
  if (scan.views.empty()) reader.fail("[[view]]", "is missing; a scan needs at least one");
  require_distinct_names(reader, scan.patterns);
  require_distinct_folders(reader, scan.views);
  if (!has_rig && content == RigContent::PhaseOnly) take_camera_from_frames(scan, run);
  if (content == RigContent::PhaseOnly) assume_field(scan, run);
  reader.warn_of_unused_keys(run);
  return scan;
}

Scan scan_of_camera(const Scan& scan, std::size_t camera) {
  Scan out = scan;
  out.rig = rig_of_camera(scan.rig, camera);
  if (camera == 0) return out;
  for (ScanView& view : out.views)
    view.folder /= out.rig.reference().name;
  return out;
}

}  // namespace frangia
