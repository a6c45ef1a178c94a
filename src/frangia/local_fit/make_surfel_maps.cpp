#include "frangia/local_fit/make_surfel_maps.h"

#include <utility>

#include "frangia/views/load_each_view.h"

namespace frangia {

std::vector<SurfelMap> make_surfel_maps(const ViewStore& views,
                                        const CameraModel& camera,
                                        std::size_t pixels,
                                        const Run& run) {
  const CameraRays rays(views, camera);
  const LocalPlanesOptions options{.every =
                                       surfel_stride(camera.width_px, camera.height_px, pixels)};
  std::vector<SurfelMap> maps;
  LocalPlanes planes;
  load_each_view(views, [&](std::size_t i, const View& view) {
    run.report(static_cast<double>(i) / static_cast<double>(views.size()));
    planes = local_planes(view, rays, options, std::move(planes));
    maps.push_back(make_surfel_map(planes, rays, pixels));
  });
  return maps;
}

}  // namespace frangia
