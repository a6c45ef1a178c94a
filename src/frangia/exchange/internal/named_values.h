#pragma once

#include <filesystem>
#include <map>
#include <string>

#include <Eigen/Core>

namespace frangia {

/// The matrices and texts of a file by their names. Names of inner structures are joined by dots.
struct NamedValues {
  std::map<std::string, Eigen::MatrixXd> matrices;  ///< a number is 1 x 1, a list 1 x n
  std::map<std::string, std::string> texts;
};

/// Arranges a list of 1 x n numbers in rows, one row after the other.
///
/// @missing  empty when the list does not have rows x columns numbers
[[nodiscard]] Eigen::MatrixXd rows_of_list(const Eigen::MatrixXd& list,
                                           Eigen::Index rows,
                                           Eigen::Index columns);

/// Reads a .yml, .yaml or .xml as OpenCV's FileStorage writes them.
///
/// @errors   Error(Input) that names the file
[[nodiscard]] NamedValues read_opencv_values(const std::filesystem::path& file);

/// Reads a .json. A list of lists of equal lengths is a matrix; an object with rows, cols and data
/// is one too.
///
/// @errors   Error(Input) that names the file
[[nodiscard]] NamedValues read_json_values(const std::filesystem::path& file);

/// Reads a .mat of version 5 or 7.
///
/// @errors   Error(Input) that names the file, also when a variable is an object of a MATLAB class
[[nodiscard]] NamedValues read_mat_values(const std::filesystem::path& file);

}  // namespace frangia
