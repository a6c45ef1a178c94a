#include "frangia/calibrate/artifact/internal/artifact_inverse.h"

#include "frangia/calibrate/internal/invert_normal.h"

namespace frangia {

ArtifactInverse invert_artifacts(const ArtifactLinearization& linear) {
  constexpr double kOpen = 1e-13;
  constexpr double kMuch = 0.1;  // share of a parameter that lies in open directions
  const NormalInverse inverse = invert_normal(linear.normal, kOpen);
  ArtifactInverse out{linear.names, inverse.covariance, {}};
  for (Eigen::Index i = 0; i < inverse.open.size(); ++i)
    if (inverse.open[i] > kMuch) out.open.push_back(linear.names[static_cast<std::size_t>(i)]);
  return out;
}

}  // namespace frangia
