#include "frangia/exchange/internal/opencv_text.h"

#include <opencv2/core.hpp>

namespace frangia {

std::string opencv_text(const std::vector<std::pair<std::string, Eigen::MatrixXd>>& matrices,
                        const std::vector<std::pair<std::string, int>>& numbers,
                        const std::string& ending) {
  // In memory, FileStorage takes the format from the ending of the name.
  cv::FileStorage storage(ending == ".xml" ? ".xml" : ".yml",
                          cv::FileStorage::WRITE | cv::FileStorage::MEMORY);
  for (const auto& [name, number] : numbers)
    storage << name << number;
  for (const auto& [name, matrix] : matrices) {
    cv::Mat copy(static_cast<int>(matrix.rows()), static_cast<int>(matrix.cols()), CV_64F);
    for (int row = 0; row < copy.rows; ++row) {
      for (int column = 0; column < copy.cols; ++column)
        copy.at<double>(row, column) = matrix(row, column);
    }
    storage << name << copy;
  }
  return storage.releaseAndGetString();
}

}  // namespace frangia
