#include "frangia/rig/rig_covariance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>
#include <variant>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/core/atomic_file.h"
#include "frangia/core/error.h"
#include "frangia/core/read_text_file.h"
#include "frangia/core/symmetric_eigen.h"
#include "frangia/rig/internal/covariance_reader.h"
#include "frangia/rig/rig.h"

namespace frangia {
namespace {

constexpr std::array kIntrinsics = {
    "focal_px", "focal_ratio", "principal_x_px", "principal_y_px", "k1", "k2", "p1", "p2", "k3"};
constexpr std::array kPose = {
    "rotation_x_rad", "rotation_y_rad", "rotation_z_rad", "x_mm", "y_mm", "z_mm"};
constexpr std::string_view kCamera = "camera.";
constexpr std::string_view kProjector = "projector.";
constexpr std::string_view kPitchScale = "projector.pitch_scale";

/// Largest negative eigenvalue of the correlation matrix, and largest difference of correlations
/// across its diagonal. The file holds nine digits.
constexpr double kRounding = 1e-6;

/// Scales a covariance to correlations; the row of a parameter without a variance is zero.
Eigen::MatrixXd correlation_of(const Eigen::MatrixXd& covariance, Eigen::VectorXd& sigma) {
  sigma = covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
  const Eigen::VectorXd scale = sigma.unaryExpr([](double s) { return s > 0.0 ? 1.0 / s : 0.0; });
  return scale.asDiagonal() * covariance * scale.asDiagonal();
}

void check_matrix(const RigCovariance& read, const CovarianceReader& reader) {
  Eigen::VectorXd sigma;
  const Eigen::MatrixXd correlation = correlation_of(read.covariance, sigma);
  for (Eigen::Index i = 0; i < correlation.rows(); ++i) {
    const std::string& name = read.parameters[static_cast<std::size_t>(i)];
    const double variance = read.covariance(i, i);
    if (variance < 0.0) reader.fail(fmt::format("the variance of {} is {:g}", name, variance));
    const bool correlated = !read.covariance.row(i).isZero() || !read.covariance.col(i).isZero();
    if (variance == 0.0 && correlated)
      reader.fail(fmt::format("{} has no variance, but covariances", name));
    for (Eigen::Index j = 0; j < i; ++j) {
      if (std::abs(correlation(i, j) - correlation(j, i)) < kRounding) continue;
      reader.fail(
          fmt::format("the matrix is not symmetric: {} and {} have two covariances, {:g} "
                      "and {:g}",
                      name,
                      read.parameters[static_cast<std::size_t>(j)],
                      read.covariance(i, j),
                      read.covariance(j, i)));
    }
  }
  const double least = symmetric_eigen(correlation).values[0];
  if (least < -kRounding) {
    reader.fail(fmt::format(
        "the matrix is not positive semidefinite: its smallest eigenvalue, in parameters scaled to "
        "unit variance, is {:.2g}",
        least));
  }
}

/// Adds to one of the nine intrinsic parameters.
void change_intrinsic(CameraModel& model, std::size_t which, double change) {
  const double ratio = model.focal_px.y() / model.focal_px.x();
  switch (which) {
    case 0:
      model.focal_px += change * Eigen::Vector2d(1.0, ratio);
      break;
    case 1:
      model.focal_px.y() += change * model.focal_px.x();
      break;
    case 2:
      model.principal_point_px.x() += change;
      break;
    case 3:
      model.principal_point_px.y() += change;
      break;
    default:
      model.distortion.at(which - 4) += change;
  }
}

/// Adds to the rotation vector and the translation of `p = R X + t`.
void change_pose(Projector& projector, const Eigen::Matrix<double, 6, 1>& changes) {
  const Eigen::Vector3d translation = -(projector.rotation * projector.position_mm);
  const Eigen::AngleAxisd turn(projector.rotation);
  const Eigen::Vector3d vector = turn.angle() * turn.axis() + changes.head<3>();
  const double angle = vector.norm();
  projector.rotation = angle > 0.0 ? Eigen::AngleAxisd(angle, vector / angle).toRotationMatrix()
                                   : Eigen::Matrix3d(Eigen::Matrix3d::Identity());
  projector.position_mm = -(projector.rotation.transpose() * (translation + changes.tail<3>()));
}

template <std::size_t n>
std::size_t index_in(const std::array<const char*, n>& names, std::string_view name) {
  return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

}  // namespace

std::vector<std::string> rig_parameter_names(const Rig& rig) {
  std::vector<std::string> names;
  for (const char* name : kIntrinsics)
    names.push_back(std::string(kCamera) + name);
  for (const char* name : kIntrinsics)
    if (!rig.projector.is_angular()) names.push_back(std::string(kProjector) + name);
  for (const char* name : kPose)
    names.push_back(std::string(kProjector) + name);
  if (rig.projector.is_angular()) names.emplace_back(kPitchScale);
  return names;
}

RigCovariance read_rig_covariance(const std::filesystem::path& path, const Rig& rig) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: there is no such file; copy it to the folder of the rig.toml that "
                            "names it, or remove the key covariance from [calibration]",
                            path.string()));
  }
  CovarianceReader reader(path, read_text_file(path));
  const auto header = reader.line();
  if (header.size() < 2 || header.front() != "parameter")
    reader.fail("its first line is not parameter,NAME,...");
  const std::vector<std::string> known = rig_parameter_names(rig);
  RigCovariance read;
  std::set<std::string_view> seen;
  for (const std::string_view name : std::vector(header.begin() + 1, header.end())) {
    if (std::find(known.begin(), known.end(), name) == known.end())
      reader.fail(fmt::format("'{}' is not a parameter of this rig", name));
    if (!seen.insert(name).second) reader.fail(fmt::format("{} appears twice", name));
    read.parameters.emplace_back(name);
  }
  const std::size_t count = read.parameters.size();
  read.covariance.resize(static_cast<Eigen::Index>(count), static_cast<Eigen::Index>(count));
  for (std::size_t row = 0; row < count; ++row) {
    const auto values = reader.line();
    const std::string& name = read.parameters[row];
    if (values.empty()) reader.fail(fmt::format("the row of {} is missing", name));
    if (values.front() != name) {
      reader.fail(
          fmt::format("the row of '{}' stands where that of {} should be", values.front(), name));
    }
    if (values.size() != count + 1) {
      reader.fail(
          fmt::format("the row of {} has {} values instead of {}", name, values.size() - 1, count));
    }
    for (std::size_t column = 0; column < count; ++column) {
      read.covariance(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)) =
          reader.number(values[column + 1], name);
    }
  }
  if (!reader.line().empty())
    reader.fail(fmt::format("it has more than {} rows of covariances", count));
  check_matrix(read, reader);
  return read;
}

void write_rig_covariance(const std::filesystem::path& path, const RigCovariance& covariance) {
  std::string text = fmt::format("parameter,{}\n", fmt::join(covariance.parameters, ","));
  for (std::size_t row = 0; row < covariance.parameters.size(); ++row) {
    text += covariance.parameters[row];
    for (Eigen::Index column = 0; column < covariance.covariance.cols(); ++column) {
      text += fmt::format(",{:.9g}", covariance.covariance(static_cast<Eigen::Index>(row), column));
    }
    text += "\n";
  }
  AtomicFile file(path);
  file.stream() << text;
  file.commit();
}

Eigen::MatrixXd covariance_factor(const RigCovariance& covariance) {
  Eigen::VectorXd sigma;
  const auto eigen = symmetric_eigen(correlation_of(covariance.covariance, sigma));
  Eigen::Index first = 0;
  while (first < eigen.values.size() && !(eigen.values[first] > 0.0))
    ++first;
  const Eigen::Index kept = eigen.values.size() - first;
  return sigma.asDiagonal() * eigen.vectors.rightCols(kept) *
         eigen.values.tail(kept).cwiseSqrt().asDiagonal();
}

Rig change_parameters(const Rig& rig,
                      const std::vector<std::string>& names,
                      const Eigen::VectorXd& changes) {
  require(static_cast<std::size_t>(changes.size()) == names.size(),
          "change_parameters: there must be one change for each parameter");
  Rig changed = rig;
  Eigen::Matrix<double, 6, 1> pose = Eigen::Matrix<double, 6, 1>::Zero();
  auto* const pinhole = std::get_if<PinholeModel>(&changed.projector.model);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const double change = changes[static_cast<Eigen::Index>(i)];
    const std::string_view name = names[i];
    const bool of_camera = name.starts_with(kCamera);
    const std::string_view tail = name.substr(std::min(name.find('.') + 1, name.size()));
    const std::size_t intrinsic = index_in(kIntrinsics, tail);
    const std::size_t in_pose = index_in(kPose, tail);
    if (of_camera && intrinsic < kIntrinsics.size()) {
      change_intrinsic(changed.camera.model, intrinsic, change);
    } else if (name.starts_with(kProjector) && intrinsic < kIntrinsics.size() &&
               pinhole != nullptr) {
      change_intrinsic(*pinhole, intrinsic, change);
    } else if (name.starts_with(kProjector) && in_pose < kPose.size()) {
      pose[static_cast<Eigen::Index>(in_pose)] += change;
    } else if (name == kPitchScale && pinhole == nullptr) {
      std::get<AngularModel>(changed.projector.model).pitch_scale += change;
    } else {
      throw Error(ErrorKind::Input, fmt::format("'{}' is not a parameter of this rig", name));
    }
  }
  if (!pose.isZero(0.0)) change_pose(changed.projector, pose);
  return changed;
}

}  // namespace frangia
