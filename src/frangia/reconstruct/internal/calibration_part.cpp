#include "frangia/reconstruct/internal/calibration_part.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "frangia/range/calibration_uncertainty.h"

namespace frangia {
namespace {

/// Points of all views, in the rig frame: enough for a rigid motion, few enough to be quick.
std::vector<Eigen::Vector3d> measured_volume(const ViewStore& views,
                                             const Image<Eigen::Vector2f>& rays) {
  constexpr int kAcross = 48;         // sampled pixels along the longer side of the image
  constexpr std::size_t kMost = 600;  // points
  const int step = std::max(1, std::max(rays.width(), rays.height()) / kAcross);
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const Image<float> depth_mm = views.load_depth_mm(i);
    for (int y = step / 2; y < depth_mm.height(); y += step) {
      for (int x = step / 2; x < depth_mm.width(); x += step) {
        const double depth = static_cast<double>(depth_mm(x, y));
        if (!std::isnan(depth))
          points.emplace_back(depth * rays(x, y).cast<double>().homogeneous());
      }
    }
  }
  const std::size_t every = points.size() / kMost + 1;
  std::vector<Eigen::Vector3d> some;
  for (std::size_t i = 0; i < points.size(); i += every)
    some.push_back(points[i]);
  return some;
}

}  // namespace

std::function<void(View&, std::size_t camera)> calibration_part(
    const ViewStore& views,
    const Rig& rig,
    const Pattern& pattern,
    const Image<Eigen::Vector2f>& rays) {
  if (!rig.calibration || rig.calibration->covariance.empty()) return {};
  const auto volume = measured_volume(views, rays);
  const auto uncertainties = std::make_shared<std::vector<CalibrationUncertainty>>();
  for (std::size_t camera = 0; camera < rig.cameras.size(); ++camera)
    uncertainties->emplace_back(rig, pattern, volume, camera);
  return [uncertainties](View& view, std::size_t camera) {
    uncertainties->at(camera).add_to(view.range);
  };
}

}  // namespace frangia
