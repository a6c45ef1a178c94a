#include "inspect_datums.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/features/find_features.h"
#include "frangia/geometry/transform_mesh.h"
#include "frangia/report/measured_characteristics.h"
#include "frangia/report/planned_nominals.h"

namespace frangia {
namespace {

const Feature& found_datum(const PlannedFeature& planned,
                           const std::vector<Feature>& features,
                           const Mesh& mesh,
                           const std::filesystem::path& on) {
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& vertex : mesh.vertices_mm)
    if (vertex.allFinite()) box.extend(vertex);
  const double farthest_mm = kFarthestFeature * static_cast<double>(box.diagonal().norm());
  const Feature* feature = nearest_feature(planned, features, farthest_mm);
  if (feature == nullptr) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: datum \"{}\": there is no {} near ({:g}, {:g}, {:g}); check its "
                            "near_mm, in the frame of the reference",
                            on.string(),
                            planned.name,
                            name_of(planned.kind),
                            planned.near_mm.x(),
                            planned.near_mm.y(),
                            planned.near_mm.z()));
  }
  return *feature;
}

}  // namespace

DatumFit align_by_datums(const InspectArguments& arguments,
                         InspectionPlan plan,
                         const Mesh& mesh,
                         const Reference& reference,
                         const Run& run) {
  if (reference.cad) {
    state_nominals(plan.features, reference.cad->faces(), arguments.plan);
  } else {
    check_without_cad(plan.features, arguments.plan);
  }
  AlignmentArguments near = arguments.alignment;
  near.align = "best-fit";
  DatumFit fit{align(mesh, reference.scene, near, run), {}};
  const Mesh aligned = transform_mesh(mesh, fit.alignment.pose.reference_from_mesh);
  run.stage("datums");
  const std::vector<Feature> measured = find_features(aligned, {.edges = false}, run);
  std::vector<Feature> nominal;  // searched where a datum names no face
  std::vector<Datum> datums;
  for (const std::string& name : plan.datums) {
    const PlannedFeature& planned =
        *std::find_if(plan.features.begin(), plan.features.end(), [&](const auto& feature) {
          return feature.name == name;
        });
    const Feature& seen = found_datum(planned, measured, aligned, arguments.mesh);
    Datum datum{name, {}, seen.fit.shape, seen.uncertainty};
    if (planned.face > 0) {
      datum.nominal = reference.cad->faces()[planned.face - 1].shape.value();
    } else {
      if (nominal.empty()) nominal = find_features(reference.scene.mesh(), {.edges = false}, run);
      datum.nominal =
          found_datum(planned, nominal, reference.scene.mesh(), arguments.reference).fit.shape;
    }
    datums.push_back(std::move(datum));
  }
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3f& vertex : aligned.vertices_mm)
    box.extend(vertex.cast<double>());
  const DatumAlignment found = align_to_datums(datums, box.center(), 0.5 * box.diagonal().norm());
  const BestFitOptions options = near.best_fit();
  const int iterations = fit.alignment.pose.iterations;
  AlignmentPose& pose = fit.alignment.pose;
  pose = assess_pose(mesh, reference.scene, found.motion * pose.reference_from_mesh, options, run);
  pose.iterations = iterations;
  pose.uncertainty = found.uncertainty;
  fit.alignment.alternatives = {pose};
  fit.alignment.free_directions = found.free_directions;
  fit.residuals = found.residuals;
  return fit;
}

void add_datums(nlohmann::ordered_json& json, const std::vector<DatumResidual>& residuals) {
  auto& datums = json["alignment_details"]["datums"];
  datums = nlohmann::ordered_json::array();
  for (const DatumResidual& one : residuals) {
    datums.push_back({{"name", one.name},
                      {"angle_deg", deg_from_rad(one.angle_rad)},
                      {"distance_mm", one.distance_mm}});
  }
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

}  // namespace frangia
