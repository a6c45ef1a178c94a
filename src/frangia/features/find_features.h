#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/run.h"
#include "frangia/features/fit_shape.h"
#include "frangia/features/shape.h"
#include "frangia/features/shape_uncertainty.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// A geometrical element of a mesh.
struct Feature {
  ShapeFit fit;                  ///< for a line or a circle: of the two surfaces that meet there
  ShapeUncertainty uncertainty;  ///< of its size; NaN where nothing determines it, or no sigma is
                                 ///< stated
  bool hole = false;             ///< the material is outside: a bore, a groove
  /// Vertices that it was fitted to, ascending; samples for a mesh whose vertices do not cover its
  /// surface. Empty for lines and circles.
  std::vector<std::uint32_t> vertices;
};

/// What is looked for.
struct FindFeaturesOptions {
  std::size_t cells = 20000;         ///< of the search: the smallest feature covers about 15
  std::size_t seeds = 120;           ///< patches that the search starts from, in each round
  double least_area_share = 0.0008;  ///< of a feature, of the area of the mesh
  /// Points of a feature lie within this distance of it; 0: chosen from the noise of the mesh.
  double gate_mm = 0.0;
  bool edges = true;  ///< also lines and circles where two features meet
  /// What the calibration of the rig does to all vertices of the mesh alike, as `FeaturePoints` has
  /// it; null: not known. Without it the systematic part of sigma counts as alike along the
  /// normals.
  const Eigen::MatrixXf* calibration_mm = nullptr;
  /// Whether a shape is one of those that are looked for. It is then preferred to one of another
  /// kind that fits the same points better, as a cone does a cylinder that tapers a little. Null:
  /// none is.
  std::function<bool(const Shape&)> wanted = {};

  /// @errors   Error(Input) that names the value which is out of its range
  void check() const;
};

/// Finds planes, cylinders, spheres, cones and tori in a mesh, and the lines and circles where they
/// meet, the largest first within each kind of surface.
///
/// Patches around random points suggest shapes, which grow over the connected points that lie on
/// them; the largest region is taken first. Each is fitted by weighted least squares to the points
/// that are not at its border, and a simpler shape is preferred if it fits nearly as well
/// (Schwarz's criterion). Synthesized triangles are left out.
///
/// @units    mm
/// @missing  a mesh without such surfaces has no features
/// @errors   Error(Input) for a mesh without measured triangles, or as the options' check
/// @source   Schnabel, Wahl & Klein 2007; Schwarz 1978
[[nodiscard]] std::vector<Feature> find_features(const Mesh& mesh,
                                                 const FindFeaturesOptions& options = {},
                                                 const Run& run = {});

/// A place that someone points at.
struct FeaturePlace {
  Eigen::Vector3d point_mm = Eigen::Vector3d::Zero();  ///< on the surface, or near it
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();   ///< unit, outward, of the surface there
};

/// The plane, cylinder, sphere, cone or torus on which the surface around each place lies, grown
/// and fitted as `find_features` does.
///
/// @shape    one for each place
/// @units    mm
/// @missing  none where the surface around the place lies on no such shape
/// @errors   as find_features
[[nodiscard]] std::vector<std::optional<Feature>> features_at(
    const Mesh& mesh,
    std::span<const FeaturePlace> places,
    const FindFeaturesOptions& options = {},
    const Run& run = {});

}  // namespace frangia
