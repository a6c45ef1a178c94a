#include <algorithm>
#include <cmath>
#include <cstddef>

#include "frangia/core/linear_algebra.h"
#include "frangia/decode/explain/internal/frame_design.h"
#include "frangia/decode/explain/internal/log_densities.h"
#include "frangia/decode/explain/internal/score_frames.h"

namespace frangia {

double rough_score(const Eigen::MatrixXd& moments,
                   const Eigen::VectorXd& means,
                   double relative_noise,
                   const FrameHypothesis& hypothesis) {
  const FrameDesign design = design_of(hypothesis);
  const double noise = relative_noise * relative_noise;
  double out = -static_cast<double>(design.span.cols()) * std::log(kBroad);
  for (std::size_t k = 0; k < hypothesis.free.size(); ++k) {
    if (!hypothesis.free[k]) continue;
    const auto i = static_cast<Eigen::Index>(k);
    out -= 0.5 * std::log(std::max(moments(i, i) - means(i) * means(i), 0.0) + noise);
  }
  const Eigen::Index freedom = design.rest.cols();
  if (freedom == 0) return out;
  const Eigen::MatrixXd shown = moments(design.shown, design.shown);
  const double left = congruence(design.rest, shown).trace();
  const auto count = static_cast<double>(freedom);
  return out - 0.5 * count * std::log(left / count + noise);
}

}  // namespace frangia
