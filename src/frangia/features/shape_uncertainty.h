#pragma once

#include <cstdint>
#include <span>

#include <Eigen/Core>

#include "frangia/core/missing.h"
#include "frangia/features/feature_points.h"
#include "frangia/features/fit_shape.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// Expanded uncertainty of the size of a fitted shape: the diameter, or the offset of a plane.
struct ShapeUncertainty {
  /// Whether the points state a sigma. The residuals of a mesh without one, such as that of another
  /// program, show its noise alone, and those of a model nothing: all other members are then
  /// missing.
  bool is_known = true;
  double u95_mm = kMissing;         ///< half the width of the 95 % interval
  double noise_mm = kMissing;       ///< standard uncertainty by noise, form and edges
  double systematic_mm = kMissing;  ///< standard uncertainty by the systematic part of sigma
  /// Half the width of the 95 % interval of the center: along the normal of a plane, across the
  /// axis of a cylinder or cone, in the worst direction otherwise.
  double center_u95_mm = kMissing;
  double axis_u95_rad = kMissing;   ///< of the direction of the axis; NaN for a sphere
  double angle_u95_rad = kMissing;  ///< of the half angle of a cone; NaN otherwise
  /// What independent changes of the rig's parameters, of one standard deviation each, do to the
  /// parameters of the shape (see `moved`): a column for each change; empty: not known.
  Eigen::MatrixXd calibration;
  double center_local_u95_mm = kMissing;  ///< `center_u95_mm` without `calibration`
  double axis_local_u95_rad = kMissing;   ///< `axis_u95_rad` without `calibration`
};

/// Estimates the uncertainty of a fit from its own residuals.
///
/// Residuals of neighbouring points are alike, so the points are split into compact blocks and the
/// spread of the blocks' gradients is propagated, with Student's factor. What reaches across the
/// borders of 128 blocks is estimated from that of 512; 32 blocks count where their spread is
/// larger than chance allows. It is never smaller than the stated noise of the points propagates
/// to. The systematic part of sigma is propagated as one error that is alike in all points.
///
/// @units    mm, rad
/// @missing  NaN when the points do not determine the shape
/// @source   Liang & Zeger 1986 (clustered errors); Huber 1981, 7.6; GUM (JCGM 100:2008), 5.2.2
[[nodiscard]] ShapeUncertainty shape_uncertainty(const FeaturePoints& points,
                                                 std::span<const std::uint32_t> chosen,
                                                 const ShapeFit& fit);

/// The uncertainty of a fit where the points state their noise, and one that is not known where
/// they do not: what their residuals show is not all of it.
[[nodiscard]] ShapeUncertainty known_uncertainty(const FeaturePoints& points,
                                                 ShapeUncertainty of_residuals);

/// How an error of the part's temperature, of one standard uncertainty, displaces the vertices of
/// its mesh along their normals: it scales the part about its middle. It is a further row of
/// `FeaturePoints::calibration_mm`.
///
/// @shape    one row, a column for each vertex
/// @units    mm; 1/K; K
[[nodiscard]] Eigen::MatrixXf thermal_displacement(const Mesh& mesh,
                                                   double expansion_per_k,
                                                   double temperature_u_k);

}  // namespace frangia
