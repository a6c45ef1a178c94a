#include "reconstruct_result.h"

#include <cmath>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "frangia/core/angles.h"

#include "counted.h"
#include "fixed_text.h"
#include "json_number.h"
#include "mesh_result.h"
#include "option_names.h"
#include "print_text.h"
#include "quality_json.h"
#include "refinement_text.h"
#include "text_table.h"

namespace frangia {
namespace {

nlohmann::ordered_json json_of(const PoseExplanation& found) {
  nlohmann::ordered_json json;
  json["best"] = name_of(found.best);
  json["alike"] = nlohmann::ordered_json::array();
  for (const PoseCause cause : found.alike)
    json["alike"].push_back(name_of(cause));
  json["second"] = name_of(found.second);
  json["log_odds"] = found.log_odds;
  json["decided"] = found.decided;
  json["views"] = found.views;
  json["effect_mm"] = found.effect_mm;
  json["moved_mm"] = found.moved_mm;  // NaN is written as null
  json["moved_sigma_mm"] = found.moved_sigma_mm;
  json["turned_deg"] = deg_from_rad(found.turned_rad);
  json["turned_sigma_deg"] = deg_from_rad(found.turned_sigma_rad);
  json["scale"] = found.scale;
  json["terms"] = found.terms;
  json["time_constant"] = found.time_constant;
  json["times_assumed"] = found.times_assumed;
  json["unexplained_mm"] = found.unexplained_mm;
  json["text"] = found.text;
  json["remedy"] = found.remedy;
  return json;
}

nlohmann::ordered_json json_of(const RegistrationReport& report) {
  const auto number = [](double value) {  // JSON has no NaN
    return std::isnan(value) ? nlohmann::ordered_json() : nlohmann::ordered_json(value);
  };
  nlohmann::ordered_json json;
  json["rms_before_mm"] = report.rms_before_mm;
  json["rms_after_mm"] = report.rms_after_mm;
  json["closure_before_deg"] = number(deg_from_rad(report.closure_before_rad));
  json["closure_after_deg"] = number(deg_from_rad(report.closure_after_rad));
  json["overlap"] = report.overlap;
  json["condition"] = report.condition;
  json["weakest"] = report.weakest;
  json["axis"] = {report.table.axis.x(), report.table.axis.y(), report.table.axis.z()};
  json["point_mm"] = {
      report.table.point_mm.x(), report.table.point_mm.y(), report.table.point_mm.z()};
  json["axis_sigma_mm"] = report.axis_sigma_mm;
  json["axis_moved_mm"] = report.axis_moved_mm();
  json["axis_turned_deg"] = deg_from_rad(report.axis_turned_rad());
  json["angles_deg"] = nlohmann::ordered_json::array();
  for (const double angle : report.angles_rad)
    json["angles_deg"].push_back(deg_from_rad(angle));
  json["part_poses"] = nlohmann::ordered_json::array();
  for (const Eigen::Isometry3d& part_pose : report.part_poses) {
    nlohmann::ordered_json rows;
    for (int row = 0; row < 3; ++row)
      rows.push_back({part_pose(row, 0), part_pose(row, 1), part_pose(row, 2), part_pose(row, 3)});
    json["part_poses"].push_back(rows);
  }
  json["kept_rig"] = report.kept_rig;
  json["rests_on_rig"] = report.rests_on_rig;
  json["not_determined"] = report.undetermined;
  json["left_out"] = report.outliers;
  json["explanation"] = json_of(report.explanation);
  return json;
}

nlohmann::ordered_json json_of(const std::vector<ViewSummary>& views) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const ViewSummary& view : views) {
    json.push_back({{"view", view.name},
                    {"angle_deg", deg_from_rad(view.angle_rad)},
                    {"setup", view.setup},
                    {"points", view.points},
                    {"sigma_mm", view.sigma_mm},  // NaN is written as null
                    {"left_out", view.left_out}});
    if (!view.reason.empty()) json.back()["reason"] = with_flags(view.reason);
    json.back().update(json_of_quality(view.quality, view.left_out));
  }
  return json;
}

/// The median sigma of the vertices, with its parts where they are known.
nlohmann::ordered_json json_of(const MedianSigma& sigma) {
  nlohmann::ordered_json json{{"combined_mm", sigma.combined_mm}};  // NaN is written as null
  if (std::isnan(sigma.systematic_mm)) return json;
  json["noise_mm"] = sigma.noise_mm;
  json["systematic_mm"] = sigma.systematic_mm;
  return json;
}

/// ", median sigma 0.0123 mm (noise 0.0031, systematic 0.0119)"; empty without a known sigma.
std::string text_of(const MedianSigma& sigma) {
  if (std::isnan(sigma.combined_mm)) return "";
  std::string text = fmt::format(", median sigma {:.4f} mm", sigma.combined_mm);
  if (std::isnan(sigma.systematic_mm)) return text;
  return text +
         fmt::format(" (noise {:.4f}, systematic {:.4f})", sigma.noise_mm, sigma.systematic_mm);
}

/// One line for each view.
std::string table_of(const std::vector<ViewSummary>& views) {
  TextColumn name{"view", {}, false};
  TextColumn setup{"setup", {}};
  TextColumn angle{"angle deg", {}};
  TextColumn points{"points", {}};
  TextColumn sigma{"sigma mm", {}};
  TextColumn state{"", {}, false};
  bool several_setups = false;
  for (const ViewSummary& view : views) {
    several_setups = several_setups || view.setup != views.front().setup;
    name.values.push_back(view.name);
    setup.values.push_back(fmt::format("{}", view.setup));
    angle.values.push_back(fixed_text(deg_from_rad(view.angle_rad), 2));
    points.values.push_back(fmt::format("{}", view.points));
    sigma.values.push_back(std::isnan(view.sigma_mm) ? "-" : fmt::format("{:.4f}", view.sigma_mm));
    state.values.emplace_back(view.left_out ? "left out" : "");
  }
  if (several_setups) return text_table({name, setup, angle, points, sigma, state});
  return text_table({name, angle, points, sigma, state});
}

/// The check of the rig by what was measured twice; what contradicts has been said before.
void print_agreements(const Reconstruction& result) {
  bool compared = false;
  for (const RigAgreement& agreement : result.agreements) {
    compared = compared || agreement.by == MeasuredTwiceBy::Cameras;
    if (agreement.is_consistent()) print_text("{}\n", with_flags(agreement.text()));
  }
  if (result.cameras > 1 && !compared) {
    print_text("{} cameras: nothing compares them; fringes in both directions would\n",
               result.cameras);
  }
}

nlohmann::ordered_json json_of(const RigAgreement& agreement) {
  const Explanation& found = agreement.explanation;
  return {{"disagreement_mm", agreement.median_mm},  // NaN becomes null
          {"over_noise", agreement.over_noise},
          {"chi_squared", agreement.chi_squared},
          {"beyond", agreement.beyond},
          {"consistent", agreement.is_consistent()},
          {"best", found.best},
          {"second", found.second},
          {"log10_odds", number_or_null(found.log_odds / std::log(10.0))},
          {"unexplained", number_or_null(found.unexplained)},
          {"remedy", with_flags(found.remedy)},
          {"text", with_flags(agreement.text())}};
}

nlohmann::ordered_json json_of(const SilhouetteReport& report) {
  return {{"views", report.views},
          {"rims", report.rims},
          {"outside_mm", report.outside_mm},
          {"largest_mm", report.largest_mm},
          {"limit_mm", report.limit_mm},
          {"excluded_mm", report.excluded_mm},
          {"consistent", !report.contradicts()},
          {"text", report.text()}};
}

nlohmann::ordered_json json_of(const TargetsReport& report) {
  nlohmann::ordered_json json;
  json["targets"] = nlohmann::ordered_json::array();
  for (const MeasuredTarget& target : report.targets) {
    json["targets"].push_back(
        {{"code", target.code < 0 ? nlohmann::ordered_json() : nlohmann::ordered_json(target.code)},
         {"center_mm", {target.center_mm.x(), target.center_mm.y(), target.center_mm.z()}},
         {"sigma_mm", target.sigma_mm},
         {"views", target.views},
         {"setups", target.setups}});
  }
  json["tying"] = report.tying;
  json["tying_setups"] = report.tying_setups;
  json["rms_mm"] = report.rms_mm;
  json["over_sigma"] = report.over_sigma;
  json["masked"] = report.masked;
  json["filled"] = report.filled;
  if (report.scale) {
    json["scale"] = {{"factor", report.scale->factor},
                     {"sigma", report.scale->sigma},
                     {"distances", report.scale->distances},
                     {"consistent", !report.scale->contradicts()}};
  }
  json["text"] = report.text();
  return json;
}

/// The answer of --json.
nlohmann::ordered_json json_of(const Reconstruction& result, const std::filesystem::path& raw) {
  nlohmann::ordered_json json;
  if (result.cameras > 1) {
    json["cameras"] = {
        {"count", result.cameras}, {"disagreement_mm", nullptr}, {"over_noise", nullptr}};
  }
  for (const RigAgreement& agreement : result.agreements)
    json[agreement.by == MeasuredTwiceBy::Directions ? "directions" : "cameras"].update(
        json_of(agreement));
  json["points"] = result.points;
  json["views"] = result.views;
  json["per_view"] = json_of(result.view_summaries);
  json["vertices"] = result.mesh.vertices_mm.size();
  json["triangles"] = result.mesh.triangles.size();
  json["islands_removed"] = json_of(result.islands);
  json["median_sigma"] = json_of(result.sigma);
  if (result.indirect_light) {
    json["indirect_light"] = {{"reflectance", result.indirect_light->albedo},
                              {"affected", result.indirect_light->affected},
                              {"largest_mm", result.indirect_light->largest_mm}};
  }
  if (!raw.empty()) json["raw"] = raw.string();
  if (result.refinement) json["refinement"] = json_of(*result.refinement);
  if (result.registration) json["registration"] = json_of(*result.registration);
  if (result.silhouettes) json["silhouettes"] = json_of(*result.silhouettes);
  if (result.targets) json["targets"] = json_of(*result.targets);
  if (result.background.points > 0) {
    json["background"] = {{"points", result.background.points},
                          {"from_axis_mm", result.background.from_axis_mm}};
  }
  if (!std::isnan(result.turntable_top_height_mm))
    json["turntable_top_height_mm"] = result.turntable_top_height_mm;
  return json;
}

}  // namespace

void print_reconstruction(const Reconstruction& result,
                          const std::vector<std::filesystem::path>& outputs,
                          const std::filesystem::path& raw,
                          Terminal& terminal) {
  if (terminal.json) {
    print_mesh_result(json_of(result, raw), result.untrusted_reason, terminal, outputs);
    return;
  }
  if (terminal.quiet) return;
  terminal.finish();
  print_agreements(result);
  write_output(table_of(result.view_summaries));
  print_text("{} points from {} -> {} triangles{}{}\n",
             result.points,
             counted(result.views, "view"),
             result.mesh.triangles.size(),
             text_of(result.sigma),
             text_of(result.islands));
  if (result.silhouettes && !result.silhouettes->contradicts())
    print_text("{}\n", result.silhouettes->text());
  if (result.targets) print_text("{}\n", result.targets->text());
  if (result.refinement) print_changes(*result.refinement);  // a note has said the rest
  print_mesh_summary(terminal, outputs);
  if (!raw.empty()) terminal.print_written(raw.string());
}

}  // namespace frangia
