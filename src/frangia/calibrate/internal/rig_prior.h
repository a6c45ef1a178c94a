#pragma once

#include <array>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <ceres/cost_function.h>

namespace frangia {

/// Information about camera, projector, pose and pitch from an earlier calibration.
class RigPrior final : public ceres::CostFunction {
 public:
  RigPrior(Eigen::MatrixXd root, const std::array<double, 25>& mean)
      : root_(std::move(root)), mean_(mean) {
    set_num_residuals(static_cast<int>(root_.rows()));
    *mutable_parameter_block_sizes() = {9, 9, 6, 1};
  }
  bool Evaluate(const double* const* parameters,
                double* residuals,
                double** jacobians) const override {
    const std::vector<int>& sizes = parameter_block_sizes();
    Eigen::VectorXd change(static_cast<Eigen::Index>(mean_.size()));
    Eigen::Index at = 0;
    for (std::size_t block = 0; block < sizes.size(); ++block) {
      const Eigen::MatrixXd columns = root_.middleCols(at, sizes[block]);
      for (int i = 0; i < sizes[block]; ++i)
        change[at + i] = parameters[block][i] - mean_.at(static_cast<std::size_t>(at + i));
      if (jacobians != nullptr && jacobians[block] != nullptr) {
        Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
            jacobians[block], columns.rows(), columns.cols()) = columns;
      }
      at += sizes[block];
    }
    Eigen::Map<Eigen::VectorXd>(residuals, root_.rows()) = root_ * change;
    return true;
  }

 private:
  Eigen::MatrixXd root_;
  std::array<double, 25> mean_;
};

}  // namespace frangia
