#include "frangia/local_fit/surfel_map.h"

#include <algorithm>
#include <array>
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

/// Cosine of the incidence below which a quadratic over the image is not used: 60 degrees.
constexpr float kSteepCosine = 0.5F;

/// A surfel by the quadratic over its tangent plane, instead of over the image: near the limb of a
/// round part inverse depth bends too strongly for one, while the surface itself does not. Pixels
/// that steepness spreads too far over the surface are left out, but for the next ones.
SurfelMap::Surfel fitted_on_tangent(const SurfelMap::Surfel& first,
                                    float cosine,
                                    const Image<float>& depth_mm,
                                    const CameraRays& camera,
                                    const Eigen::Vector2i& at) {
  constexpr int kReach = 2;
  constexpr int kFewest = 12;    // pixels
  constexpr float kFar = 5.0F;   // pixels seen from the front: those 2 pixels away at 66 degrees
  constexpr float kNext = 1.5F;  // of the distance of the next pixel
  using Terms = Eigen::Matrix<double, 6, 1>;
  const Eigen::Vector3f across = first.normal.unitOrthogonal();
  const Eigen::Vector3f along = first.normal.cross(across);
  const float pixel_mm = first.point_mm.z() / static_cast<float>(camera.model.focal_px.x());
  const float reach_mm = pixel_mm * std::max(kFar, kNext / cosine);
  Eigen::Matrix<double, 6, 6> normal = Eigen::Matrix<double, 6, 6>::Zero();
  Terms right = Terms::Zero();
  int count = 0;
  for (int y = std::max(0, at.y() - kReach); y <= std::min(depth_mm.height() - 1, at.y() + kReach);
       ++y) {
    for (int x = std::max(0, at.x() - kReach); x <= std::min(depth_mm.width() - 1, at.x() + kReach);
         ++x) {
      const Eigen::Vector3f from =
          depth_mm(x, y) * camera.rays(x, y).homogeneous() - first.point_mm;
      const Eigen::Vector2d place(from.dot(across) / reach_mm, from.dot(along) / reach_mm);
      if (!(place.squaredNorm() < 1.0)) continue;  // or missing
      Terms terms;
      terms << 1.0, place, place.x() * place.x(), place.x() * place.y(), place.y() * place.y();
      normal += terms * terms.transpose();
      right += terms * static_cast<double>(from.dot(first.normal));
      ++count;
    }
  }
  if (count < kFewest) return first;
  const Terms fit = normal.ldlt().solve(right);
  if (!fit.allFinite()) return first;
  // Along the ray, to the surface. Its normal stays: that of the image's plane has less noise.
  const float closer = static_cast<float>(fit[0]) / -first.normal.dot(first.point_mm);
  return {first.point_mm * (1.0F - closer), first.normal, first.sigma_mm};
}

}  // namespace

int surfel_stride(int width, int height, std::size_t pixels) {
  const double all = static_cast<double>(width) * height;
  return std::max(1, static_cast<int>(std::ceil(std::sqrt(all / static_cast<double>(pixels)))));
}

SurfelMap make_surfel_map(const LocalPlanes& view,
                          const Image<float>& depth_mm,
                          const CameraRays& camera,
                          std::size_t pixels) {
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
      SurfelMap::Surfel surfel{point, plane.normal, cosine * cosine / std::sqrt(quad.weight)};
      if (cosine < kSteepCosine)
        surfel = fitted_on_tangent(surfel, cosine, depth_mm, camera, {x, y});
      map.surfels(column, row) = surfel;
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
    maps.push_back(make_surfel_map(planes, view.range.depth_mm, rays, most));
  });
  return maps;
}

}  // namespace frangia
