#include "frangia/service/growing_surface.h"

#include <cmath>
#include <condition_variable>
#include <cstring>
#include <mutex>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "frangia/core/angles.h"

namespace frangia {
namespace {

using Json = nlohmann::json;

constexpr double kRadius_mm = 40.0;
constexpr double kDistance_mm = 500.0;

/// A camera that looks at the axis of a turntable from the side.
Rig rig_of(int width) {
  Rig rig;
  CameraModel& camera = rig.reference().model;
  camera.width_px = width;
  camera.height_px = width * 4 / 5;
  camera.focal_px.setConstant(2.0 * width);
  camera.principal_point_px = 0.5 * Eigen::Vector2d(camera.width_px - 1, camera.height_px - 1);
  Turntable& table = rig.turntable.emplace();
  table.axis = -Eigen::Vector3d::UnitY();
  table.point_mm = {0.0, 0.0, kDistance_mm};
  return rig;
}

/// What the camera sees of a ball around a point of the axis.
RangeGrid view_of_ball(const Rig& rig) {
  const CameraModel& camera = rig.reference().model;
  RangeGrid range{Image<float>(camera.width_px, camera.height_px, kMissing),
                  Image<float>(camera.width_px, camera.height_px, kMissing)};
  const Eigen::Vector3d center = rig.turntable->point_mm;
  for (int y = 0; y < camera.height_px; ++y) {
    for (int x = 0; x < camera.width_px; ++x) {
      const Eigen::Vector2d ray = camera.ray(Eigen::Vector2d(x, y));
      const Eigen::Vector3d along = Eigen::Vector3d(ray.x(), ray.y(), 1.0).normalized();
      const double middle = along.dot(center);
      const double square = kRadius_mm * kRadius_mm - center.squaredNorm() + middle * middle;
      if (square <= 0.0) continue;
      range.depth_mm(x, y) = static_cast<float>((middle - std::sqrt(square)) * along.z());
      range.sigma_mm(x, y) = 0.02F;
    }
  }
  return range;
}

/// Keeps what a growing surface reports.
class Reports {
 public:
  void add(const GrownSurface& grown) {
    const std::lock_guard lock(mutex_);
    last_ = grown;
    came_.notify_all();
  }
  /// The first surface with so many views.
  GrownSurface with(std::size_t views) {
    std::unique_lock lock(mutex_);
    EXPECT_TRUE(came_.wait_for(
        lock, std::chrono::seconds(120), [&] { return last_.views.size() == views; }));
    return last_;
  }

 private:
  std::mutex mutex_;
  std::condition_variable came_;
  GrownSurface last_;
};

std::vector<Eigen::Vector3f> positions_of(const std::string& packed) {
  std::uint32_t length = 0;
  std::memcpy(&length, packed.data(), sizeof length);
  const Json header = Json::parse(packed.substr(sizeof length, length));
  const Json& positions = header.at("arrays").at(0);
  EXPECT_EQ(positions.at("name"), "positions");
  std::vector<Eigen::Vector3f> points(positions.at("length").get<std::size_t>() / 3);
  std::memcpy(static_cast<void*>(points.data()),
              packed.data() + positions.at("offset").get<std::size_t>(),
              points.size() * sizeof points[0]);
  return points;
}

TEST(GrowingSurface, HoldsTheViewsSoFarInTheirPlaces) {
  Reports reports;
  const Rig rig = rig_of(1280);
  const RangeGrid range = view_of_ball(rig);
  GrowingSurface growing(rig, [&](const GrownSurface& grown) { reports.add(grown); });
  growing.add(0, 0.0, range);
  const GrownSurface one = reports.with(1);
  growing.add(2, rad_from_deg(90.0), range);
  growing.add(5, rad_from_deg(180.0), range);
  const GrownSurface three = reports.with(3);
  EXPECT_EQ(three.views, (std::vector<std::size_t>{0, 2, 5}));
  EXPECT_GT(three.revision, one.revision);
  EXPECT_GT(three.triangles, one.triangles);
  EXPECT_GT(one.triangles, 1000U);
  EXPECT_LT(three.triangles, 400'000U) << "it is coarse";
  // The frame of the object has its origin at the middle of the ball.
  double worst_mm = 0.0;
  for (const Eigen::Vector3f& point : positions_of(*three.packed))
    worst_mm = std::max(worst_mm, std::abs(point.norm() - kRadius_mm));
  EXPECT_LT(worst_mm, 0.5);
}

TEST(GrowingSurface, EndsWhileItIsMade) {
  const Rig rig = rig_of(640);
  const RangeGrid range = view_of_ball(rig);
  for (int i = 0; i < 3; ++i) {
    GrowingSurface growing(rig, [](const GrownSurface&) {});
    growing.add(0, 0.0, range);
  }
}

TEST(GrowingSurface, OutlivesAnyException) {
  Reports reports;
  const Rig rig = rig_of(320);
  const RangeGrid range = view_of_ball(rig);
  GrowingSurface growing(rig, [&](const GrownSurface& grown) {
    reports.add(grown);
    if (grown.views.size() == 1) throw std::length_error("of a library");
  });
  growing.add(0, 0.0, range);
  EXPECT_GT(reports.with(1).triangles, 100U);
  growing.add(1, 0.0, range);
  EXPECT_GT(reports.with(2).triangles, 100U);
}

TEST(GrowingSurface, WaitsForPointsThatFormASurface) {
  Reports reports;
  const Rig rig = rig_of(320);
  const RangeGrid range = view_of_ball(rig);
  RangeGrid empty = range;
  for (float& depth : empty.depth_mm.pixels())
    depth = kMissing;
  GrowingSurface growing(rig, [&](const GrownSurface& grown) { reports.add(grown); });
  growing.add(0, 0.0, empty);
  growing.add(1, 0.0, range);
  EXPECT_GT(reports.with(2).triangles, 100U);
}

}  // namespace
}  // namespace frangia
