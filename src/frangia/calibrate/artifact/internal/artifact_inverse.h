#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "frangia/calibrate/internal/artifact_model.h"

namespace frangia {

/// Covariance of the estimated parameters. Directions that the data leaves open are infinite.
struct ArtifactInverse {
  std::vector<std::string> names;
  Eigen::MatrixXd covariance;
  std::vector<std::string> open;
};

/// Inverts the normal equations; a direction whose eigenvalue is below 1e-13 of the largest, in
/// parameters scaled to unit diagonal, is open.
[[nodiscard]] ArtifactInverse invert_artifacts(const ArtifactLinearization& linear);

}  // namespace frangia
