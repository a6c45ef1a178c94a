#include "frangia/calibrate/write_covariance.h"

#include <fmt/format.h>

#include "frangia/core/atomic_file.h"

namespace frangia {

void write_covariance(const std::filesystem::path& path, const RigSolution& solution) {
  std::string text = "parameter";
  for (const std::string& name : solution.parameters)
    text += "," + name;
  text += "\n";
  for (std::size_t row = 0; row < solution.parameters.size(); ++row) {
    text += solution.parameters[row];
    for (std::size_t column = 0; column < solution.parameters.size(); ++column) {
      text += fmt::format(
          ",{:.9g}",
          solution.covariance(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)));
    }
    text += "\n";
  }
  AtomicFile file(path);
  file.stream() << text;
  file.commit();
}

}  // namespace frangia
