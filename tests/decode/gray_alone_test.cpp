// A scan of Gray code without fringes, from frames to points.
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/core/statistics.h"
#include "frangia/geometry/ray_scene.h"
#include "frangia/reconstruct/reconstruct.h"

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

/// Errors of the points of one view.
struct PointErrors {
  double median_mm = 0.0;   ///< of the absolute errors
  double over_sigma = 0.0;  ///< median over the standard uncertainty; 1 for normal deviates
  double beyond = 0.0;      ///< share beyond three standard uncertainties
  std::size_t count = 0;
};

PointErrors errors_of(const Scan& scan) {
  const Reconstruction result = reconstruct(scan, {.keep_turntable_top = true, .keep_raw = true});
  const RayScene truth(make_part("ball-bar"));
  std::vector<double> errors;
  std::vector<double> ratios;
  const Eigen::Vector3d camera =
      scan.rig.rig_from_object(scan.views.front().angle_rad).inverse().translation();
  for (std::size_t i = 0; i < result.raw.points_mm.size(); ++i) {
    const Eigen::Vector3d point = result.raw.points_mm[i].cast<double>();
    const Eigen::Vector3d ray = (point - camera).normalized();
    const auto hit = truth.first_hit(camera, ray);
    if (!hit) continue;
    errors.push_back(std::abs(hit->distance - (point - camera).norm()));
    ratios.push_back(errors.back() /
                     std::hypot(result.raw.sigma_mm[i], result.raw.systematic_mm[i]));
  }
  constexpr double kMedianOfNormal = 0.6745;
  PointErrors out;
  out.count = errors.size();
  const auto beyond =
      std::count_if(ratios.begin(), ratios.end(), [](double ratio) { return ratio > 3.0; });
  out.beyond = static_cast<double>(beyond) / static_cast<double>(out.count);
  out.median_mm = median(std::move(errors));
  out.over_sigma = median(std::move(ratios)) / kMedianOfNormal;
  return out;
}

// The 3 x 3 rays of a pixel place a border to a third of a pixel only, which raises the errors.
TEST_F(GrayAlone, GivesPointsWithAnHonestSigma) {
  const PointErrors errors = errors_of(scan(true, false));
  EXPECT_GT(errors.count, 5000U);
  EXPECT_LT(errors.median_mm, 0.1) << "stripes of 10 px are 3 mm wide";
  EXPECT_GT(errors.over_sigma, 0.6);
  EXPECT_LT(errors.over_sigma, 1.7);
  EXPECT_LT(errors.beyond, 0.08) << "stripes that are cut at silhouettes";
}

TEST_F(GrayAlone, TakesTheThresholdFromWhiteAndAmbientFrames) {
  const PointErrors errors = errors_of(scan(false, true));
  EXPECT_GT(errors.count, 5000U);
  EXPECT_LT(errors.median_mm, 0.1);
  EXPECT_LT(errors.over_sigma, 1.7);
  EXPECT_LT(errors.beyond, 0.08);
}

}  // namespace
}  // namespace frangia::gray_alone
