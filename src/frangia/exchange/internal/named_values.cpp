#include "frangia/exchange/internal/named_values.h"

#include <fmt/format.h>

#include "frangia/core/error.h"

namespace frangia {

void check_count(const NamedValues& values, const std::filesystem::path& file) {
  constexpr std::size_t kMaxValues = 10'000;
  if (values.matrices.size() + values.texts.size() <= kMaxValues) return;
  throw Error(
      ErrorKind::Input,
      fmt::format("{}: it holds more than {} values; give a file with the calibration alone",
                  file.string(),
                  kMaxValues));
}

Eigen::MatrixXd rows_of_list(const Eigen::MatrixXd& list, Eigen::Index rows, Eigen::Index columns) {
  // Each is compared alone, too: the product of two numbers of a file may overflow.
  if (rows <= 0 || columns <= 0 || rows > list.size() || columns > list.size() ||
      rows * columns != list.size())
    return {};
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  return Eigen::Map<const RowMajor>(list.data(), rows, columns);
}

}  // namespace frangia
