#include "frangia/registration/internal/drift_views.h"

#include <utility>

#include "frangia/core/error.h"
#include "frangia/core/parallel.h"
#include "frangia/core/statistics.h"
#include "frangia/local_fit/surfel_map.h"
#include "frangia/registration/internal/retriangulate_views.h"

namespace frangia {
namespace {

/// Surfels of a map. Each has its derivatives, 150 bytes.
constexpr std::size_t kSurfelsOfView = 30'000;

}  // namespace

std::vector<DriftView> drift_views(std::span<const RigSurfaces> surfaces,
                                   const Rig& given,
                                   const Rig& rig,
                                   bool changed,
                                   const Run& run) {
  const Run silent{.stop = run.stop};
  std::vector<DriftView> views;
  for (const RigSurfaces& surface : surfaces) {
    const std::size_t budget = surfels_per_view(kSurfelsOfView, surface.views.size());
    const auto maps =
        changed
            ? make_surfel_maps(retriangulate_views(surface.views, surface.pattern, given, rig, run),
                               rig.reference().model,
                               budget,
                               silent)
            : make_surfel_maps(surface.views, rig.reference().model, budget, silent);
    for (std::size_t i = 0; i < maps.size(); ++i)
      views.push_back({maps[i], surface.stations[i], {}});
  }
  return views;
}

void differentiate(std::vector<DriftView>& views,
                   std::span<const RigSurfaces> surfaces,
                   const PointDrift& drift) {
  std::size_t view = 0;
  for (const RigSurfaces& surface : surfaces) {
    for (std::size_t i = 0; i < surface.stations.size(); ++i, ++view) {
      const auto surfels = views[view].map.surfels.pixels();
      auto& derivatives = views[view].derivatives;
      derivatives.resize(surfels.size());
      parallel_chunks(surfels.size(), 1024, [&](std::size_t begin, std::size_t end) {
        for (std::size_t at = begin; at < end; ++at) {
          if (surfels[at].sigma_mm > 0.0F)
            derivatives[at] = drift.of(surfels[at].point_mm.cast<double>(), surface.pattern);
        }
      });
    }
  }
}

ViewPairs comparable_pairs(const std::vector<DriftView>& views,
                           std::span<const Station> stations,
                           const TableState& table,
                           const FastCameraModel& camera,
                           bool turns) {
  std::vector<SurfelMap> maps;
  std::vector<Eigen::Isometry3d> poses;
  for (const DriftView& view : views) {
    maps.push_back(view.map);
    poses.push_back(table.table.rig_from_object(table.angles_rad[view.station]));
  }
  ViewPairs pairs = choose_view_pairs(maps, camera, poses);
  for (std::size_t from = 0; from < pairs.size(); ++from) {
    const std::size_t own = views[from].station;
    std::erase_if(pairs[from], [&](std::size_t to) {
      const std::size_t other = views[to].station;
      return turns ? stations[own].setup != stations[other].setup : own != other;
    });
  }
  return pairs;
}

SurfelScale scale_of(const std::vector<DriftView>& views) {
  constexpr std::size_t kSamples = 1000;  // of a view
  std::vector<float> sigmas_mm;
  std::vector<float> distances_mm;
  for (const DriftView& view : views) {
    for (const auto& surfel : pick_surfels(view.map, kSamples)) {
      sigmas_mm.push_back(surfel.sigma_mm);
      distances_mm.push_back(surfel.point_mm.norm());
    }
  }
  if (sigmas_mm.empty()) throw Error(ErrorKind::Numeric, "refine_rig: the views hold no surface");
  return {static_cast<double>(median(std::move(distances_mm))),
          static_cast<double>(median(std::move(sigmas_mm)))};
}

}  // namespace frangia
