#pragma once

#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

namespace frangia {

/// The text that OpenCV's FileStorage writes for whole numbers and matrices, as XML for the ending
/// .xml and as YAML for any other.
[[nodiscard]] std::string opencv_text(
    const std::vector<std::pair<std::string, Eigen::MatrixXd>>& matrices,
    const std::vector<std::pair<std::string, int>>& numbers,
    const std::string& ending);

}  // namespace frangia
