#include "frangia/dataset/write_scan.h"

#include <array>
#include <string>
#include <vector>

#include "frangia/core/angles.h"
#include "frangia/rig/toml_writer.h"
#include "frangia/rig/write_rig.h"

namespace frangia {
namespace {

/// Twelve digits, so that 120 degrees are not written as 120.00000000000001.
double rounded(double value) {
  return rounded_to_digits(value, 12);
}

void put_pattern(TomlWriter& writer, const Pattern& pattern) {
  static constexpr std::array kKinds = {"fringe", "line", "gray", "ramp", "white", "ambient"};
  writer.begin_table_of_list("pattern");
  writer.put("name", pattern.name);
  writer.put("kind", std::string(kKinds.at(static_cast<std::size_t>(pattern.kind))));
  if (pattern.source == PatternSource::Screen) writer.put("source", std::string("screen"));
  if (pattern.direction == FringeDirection::Horizontal)
    writer.put("direction", std::string("horizontal"));
  if (!pattern.exposures_ms.empty()) writer.put("exposures_ms", pattern.exposures_ms);
  if (pattern.kind == PatternKind::Ramp) writer.put("levels", pattern.levels);
  if (pattern.kind == PatternKind::Gray) {
    writer.put("bits", pattern.bits);
    writer.put("stripe_px", pattern.stripe_px);
    if (pattern.offset_px != 0.0) writer.put("offset_px", pattern.offset_px);
    static constexpr std::array kInverted = {"none", "after", "alternating"};
    writer.put("inverted", std::string(kInverted.at(static_cast<std::size_t>(pattern.inverted))));
    if (pattern.is_binary) writer.put("code", std::string("binary"));
    if (pattern.order == BitOrder::LeastSignificantFirst)
      writer.put("order", std::string("lsb-first"));
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
    std::vector<std::vector<double>> rows;
    for (int row = 0; row < 3; ++row) {
      rows.push_back(
          {rounded(rotation(row, 0)), rounded(rotation(row, 1)), rounded(rotation(row, 2))});
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
  writer.put("kind", std::string(name_of(board.kind)));
  const bool circles = board.kind == BoardKind::Circles;
  writer.put(circles ? "circles" : "corners", std::vector<int>{board.columns, board.rows});
  writer.put(circles ? "spacing_mm" : "square_mm", board.square_mm);
  if (circles) writer.put("diameter_mm", circle_diameter_mm(board));
  if (board.kind != BoardKind::Charuco) return;
  writer.put("marker_mm", marker_side_mm(board));
  writer.put("dictionary", board.dictionary);
  if (board.first_id != 0) writer.put("first_id", board.first_id);
  if (board.legacy_layout) writer.put("legacy_layout", true);
}

void put_artifact(TomlWriter& writer, const Artifact& artifact) {
  writer.begin_table("board");
  writer.put("kind", name_of(artifact));
  if (const auto* screen = std::get_if<Screen>(&artifact)) {
    writer.put("size_px", std::vector<int>{screen->width_px, screen->height_px});
    writer.put("pixel_mm", screen->pixel_mm);
  }
  if (const auto* balls = std::get_if<Balls>(&artifact)) {
    writer.put("diameter_mm", balls->diameter_mm);
    if (balls->spacing_mm) writer.put("spacing_mm", *balls->spacing_mm);
  }
}

void put_targets(TomlWriter& writer, const TargetSet& targets) {
  writer.begin_table("targets");
  if (targets.diameter_mm > 0.0) {
    writer.put("diameter_mm", targets.diameter_mm);
    writer.put("disc", std::string(name_of(targets.tone)));
  }
  if (!targets.dictionary.empty()) {
    writer.put("dictionary", targets.dictionary);
    writer.put("marker_mm", targets.marker_mm);
  }
  if (targets.sticker_mm > 0.0) writer.put("sticker_mm", targets.sticker_mm);
  for (const KnownTargetDistance& known : targets.distances) {
    writer.begin_table_of_list("targets.distance");
    writer.put("from", known.first);
    writer.put("to", known.second);
    writer.put("distance_mm", known.distance_mm);
    writer.put("sigma_mm", known.sigma_mm);
  }
}

void put_frame_storage(TomlWriter& writer, const FrameStorage& frames) {
  if (frames == FrameStorage{}) return;
  writer.begin_table("frames");
  writer.put("format", std::string(frames.is_float ? "float" : "png"));
  if (frames.is_float) {
    writer.put("zero", frames.zero);
    writer.put("full_scale", frames.full_scale);
  }
  if (frames.compression_counts2 > 0.0)
    writer.put("compression_counts2", rounded(frames.compression_counts2));
}

TomlWriter composed(const Scan& scan) {
  TomlWriter writer;
  writer.put("format", std::string("frangia-scan"));
  writer.put("version", kScanVersion);
  writer.put("name", scan.name);
  if (scan.board) put_board(writer, *scan.board);
  if (scan.artifact) put_artifact(writer, *scan.artifact);
  if (scan.targets) put_targets(writer, *scan.targets);
  put_frame_storage(writer, scan.frames);
  for (const Pattern& pattern : scan.patterns)
    put_pattern(writer, pattern);
  for (const ScanView& view : scan.views) {
    writer.begin_table_of_list("view");
    writer.put("angle_deg", rounded(deg_from_rad(view.angle_rad)));
    writer.put("folder", view.folder.generic_string());
    if (view.setup != 0) writer.put("setup", view.setup);
  }
  put_part_poses(writer, scan.part_poses);
  return writer;
}

}  // namespace

std::string scan_text(const Scan& scan) {
  return composed(scan).text();
}

void write_scan(const Scan& scan, Durability durability) {
  write_rig(scan.folder / "rig.toml", scan.rig, durability);
  composed(scan).save(scan.folder / "scan.toml", durability);
}

void write_part_poses(const std::filesystem::path& path,
                      const std::map<int, Eigen::Isometry3d>& part_poses) {
  TomlWriter writer;
  put_part_poses(writer, part_poses);
  writer.save(path);
}

}  // namespace frangia
