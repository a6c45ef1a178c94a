#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>

#include <Eigen/Core>

#include "frangia/core/run.h"

namespace frangia {

/// The matrices and texts of a file by their names. Names of inner structures are joined by dots.
struct NamedValues {
  std::map<std::string, Eigen::MatrixXd> matrices;  ///< a number is 1 x 1, a list 1 x n
  std::map<std::string, std::string> texts;
};

constexpr std::size_t kMaxValueNumbers = 1000;  ///< of a matrix that is kept
constexpr std::size_t kMaxNameBytes = 250;      ///< of a name with those of outer structures

/// Refuses a file with more values than any calibration has: each takes many times its size in the
/// file.
///
/// @errors   Error(Input) that names the file
void check_count(const NamedValues& values, const std::filesystem::path& file);

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
/// is one too. Matrices of more than 1000 numbers are left out.
///
/// @errors   Error(Input) that names the file
[[nodiscard]] NamedValues read_json_values(const std::filesystem::path& file);

/// Reads a .mat of version 5 or 7. Of a compressed variable only as much is expanded as tells that
/// it is kept: matrices of more than 1000 numbers are left out. All structures together may expand
/// to 64 MB.
///
/// @errors   Error(Input) that names the file, also when a variable is an object of a MATLAB class;
///           Error(Cancelled)
[[nodiscard]] NamedValues read_mat_values(const std::filesystem::path& file, const Run& run = {});

}  // namespace frangia
