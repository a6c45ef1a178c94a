#include "frangia/dataset/internal/assume_rig.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/angles.h"
#include "frangia/frames/png.h"

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

}  // namespace

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

void choose_projector_model(TomlReader& scan_toml, Projector& projector) {
  const auto* pinhole = std::get_if<PinholeModel>(&projector.model);
  if (pinhole == nullptr || pinhole->width_px > 0) return;
  const std::vector<TomlReader> patterns = scan_toml.tables("pattern");
  const bool angular = std::any_of(patterns.begin(), patterns.end(), [](const TomlReader& pattern) {
    return pattern.has("fringes_per_degree");
  });
  if (angular) projector.model = AngularModel{};
}

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

}  // namespace frangia
