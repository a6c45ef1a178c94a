#include "frangia/rig/rig_covariance.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/core/durable_file.h"
#include "frangia/core/error.h"
#include "frangia/core/linear_algebra.h"
#include "frangia/core/open_below.h"
#include "frangia/rig/internal/parameter_names.h"
#include "frangia/rig/rig.h"

namespace frangia {
namespace {

/// Reads the lines of comma-separated values of a covariance.
class CovarianceReader {
 public:
  CovarianceReader(const std::filesystem::path& path, std::string text)
      : path_(path), text_(std::move(text)), rest_(text_) {}

  [[noreturn]] void fail(const std::string& why) const {
    throw Error(ErrorKind::Input,
                fmt::format("{}: {}; calibrate the rig again, or remove the key covariance from "
                            "[calibration] of its rig.toml",
                            path_.string(),
                            why));
  }

  /// Returns the next line that is not empty; empty at the end.
  std::vector<std::string_view> line() {
    std::vector<std::string_view> values;
    while (!rest_.empty() && values.empty()) {
      const std::size_t end = std::min(rest_.find('\n'), rest_.size());
      std::string_view one = rest_.substr(0, end);
      rest_.remove_prefix(std::min(end + 1, rest_.size()));
      if (one.ends_with('\r')) one.remove_suffix(1);
      if (one.empty()) continue;
      while (true) {
        const std::size_t comma = std::min(one.find(','), one.size());
        values.push_back(one.substr(0, comma));
        if (comma == one.size()) break;
        one.remove_prefix(comma + 1);
      }
    }
    return values;
  }

  [[nodiscard]] double number(std::string_view word, std::string_view row) const {
    double value = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value)) {
      fail(fmt::format("the value '{}' in the row of {} is not a finite number", word, row));
    }
    return value;
  }

 private:
  const std::filesystem::path& path_;
  std::string text_;
  std::string_view rest_;
};

/// Largest negative eigenvalue of the correlation matrix, and largest difference of correlations
/// across its diagonal. The file holds nine digits.
constexpr double kRounding = 1e-6;

/// Of a file; a matrix of 400 parameters has 3 MB.
constexpr std::uint64_t kMostCovarianceBytes = 4'000'000;

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

}  // namespace

std::vector<std::string> rig_parameter_names(const Rig& rig) {
  std::vector<std::string> names;
  const auto add = [&](const std::string& device, const auto& of_device) {
    for (const char* name : of_device)
      names.push_back(device + name);
  };
  add(std::string(kCameraPrefix), kIntrinsicNames);
  if (!rig.projector.is_angular()) add(std::string(kProjectorPrefix), kIntrinsicNames);
  add(std::string(kProjectorPrefix), kPoseNames);
  if (const auto* angular = std::get_if<AngularModel>(&rig.projector.model)) {
    names.emplace_back(kPitchScaleName);
    if (!angular->wavefront.is_plane()) {
      for (std::size_t term = 0; term < Wavefront::kTerms; ++term)
        names.push_back(Wavefront::parameter_name(term));
    }
  }
  for (std::size_t i = 1; i < rig.cameras.size(); ++i) {
    add(camera_prefix(rig.cameras[i].camera.name), kIntrinsicNames);
    add(camera_prefix(rig.cameras[i].camera.name), kPoseNames);
  }
  return names;
}

RigCovariance read_rig_covariance(const std::filesystem::path& path, const Rig& rig) {
  std::error_code error;
  if (!std::filesystem::exists(std::filesystem::symlink_status(path, error))) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: there is no such file; copy it to the folder of the rig.toml that "
                            "names it, or remove the key covariance from [calibration]",
                            path.string()));
  }
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  CovarianceReader reader(path, read_below(folder, path.filename(), kMostCovarianceBytes));
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
  write_text_file(path, text);
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

}  // namespace frangia
