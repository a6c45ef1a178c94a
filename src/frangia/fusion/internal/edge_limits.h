#pragma once

#include <cmath>
#include <cstddef>

#include "frangia/fusion/fusion_parameters.h"

namespace frangia {

/// `EdgeParameters` for one voxel size: lengths in mm, cosines in place of angles. See there.
struct EdgeLimits {
  EdgeLimits(const EdgeParameters& parameters, float voxel_size_mm)
      : voxel_mm(voxel_size_mm),
        chamfer_cosine(cosine(parameters.chamfer_rad)),
        face_reach_mm(length(parameters.face_reach_voxels)),
        min_face_vertices(static_cast<std::size_t>(parameters.min_face_vertices)),
        face_normal_cosine(cosine(parameters.face_normal_rad)),
        face_offset_mm(length(parameters.face_offset_voxels)),
        flat_voxels(static_cast<float>(parameters.flat_voxels)),
        flat_sigmas(static_cast<float>(parameters.flat_sigmas)),
        face_width_voxels(static_cast<float>(parameters.face_width_voxels)),
        min_edge_cosine(cosine(parameters.min_edge_rad)),
        max_edge_cosine(cosine(parameters.max_edge_rad)),
        check_reach_mm(length(parameters.check_reach_voxels)),
        on_face_mm(length(parameters.on_face_voxels)),
        on_face_sigmas(static_cast<float>(parameters.on_face_sigmas)),
        edge_zone_mm(length(parameters.edge_zone_voxels)),
        face_vertex_cosine(cosine(parameters.face_vertex_rad)),
        to_corner_mm(length(parameters.to_corner_voxels)),
        to_edge_mm(length(parameters.to_edge_voxels)),
        to_face_mm(length(parameters.to_face_voxels)),
        max_split_mm(length(parameters.max_split_voxels)),
        max_corner_mm(length(parameters.max_corner_voxels)),
        min_edge_vertices(static_cast<std::size_t>(parameters.min_edge_vertices)),
        fold_cosine(cosine(parameters.fold_rad)) {}

  float voxel_mm;
  float chamfer_cosine;
  float face_reach_mm;
  std::size_t min_face_vertices;
  float face_normal_cosine;
  float face_offset_mm;
  float flat_voxels;
  float flat_sigmas;
  float face_width_voxels;
  float min_edge_cosine;
  float max_edge_cosine;
  float check_reach_mm;
  float on_face_mm;
  float on_face_sigmas;
  float edge_zone_mm;
  float face_vertex_cosine;
  float to_corner_mm;
  float to_edge_mm;
  float to_face_mm;
  float max_split_mm;
  float max_corner_mm;
  std::size_t min_edge_vertices;
  float fold_cosine;

 private:
  [[nodiscard]] static float cosine(double angle_rad) {
    return static_cast<float>(std::cos(angle_rad));
  }
  [[nodiscard]] float length(double voxels) const { return static_cast<float>(voxels) * voxel_mm; }
};

}  // namespace frangia
