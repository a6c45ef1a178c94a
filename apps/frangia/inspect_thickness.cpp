#include "inspect_thickness.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "frangia/inspect/deviation_summary.h"

#include "fixed_text.h"
#include "json_number.h"

namespace frangia {

namespace {

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

}  // namespace

MeasuredWalls measure_walls(const Mesh& mesh, const Run& run) {
  run.stage("thickness");
  MeasuredWalls walls;
  walls.thickness = thickness_of(RayScene(mesh, run), {}, run);
  walls.summary = summarize(mesh, walls.thickness);
  return walls;
}

void add_thickness(InspectAnswer& answer, const MeasuredWalls& walls) {
  const ThicknessSummary& summary = walls.summary;
  nlohmann::ordered_json counts;
  for (std::size_t i = 0; i < kThicknessStatuses; ++i)
    counts[std::string(name_of(static_cast<ThicknessStatus>(i)))] = summary.count.at(i);
  const Eigen::Vector3d& at = summary.min_at_mm;
  answer.json["thickness"] = {
      {"area_mm2", summary.area_mm2},
      {"mean_mm", number_or_null(summary.mean_mm)},
      {"p5_mm", number_or_null(summary.p5_mm)},
      {"median_mm", number_or_null(summary.median_mm)},
      {"p95_mm", number_or_null(summary.p95_mm)},
      {"min_mm", number_or_null(summary.min_mm)},
      {"min_u_mm", number_or_null(summary.min_u_mm)},
      {"min_at_mm", {number_or_null(at.x()), number_or_null(at.y()), number_or_null(at.z())}},
      {"max_mm", number_or_null(summary.max_mm)},
      {"median_u_mm", number_or_null(summary.median_u_mm)},
      {"vertices", counts}};
  const std::size_t measured =
      summary.count.at(static_cast<std::size_t>(ThicknessStatus::Measured));
  if (measured == 0) {
    answer.text +=
        "thickness: no vertex faces a wall that was measured\n" + without_thickness(summary);
    return;
  }
  answer.text += fmt::format(
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
  answer.text += std::isfinite(summary.median_u_mm)
                     ? fmt::format("its standard uncertainty: {} mm, median\n",
                                   fixed_text(summary.median_u_mm, 4))
                     : "the mesh has no sigma: the uncertainty of the thickness is not known\n";
  answer.text += without_thickness(summary);
}

RenderOptions thickness_picture(const InspectArguments& arguments,
                                const Mesh& mesh,
                                const MeasuredWalls& walls) {
  constexpr std::size_t kBins = 60;
  RenderOptions options;
  options.values = walls.thickness.thickness_mm;
  options.value_label = "thickness, mm";
  const double top = arguments.scale_mm > 0.0              ? arguments.scale_mm
                     : std::isfinite(walls.summary.p95_mm) ? 1.1 * walls.summary.p95_mm
                                                           : 1.0;
  options.value_max = static_cast<float>(top);
  options.histogram = deviation_histogram(mesh, options.values, 0.0, top, kBins);
  return options;
}

}  // namespace frangia
