#include "frangia/range/triangulate.h"

#include <algorithm>
#include <cmath>

#include "frangia/core/error.h"
#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"
#include "frangia/range/fringe_ray.h"
#include "frangia/rig/phase_range.h"

namespace frangia {

RangeGrid triangulate(AbsolutePhase& phase, const Rig& rig, const Image<Eigen::Vector2f>& rays) {
  require(same_size(phase.phase_rad, rays), "triangulate: phase and rays differ in size");
  const int width = rays.width();
  RangeGrid out{Image<float>(width, rays.height(), Uninitialized{}),
                Image<float>(width, rays.height(), Uninitialized{}),
                Image<float>(width, rays.height(), Uninitialized{})};
  const bool has_systematic = !phase.systematic_rad.empty();
  if (has_systematic) out.systematic_mm = Image<float>(width, rays.height(), kMissing);
  out.differing_share = phase.differing_share;
  const PhaseRange lit = phase_range(phase.pattern, rig.projector);
  parallel_rows(rays.height(), [&](int y) {
    for (Image<float>* image : {&out.depth_mm, &out.sigma_mm, &out.phase_rad})
      std::fill_n(&(*image)(0, y), width, kMissing);
    for (int x = 0; x < width; ++x) {
      const float measured_rad = phase.phase_rad(x, y);
      const double phi = measured_rad;
      if (std::isnan(phi)) continue;
      const double sigma = phase.sigma_rad(x, y);
      const Eigen::Vector2d ray = rays(x, y).cast<double>();
      const bool in_field = phi > lit.min_rad - 4.0 * sigma && phi < lit.max_rad + 4.0 * sigma;
      const RayDepth found = in_field ? intersect_fringe(ray, phi, phase.pattern, rig.projector)
                                      : RayDepth{kMissing, kMissing};
      if (std::isnan(found.depth_mm)) {
        phase.status(x, y) = PixelStatus::OutOfField;
        continue;
      }
      const double along_ray = std::sqrt(1.0 + ray.squaredNorm());
      out.set({x,
               y,
               static_cast<float>(found.depth_mm),
               static_cast<float>(std::abs(found.mm_per_rad) * sigma * along_ray),
               measured_rad,
               has_systematic ? static_cast<float>(std::abs(found.mm_per_rad) *
                                                   phase.systematic_rad(x, y) * along_ray)
                              : kMissing});
    }
  });
  return out;
}

}  // namespace frangia
