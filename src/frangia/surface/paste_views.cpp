#include "frangia/surface/paste_views.h"

#include <algorithm>

#include <fmt/format.h>

#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"
#include "frangia/surface/crossings.h"
#include "frangia/surface/distance_field.h"
#include "frangia/surface/evidence.h"
#include "frangia/surface/local_planes.h"
#include "frangia/surface/measure_sampling.h"
#include "frangia/surface/mesh_quads.h"
#include "frangia/surface/place_vertices.h"
#include "frangia/surface/tidy_mesh.h"

namespace frangia {
namespace {

double choose_voxel(const Sampling& sampling, const PasteOptions& options, const Run& run) {
  if (options.voxel_mm > 0.0) return options.voxel_mm;
  const double voxel_mm = std::max(1.5 * sampling.spacing_mm, 3.0 * sampling.sigma_mm);
  run.note(
      fmt::format("the surface is sampled every {:.3g} mm: the points are {:.3g} mm apart, their "
                  "sigma is {:.2g} mm",
                  voxel_mm,
                  sampling.spacing_mm,
                  sampling.sigma_mm));
  return voxel_mm;
}

void clip(View& view, const CameraRays& camera, double min_z_mm) {
  const Eigen::Isometry3f object_from_rig = view.rig_from_object.inverse().cast<float>();
  const auto lowest = static_cast<float>(min_z_mm);
  Image<float>& depth = view.range.depth_mm;
  parallel_rows(depth.height(), [&](int y) {
    for (int x = 0; x < depth.width(); ++x) {
      const Eigen::Vector3f point = depth(x, y) * camera.rays(x, y).homogeneous();
      if ((object_from_rig * point).z() < lowest) depth(x, y) = kMissing;
    }
  });
}

LocalPlanes load(const ViewStore& views,
                 std::size_t index,
                 const CameraRays& camera,
                 const PasteOptions& options) {
  View view = views.load(index);
  if (options.clip_below) clip(view, camera, options.min_z_mm);
  return local_planes(view, camera);
}

}  // namespace

Mesh paste_views(const ViewStore& views,
                 const Lens& camera,
                 const PasteOptions& options,
                 const Run& run) {
  const CameraRays rays(camera);
  const Sampling sampling = measure_sampling(views, rays, run);
  require(sampling.points > 0, "no view holds a point: there is no surface to paste");
  const double voxel_mm = choose_voxel(sampling, options, run);
  const double noise_mm = 4.0 * sampling.sigma_mm;
  const Band band{
      voxel_mm, 4.0 * voxel_mm + noise_mm, 2.0 * voxel_mm + noise_mm, 0.5 * voxel_mm + noise_mm};
  const auto count = static_cast<double>(views.size());

  DistanceField field;
  field.voxel_mm = voxel_mm;
  for (std::size_t i = 0; i < views.size(); ++i) {
    add_view(field, load(views, i, rays, options), rays, band);
    run.report(0.6 * static_cast<double>(i + 1) / count);
  }
  const Crossings crossings = find_crossings(field);
  field = {};

  std::vector<Evidence> evidence(crossings.points_mm.size());
  for (std::size_t i = 0; i < views.size(); ++i) {
    add_evidence(evidence,
                 crossings,
                 load(views, i, rays, options),
                 rays,
                 {0.75 * voxel_mm + noise_mm, 3.0 * voxel_mm + noise_mm});
    run.report(0.6 + 0.2 * static_cast<double>(i + 1) / count);
  }
  add_disagreement(evidence, crossings);
  Mesh mesh = mesh_quads(place_vertices(crossings, evidence), crossings, evidence);
  run.report(0.95);
  drop_small_parts(mesh, options.min_part_triangles);
  split_bow_ties(mesh);
  drop_unused_vertices(mesh);
  run.report(1.0);
  return mesh;
}

}  // namespace frangia
