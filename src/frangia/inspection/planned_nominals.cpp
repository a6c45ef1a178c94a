#include "frangia/inspection/planned_nominals.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/inspection/internal/shape_mismatch.h"

namespace frangia {
namespace {

bool has_size(ShapeKind kind) {
  return kind == ShapeKind::Cylinder || kind == ShapeKind::Sphere || kind == ShapeKind::Torus;
}

[[noreturn]] void refuse_planned(const std::filesystem::path& path,
                                 const PlannedFeature& feature,
                                 const std::string& why) {
  throw Error(ErrorKind::Input,
              fmt::format("{}: feature \"{}\": {}", path.string(), feature.name, why));
}

void check_tolerance(const std::filesystem::path& path, const PlannedFeature& feature) {
  if (!feature.tolerance_mm || feature.diameter_mm) return;
  if (feature.kind == ShapeKind::Plane || feature.kind == ShapeKind::Line)
    refuse_planned(
        path,
        feature,
        fmt::format("tolerance_mm is of a diameter, which a {} does not have; leave it out",
                    name_of(feature.kind)));
  refuse_planned(
      path, feature, "tolerance_mm is of the diameter; state diameter_mm, the nominal size");
}

/// The diameter of the nearest face of the kind; none where no face is near.
std::optional<double> nearest_diameter(const PlannedFeature& feature,
                                       const std::vector<CadFace>& faces) {
  std::optional<double> diameter;
  double least = std::numeric_limits<double>::infinity();
  for (const CadFace& face : faces) {
    if (!face.shape || face.shape->kind != feature.kind) continue;
    const double mismatch = shape_mismatch_mm(feature, *face.shape);
    // Nearer to the face than the face is large.
    if (mismatch >= std::min(least, face.shape->radius_mm)) continue;
    least = mismatch;
    diameter = 2.0 * face.shape->radius_mm;
  }
  return diameter;
}

}  // namespace

void state_nominals(std::vector<PlannedFeature>& features,
                    const std::vector<CadFace>& faces,
                    const std::filesystem::path& path) {
  for (PlannedFeature& feature : features) {
    if (feature.face > faces.size()) {
      refuse_planned(
          path,
          feature,
          fmt::format("face = {}, but the reference has {} faces", feature.face, faces.size()));
    }
    if (feature.face > 0) {
      const CadFace& face = faces[feature.face - 1];
      if (!face.shape)
        refuse_planned(path, feature, fmt::format("face {} is a free-form surface", feature.face));
      feature.kind = face.shape->kind;
      feature.near_mm = face.shape->center_mm;
    }
    if (!feature.diameter_mm && has_size(feature.kind)) {
      feature.diameter_mm = feature.face > 0 ? 2.0 * faces[feature.face - 1].shape->radius_mm
                                             : nearest_diameter(feature, faces);
    }
    check_tolerance(path, feature);
  }
}

void check_without_cad(const std::vector<PlannedFeature>& features,
                       const std::filesystem::path& path) {
  for (const PlannedFeature& feature : features) {
    if (feature.face > 0) {
      refuse_planned(path,
                     feature,
                     fmt::format("face = {}, but the reference is no CAD model; give a .step or "
                                 ".iges file, or state kind and near_mm",
                                 feature.face));
    }
    check_tolerance(path, feature);
  }
}

}  // namespace frangia
