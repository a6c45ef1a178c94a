#include "frangia/calibrate/internal/leave_one_out.h"

#include <cmath>
#include <vector>

#include <Eigen/Cholesky>

namespace frangia {
namespace {

/// Rows of the response that the free parameters of camera, projector and relative pose have in the
/// order of the linearization, and their number in the full order.
std::vector<Eigen::Index> free_parameters(const RigFreedom& freedom) {
  std::vector<Eigen::Index> free;
  for (Eigen::Index i = 0; i < kIntrinsics; ++i)
    if (freedom.camera.at(static_cast<std::size_t>(i))) free.push_back(i);
  for (Eigen::Index i = 0; i < kIntrinsics; ++i)
    if (freedom.projector.at(static_cast<std::size_t>(i))) free.push_back(kIntrinsics + i);
  for (Eigen::Index i = 0; i < kPose; ++i)
    free.push_back(2 * kIntrinsics + i);
  return free;
}

}  // namespace

void add_leave_one_out(std::span<const RigObservation> observations,
                       const RigFreedom& freedom,
                       const RigNoise& noise,
                       const RigParameters& parameters,
                       const Eigen::MatrixXd& response,
                       RigSolution& solution) {
  const RigLinearization all = linearize_rig(observations, freedom, noise, parameters);
  const Eigen::MatrixXd normal = all.jacobian.transpose() * all.jacobian;
  const Eigen::VectorXd gradient = all.jacobian.transpose() * all.residuals;
  const auto free = free_parameters(freedom);
  const auto shown = static_cast<Eigen::Index>(free.size());
  const Eigen::MatrixXd by_free = response(Eigen::all, free);
  const std::size_t views = parameters.camera_from_board.size();
  const auto points = static_cast<double>(response.rows()) / 3.0;
  double squares = 0.0;
  for (std::size_t view = 0; view < views; ++view) {
    std::vector<Eigen::Index> rows;
    for (std::size_t i = 0; i < observations.size(); ++i) {
      if (observations[i].view != view) continue;
      rows.push_back(static_cast<Eigen::Index>(2 * i));
      rows.push_back(static_cast<Eigen::Index>(2 * i + 1));
    }
    const Eigen::MatrixXd jacobian = all.jacobian(rows, Eigen::all);
    Eigen::MatrixXd others = normal - jacobian.transpose() * jacobian;
    // The pose of the view itself is open without the view.
    const auto first = others.rows() - kPose * static_cast<Eigen::Index>(views - view);
    others.middleRows<kPose>(first).setZero();
    others.middleCols<kPose>(first).setZero();
    others.block<kPose, kPose>(first, first).setIdentity();
    Eigen::VectorXd slope = gradient - jacobian.transpose() * all.residuals(rows);
    slope.segment<kPose>(first).setZero();
    const Eigen::VectorXd step = -others.ldlt().solve(slope);
    const double square = (by_free * step.head(shown)).squaredNorm() / points;
    solution.leave_one_out_mm.push_back(std::sqrt(square));
    squares += square;
  }
  const auto count = static_cast<double>(views);
  solution.spread_mm = std::sqrt((count - 1.0) / count * squares);
}

}  // namespace frangia
