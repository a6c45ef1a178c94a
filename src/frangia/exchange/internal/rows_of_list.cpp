#include "frangia/exchange/internal/named_values.h"

namespace frangia {

Eigen::MatrixXd rows_of_list(const Eigen::MatrixXd& list, Eigen::Index rows, Eigen::Index columns) {
  // Each is compared alone, too: the product of two numbers of a file may overflow.
  if (rows <= 0 || columns <= 0 || rows > list.size() || columns > list.size() ||
      rows * columns != list.size())
    return {};
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  return Eigen::Map<const RowMajor>(list.data(), rows, columns);
}

}  // namespace frangia
