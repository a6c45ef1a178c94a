#include "frangia/reconstruct/internal/points_of_setups.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "frangia/rig/camera_model.h"

namespace frangia {
namespace {

/// Adds every `step`-th measured pixel of a view.
void add_points(const View& view,
                const Image<Eigen::Vector2f>& rays,
                std::size_t step,
                PointCloud& cloud) {
  const Eigen::Isometry3d object_from_rig = view.rig_from_object.inverse();
  std::size_t measured = 0;
  for (std::size_t pixel = 0; pixel < rays.pixels().size(); ++pixel) {
    const float depth = view.range.depth_mm.pixels()[pixel];
    if (std::isnan(depth) || measured++ % step != 0) continue;
    const Eigen::Vector3f seen = depth * rays.pixels()[pixel].homogeneous();
    cloud.points_mm.emplace_back((object_from_rig * seen.cast<double>()).cast<float>());
    cloud.sigma_mm.push_back(view.range.sigma_mm.pixels()[pixel]);
  }
}

}  // namespace

std::vector<PointCloud> points_of_setups(const MeasuredSetup& joined,
                                         const Rig& rig,
                                         std::size_t most,
                                         const Run& run) {
  const MeasuredViews& measured = joined.measured;
  const auto rays = measured.reference().rays(rig.reference().model);
  std::map<int, PointCloud> clouds;
  for (const SetupJoin& join : joined.joins)
    if (join.joined) clouds[join.number];
  // Stations hold the place of their setup among the joined ones, the reference first.
  std::vector<int> numbers{joined.number};
  for (const SetupJoin& join : joined.joins)
    if (join.joined && join.number != joined.number) numbers.push_back(join.number);
  std::size_t points = 0;
  for (std::size_t i = 0; i < measured.reference().size(); ++i) {
    const Image<float> depth_mm = measured.reference().load_depth_mm(i);
    for (const float depth : depth_mm.pixels())
      points += std::isnan(depth) ? 0U : 1U;
  }
  const std::size_t step =
      std::max<std::size_t>(1, points / (numbers.size() * std::max<std::size_t>(1, most)));
  for (std::size_t i = 0; i < measured.reference().size(); ++i) {
    run.check();
    add_points(measured.reference().load_points(i),
               *rays,
               step,
               clouds[numbers.at(measured.stations[i].setup)]);
  }
  std::vector<PointCloud> all;
  all.reserve(clouds.size());
  for (auto& [number, cloud] : clouds)
    all.push_back(std::move(cloud));
  return all;
}

}  // namespace frangia
