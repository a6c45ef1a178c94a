#pragma once

#include <ceres/iteration_callback.h>

#include "frangia/core/run.h"

namespace frangia {

/// Lets a stop request end the solver.
class StopCallback final : public ceres::IterationCallback {
 public:
  explicit StopCallback(const Run& run) : run_(run) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& /*summary*/) override {
    return run_.stop.stop_requested() ? ceres::SOLVER_ABORT : ceres::SOLVER_CONTINUE;
  }

 private:
  const Run& run_;
};

}  // namespace frangia
