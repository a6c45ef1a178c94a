#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace frangia {

struct Rig;

/// The covariance of the estimated parameters of a rig. docs/calibration.md defines the parameters.
///
/// @units    those that end the names of the parameters
struct RigCovariance {
  std::vector<std::string> parameters;  ///< names, in the order of the rows
  Eigen::MatrixXd covariance;           ///< symmetric, one row and column for each parameter

  [[nodiscard]] bool empty() const { return parameters.empty(); }  ///< whether it is not known
};

/// Returns the names of the parameters of a rig that a covariance may hold.
[[nodiscard]] std::vector<std::string> rig_parameter_names(const Rig& rig);

/// Reads the CSV file of a covariance: a line with the names of the parameters, then one line for
/// each of them with its name and its covariances.
///
/// The name may come from a rig.toml that somebody else wrote: the file is not read through a link.
///
/// @errors   Error(Input) that names the file: it does not exist, is a link or no file,
///           has more than 4 MB, a parameter is repeated or is not one of the rig's, a line has
///           another name or length than the header states, a value is not a finite number, or
///           the matrix is not symmetric and positive semidefinite
[[nodiscard]] RigCovariance read_rig_covariance(const std::filesystem::path& path, const Rig& rig);

/// Writes the CSV file that `read_rig_covariance` reads.
///
/// @errors   Error(File) when the file cannot be written
void write_rig_covariance(const std::filesystem::path& path, const RigCovariance& covariance);

/// Returns the matrix F with F transpose(F) = covariance: its columns are independent changes of
/// the parameters of one standard deviation each.
///
/// @shape    parameters x number of determined directions
[[nodiscard]] Eigen::MatrixXd covariance_factor(const RigCovariance& covariance);

/// Returns the rig with its parameters changed.
///
/// @shape    one change for each name
/// @errors   Error(Input) when a name is not one of `rig_parameter_names`
[[nodiscard]] Rig change_parameters(const Rig& rig,
                                    const std::vector<std::string>& names,
                                    const Eigen::VectorXd& changes);

}  // namespace frangia
