#include "inspect_features.h"

#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "frangia/core/angles.h"

#include "fixed_text.h"
#include "json_number.h"
#include "text_table.h"

namespace frangia {
namespace {

using Json = nlohmann::ordered_json;
using Nominals = std::vector<std::optional<NominalFace>>;

Json json_of_vector(const Eigen::Vector3d& vector) {
  return {vector.x(), vector.y(), vector.z()};
}

bool has_diameter(ShapeKind kind) {
  return kind != ShapeKind::Plane && kind != ShapeKind::Line;
}

Json json_of_feature(const Feature& feature) {
  const Shape& shape = feature.fit.shape;
  const bool fitted = is_surface(shape.kind);
  return {{"kind", name_of(shape.kind)},
          {"diameter_mm", has_diameter(shape.kind) ? Json(2.0 * shape.radius_mm) : Json()},
          {"u95_mm", number_or_null(feature.uncertainty.u95_mm)},
          {"form_mm", fitted ? Json(feature.fit.form_mm) : Json()},
          {"center_mm", json_of_vector(shape.center_mm)},
          {"axis", shape.kind == ShapeKind::Sphere ? Json() : json_of_vector(shape.axis)},
          {"points", feature.fit.points}};
}

Json json_of_details(const Feature& feature) {
  const Shape& shape = feature.fit.shape;
  const ShapeUncertainty& u = feature.uncertainty;
  const double none = std::numeric_limits<double>::quiet_NaN();
  const bool cone = shape.kind == ShapeKind::Cone;
  const bool torus = shape.kind == ShapeKind::Torus;
  return {{"hole", feature.hole},
          {"rms_mm", is_surface(shape.kind) ? Json(feature.fit.rms_mm) : Json()},
          {"half_angle_deg", number_or_null(cone ? deg_from_rad(shape.half_angle_rad) : none)},
          {"half_angle_u95_deg", number_or_null(deg_from_rad(u.angle_u95_rad))},
          {"tube_diameter_mm", number_or_null(torus ? 2.0 * shape.tube_radius_mm : none)},
          {"u_noise_mm", number_or_null(u.noise_mm)},
          {"u_systematic_mm", number_or_null(u.systematic_mm)},
          {"center_u95_mm", number_or_null(u.center_u95_mm)},
          {"axis_u95_deg", number_or_null(deg_from_rad(u.axis_u95_rad))}};
}

Json json_of_nominal(const Feature& feature, const std::optional<NominalFace>& nominal) {
  if (!nominal) return {};
  Json json{{"face", nominal->number},
            {"diameter_mm", Json()},
            {"difference_mm", Json()},
            {"half_angle_deg", Json()},
            {"half_angle_difference_deg", Json()}};
  if (nominal->shape.kind == ShapeKind::Cone) {
    json["half_angle_deg"] = deg_from_rad(nominal->shape.half_angle_rad);
    json["half_angle_difference_deg"] =
        deg_from_rad(feature.fit.shape.half_angle_rad - nominal->shape.half_angle_rad);
  }
  if (has_diameter(nominal->shape.kind)) {
    json["diameter_mm"] = 2.0 * nominal->shape.radius_mm;
    json["difference_mm"] = 2.0 * (feature.fit.shape.radius_mm - nominal->shape.radius_mm);
  }
  return json;
}

std::string vector_text(const Eigen::Vector3d& vector, int decimals) {
  return fixed_text(vector.x(), decimals) + " " + fixed_text(vector.y(), decimals) + " " +
         fixed_text(vector.z(), decimals);
}

std::string cell_text(double value, int decimals) {
  return std::isfinite(value) ? fixed_text(value, decimals) : "";
}

}  // namespace

void add_features(nlohmann::ordered_json& json,
                  const std::vector<Feature>& features,
                  const Nominals& nominals) {
  json["features"] = Json::array();
  json["feature_details"] = Json::array();
  for (std::size_t i = 0; i < features.size(); ++i) {
    json["features"].push_back(json_of_feature(features[i]));
    Json details = json_of_details(features[i]);
    if (!nominals.empty()) details["nominal"] = json_of_nominal(features[i], nominals[i]);
    json["feature_details"].push_back(details);
  }
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

}  // namespace frangia
