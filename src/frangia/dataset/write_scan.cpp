#include "frangia/dataset/write_scan.h"

#include <array>
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <toml++/toml.h>

#include "frangia/core/angles.h"
#include "frangia/core/atomic_file.h"
#include "frangia/rig/read_rig.h"

namespace frangia {
namespace {

/// Writes keys in the order of the calls; a toml::table would sort them.
class TomlWriter {
 public:
  void begin_table(const std::string& name) { text_ << "\n[" << name << "]\n"; }
  void begin_table_of_list(const std::string& name) { text_ << "\n[[" << name << "]]\n"; }
  template <typename T>
  void put(const std::string& key, const T& value) {
    text_ << key << " = " << toml::value(value) << '\n';
  }
  void put(const std::string& key, const toml::array& values) {
    text_ << key << " = " << values << '\n';
  }
  void put(const std::string& key, const std::vector<double>& values) {
    toml::array array;
    for (const double value : values)
      array.push_back(value);
    put(key, array);
  }
  void save(const std::filesystem::path& path) const {
    AtomicFile file(path);
    file.stream() << text_.str();
    file.commit();
  }

 private:
  std::ostringstream text_;
};

/// Twelve digits, so that 120 degrees are not written as 120.00000000000001.
double rounded(double value) {
  return std::strtod(fmt::format("{:.12g}", value).c_str(), nullptr);
}

void put_pattern(TomlWriter& writer, const Pattern& pattern) {
  static constexpr std::array kKinds = {"fringe", "line", "gray", "ramp", "white"};
  writer.begin_table_of_list("pattern");
  writer.put("name", pattern.name);
  writer.put("kind", std::string(kKinds.at(static_cast<std::size_t>(pattern.kind))));
  if (pattern.direction == FringeDirection::Horizontal)
    writer.put("direction", std::string("horizontal"));
  if (!pattern.exposures_ms.empty()) writer.put("exposures_ms", pattern.exposures_ms);
  if (pattern.kind == PatternKind::Ramp) writer.put("levels", pattern.levels);
  if (pattern.kind == PatternKind::Gray) {
    writer.put("bits", pattern.bits);
    writer.put("stripe_px", pattern.stripe_px);
    writer.put("inverted", pattern.inverted);
  }
  if (pattern.kind != PatternKind::Fringe) return;
  if (pattern.fringes_per_degree > 0.0) {
    writer.put("fringes_per_degree", pattern.fringes_per_degree);
  } else {
    writer.put("period_px", pattern.period_px);
  }
  std::vector<double> shifts_deg;
  for (const double shift_rad : pattern.shifts_rad)
    shifts_deg.push_back(rounded(deg_from_rad(shift_rad)));
  writer.put("shifts_deg", shifts_deg);
}

void put_part_poses(TomlWriter& writer, const std::map<int, Eigen::Isometry3d>& part_poses) {
  for (const auto& [setup, part_pose] : part_poses) {
    const Eigen::Matrix3d rotation = part_pose.linear();
    const Eigen::Vector3d translation_mm = part_pose.translation();
    toml::array rows;
    for (int row = 0; row < 3; ++row) {
      rows.push_back(toml::array{
          rounded(rotation(row, 0)), rounded(rotation(row, 1)), rounded(rotation(row, 2))});
    }
    writer.begin_table_of_list("setup");
    writer.put("number", setup);
    writer.put("rotation", rows);
    writer.put(
        "translation_mm",
        std::vector{
            rounded(translation_mm.x()), rounded(translation_mm.y()), rounded(translation_mm.z())});
  }
}

void put_board(TomlWriter& writer, const Board& board) {
  writer.begin_table("board");
  writer.put("kind", name_of(board.kind));
  const bool circles = board.kind == BoardKind::Circles;
  writer.put(circles ? "circles" : "corners", toml::array{board.columns, board.rows});
  writer.put(circles ? "spacing_mm" : "square_mm", board.square_mm);
}

}  // namespace

void write_scan(const Scan& scan) {
  write_rig(scan.folder / "rig.toml", scan.rig);
  TomlWriter writer;
  writer.put("format", std::string("frangia-scan"));
  writer.put("version", kScanVersion);
  writer.put("name", scan.name);
  if (scan.board) put_board(writer, *scan.board);
  for (const Pattern& pattern : scan.patterns)
    put_pattern(writer, pattern);
  for (const ScanView& view : scan.views) {
    writer.begin_table_of_list("view");
    writer.put("angle_deg", rounded(deg_from_rad(view.angle_rad)));
    writer.put("folder", view.folder.generic_string());
    if (view.setup != 0) writer.put("setup", view.setup);
  }
  put_part_poses(writer, scan.part_poses);
  writer.save(scan.folder / "scan.toml");
}

void write_part_poses(const std::filesystem::path& path,
                      const std::map<int, Eigen::Isometry3d>& part_poses) {
  TomlWriter writer;
  put_part_poses(writer, part_poses);
  writer.save(path);
}

}  // namespace frangia
