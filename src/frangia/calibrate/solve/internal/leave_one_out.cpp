#include "frangia/calibrate/solve/internal/leave_one_out.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

namespace frangia {

LeaveOneOut leave_one_out(std::span<const RigObservation> observations,
                          const RigFreedom& freedom,
                          const RigNoise& noise,
                          const RigParameters& parameters,
                          const Eigen::MatrixXd& response) {
  LeaveOneOut out;
  RigLinearization all = linearize_rig(observations, freedom.layout, noise, parameters);
  const std::vector<Eigen::Index> columns = free_columns(freedom, all.jacobian.cols());
  all.jacobian = all.jacobian(Eigen::all, columns).eval();
  const Eigen::MatrixXd normal = all.jacobian.transpose() * all.jacobian;
  const Eigen::VectorXd gradient = all.jacobian.transpose() * all.residuals;
  // The free parameters of the devices come first.
  const auto devices = static_cast<Eigen::Index>(freedom.layout.board());
  const auto shown = std::lower_bound(columns.begin(), columns.end(), devices) - columns.begin();
  const Eigen::MatrixXd by_free =
      response(Eigen::all, std::vector<Eigen::Index>(columns.begin(), columns.begin() + shown));
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
    out.by_view_mm.push_back(std::sqrt(square));
    squares += square;
  }
  const auto count = static_cast<double>(views);
  out.spread_mm = std::sqrt((count - 1.0) / count * squares);
  return out;
}

}  // namespace frangia
