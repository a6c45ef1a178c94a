#include "inspect_alignment.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "frangia/core/angles.h"

#include "option_values.h"

namespace frangia {
namespace {

using Json = nlohmann::ordered_json;

Json json_of_matrix(const Eigen::Isometry3d& pose) {
  Json rows = Json::array();
  for (Eigen::Index row = 0; row < 4; ++row) {
    const Eigen::Vector4d values = pose.matrix().row(row).transpose();
    rows.push_back({values[0], values[1], values[2], values[3]});
  }
  return rows;
}

Json json_of_pose(const AlignmentPose& pose) {
  return {{"matrix", json_of_matrix(pose.reference_from_mesh)},
          {"rms_mm", pose.rms_mm},
          {"overlap", pose.overlap}};
}

}  // namespace

void add_alignment_options(CLI::App& verb, AlignmentArguments& arguments) {
  verb.add_option("--align",
                  arguments.align,
                  "move the mesh onto the reference first: best-fit, from any start; datum, by the "
                  "datums of the --plan; none, as it stands, with its overlap")
      ->check(one_of({"best-fit", "datum", "none"}));
  verb.add_option(
          "--start",
          arguments.start,
          "of the poses that --align best-fit lists because they fit alike, the one to take")
      ->check(from_to(1, 1000));
  verb.add_option("--tolerance",
                  arguments.tolerance_mm,
                  "tolerance of the deviations, mm: T for plus and minus T, or LOWER,UPPER; 0.1 "
                  "by default")
      ->transform(a_length())
      ->delimiter(',')
      ->expected(1, 2);
}

ToleranceLimits AlignmentArguments::band() const {
  constexpr double kUsual = 0.1;
  ToleranceLimits limits{-kUsual, kUsual};
  if (tolerance_mm.size() == 1) limits = {-tolerance_mm[0], tolerance_mm[0]};
  if (tolerance_mm.size() == 2) limits = {tolerance_mm[0], tolerance_mm[1]};
  limits.check();
  return limits;
}

double AlignmentArguments::overlap_tolerance_mm() const {
  if (tolerance_mm.empty()) return 0.0;
  const ToleranceLimits limits = band();
  return std::max(std::abs(limits.lower), std::abs(limits.upper));
}

BestFitOptions AlignmentArguments::best_fit() const {
  BestFitOptions options;
  options.tolerance_mm = overlap_tolerance_mm();
  options.reference_unit_mm = unit_mm.value_or(1.0);
  return options;
}

Alignment align(const Mesh& mesh,
                const RayScene& reference,
                const AlignmentArguments& arguments,
                const Run& run) {
  BestFitOptions options = arguments.best_fit();
  if (arguments.start > 0) options.start = arguments.start - 1;
  if (arguments.align == "best-fit") return align_best_fit(mesh, reference, options, run);
  Alignment as_it_stands;
  as_it_stands.pose = assess_pose(mesh, reference, Eigen::Isometry3d::Identity(), options, run);
  return as_it_stands;
}

void add_alignment(nlohmann::ordered_json& json, const Alignment& alignment) {
  json["alignment"] = json_of_pose(alignment.pose);
  Json poses = Json::array();
  for (const AlignmentPose& pose : alignment.alternatives)
    poses.push_back(json_of_pose(pose));
  json["alignment_details"] = {{"iterations", alignment.pose.iterations},
                               {"free_directions", alignment.free_directions},
                               {"poses", poses}};
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

}  // namespace frangia
