// A scan of Gray code without fringes, from frames to points.
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/geometry/ray_scene.h"
#include "frangia/pipeline/reconstruct.h"

#include "support/error_of.h"
#include "support/small_scan.h"
#include "support/temporary_folder.h"

namespace frangia::gray_alone {
namespace {

class GrayAlone : public ::testing::Test {
 protected:
  [[nodiscard]] Scan scan(bool inverted, bool white) const {
    Scan plan;
    plan.folder = folder_.path() / "scan";
    plan.name = "ball-bar";
    plan.rig = testing::small_rig("digital");
    plan.patterns = default_patterns(plan.rig,
                                     {.sequence = "gray-alone",
                                      .fringes = 64.0,
                                      .inverted = inverted,
                                      .white = white,
                                      .dark = white});
    plan.views.push_back({0.2, "views/0"});
    static_cast<void>(simulate_scan(make_part("ball-bar"), plan, {.samples_per_px = 9}));
    return read_scan(plan.folder);
  }

 private:
  testing::TemporaryFolder folder_;
};

/// Errors of the points of one view over their standard uncertainty.
struct PointErrors {
  double rms_mm = 0.0;
  double over_sigma = 0.0;
  std::size_t count = 0;
};

PointErrors errors_of(const Scan& scan) {
  const Reconstruction result = reconstruct(scan, {.keep_turntable_top = true, .keep_raw = true});
  const RayScene truth(make_part("ball-bar"));
  PointErrors out;
  const Eigen::Vector3d camera =
      scan.rig.rig_from_object(scan.views.front().angle_rad).inverse().translation();
  for (std::size_t i = 0; i < result.raw.points_mm.size(); ++i) {
    const Eigen::Vector3d point = result.raw.points_mm[i].cast<double>();
    const Eigen::Vector3d ray = (point - camera).normalized();
    const auto hit = truth.first_hit(camera, ray);
    if (!hit) continue;
    const double error = hit->distance - (point - camera).norm();
    const double sigma = std::hypot(result.raw.sigma_mm[i], result.raw.systematic_mm[i]);
    if (std::abs(error) > 5.0) continue;  // a pixel at an edge sees the other ball
    out.rms_mm += error * error;
    out.over_sigma += std::pow(error / sigma, 2);
    ++out.count;
  }
  out.rms_mm = std::sqrt(out.rms_mm / static_cast<double>(out.count));
  out.over_sigma = std::sqrt(out.over_sigma / static_cast<double>(out.count));
  return out;
}

TEST_F(GrayAlone, GivesPointsWithAnHonestSigma) {
  const PointErrors errors = errors_of(scan(true, false));
  EXPECT_GT(errors.count, 5000U);
  EXPECT_LT(errors.rms_mm, 0.3) << "stripes of 10 px are 3 mm wide";
  EXPECT_GT(errors.over_sigma, 0.6);
  EXPECT_LT(errors.over_sigma, 1.5);
}

TEST_F(GrayAlone, TakesTheThresholdFromWhiteAndAmbientFrames) {
  const PointErrors errors = errors_of(scan(false, true));
  EXPECT_GT(errors.count, 5000U);
  EXPECT_LT(errors.rms_mm, 0.3);
  EXPECT_LT(errors.over_sigma, 1.5);
}

}  // namespace
}  // namespace frangia::gray_alone
