#include "frangia/decode/triangulate_view.h"

#include <utility>

#include "frangia/range/difference_uncertainty.h"
#include "frangia/range/triangulate.h"

namespace frangia {

TriangulatedView triangulate_view(DecodedView& decoded,
                                  const ViewFit& fit,
                                  const Rig& rig,
                                  const Image<Eigen::Vector2f>& rays,
                                  DirectionChoice directions) {
  if (!fit.uses_first && decoded.second_phase) {
    decoded.phase = std::move(*decoded.second_phase);
    decoded.second_phase.reset();
  }
  TriangulatedView out;
  out.range = triangulate(decoded.phase, rig, rays);
  if (!decoded.second_phase || !fit.uses_second) return out;
  const RangeGrid second = triangulate(*decoded.second_phase, rig, rays);
  const auto fusion =
      directions == DirectionChoice::Best ? DirectionFusion::Best : DirectionFusion::LeastSquares;
  out.disagreement =
      fuse_directions(second,
                      rays,
                      {.fusion = fusion,
                       .calibration = between_directions(
                           rig, decoded.phase.pattern, decoded.second_phase->pattern)},
                      out.range,
                      decoded.phase.status);
  return out;
}

}  // namespace frangia
