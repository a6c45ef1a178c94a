#pragma once

#include <array>
#include <cstddef>
#include <utility>

#include <ceres/dynamic_autodiff_cost_function.h>
#include <ceres/iteration_callback.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include "frangia/core/run.h"

namespace frangia {

/// Solves a problem without a word on stderr. Ceres' Levenberg-Marquardt steps warn through glog of
/// each matrix that is not positive definite whatever `logging_type` is; the solver then takes a
/// shorter step, and the summary tells how it ended.
///
/// glog has one level for the process: it is raised while a problem is solved, also for solutions
/// at the same time, and set back afterwards.
[[nodiscard]] ceres::Solver::Summary solve_quietly(ceres::Solver::Options options,
                                                   ceres::Problem& problem);

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

/// A residual of separate blocks of parameters as one of an array of blocks.
template <typename Residual, std::size_t kBlocks>
struct ResidualOfBlocks {
  Residual residual;

  template <typename T>
  bool operator()(T const* const* blocks, T* values) const {
    return [&]<std::size_t... i>(std::index_sequence<i...>) {
      return residual(blocks[i]..., values);
    }
    (std::make_index_sequence<kBlocks>{});
  }
};

/// Returns the cost function of a residual with `count` values, which depends on blocks of these
/// sizes, for a problem that then owns it. The derivatives are taken twelve at a time: one type of
/// dual number serves all residuals, which compiles in a third of the time.
template <std::size_t kBlocks, typename Residual>
[[nodiscard]] ceres::CostFunction* cost_function(const Residual& residual,
                                                 int count,
                                                 const std::array<int, kBlocks>& sizes) {
  constexpr int kAtATime = 12;
  using Functor = ResidualOfBlocks<Residual, kBlocks>;
  auto* cost =
      new ceres::DynamicAutoDiffCostFunction<Functor, kAtATime>(  // NOLINT(*-owning-memory)
          new Functor{residual});                                 // NOLINT(*-owning-memory)
  for (const int size : sizes)
    cost->AddParameterBlock(size);
  cost->SetNumResiduals(count);
  return cost;
}

}  // namespace frangia
