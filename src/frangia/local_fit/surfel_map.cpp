#include "frangia/local_fit/surfel_map.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>

#include "frangia/core/parallel.h"
#include "frangia/views/view_store.h"

namespace frangia {
namespace {

bool is_seen(const SurfelMap::Surfel& surfel) {
  return surfel.sigma_mm > 0.0F;
}

/// Reduces a map to the smallest rectangle that holds its surfels: a part seldom fills the view.
void crop(SurfelMap& map) {
  Eigen::AlignedBox2i box;
  for (int y = 0; y < map.surfels.height(); ++y) {
    for (int x = 0; x < map.surfels.width(); ++x)
      if (is_seen(map.surfels(x, y))) box.extend(Eigen::Vector2i(x, y));
  }
  if (box.isEmpty()) {
    map.surfels = {};
    return;
  }
  const Eigen::Vector2i size = box.sizes() + Eigen::Vector2i::Ones();
  Image<SurfelMap::Surfel> cropped(size.x(), size.y());
  for (int y = 0; y < size.y(); ++y)
    std::copy_n(&map.surfels(box.min().x(), box.min().y() + y), size.x(), &cropped(0, y));
  map.first_column = box.min().x();
  map.first_row = box.min().y();
  map.surfels = std::move(cropped);
}

}  // namespace

int surfel_stride(int width, int height, std::size_t pixels) {
  const double all = static_cast<double>(width) * height;
  return std::max(1, static_cast<int>(std::ceil(std::sqrt(all / static_cast<double>(pixels)))));
}

SurfelMap make_surfel_map(const LocalPlanes& view, const CameraRays& camera, std::size_t pixels) {
  SurfelMap map;
  map.stride = surfel_stride(view.planes.width(), view.planes.height(), pixels);
  map.surfels = Image<SurfelMap::Surfel>(view.quads.width() / map.stride + 1,
                                         view.quads.height() / map.stride + 1);
  parallel_rows(map.surfels.height(), [&](int row) {
    for (int column = 0; column < map.surfels.width(); ++column) {
      const int x = column * map.stride;
      const int y = row * map.stride;
      if (x >= view.quads.width() || y >= view.quads.height()) continue;
      const LocalPlanes::Quad& quad = view.quads(x, y);
      const LocalPlanes::Plane& plane = view.planes(x, y);
      if (quad.kind != LocalPlanes::Kind::Smooth || plane.window != WindowKind::Centered) continue;
      const Eigen::Vector3f ray = camera.rays(x, y).homogeneous();
      const Eigen::Vector3f point = ray / view.inverse_depth(x, y);
      const float cosine = -plane.normal.dot(point) / point.norm();
      map.surfels(column, row) = {point, plane.normal, cosine * cosine / std::sqrt(quad.weight)};
    }
  });
  crop(map);
  return map;
}

std::vector<SurfelMap::Surfel> pick_surfels(const SurfelMap& map, std::size_t count) {
  const auto surfels = map.surfels.pixels();
  const auto all = static_cast<std::size_t>(std::count_if(surfels.begin(), surfels.end(), is_seen));
  std::vector<SurfelMap::Surfel> picked;
  picked.reserve(std::min(all, count));
  std::size_t rank = 0;
  for (const SurfelMap::Surfel& surfel : surfels) {
    if (!is_seen(surfel)) continue;
    // Picks every (all / count)-th surfel; over many rows this is as even as a grid.
    if (all <= count || rank * count / all != (rank + 1) * count / all) picked.push_back(surfel);
    ++rank;
  }
  return picked;
}

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
