#include "frangia/local_fit/make_surfel_maps.h"

#include <algorithm>
#include <utility>

#include "frangia/views/load_each_view.h"

namespace frangia {

std::size_t surfel_budget(std::size_t pixels, std::size_t views) {
  // More views overlap more and need fewer surfels each. `./run figures views` prints the accuracy
  // with 6, 24 and 96 views.
  constexpr std::size_t kAllSurfels = 24 * kSurfelsPerView;
  return std::min(pixels, kAllSurfels / std::max<std::size_t>(1, views));
}

std::vector<SurfelMap> make_surfel_maps(const ViewStore& views,
                                        const CameraModel& camera,
                                        std::size_t pixels,
                                        const Run& run) {
  const CameraRays rays(views, camera);
  const std::size_t most = surfel_budget(pixels, views.size());
  const LocalPlanesOptions options{.every = surfel_stride(camera.width_px, camera.height_px, most)};
  std::vector<SurfelMap> maps;
  LocalPlanes planes;
  load_each_view(views, [&](std::size_t i, const View& view) {
    run.report(static_cast<double>(i) / static_cast<double>(views.size()));
    planes = local_planes(view, rays, options, std::move(planes));
    maps.push_back(make_surfel_map(planes, rays, most));
  });
  return maps;
}

}  // namespace frangia
