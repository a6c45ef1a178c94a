#include "frangia/decode/triangulate_view.h"

#include <cstddef>
#include <span>

#include "frangia/range/calibration_uncertainty.h"
#include "frangia/range/triangulate.h"

namespace frangia {

TriangulatedView triangulate_view(DecodedView& decoded,
                                  const ViewFit& fit,
                                  const Rig& rig,
                                  const Image<Eigen::Vector2f>& rays,
                                  DirectionChoice directions) {
  const auto fusion =
      directions == DirectionChoice::Best ? DirectionFusion::Best : DirectionFusion::LeastSquares;
  AbsolutePhase& leading = decoded.directions[fit.leading()].phase;
  TriangulatedView out;
  out.range = triangulate(leading, rig, rays);
  for (const std::size_t i : std::span(fit.used).subspan(1)) {
    AbsolutePhase& phase = decoded.directions[i].phase;
    const RangeGrid other = triangulate(phase, rig, rays);
    out.disagreement = fuse_directions(
        other,
        rays,
        {.fusion = fusion, .calibration = between_directions(rig, leading.pattern, phase.pattern)},
        out.range,
        leading.status);
  }
  return out;
}

}  // namespace frangia
