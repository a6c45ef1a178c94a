#include "frangia/fusion/fuse_views.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <future>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "frangia/fusion/internal/distance_field.h"
#include "frangia/fusion/internal/edge_crossings.h"
#include "frangia/fusion/internal/hermite_accumulators.h"
#include "frangia/fusion/internal/measure_sampling.h"
#include "frangia/fusion/internal/mesh_quads.h"
#include "frangia/fusion/internal/place_vertices.h"
#include "frangia/fusion/internal/voxel_budget.h"
#include "frangia/geometry/clean_mesh.h"
#include "frangia/local_fit/local_planes.h"
#include "frangia/views/add_edge_pixels.h"
#include "frangia/views/subsample.h"

namespace frangia {
namespace {

double choose_voxel(const Sampling& sampling, const FusionOptions& options, const Run& run) {
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

/// Calls `use` with every `step`-th pixel of each view in turn; while one is used the next is read.
void for_each_view(const ViewStore& views,
                   int step,
                   const CameraRays& camera,
                   const LocalPlanesOptions& how,
                   const std::function<void(const LocalPlanes&)>& use) {
  const auto read = [&](std::size_t i) {
    return std::async(std::launch::async, [&views, step, i] {
      View view = views.load_points(i);
      add_edge_pixels(view);
      return step > 1 ? subsample(view, step) : view;
    });
  };
  LocalPlanes planes;
  std::future<View> next = read(0);
  for (std::size_t i = 0; i < views.size(); ++i) {
    const View view = next.get();
    if (i + 1 < views.size()) next = read(i + 1);
    planes = local_planes(view, camera, how, std::move(planes));
    use(planes);
  }
}

/// The field only tells where to look: pixels closer together than its voxels tell it no more.
int field_pixel_step(const Sampling& sampling, double voxel_mm) {
  constexpr double kCoarsest = 1.2;  // voxels between pixels
  return std::max(1, static_cast<int>(kCoarsest * voxel_mm / sampling.spacing_mm));
}

}  // namespace

Mesh fuse_views(const ViewStore& views,
                const CameraModel& camera,
                const FusionOptions& options,
                const Run& run) {
  const CameraRays rays(camera);
  const Sampling sampling = measure_sampling(views, rays, run);

  require(sampling.points > 0, "no view holds a point: there is no surface to fuse");
  const double voxel_mm = choose_voxel(sampling, options, run);
  const VoxelBudget budget = voxel_budget(voxel_mm, options.max_memory_mb);
  budget.check(sampling, views.size());
  const double noise_mm = 4.0 * sampling.sigma_mm;
  const double near_mm = 0.75 * voxel_mm + noise_mm;
  const TruncationBand band{voxel_mm,
                            3.0 * voxel_mm + noise_mm,
                            2.0 * voxel_mm + noise_mm,
                            0.5 * voxel_mm + noise_mm,
                            near_mm,
                            1.0 / (voxel_mm * voxel_mm)};
  const double progress = 0.4 / static_cast<double>(views.size());
  double done = 0.0;

  const int step = field_pixel_step(sampling, voxel_mm);
  std::optional<CameraRays> thinned;
  if (step > 1) thinned.emplace(subsample(camera, step));
  const CameraRays& thin_rays = thinned ? *thinned : rays;
  const int extrapolate_px =
      static_cast<int>(std::ceil(2.0 * voxel_mm / (step * sampling.spacing_mm)));
  DistanceField field;
  field.voxel_mm = voxel_mm;
  for_each_view(
      views, step, thin_rays, {.extrapolate_px = extrapolate_px}, [&](const LocalPlanes& view) {
        integrate_view(field, view, thin_rays, band);
        budget.check(static_cast<double>(field.blocks.size()));
        run.report(done += progress);
      });

  if (field.blocks.empty()) {
    throw Error(
        ErrorKind::Input,
        fmt::format("no surface is left at a voxel of {:.4g} mm, for points that are {:.3g} "
                    "mm apart: the part is smaller than the voxel, or its points are no "
                    "neighbours; set a smaller `voxel`",
                    voxel_mm,
                    sampling.spacing_mm));
  }
  const EdgeCrossings crossings = find_edge_crossings(field);
  field = {};

  HermiteAccumulators hermite(crossings.points_mm.size());
  for_each_view(views, 1, rays, {.widen = true}, [&](const LocalPlanes& view) {
    accumulate_view(hermite, crossings, view, rays, {near_mm, band.front_mm});
    run.report(done += progress);
  });
  add_between_view_variance(hermite, crossings);
  Mesh mesh = mesh_quads(place_vertices(crossings, hermite), crossings, hermite);
  run.report(0.95);
  clean_mesh(mesh, options.min_component_triangles);
  run.report(1.0);
  return mesh;
}

}  // namespace frangia
