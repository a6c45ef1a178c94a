#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "frangia/calibrate/check/check_kinds.h"
#include "frangia/calibrate/check/internal/check_limits.h"
#include "frangia/calibrate/internal/artifact_model.h"
#include "frangia/core/error.h"
#include "frangia/core/statistics.h"
#include "frangia/geometry/fit_primitives.h"

namespace frangia {
namespace {

/// Signed distances of points from the plane that fits most of them best.
///
/// @shape    one for each point
std::vector<double> heights_of(const std::vector<Eigen::Vector3d>& points) {
  std::vector<double> heights(points.size(), 0.0);
  std::vector<bool> used(points.size(), true);
  constexpr int kRounds = 3;
  for (int round = 0; round < kRounds; ++round) {
    std::vector<Eigen::Vector3d> inliers;
    for (std::size_t i = 0; i < points.size(); ++i)
      if (used[i]) inliers.push_back(points[i]);
    const auto plane = fit_plane(inliers);
    std::vector<double> magnitudes;
    for (std::size_t i = 0; i < points.size(); ++i) {
      heights[i] = plane.signedDistance(points[i]);
      magnitudes.push_back(std::abs(heights[i]));
    }
    constexpr double kGate = 5.0 * 1.4826;  // medians: edges of the plate
    const double gate = kGate * median(magnitudes);
    for (std::size_t i = 0; i < points.size(); ++i)
      used[i] = std::abs(heights[i]) <= gate;
  }
  return heights;
}

/// Heights of a view averaged over patches, and the typical standard deviation of an average: the
/// noise of single sites is not a fault of the rig.
struct PatchHeights {
  std::vector<double> mean_mm;
  double sigma_mm = 0.0;
};

/// @shape    one pixel for each height
PatchHeights patch_heights(std::span<const double> heights,
                           std::span<const Eigen::Vector2d> pixels,
                           double patch_px) {
  constexpr double kFewest = 12.0;  // sites in a patch
  constexpr double kOverlap = 3.5;  // sites that share pixels
  struct Sums {
    double count = 0.0;
    double sum = 0.0;
    double squares = 0.0;
  };
  std::map<std::pair<long, long>, Sums> patches;
  for (std::size_t i = 0; i < heights.size(); ++i) {
    Sums& patch =
        patches[{std::lround(pixels[i].x() / patch_px), std::lround(pixels[i].y() / patch_px)}];
    patch.count += 1.0;
    patch.sum += heights[i];
    patch.squares += heights[i] * heights[i];
  }
  PatchHeights out;
  std::vector<double> sigmas;
  for (const auto& [place, patch] : patches) {
    if (patch.count < kFewest) continue;
    const double mean = patch.sum / patch.count;
    const double variance = std::max(patch.squares / patch.count - mean * mean, 0.0);
    out.mean_mm.push_back(mean);
    sigmas.push_back(std::sqrt(variance * kOverlap / patch.count));
  }
  out.sigma_mm = median(sigmas);
  return out;
}

}  // namespace

RigCheck check_plate_of(const Scan& scan,
                        const CheckRigOptions& options,
                        const CheckedCamera& camera,
                        const Run& run) {
  const Rig& rig = scan.rig;
  const ArtifactCapture capture = measure_plate(scan, rig, options.measure, run);
  const double patch_px =
      8.0 * std::max(rig.reference().model.width_px, rig.reference().model.height_px) /
      options.measure.plate_sites;
  std::vector<Eigen::Vector3d> all;
  std::vector<Eigen::Vector3d> turned;
  std::vector<Eigen::Vector2d> pixels;
  std::vector<std::size_t> ends;  // of each view's points among `turned`
  double worst = 0.0;
  double worst_sigma = 0.0;
  for (const ArtifactView& view : capture.views) {
    const std::vector<Eigen::Vector3d> points = site_points(view.sites, rig);
    const Eigen::Isometry3d to_zero =
        rig.turntable ? table_turn(rig, -view.angle_rad) : Eigen::Isometry3d::Identity();
    std::vector<Eigen::Vector3d> measured;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!points[i].allFinite()) continue;
      measured.push_back(points[i]);
      pixels.push_back(view.sites[i].camera_px);
      turned.push_back(to_zero * points[i]);
    }
    ends.push_back(turned.size());
    all.insert(all.end(), measured.begin(), measured.end());
    const PatchHeights patches =
        patch_heights(heights_of(measured), std::span(pixels).last(measured.size()), patch_px);
    const double flatness = spread_of(patches.mean_mm);
    if (patches.mean_mm.empty() || flatness < worst) continue;
    worst = flatness;
    worst_sigma = patches.sigma_mm;
  }
  if (worst == 0.0) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: the plate is too small in the image to be checked; let it fill a "
                            "third of it",
                            (scan.folder / "scan.toml").string()));
  }
  CheckLimits limits(
      camera, all, options, {.views = capture.views.size(), .left_out = capture.left_out});
  limits.add("flatness",
             worst,
             worst_sigma,
             1.0,
             fmt::format("{:.4f} mm from a plane in the worst view", worst));
  if (!rig.turntable || capture.views.size() < 2) return limits.result();
  const std::vector<double> heights = heights_of(turned);
  double together = 0.0;
  double together_sigma = 0.0;
  std::size_t begin = 0;
  for (const std::size_t end : ends) {
    const PatchHeights patches = patch_heights(std::span(heights).subspan(begin, end - begin),
                                               std::span(pixels).subspan(begin, end - begin),
                                               patch_px);
    begin = end;
    const double disagreement = spread_of(patches.mean_mm);
    if (patches.mean_mm.empty() || disagreement < together) continue;
    together = disagreement;
    together_sigma = patches.sigma_mm;
  }
  limits.add("disagreement of the views",
             together,
             together_sigma,
             1.0,
             fmt::format("{:.4f} mm from the plane of all views in the worst view", together));
  return limits.result();
}

}  // namespace frangia
