#pragma once

#include "frangia/core/angles.h"

namespace frangia {

// Heuristic thresholds of the fusion. No length is absolute: lengths are in voxels, in pixels, in
// pixel spacings on the surface or in sigmas of the points. docs/parameters.md lists what half and
// double of each do to the meshes of six small scans (`./run figures sensitivity`).

/// The voxel size and the signed distance field.
struct FieldParameters {
  /// Automatic voxel size: at least this many pixel spacings. Smaller voxels add triangles, not
  /// information.
  double voxel_spacings = 1.5;
  /// Automatic voxel size: at least this many sigmas of a point.
  double voxel_sigmas = 3.0;
  /// Sigmas that are added to each depth of the truncation band.
  double band_sigmas = 4.0;
  /// Depth of the truncation band in front of the surface, voxels. A cell's diagonal is 1.7.
  double front_voxels = 3.0;
  /// Depth of the truncation band behind the surface, voxels.
  double back_voxels = 2.0;
  /// Depth behind the surface at which the weight has fallen to a quarter, voxels.
  double falloff_voxels = 0.5;
  /// A view observes the same surface as another within this distance, voxels.
  double near_voxels = 0.75;
  /// The field samples a view at pixels no farther apart than this, voxels.
  double max_pixel_step_voxels = 1.2;
  /// Distance that planes are extrapolated beyond the boundary of a view's data, voxels.
  double extrapolate_voxels = 2.0;
  /// Weight of an extrapolated distance, 1 / voxel^2. It is far below that of any measurement,
  /// 1 / sigma^2, so it only counts where there is no measurement.
  double extrapolated_weight = 1e-6;
  /// Weight of a voxel deeper than the band, 1 / voxel^2, far below `extrapolated_weight`. It fills
  /// the inner corners of cells at the boundary of the data.
  double deep_weight = 1e-9;
  /// Depth to which `deep_weight` is added, in depths of the band behind the surface.
  double deep_bands = 10.0;
  /// Largest difference of the distances at the ends of a crossed edge, voxels. A distance changes
  /// by at most 1; a larger step separates two surfaces.
  double max_step_voxels = 2.5;
};

/// What each view contributes to a crossing, and how the variances combine.
struct HermiteParameters {
  /// Normals that differ by less belong to one face.
  double same_face_rad = rad_from_deg(37.0);
  /// A normal at more than this angle to the outward direction of the crossed edge belongs to the
  /// back of a thin wall.
  double back_face_rad = rad_from_deg(107.5);
  /// A point so far behind a view's surface is hidden, in distances at which surfaces are the same.
  double hidden_bands = 2.0;
  /// Radius around the pixel within which free space must be observed on all sides, px.
  double clear_sight_px = 4.0;
  /// Distance that the surface at that radius must lie behind the point, as a share of that at the
  /// pixel.
  double clear_sight_share = 0.5;
  /// Weight of free space over the weight of the surface observed behind it. The points that
  /// support a surface may be smoothed over 7 x 7 pixels, which raises their weight by this factor:
  /// 147 / 11, the inverse of `value_variance(3)`. The points behind may not be smoothed.
  double free_space_factor = 147.0 / 11.0;
  /// Weight of a point half a pixel beyond the boundary of the data, as a share of the pixel's.
  double boundary_share = 0.1;
  /// Largest incidence at which such a point counts.
  double boundary_incidence_rad = rad_from_deg(72.5);
  /// The same where the plane was fitted to 3 x 3 pixels, whose slope is less certain.
  double small_window_incidence_rad = rad_from_deg(60.0);
  /// Variance of a bilinearly interpolated value over that of a smoothed pixel. Measured, see
  /// docs/parameters.md.
  double interpolated_variance = 0.73;
  /// Error of pixel response and of what a lens model leaves within the image, px. What is
  /// uncertain of its coefficients enters by the covariance of the calibration. See
  /// docs/parameters.md.
  double lateral_px = 0.01;
  /// RMS error of the position of a point at the boundary of the data, px: the part fills a share
  /// of a pixel's square between 1 and 1/2, so the centroid of that share is off by 0 to 1/4,
  /// evenly distributed: 1 / (4 sqrt 3). A local fit over 5 pixels takes half of its value there
  /// from pixels further in: the means of columns weigh 0.6, 0.4, 0.2, 0, -0.2 in the outermost,
  /// and 0.4, 0.3, 0.2, 0.1, 0 in the next one.
  double boundary_lateral_px = 0.072;
  /// The same of a slope steeper than `small_window_incidence_rad` that no window of 5 x 5 pixels
  /// fits: pixels on the two sides of a step make it, which lies anywhere within a pixel, evenly
  /// distributed: 1 / sqrt 12.
  double step_lateral_px = 0.289;
  /// A second face counts from this share of the weight of the first.
  double lesser_share = 0.1;
};

/// Vertex placement.
struct VertexParameters {
  /// Eigenvalues of sum n n^T below this share of the largest are noise. Two faces that meet at
  /// less than 25 degrees count as one.
  double min_eigenvalue = 0.05;
  /// Planes within this angle of their mean are parallel.
  double parallel_rad = rad_from_deg(14.0);
  /// Distance that a vertex may leave its cell by, voxels: an edge of the object can run where the
  /// grid has no crossing.
  double max_excursion_voxels = 0.5;
  /// Half the width over which the error of smoothed pixels is correlated, px. Measured, see
  /// docs/parameters.md.
  double correlation_px = 1.6;
};

/// Reconstruction of sharp edges and corners.
struct EdgeParameters {
  /// A triangle that deviates from the normals of its vertices by more is part of a chamfer.
  double chamfer_rad = rad_from_deg(15.0);
  /// Radius within which the vertices of a face are collected, voxels.
  double face_reach_voxels = 5.0;
  /// Fewest vertices of a face.
  double min_face_vertices = 5.0;
  /// Vertices of one face: largest angle between their normals.
  double face_normal_rad = rad_from_deg(20.0);
  /// Vertices of one face: largest distance from the plane of the seed, voxels.
  double face_offset_voxels = 0.25;
  /// Largest RMS distance of a face's vertices from their plane, voxels, ...
  double flat_voxels = 0.03;
  /// ... plus this many sigmas.
  double flat_sigmas = 2.0;
  /// Smallest RMS extent of a face across its longest direction, voxels.
  double face_width_voxels = 0.2;
  /// Two faces form an edge from this angle ...
  double min_edge_rad = rad_from_deg(29.5);
  /// ... to this angle. A knife edge is not determined by its faces.
  double max_edge_rad = rad_from_deg(140.0);
  /// Radius around a chamfer vertex within which all vertices must lie on its faces, voxels.
  double check_reach_voxels = 2.0;
  /// A vertex lies on a face within this distance, voxels, ...
  double on_face_voxels = 0.08;
  /// ... plus this many sigmas.
  double on_face_sigmas = 3.0;
  /// A vertex this near to an edge may lie on no face, voxels.
  double edge_zone_voxels = 0.6;
  /// A face vertex: largest angle between its normal and the face.
  double face_vertex_rad = rad_from_deg(26.0);
  /// Farthest that a chamfer vertex moves to a corner, voxels; half the diagonal of a cell is 0.87.
  double to_corner_voxels = 0.85;
  /// Farthest that a chamfer vertex moves to an edge, voxels.
  double to_edge_voxels = 0.45;
  /// Farthest that a chamfer vertex moves to a face, voxels.
  double to_face_voxels = 0.45;
  /// Farthest that a new edge vertex lies from the middle of the mesh edge it splits, voxels.
  double max_split_voxels = 1.2;
  /// Farthest that a new corner vertex lies from a corner of the triangle it splits, voxels.
  double max_corner_voxels = 3.0;
  /// Fewest vertices and splits along an edge of the object; shorter ones are folds.
  double min_edge_vertices = 24.0;
  /// A triangle folds when its normal differs from those of its faces by more.
  double fold_rad = rad_from_deg(60.0);
};

/// Removal of slivers and foldovers.
struct CleanupParameters {
  /// Triangles lower than this, and edges shorter than twice this, are slivers, voxels.
  double sliver_voxels = 0.1;
  /// The diagonals of a quad are equally near to the surface within this share of their length.
  double diagonal_tolerance = 0.02;
  /// A collapse turns no triangle by more.
  double collapse_turn_rad = rad_from_deg(60.0);
  /// A triangle that deviates from the normals of its vertices by more is a foldover.
  double foldover_rad = rad_from_deg(69.5);
  /// A vertex at the boundary that fewer views observed than this share of what the vertices around
  /// it have in the median is a tooth beyond the edge of a face. Of 96 views of a bracket, 43 of 76
  /// such vertices were more than 0.1 mm off, a quarter of a voxel.
  double rim_views_share = 1.0 / 3.0;
};

/// Heuristic thresholds of the fusion, by stage.
struct FusionParameters {
  FieldParameters field;      ///< signed distance field
  HermiteParameters hermite;  ///< Hermite samples on the edges of voxels
  VertexParameters vertices;  ///< positions of the mesh's vertices
  EdgeParameters edges;       ///< sharp edges
  CleanupParameters cleanup;  ///< removal of defective triangles
};

}  // namespace frangia
