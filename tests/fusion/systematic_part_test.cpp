// The two parts of sigma through fusion.
#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/core/statistics.h"
#include "frangia/fusion/fuse_views.h"
#include "frangia/geometry/vertex_data.h"

#include "support/analytic_views.h"

namespace frangia {
namespace {

using testing::floor_at;
using testing::look_from;
using testing::small_camera_model;
using testing::snapshots;

constexpr double kDistance = 650.0;

/// The same plane, seen `count` times from one latitude with a noise of its own each time.
ViewStore views_of_plane(int count, double latitude_rad) {
  return snapshots(floor_at(0.0),
                   small_camera_model(160),
                   std::vector<Eigen::Isometry3d>(static_cast<std::size_t>(count),
                                                  look_from(0.3, latitude_rad, kDistance)),
                   {.noise_mm = 0.05, .sigma_mm = 0.05});
}

/// Copies the views and gives each of them a systematic part.
ViewStore with_systematic(const ViewStore& views, const std::vector<float>& systematic_mm) {
  ViewStore out;
  for (std::size_t i = 0; i < views.size(); ++i) {
    View view = views.load(i);
    const Image<float>& depth = view.range.depth_mm;
    view.range.systematic_mm = Image<float>(depth.width(), depth.height(), kMissing);
    for (std::size_t pixel = 0; pixel < depth.pixels().size(); ++pixel) {
      if (!std::isnan(depth.pixels()[pixel]))
        view.range.systematic_mm.pixels()[pixel] = systematic_mm[i % systematic_mm.size()];
    }
    out.add(view);
  }
  return out;
}

FusionOptions options() {
  return {.voxel_mm = 1.0};
}

TEST(SystematicPart, StaysWhereNoiseFallsWithTheRootOfTheNumberOfViews) {
  std::vector<double> noise;
  std::vector<double> systematic;
  for (const int count : {2, 8, 32}) {
    const ViewStore views = with_systematic(views_of_plane(count, rad_from_deg(89.0)), {0.03F});
    const MedianSigma sigma = median_sigma(fuse_views(views, small_camera_model(160), options()));
    noise.push_back(sigma.noise_mm);
    systematic.push_back(sigma.systematic_mm);
  }
  EXPECT_NEAR(noise[0] / noise[1], 2.0, 0.2);
  EXPECT_NEAR(noise[1] / noise[2], 2.0, 0.2);
  for (const double part : systematic)
    EXPECT_NEAR(part, 0.03, 0.0003);  // the incidence is within 6 degrees
}

/// Views of a plane from four sides, whose errors differ: each has ripples of its own of this
/// amplitude and period, and states their RMS.
ViewStore views_with_ripples(double amplitude_mm, double period_px, double step_deg) {
  std::vector<Eigen::Isometry3d> poses(4);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    poses[i] = look_from(
        0.3 + rad_from_deg(step_deg) * static_cast<double>(i), rad_from_deg(70.0), kDistance);
  }
  const ViewStore views = with_systematic(
      snapshots(
          floor_at(0.0), small_camera_model(160), poses, {.noise_mm = 0.01, .sigma_mm = 0.01}),
      {0.03F});
  ViewStore out;
  for (std::size_t i = 0; i < views.size(); ++i) {
    View view = views.load(i);
    view.range.differing_share = 1.0F;
    for (int y = 0; y < view.range.depth_mm.height(); ++y) {
      for (int x = 0; x < view.range.depth_mm.width(); ++x) {
        view.range.depth_mm(x, y) += static_cast<float>(
            amplitude_mm * std::sin(kTwoPi * x / period_px + 1.7 * static_cast<double>(i)));
      }
    }
    out.add(view);
  }
  return out;
}

/// RMS over the vertices of the height above the plane, and of its ratio to sigma.
struct PlaneErrors {
  double rms_mm = 0.0;
  double over_sigma = 0.0;
};

PlaneErrors errors_of(const Mesh& mesh) {
  PlaneErrors out;
  const auto count = static_cast<double>(mesh.vertices_mm.size());
  for (std::size_t i = 0; i < mesh.vertices_mm.size(); ++i) {
    const double error = mesh.vertices_mm[i].z();
    out.rms_mm += error * error / count;
    out.over_sigma += std::pow(error / static_cast<double>(mesh.sigma_mm[i]), 2) / count;
  }
  return {std::sqrt(out.rms_mm), std::sqrt(out.over_sigma)};
}

TEST(SystematicPart, ThatDiffersByViewCoversTheRipplesThatAreLeft) {
  const double amplitude_mm = 0.03 * std::sqrt(2.0);  // 0.03 RMS
  for (const double period_px : {24.0, 6.0, 2.3}) {
    const Mesh mesh = fuse_views(
        views_with_ripples(amplitude_mm, period_px, 90.0), small_camera_model(160), options());
    const PlaneErrors errors = errors_of(mesh);
    EXPECT_GT(errors.over_sigma, 0.55) << period_px;  // 0.58 where the fits smooth most of it
    EXPECT_LT(errors.over_sigma, 1.5) << period_px;
    EXPECT_LT(median_sigma(mesh).combined_mm, 0.025) << period_px;
  }
}

TEST(SystematicPart, ThatDiffersByViewStaysWhereTheViewsHaveOneDirection) {
  // The ripples of views that differ by 2 degrees may be the same on the surface.
  const Mesh mesh =
      fuse_views(views_with_ripples(0.0, 6.0, 2.0), small_camera_model(160), options());
  EXPECT_NEAR(median_sigma(mesh).systematic_mm, 0.03 * std::sin(rad_from_deg(70.0)), 0.001);
}

TEST(SystematicPart, IsProjectedOntoTheNormal) {
  const ViewStore views = with_systematic(views_of_plane(1, rad_from_deg(30.0)), {0.03F});
  const MedianSigma sigma = median_sigma(fuse_views(views, small_camera_model(160), options()));
  EXPECT_NEAR(sigma.systematic_mm, 0.03 * std::sin(rad_from_deg(30.0)), 0.0005);
}

TEST(SystematicPart, OfViewsThatDifferIsTheirWeightedMean) {
  const ViewStore views = with_systematic(views_of_plane(2, rad_from_deg(89.0)), {0.02F, 0.06F});
  const MedianSigma sigma = median_sigma(fuse_views(views, small_camera_model(160), options()));
  EXPECT_NEAR(sigma.systematic_mm, 0.04, 0.002);
}

TEST(SystematicPart, ChangesNoShapeAndCombinesWithTheNoise) {
  const ViewStore views = views_of_plane(3, rad_from_deg(50.0));
  const Mesh without = fuse_views(views, small_camera_model(160), options());
  const Mesh with = fuse_views(with_systematic(views, {0.1F}), small_camera_model(160), options());
  ASSERT_FALSE(without.empty());
  EXPECT_TRUE(without.sigma_noise_mm.empty() && without.sigma_systematic_mm.empty());
  EXPECT_EQ(with.vertices_mm, without.vertices_mm);
  EXPECT_EQ(with.triangles, without.triangles);
  EXPECT_EQ(with.sigma_noise_mm, without.sigma_mm);
  ASSERT_EQ(with.sigma_systematic_mm.size(), with.vertices_mm.size());
  for (std::size_t i = 0; i < with.sigma_mm.size(); ++i) {
    EXPECT_FLOAT_EQ(with.sigma_mm[i],
                    std::hypot(with.sigma_noise_mm[i], with.sigma_systematic_mm[i]));
  }
}

TEST(SystematicPart, IsAddedByTheCallerToViewsThatDoNotStoreIt) {
  FusionOptions how = options();
  how.terms = {{UncertaintyTerm::Calibration, [](const View& view, std::size_t /*camera*/) {
                  const Image<float>& depth = view.range.depth_mm;
                  return Image<float>(depth.width(), depth.height(), 0.07F);
                }}};
  const Mesh mesh = fuse_views(views_of_plane(2, rad_from_deg(89.0)), small_camera_model(160), how);
  EXPECT_NEAR(median_sigma(mesh).systematic_mm, 0.07, 0.0007);
}

}  // namespace
}  // namespace frangia
