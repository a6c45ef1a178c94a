#include "frangia/views/map_views.h"

#include <utility>

namespace frangia {

std::vector<PlaneMap> map_views(const ViewStore& views,
                                const Lens& camera,
                                std::size_t pixels,
                                const Run& run) {
  const CameraRays rays(camera);
  std::vector<PlaneMap> maps;
  LocalPlanes planes;
  for (std::size_t i = 0; i < views.size(); ++i) {
    run.report(static_cast<double>(i) / static_cast<double>(views.size()));
    planes = local_planes(views.load(i), rays, {}, std::move(planes));
    maps.push_back(plane_map(planes, rays, pixels));
  }
  return maps;
}

}  // namespace frangia
