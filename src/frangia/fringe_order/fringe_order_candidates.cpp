#include "frangia/fringe_order/fringe_order_candidates.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "frangia/core/angles.h"
#include "frangia/range/triangulate.h"
#include "frangia/rig/rig.h"

namespace frangia {

std::vector<FringeOrderCandidate> fringe_order_candidates(const FringePixels& pixels,
                                                          const Eigen::Isometry3d& rig_from_object,
                                                          const FringeComparison& comparison) {
  std::vector<FringeOrderCandidate> candidates;
  if (pixels.pixel.empty()) return candidates;
  const auto [low, high] = std::minmax_element(pixels.phase_rad.begin(), pixels.phase_rad.end());
  const PhaseRange lit = phase_range(comparison.pattern, comparison.rig.projector);
  const int first = static_cast<int>(std::floor((lit.min_rad - *high) / kTwoPi));
  const int last = static_cast<int>(std::ceil((lit.max_rad - *low) / kTwoPi));
  const std::size_t stride = std::max<std::size_t>(
      1, pixels.pixel.size() / static_cast<std::size_t>(comparison.max_samples));
  const Eigen::Isometry3d object_from_rig = rig_from_object.inverse();
  for (int order = first; order <= last; ++order) {
    FringeOrderCandidate candidate{.order = order};
    std::size_t tried = 0;
    for (std::size_t i = 0; i < pixels.pixel.size(); i += stride) {
      ++tried;
      const double phase = pixels.phase_rad[i] + kTwoPi * order;
      if (phase < lit.min_rad || phase > lit.max_rad) continue;
      const Eigen::Vector2d ray = comparison.rays.pixels()[pixels.pixel[i]].cast<double>();
      const RayDepth found =
          intersect_fringe(ray, phase, comparison.pattern, comparison.rig.projector);
      if (std::isnan(found.depth_mm)) continue;
      const Eigen::Vector3d point = found.depth_mm * Eigen::Vector3d(ray.x(), ray.y(), 1.0);
      candidate.points_mm.emplace_back((object_from_rig * point).cast<float>());
      candidate.spacing_mm = std::abs(found.mm_per_rad) * kTwoPi;
    }
    if (2 * candidate.points_mm.size() > tried) candidates.push_back(std::move(candidate));
  }
  return candidates;
}

void compare_with(const Image<float>& depth_mm,
                  const Eigen::Isometry3d& rig_from_object,
                  const FringeComparison& comparison,
                  FringeOrderCandidate& candidate) {
  const double tolerance = comparison.tolerance * candidate.spacing_mm;
  for (const Eigen::Vector3f& point : candidate.points_mm) {
    const Eigen::Vector3d seen = rig_from_object * point.cast<double>();
    if (!(seen.z() > 0.0)) continue;
    const Eigen::Vector2d pixel = comparison.rig.reference().model.project(seen);
    const auto x = static_cast<int>(std::lround(pixel.x()));
    const auto y = static_cast<int>(std::lround(pixel.y()));
    if (x < 0 || y < 0 || x >= depth_mm.width() || y >= depth_mm.height()) continue;
    const double in_front = depth_mm(x, y) - seen.z();
    if (std::isnan(in_front)) ++candidate.unseen;
    if (std::abs(in_front) <= tolerance) ++candidate.agree;
    if (in_front > 2.0 * tolerance) ++candidate.violations;
  }
}

}  // namespace frangia
