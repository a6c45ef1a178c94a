#include "frangia/calibrate/solve/write_covariance.h"

#include "frangia/rig/rig_covariance.h"

namespace frangia {

void write_covariance(const std::filesystem::path& path, const RigSolution& solution) {
  write_rig_covariance(path, {solution.parameters, solution.covariance});
}

}  // namespace frangia
