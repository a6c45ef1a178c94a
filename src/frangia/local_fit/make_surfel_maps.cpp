#include "frangia/local_fit/make_surfel_maps.h"

#include <utility>

namespace frangia {

std::vector<SurfelMap> make_surfel_maps(const ViewStore& views,
                                        const CameraModel& camera,
                                        std::size_t pixels,
                                        const Run& run) {
  const CameraRays rays(camera);
  std::vector<SurfelMap> maps;
  LocalPlanes planes;
  for (std::size_t i = 0; i < views.size(); ++i) {
    run.report(static_cast<double>(i) / static_cast<double>(views.size()));
    planes = local_planes(views.load_points(i), rays, {}, std::move(planes));
    maps.push_back(make_surfel_map(planes, rays, pixels));
  }
  return maps;
}

}  // namespace frangia
