#include "frangia/reconstruct/internal/resolve_fringe_orders.h"

#include <cstddef>

#include <fmt/format.h>

namespace frangia {

std::size_t resolve_fringe_orders(MeasuredViews& measured,
                                  const Rig& rig,
                                  const Image<Eigen::Vector2f>& rays,
                                  const FringeOrderCorrectionOptions& correction_options,
                                  const Run& run) {
  const FringeOptics optics{measured.coarsest, rig, rays};
  const auto resolved = resolve_by_views(measured.reference(), measured.unresolved, optics, run);
  if (resolved.removed_points > 0) {
    run.warn(
        fmt::format("points removed because neither the laser sheet nor another view determines "
                    "their fringe order: {}",
                    resolved.removed_points));
  }
  measured.points += resolved.resolved_points;
  if (!measured.unwrapped_spatially) return resolved.removed_points;
  const std::size_t corrected =
      correct_fringe_orders(measured.reference(), optics, correction_options, run);
  if (corrected > 0) {
    run.note(
        fmt::format("points moved by whole fringes to agree with the other views: {}", corrected));
  }
  return resolved.removed_points;
}

}  // namespace frangia
