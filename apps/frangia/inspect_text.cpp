#include "inspect_text.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/core/angles.h"

#include "fixed_text.h"
#include "option_names.h"
#include "text_table.h"

namespace frangia {
namespace {

using Nominals = std::vector<std::optional<NominalFace>>;

std::string reference_text(const ReferenceSummary& reference) {
  if (!reference.is_cad) return {};
  return fmt::format("reference: {} CAD face{}, unit {}\n",
                     reference.faces,
                     reference.faces == 1 ? "" : "s",
                     reference.unit);
}

std::string alignment_text(const Alignment& alignment) {
  const AlignmentPose& pose = alignment.pose;
  const Eigen::AngleAxisd turn(pose.reference_from_mesh.linear());
  std::string text = fmt::format(
      "alignment: turned by {:.3f} degrees and moved by {:.4f} mm; {:.1f} % of the mesh "
      "lies on the reference, RMS {:.4f} mm\n",
      deg_from_rad(turn.angle()),
      pose.reference_from_mesh.translation().norm(),
      100.0 * pose.overlap,
      pose.rms_mm);
  for (const std::string& direction : alignment.free_directions)
    text += fmt::format("not determined by the shape: {}\n", direction);
  return text;
}

std::string datum_text(const std::vector<DatumResidual>& residuals) {
  std::string text;
  for (const DatumResidual& one : residuals) {
    text += fmt::format("datum {}: {:.4f} mm and {:.4f} degrees from its nominal place\n",
                        one.name,
                        one.distance_mm,
                        deg_from_rad(one.angle_rad));
  }
  return text;
}

std::string points_text(const std::vector<double>& distances_mm) {
  std::string text;
  for (std::size_t i = 0; i < distances_mm.size(); ++i)
    text += fmt::format("pair of points {}: {:.4f} mm apart\n", i + 1, distances_mm[i]);
  return text;
}

bool has_diameter(ShapeKind kind) {
  return kind != ShapeKind::Plane && kind != ShapeKind::Line;
}

std::string vector_text(const Eigen::Vector3d& vector, int decimals) {
  return fixed_text(vector.x(), decimals) + " " + fixed_text(vector.y(), decimals) + " " +
         fixed_text(vector.z(), decimals);
}

std::string cell_text(double value, int decimals) {
  return std::isfinite(value) ? fixed_text(value, decimals) : "";
}

std::string feature_table(const std::vector<Feature>& features, const Nominals& nominals) {
  TextColumn kind{"feature", {}, false};
  TextColumn diameter{"diameter mm", {}};
  TextColumn u95{"U95 mm", {}};
  TextColumn form{"form mm", {}};
  TextColumn center{"center mm", {}, false};
  TextColumn axis{"axis", {}, false};
  TextColumn points{"points", {}};
  for (const Feature& feature : features) {
    const Shape& shape = feature.fit.shape;
    const double none = std::numeric_limits<double>::quiet_NaN();
    const bool bore = feature.hole && has_diameter(shape.kind);
    kind.values.push_back(std::string(name_of(shape.kind)) + (bore ? ", hole" : ""));
    diameter.values.push_back(
        cell_text(has_diameter(shape.kind) ? 2.0 * shape.radius_mm : none, 4));
    u95.values.push_back(cell_text(feature.uncertainty.u95_mm, 4));
    form.values.push_back(cell_text(is_surface(shape.kind) ? feature.fit.form_mm : none, 3));
    const Eigen::Vector3d& c = shape.center_mm;
    center.values.push_back(vector_text(c, 3));
    const Eigen::Vector3d& a = shape.axis;
    axis.values.push_back(shape.kind == ShapeKind::Sphere ? "" : vector_text(a, 4));
    points.values.push_back(fmt::format("{}", feature.fit.points));
  }
  if (nominals.empty()) return text_table({kind, diameter, u95, form, center, axis, points});
  TextColumn face{"CAD face", {}};
  TextColumn size{"nominal mm", {}};
  TextColumn difference{"difference mm", {}};
  for (std::size_t i = 0; i < features.size(); ++i) {
    const auto& nominal = nominals[i];
    const bool sized = nominal && has_diameter(nominal->shape.kind);
    face.values.push_back(nominal ? fmt::format("{}", nominal->number) : "");
    size.values.push_back(sized ? fixed_text(2.0 * nominal->shape.radius_mm, 4) : "");
    difference.values.push_back(
        sized ? signed_text(2.0 * (features[i].fit.shape.radius_mm - nominal->shape.radius_mm), 4)
              : "");
  }
  return text_table({kind, diameter, face, size, difference, u95, form, center, axis, points});
}

std::string statistics_text(const SurfaceStatistics& statistics) {
  const SurfaceError& error = statistics.error;
  std::string text;
  text += fmt::format(
      "{} vertices: RMS {:.4f} mm, bias {}, 95 % within {:.4f}, 99 % within {:.4f}, all "
      "within {:.4f}\n",
      error.count,
      error.rms_mm,
      signed_text(error.bias_mm, 4),
      error.p95_mm,
      error.p99_mm,
      error.max_mm);
  text += fmt::format(
      "{:.1f} % of the {} has mesh within {} mm\n",
      100.0 * statistics.completeness.share,
      statistics.of_views ? "reference that the scan's views could measure" : "reference",
      statistics.within_mm);
  return text;
}

std::string deviation_text(const SurfaceInspection& surface) {
  const DeviationSummary& summary = surface.summary;
  const SurfaceVerdict& verdict = surface.verdict;
  const ToleranceLimits& limits = verdict.rule.limits;
  std::string text;
  text += fmt::format("tolerance {} to {} mm: {}\n",
                      signed_text(limits.lower, 4),
                      signed_text(limits.upper, 4),
                      sentence_of(verdict));
  const bool has_means = std::isfinite(verdict.lowest.deviation_mm);
  text +=
      fmt::format("means over patches of {:.3g} mm: {}; single vertices: {} at {} to {} at {}\n",
                  verdict.rule.min_feature_mm,
                  has_means ? fmt::format("{} to {} mm",
                                          signed_text(verdict.lowest.deviation_mm, 4),
                                          signed_text(verdict.highest.deviation_mm, 4))
                            : "none was measured well enough to be judged",
                  signed_text(summary.min_mm, 4),
                  place_text(summary.min_at_mm),
                  signed_text(summary.max_mm, 4),
                  place_text(summary.max_at_mm));
  text += fmt::format("vertices left out: {}\n", left_out_text(summary));
  return text;
}

/// A line that names how many vertices were left out, and why; empty for none.
std::string without_thickness(const ThicknessSummary& summary) {
  std::vector<std::string> reasons;
  for (std::size_t i = 1; i < kThicknessStatuses; ++i) {
    std::string name(name_of(static_cast<ThicknessStatus>(i)));
    std::replace(name.begin(), name.end(), '_', ' ');
    if (summary.count.at(i) > 0) reasons.push_back(fmt::format("{} {}", summary.count.at(i), name));
  }
  return reasons.empty() ? "" : fmt::format("vertices left out: {}\n", fmt::join(reasons, ", "));
}

std::string thickness_text(const ThicknessSummary& summary) {
  const Eigen::Vector3d& at = summary.min_at_mm;
  const std::size_t measured =
      summary.count.at(static_cast<std::size_t>(ThicknessStatus::Measured));
  if (measured == 0) {
    return "thickness: no vertex faces a wall that was measured\n" + without_thickness(summary);
  }
  std::string text = fmt::format(
      "thickness: {} to {} mm, median {}; 5 % of {} mm2 are below {}; the smallest is at {} {} "
      "{}\n",
      fixed_text(summary.min_mm, 4),
      fixed_text(summary.max_mm, 4),
      fixed_text(summary.median_mm, 4),
      fixed_text(summary.area_mm2, 0),
      fixed_text(summary.p5_mm, 4),
      fixed_text(at.x(), 2),
      fixed_text(at.y(), 2),
      fixed_text(at.z(), 2));
  text += std::isfinite(summary.median_u_mm)
              ? fmt::format("its standard uncertainty: {} mm, median\n",
                            fixed_text(summary.median_u_mm, 4))
              : "the mesh has no sigma: the uncertainty of the thickness is not known\n";
  text += without_thickness(summary);
  return text;
}

std::string characteristics_text(const std::vector<MeasuredCharacteristic>& rows) {
  TextColumn name{"characteristic", {}, false};
  TextColumn value{"measured", {}};
  TextColumn u95{"U95", {}};
  TextColumn unit{"unit", {}, false};
  TextColumn decision{"decision", {}, false};
  for (const MeasuredCharacteristic& row : rows) {
    name.values.push_back(row.name);
    value.values.push_back(std::isfinite(row.value) ? fmt::format("{:.4f}", row.value)
                                                    : "not found");
    u95.values.push_back(std::isfinite(row.u95) ? fmt::format("{:.4f}", row.u95) : "");
    unit.values.push_back(row.unit);
    decision.values.emplace_back(row.limits ? name_of(row.conformity) : "");
  }
  std::string text = text_table({name, value, u95, unit, decision});
  for (const MeasuredCharacteristic& row : rows) {
    if (!row.reason.empty()) text += fmt::format("{}: {}\n", row.name, row.reason);
  }
  return text;
}

/// The decision about the whole part, where characteristics decide beside the surface.
std::string verdict_text(const Inspection& part) {
  const bool limited = std::any_of(part.characteristics.begin(),
                                   part.characteristics.end(),
                                   [](const auto& row) { return row.limits.has_value(); });
  if (!limited || part.reasons.empty()) return {};
  return fmt::format(
      "verdict about the part: {}; {}\n", name_of(part.verdict), part.reasons.front().text());
}

std::string section_text(const SectionResult& section) {
  std::string text = fmt::format("section {}: {} curve{}\n",
                                 section.name,
                                 section.measured.size(),
                                 section.measured.size() == 1 ? "" : "s");
  if (!section.blade) return text;
  text += fmt::format(
      "  chord {:.3f} mm, largest thickness {:.3f} mm, leading radius {:.3f} mm, trailing "
      "radius {:.3f} mm, stagger {:.3f} degrees\n",
      section.blade->chord_mm,
      section.blade->max_thickness_mm,
      section.blade->leading_radius_mm,
      section.blade->trailing_radius_mm,
      deg_from_rad(section.blade->stagger_rad));
  return text;
}

}  // namespace

std::string inspection_text(const Inspection& part, bool features) {
  constexpr const char* kDefaultTolerance =
      "the tolerance is the default, because none is stated: set `tolerance`, or tolerance_mm of a "
      "plan\n";
  std::string text;
  if (part.reference) text += reference_text(*part.reference);
  if (part.alignment) text += alignment_text(*part.alignment);
  text += datum_text(part.datums);
  text += points_text(part.points_mm);
  if (features) {
    text += feature_table(part.features, part.nominals);
    const bool unknown = std::any_of(part.features.begin(),
                                     part.features.end(),
                                     [](const auto& one) { return !one.uncertainty.is_known; });
    if (unknown) text += "the mesh states no sigma: the U95 of its features is not known\n";
  }
  if (part.statistics) text += statistics_text(*part.statistics);
  if (part.surface) text += deviation_text(*part.surface);
  if (part.surface && part.tolerance_is_default) text += with_flags(kDefaultTolerance);
  if (part.walls) text += thickness_text(part.walls->summary);
  if (!part.characteristics.empty()) text += characteristics_text(part.characteristics);
  for (const SectionResult& section : part.sections)
    text += section_text(section);
  return text + verdict_text(part);
}

}  // namespace frangia
