#include "frangia/dataset/scan_folder.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <functional>
#include <set>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/core/angles.h"
#include "frangia/core/atomic_file.h"
#include "frangia/frames/png.h"
#include "frangia/rig/read_rig.h"
#include "frangia/rig/toml_reader.h"

namespace frangia {
namespace {

constexpr std::size_t kMinShifts = 3;
constexpr int kMaxSetups = 1000;

std::string file_name_part(TomlReader& reader, std::string_view key) {
  std::string name = reader.text(key);
  const bool plain = !name.empty() && name.front() != '.' &&
                     std::none_of(name.begin(), name.end(), [](char letter) {
                       return letter == '/' || letter == '\\' || letter == '@' || letter == '\0';
                     });
  if (!plain) {
    reader.fail(key,
                fmt::format("is \"{}\"; it begins file names, so keep to plain letters", name));
  }
  return name;
}

void read_fringes(TomlReader& reader, const Rig& rig, Pattern& pattern) {
  if (rig.projector.is_angular()) {
    pattern.fringes_per_degree = reader.positive("fringes_per_degree");
  } else {
    pattern.period_px = reader.positive("period_px");
  }
  for (const double shift_deg : reader.numbers("shifts_deg")) {
    pattern.shifts_rad.push_back(rad_from_deg(shift_deg));
  }
  if (pattern.shifts_rad.size() < kMinShifts) {
    reader.fail("shifts_deg",
                fmt::format("has {} shifts; a phase needs at least 3", pattern.shifts_rad.size()));
  }
}

void read_gray(TomlReader& reader, const Rig& rig, Pattern& pattern) {
  constexpr int kMaxBits = 24;
  pattern.kind = PatternKind::Gray;
  const auto* model = std::get_if<PinholeModel>(&rig.projector.model);
  if (model == nullptr) reader.fail("kind", "is \"gray\", which an angular projector cannot show");
  pattern.bits = reader.integer("bits", 1, kMaxBits);
  if (reader.has("inverted")) pattern.inverted = reader.boolean("inverted");
  if (reader.has("stripe_px")) pattern.stripe_px = reader.positive("stripe_px");
  const bool rows = pattern.direction == FringeDirection::Horizontal;
  const int side = rows ? model->height_px : model->width_px;
  if (std::ldexp(pattern.stripe_px, pattern.bits) < side * (1.0 - 1e-9)) {
    reader.fail("bits",
                fmt::format("is {}, which numbers fewer than the projector's {} {}",
                            pattern.bits,
                            side,
                            rows ? "rows" : "columns"));
  }
}

void read_ramp(TomlReader& reader, Pattern& pattern) {
  pattern.kind = PatternKind::Ramp;
  pattern.levels = reader.numbers("levels");
  const bool rises =
      std::is_sorted(pattern.levels.begin(), pattern.levels.end(), std::less_equal<>());
  if (pattern.levels.size() < 3 || !rises || pattern.levels.front() != 0.0 ||
      pattern.levels.back() != 1.0)
    reader.fail("levels", "must be three rising shares of full light or more, from 0 to 1");
}

void read_exposures(TomlReader& reader, Pattern& pattern) {
  if (!reader.has("exposures_ms")) return;
  pattern.exposures_ms = reader.numbers("exposures_ms");
  const bool positive = std::all_of(pattern.exposures_ms.begin(),
                                    pattern.exposures_ms.end(),
                                    [](double exposure) { return exposure > 0.0; });
  if (pattern.exposures_ms.empty() || !positive)
    reader.fail("exposures_ms", "must be one exposure or more, each above 0");
  if (pattern.kind != PatternKind::Fringe && pattern.kind != PatternKind::Gray)
    reader.fail("exposures_ms", R"(is for patterns of kind "fringe" and "gray" only)");
}

void read_direction(TomlReader& reader, const Rig& rig, Pattern& pattern) {
  if (!reader.has("direction")) return;
  const std::string direction = reader.text("direction");
  if (direction == "horizontal" && rig.projector.is_angular())
    reader.fail("direction", "is \"horizontal\", but an angular projector's fringes are vertical");
  if (direction != "vertical" && direction != "horizontal") {
    reader.fail("direction",
                fmt::format(R"(is "{}"; it must be "vertical" or "horizontal")", direction));
  }
  if (direction == "horizontal") pattern.direction = FringeDirection::Horizontal;
}

Pattern read_pattern(TomlReader reader, const Rig& rig, const Run& run) {
  Pattern pattern;
  pattern.name = file_name_part(reader, "name");
  read_direction(reader, rig, pattern);
  const std::string kind = reader.text("kind");
  if (kind == "fringe") {
    read_fringes(reader, rig, pattern);
  } else if (kind == "line") {
    pattern.kind = PatternKind::Line;
    if (!rig.laser_sheet)
      reader.fail("kind", "is \"line\", but rig.toml has no [line] that says where it is");
  } else if (kind == "gray") {
    read_gray(reader, rig, pattern);
  } else if (kind == "ramp") {
    read_ramp(reader, pattern);
  } else {
    reader.fail("kind",
                fmt::format(R"(is "{}"; it must be "fringe", "line", "gray" or "ramp")", kind));
  }
  read_exposures(reader, pattern);
  reader.warn_of_unused_keys(run);
  return pattern;
}

ScanView read_view(TomlReader reader, bool has_turntable, const Run& run) {
  ScanView view;
  view.angle_rad =
      rad_from_deg(has_turntable ? reader.number("angle_deg") : reader.number_or("angle_deg", 0.0));
  view.folder = reader.text("folder");
  if (view.folder.is_absolute()) reader.fail("folder", "must be relative to the scan folder");
  if (reader.has("setup")) view.setup = reader.integer("setup", 0, kMaxSetups);
  reader.warn_of_unused_keys(run);
  return view;
}

/// Rough is enough: people type two digits. What is returned is a rotation to all of them.
Eigen::Matrix3d rough_rotation(TomlReader& reader, std::string_view key) {
  constexpr double kRough = 0.05;
  const auto rows = reader.rows(key, 3, 3);
  Eigen::Matrix3d matrix;
  for (int i = 0; i < 9; ++i)
    matrix(i / 3, i % 3) = rows[static_cast<std::size_t>(i / 3)][static_cast<std::size_t>(i % 3)];
  if ((matrix * matrix.transpose() - Eigen::Matrix3d::Identity()).norm() > kRough ||
      matrix.determinant() < 0.0) {
    reader.fail(
        key,
        "is not a rotation: its rows must be of unit length, at right angles, and right-handed");
  }
  return Eigen::Quaterniond(matrix).normalized().toRotationMatrix();
}

/// How the part stands in one setup: `rotation` and `translation_mm`.
void read_part_pose(TomlReader reader,
                    std::map<int, Eigen::Isometry3d>& part_poses,
                    const Run& run) {
  const int setup = reader.integer("number", 1, kMaxSetups);
  Eigen::Isometry3d part_pose = Eigen::Isometry3d::Identity();
  part_pose.linear() = rough_rotation(reader, "rotation");
  const std::vector<double> translation_mm = reader.numbers("translation_mm", 3);
  part_pose.translation() =
      Eigen::Vector3d(translation_mm[0], translation_mm[1], translation_mm[2]);
  if (!part_poses.emplace(setup, part_pose).second)
    reader.fail("number", fmt::format("is {}, which is given twice", setup));
  reader.warn_of_unused_keys(run);
}

/// The frame number in "NAME-12.png" or "NAME-12@1.png", or -1.
int frame_number(const std::string& file, const std::string& pattern_name) {
  const std::string_view ending = ".png";
  const std::size_t begin = pattern_name.size() + 1;
  if (file.size() <= begin + ending.size() || file.size() > begin + ending.size() + 9) return -1;
  if (file.compare(0, begin, pattern_name + "-") != 0) return -1;
  if (file.compare(file.size() - ending.size(), ending.size(), ending) != 0) return -1;
  std::string digits = file.substr(begin, file.size() - begin - ending.size());
  digits.resize(std::min(digits.size(), digits.find('@')));
  if (digits.empty()) return -1;
  const bool all_digits = std::all_of(
      digits.begin(), digits.end(), [](unsigned char letter) { return std::isdigit(letter) != 0; });
  return all_digits ? std::stoi(digits) : -1;
}

void refuse_extra_frames(const std::filesystem::path& folder,
                         const std::vector<Pattern>& patterns) {
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string file = entry.path().filename().string();
    for (const Pattern& pattern : patterns) {
      if (frame_number(file, pattern.name) < pattern.frame_count()) continue;
      throw Error(ErrorKind::Input,
                  fmt::format("{}: is one frame too many: pattern \"{}\" has {} in scan.toml; take "
                              "the file away or correct scan.toml",
                              entry.path().string(),
                              pattern.name,
                              pattern.frame_count()));
    }
  }
}

int brightest(const Frame& frame) {
  return std::visit(
      [](const auto& image) {
        return static_cast<int>(*std::max_element(image.pixels().begin(), image.pixels().end()));
      },
      frame);
}

void check_frame(const Frame& frame,
                 const Frame& first,
                 const Camera& camera,
                 const std::filesystem::path& path) {
  const auto fail = [&](const std::string& what) {
    throw Error(ErrorKind::Input, fmt::format("{}: {}", path.string(), what));
  };
  if (width_of(frame) != camera.model.width_px || height_of(frame) != camera.model.height_px) {
    fail(fmt::format("is {} x {} pixels, but camera.size_px in rig.toml is {} x {}",
                     width_of(frame),
                     height_of(frame),
                     camera.model.width_px,
                     camera.model.height_px));
  }
  if (frame.index() != first.index()) fail("is of another bit depth than the view's first frame");
  if (frame.index() == 0) {
    if (camera.white_level > 255) {
      fail(
          fmt::format("has 8 bits, but camera.white_level in rig.toml is {}; 8-bit frames are "
                      "saturated at 255 or below",
                      camera.white_level));
    }
  } else if (const int top = brightest(frame); top > camera.white_level) {
    fail(
        fmt::format("holds the value {}, above camera.white_level = {} in rig.toml; set it to the "
                    "camera's full scale, such as 4095 for 12 bits",
                    top,
                    camera.white_level));
  }
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char letter : text) {
    if (letter == '"' || letter == '\\') out += '\\';
    out += std::iscntrl(static_cast<unsigned char>(letter)) != 0 ? ' ' : letter;
  }
  return out + "\"";
}

std::string toml_of(const Pattern& pattern) {
  static constexpr std::array kKinds = {"fringe", "line", "gray", "ramp"};
  std::string text = fmt::format("\n[[pattern]]\nname = {}\nkind = \"{}\"\n",
                                 quoted(pattern.name),
                                 kKinds.at(static_cast<std::size_t>(pattern.kind)));
  if (pattern.direction == FringeDirection::Horizontal) text += "direction = \"horizontal\"\n";
  if (!pattern.exposures_ms.empty())
    text += fmt::format("exposures_ms = [{}]\n", fmt::join(pattern.exposures_ms, ", "));
  if (pattern.kind == PatternKind::Ramp)
    text += fmt::format("levels = [{}]\n", fmt::join(pattern.levels, ", "));
  if (pattern.kind == PatternKind::Gray) {
    text += fmt::format("bits = {}\nstripe_px = {}\ninverted = {}\n",
                        pattern.bits,
                        pattern.stripe_px,
                        pattern.inverted);
  }
  if (pattern.kind != PatternKind::Fringe) return text;
  if (pattern.fringes_per_degree > 0.0) {
    text += fmt::format("fringes_per_degree = {}\n", pattern.fringes_per_degree);
  } else {
    text += fmt::format("period_px = {}\n", pattern.period_px);
  }
  std::vector<double> shifts_deg;
  for (const double shift_rad : pattern.shifts_rad)
    shifts_deg.push_back(deg_from_rad(shift_rad));
  text += fmt::format("shifts_deg = [{:.10g}]\n", fmt::join(shifts_deg, ", "));
  return text;
}

}  // namespace

std::string frame_file_name(const Pattern& pattern, int frame, int exposure) {
  if (!pattern.exposures_ms.empty())
    return fmt::format("{}-{}@{}.png", pattern.name, frame, exposure);
  return fmt::format("{}-{}.png", pattern.name, frame);
}

Scan read_scan(const std::filesystem::path& folder, const Run& run) {
  if (!std::filesystem::is_directory(folder)) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: is not a folder; name a scan, a folder that holds scan.toml",
                            folder.string()));
  }
  const std::filesystem::path file = folder / "scan.toml";
  const toml::table table = parse_toml(file, "frangia-scan");
  TomlReader reader(file, "", table);
  for (const auto* known : {"format", "version"})
    reader.ignore(known);
  Scan scan;
  scan.folder = folder;
  scan.rig = read_rig(folder / "rig.toml", run);
  if (reader.has("name")) scan.name = reader.text("name");
  for (const TomlReader& pattern : reader.tables("pattern")) {
    scan.patterns.push_back(read_pattern(pattern, scan.rig, run));
  }
  for (const TomlReader& view : reader.tables("view")) {
    scan.views.push_back(read_view(view, scan.rig.turntable.has_value(), run));
  }
  for (const TomlReader& setup : reader.tables("setup"))
    read_part_pose(setup, scan.part_poses, run);
  if (scan.patterns.empty()) reader.fail("[[pattern]]", "is missing; a scan needs at least one");
  if (scan.views.empty()) reader.fail("[[view]]", "is missing; a scan needs at least one");
  std::set<std::string> names;
  for (const Pattern& pattern : scan.patterns) {
    if (!names.insert(pattern.name).second) {
      reader.fail("[[pattern]]", fmt::format("has the name \"{}\" twice", pattern.name));
    }
  }
  reader.warn_of_unused_keys(run);
  return scan;
}

std::string toml_of(const std::map<int, Eigen::Isometry3d>& part_poses) {
  std::string text;
  for (const auto& [setup, part_pose] : part_poses) {
    text += fmt::format("\n[[setup]]\nnumber = {}\nrotation = [", setup);
    for (int row = 0; row < 3; ++row) {
      text += fmt::format("{}[{:.12g}, {:.12g}, {:.12g}]",
                          row == 0 ? "" : ", ",
                          part_pose.linear()(row, 0),
                          part_pose.linear()(row, 1),
                          part_pose.linear()(row, 2));
    }
    text += fmt::format("]\nshift_mm = [{:.12g}, {:.12g}, {:.12g}]\n",
                        part_pose.translation().x(),
                        part_pose.translation().y(),
                        part_pose.translation().z());
  }
  return text;
}

void write_scan(const Scan& scan) {
  write_rig(scan.folder / "rig.toml", scan.rig);
  std::string text =
      fmt::format("format = \"frangia-scan\"\nversion = 1\nname = {}\n", quoted(scan.name));
  for (const Pattern& pattern : scan.patterns)
    text += toml_of(pattern);
  for (const ScanView& view : scan.views) {
    text += fmt::format("\n[[view]]\nangle_deg = {:.10g}\nfolder = {}\n",
                        deg_from_rad(view.angle_rad),
                        quoted(view.folder.generic_string()));
    if (view.setup != 0) text += fmt::format("setup = {}\n", view.setup);
  }
  text += toml_of(scan.part_poses);
  AtomicFile file(scan.folder / "scan.toml");
  file.stream() << text;
  file.commit();
}

std::vector<FrameStack> read_frames(const Scan& scan, std::size_t view, const Run& run) {
  const std::filesystem::path folder = scan.folder / scan.views.at(view).folder;
  if (!std::filesystem::is_directory(folder)) {
    throw Error(
        ErrorKind::Input,
        fmt::format("{}: there is no such folder, but scan.toml names it", folder.string()));
  }
  refuse_extra_frames(folder, scan.patterns);
  std::vector<FrameStack> stacks;
  for (const Pattern& pattern : scan.patterns) {
    for (int exposure = 0; exposure < pattern.exposure_count(); ++exposure) {
      FrameStack stack{.pattern = pattern,
                       .frames = {},
                       .white_level = scan.rig.camera.white_level,
                       .exposure = exposure};
      for (int frame = 0; frame < pattern.frame_count(); ++frame) {
        run.check();
        const std::filesystem::path path = folder / frame_file_name(pattern, frame, exposure);
        stack.frames.push_back(read_png(path));
        const Frame& first = stacks.empty() ? stack.frames.front() : stacks.front().frames.front();
        check_frame(stack.frames.back(), first, scan.rig.camera, path);
      }
      stacks.push_back(std::move(stack));
    }
  }
  return stacks;
}

}  // namespace frangia
