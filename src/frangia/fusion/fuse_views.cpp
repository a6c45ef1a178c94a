#include "frangia/fusion/fuse_views.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "frangia/fusion/internal/accumulate_view.h"
#include "frangia/fusion/internal/cell_loops.h"
#include "frangia/fusion/internal/differing_part.h"
#include "frangia/fusion/internal/distance_field.h"
#include "frangia/fusion/internal/hermite_accumulators.h"
#include "frangia/fusion/internal/mesh_quads.h"
#include "frangia/fusion/internal/place_vertices.h"
#include "frangia/fusion/internal/remove_weak_rim.h"
#include "frangia/fusion/internal/sampling.h"
#include "frangia/geometry/clean_mesh.h"
#include "frangia/geometry/vertex_data.h"
#include "frangia/local_fit/local_planes.h"
#include "frangia/views/add_edge_pixels.h"
#include "frangia/views/sigma_terms.h"
#include "frangia/views/thin_view.h"
#include "frangia/views/view_store.h"

namespace frangia {
namespace {

double choose_voxel(const Sampling& sampling, const FusionOptions& options, const Run& run) {
  if (options.voxel_mm > 0.0) return options.voxel_mm;
  const FieldParameters& field = options.parameters.field;
  const double voxel_mm =
      std::max(field.voxel_spacings * sampling.spacing_mm, field.voxel_sigmas * sampling.sigma_mm);
  run.note(
      fmt::format("the surface is sampled every {:.3g} mm: the points are {:.3g} mm apart, their "
                  "sigma is {:.2g} mm",
                  voxel_mm,
                  sampling.spacing_mm,
                  sampling.sigma_mm));
  return voxel_mm;
}

/// The views of a camera that has points, with its rays.
struct Source {
  const ViewStore& views;
  CameraRays rays;
  Sampling sampling;
  std::size_t camera = 0;
};

/// The sampling of all points: the finest spacing of a camera, and the mean sigma weighted by
/// points.
Sampling sampling_of(const std::vector<Source>& sources) {
  Sampling all = sources.front().sampling;
  for (std::size_t i = 1; i < sources.size(); ++i) {
    const Sampling& next = sources[i].sampling;
    const auto before = static_cast<double>(all.points);
    const auto more = static_cast<double>(next.points);
    all.sigma_mm = (before * all.sigma_mm + more * next.sigma_mm) / (before + more);
    all.spacing_mm = std::min(all.spacing_mm, next.spacing_mm);
    all.points += next.points;
  }
  return all;
}

/// Calls `use` with the local planes of every `step`-th pixel of each view in turn.
void for_each_view(const ViewStore& views,
                   int step,
                   const CameraRays& camera,
                   const LocalPlanesOptions& how,
                   const std::function<void(const LocalPlanes&)>& use) {
  LocalPlanes planes;
  load_each_view(views, [&](std::size_t /*index*/, View& view) {
    add_edge_pixels(view);
    planes = step > 1 ? local_planes(subsample(view, step), camera, how, std::move(planes))
                      : local_planes(view, camera, how, std::move(planes));
    use(planes);
  });
}

/// Samples each view at the crossings.
HermiteAccumulators sample_crossings(const std::vector<Source>& sources,
                                     const EdgeCrossings& crossings,
                                     std::span<const SigmaTerm> terms,
                                     const HermiteOptions& how,
                                     bool keep_weights,
                                     const std::function<void()>& on_view) {
  const bool has_systematic =
      !terms.empty() || std::any_of(sources.begin(), sources.end(), [](const Source& source) {
        return source.views.has_systematic();
      });
  HermiteAccumulators hermite(crossings.points_mm.size(), has_systematic);
  if (keep_weights) hermite.keep_weights();
  std::vector<const ViewStore*> stores;
  stores.reserve(sources.size());
  for (const Source& source : sources)
    stores.push_back(&source.views);
  const bool differ = has_systematic && have_directions_of_their_own(stores);
  LocalPlanes planes;
  for (const Source& source : sources) {
    load_each_view(
        source.views,
        [&](std::size_t index, View& view) {
          add_edge_pixels(view);
          Image<float> differing_mm = differ ? differing_part(view) : Image<float>();
          const Image<float> differing_terms_mm = add_terms(view, source.camera, terms);
          if (differ) add_part(differing_mm, differing_terms_mm);
          planes = local_planes(view, source.rays, {.widen = true}, std::move(planes));
          accumulate_view(hermite,
                          crossings,
                          planes,
                          source.rays,
                          how,
                          {view.range.systematic_mm, differing_mm},
                          index);
          on_view();
        },
        PointSigma::BothParts);
  }
  return hermite;
}

/// Combines the noise and the systematic part that fusion has left in `sigma_mm` and
/// `sigma_systematic_mm`.
void combine_parts(Mesh& mesh) {
  if (mesh.sigma_systematic_mm.empty()) return;
  mesh.sigma_noise_mm = mesh.sigma_mm;
  combine_sigma_parts(mesh);
}

/// Pixel step for the field. The field only locates the crossings, so pixels denser than its voxels
/// add nothing.
int field_pixel_step(const Sampling& sampling, double voxel_mm, const FieldParameters& parameters) {
  return std::max(
      1, static_cast<int>(parameters.max_pixel_step_voxels * voxel_mm / sampling.spacing_mm));
}

TruncationBand truncation_band(const Sampling& sampling,
                               double voxel_mm,
                               const FieldParameters& parameters) {
  const double noise_mm = parameters.band_sigmas * sampling.sigma_mm;
  const double per_voxel2 = 1.0 / (voxel_mm * voxel_mm);
  TruncationBand band;
  band.voxel_mm = voxel_mm;
  band.front_mm = parameters.front_voxels * voxel_mm + noise_mm;
  band.back_mm = parameters.back_voxels * voxel_mm + noise_mm;
  band.falloff_mm = parameters.falloff_voxels * voxel_mm + noise_mm;
  band.allocation_mm = parameters.near_voxels * voxel_mm + noise_mm;
  band.deepest_mm = parameters.deep_bands * band.back_mm;
  band.extrapolated_weight = parameters.extrapolated_weight * per_voxel2;
  band.deep_weight = parameters.deep_weight * per_voxel2;
  return band;
}

}  // namespace

Mesh fuse_views(const ViewStore& views,
                const CameraModel& camera,
                const FusionOptions& options,
                const Run& run) {
  const CameraViews one{views, camera};
  return fuse_views({&one, 1}, options, run);
}

namespace {

FusedSurface fuse(std::span<const CameraViews> cameras,
                  const FusionOptions& options,
                  bool keep_weights,
                  const Run& run) {
  require(!cameras.empty(), "fuse_views: needs the views of a camera");
  std::vector<Source> sources;
  std::size_t view_count = 0;
  for (const CameraViews& camera : cameras) {
    const CameraRays rays(camera.views, camera.camera);
    const Sampling sampling = measure_sampling(camera.views, rays, run);
    if (sampling.points == 0) continue;
    const auto index = static_cast<std::size_t>(&camera - cameras.data());
    sources.push_back({camera.views, rays, sampling, index});
    view_count += camera.views.size();
  }
  require(!sources.empty(), "no view holds a point: there is no surface to fuse");
  const Sampling sampling = sampling_of(sources);
  const double voxel_mm = choose_voxel(sampling, options, run);
  const VoxelBudget budget = voxel_budget(voxel_mm, options.max_memory_mb);
  budget.check(sampling, view_count);
  const FusionParameters& parameters = options.parameters;
  const TruncationBand band = truncation_band(sampling, voxel_mm, parameters.field);
  const double progress = 0.4 / static_cast<double>(view_count);
  double done = 0.0;

  DistanceField field;
  field.voxel_mm = voxel_mm;
  for (const Source& source : sources) {
    const double spacing_mm = source.sampling.spacing_mm;
    const int step = field_pixel_step(source.sampling, voxel_mm, parameters.field);
    std::optional<CameraRays> thinned;
    if (step > 1) thinned.emplace(subsample(source.rays.model, step));
    const CameraRays& thin_rays = thinned ? *thinned : source.rays;
    const int extrapolate_px = static_cast<int>(
        std::ceil(parameters.field.extrapolate_voxels * voxel_mm / (step * spacing_mm)));
    for_each_view(source.views,
                  step,
                  thin_rays,
                  {.extrapolate_px = extrapolate_px},
                  [&](const LocalPlanes& view) {
                    integrate_view(field, view, thin_rays, band);
                    budget.check(static_cast<double>(field.blocks.size()));
                    run.report(done += progress);
                  });
  }

  if (field.blocks.empty()) {
    throw Error(
        ErrorKind::Input,
        fmt::format("no surface is left at a voxel of {:.4g} mm, for points that are {:.3g} "
                    "mm apart: the part is smaller than the voxel, or its points are no "
                    "neighbours; set a smaller `voxel`",
                    voxel_mm,
                    sampling.spacing_mm));
  }
  const EdgeCrossings crossings = find_edge_crossings(field, parameters.field);
  field = {};

  HermiteAccumulators hermite =
      sample_crossings(sources,
                       crossings,
                       options.terms,
                       {band.allocation_mm, band.front_mm, parameters.hermite},
                       keep_weights,
                       [&] { run.report(done += progress); });
  add_between_view_variance(hermite, crossings);
  ViewWeights weights = keep_weights ? hermite.view_weights(crossings) : ViewWeights();
  Mesh mesh =
      mesh_quads(place_vertices(crossings, hermite, parameters), crossings, hermite, parameters);
  run.report(0.95);
  remove_weak_rim(mesh, parameters.cleanup);
  clean_mesh(mesh, options.min_component_triangles);
  widen_sigma_of_strips(mesh, static_cast<float>(voxel_mm));
  combine_parts(mesh);
  run.report(1.0);
  return {std::move(mesh), std::move(weights)};
}

}  // namespace

Mesh fuse_views(std::span<const CameraViews> cameras,
                const FusionOptions& options,
                const Run& run) {
  return fuse(cameras, options, false, run).mesh;
}

FusedSurface fuse_with_weights(std::span<const CameraViews> cameras,
                               const FusionOptions& options,
                               const Run& run) {
  return fuse(cameras, options, true, run);
}

}  // namespace frangia
