#include "frangia/align/internal/fit_pose.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "frangia/core/error.h"
#include "frangia/core/linear_algebra.h"
#include "frangia/core/parallel.h"
#include "frangia/core/random.h"
#include "frangia/core/statistics.h"
#include "frangia/geometry/robust_gauss_newton.h"
#include "frangia/geometry/surface_samples.h"
#include "frangia/geometry/vertex_data.h"

namespace frangia {
namespace {

using Eigen::Vector3d;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

struct PoseSums {
  Matrix6 hessian = Matrix6::Zero();
  Vector6 gradient = Vector6::Zero();
  std::vector<double> residuals;  ///< absolute
};

/// The center of the samples and the RMS of their distances from it.
struct SampleExtent {
  Vector3d center = Vector3d::Zero();
  double lever_mm = 1.0;
};

SampleExtent extent_of(std::span<const MeasuredSample> samples, const Eigen::Isometry3d& pose) {
  SampleExtent extent;
  const double share = 1.0 / static_cast<double>(samples.size());
  for (const MeasuredSample& sample : samples)
    extent.center += share * sample.point_mm;
  double squares = 0.0;
  for (const MeasuredSample& sample : samples)
    squares += share * (sample.point_mm - extent.center).squaredNorm();
  extent.lever_mm = std::max(std::sqrt(squares), 1e-12);
  extent.center = pose * extent.center;
  return extent;
}

}  // namespace

FindFoot exact_feet(const RayScene& reference) {
  return [&reference](const Vector3d& point, double reach) -> std::optional<Foot> {
    const auto near = reference.nearest(point, reach);
    if (!near) return std::nullopt;
    const auto& [a, b, c] = reference.mesh().triangles[near->triangle];
    const Vector3d p = reference.mesh().vertices_mm[a].cast<double>();
    const Vector3d q = reference.mesh().vertices_mm[b].cast<double>();
    const Vector3d r = reference.mesh().vertices_mm[c].cast<double>();
    return Foot{near->point_mm, (q - p).cross(r - p).normalized()};
  };
}

Eigen::Isometry3d motion_of(const Vector6& twist, const Vector3d& center, double lever_mm) {
  const Vector3d turn = twist.head<3>() / lever_mm;
  const double angle = turn.norm();
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  if (angle > 0.0) motion.linear() = Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix();
  motion.translation() = center + twist.tail<3>() - motion.linear() * center;
  return motion;
}

PoseFit fit_pose(std::span<const MeasuredSample> samples,
                 const FindFoot& find_foot,
                 const Eigen::Isometry3d& start,
                 const PoseFitOptions& options,
                 const Run& run) {
  PoseFit fit;
  fit.pose = start;
  std::vector<double> sigmas;
  for (const MeasuredSample& sample : samples)
    sigmas.push_back(sample.sigma_mm);
  const double usual = median_in_place(std::span<double>(sigmas));
  constexpr std::size_t kChunk = 512;

  const auto sums_of = [&](std::size_t begin, std::size_t end, double gate) {
    PoseSums sums;
    for (std::size_t i = begin; i < end; ++i) {
      const MeasuredSample& sample = samples[i];
      const Vector3d point = fit.pose * sample.point_mm;
      const auto foot = find_foot(point, 1.5 * gate);
      if (!foot) continue;
      if ((fit.pose.linear() * sample.normal).dot(foot->normal) < options.least_cosine) continue;
      const double r = foot->normal.dot(point - foot->point_mm);
      if (std::abs(r) >= gate) continue;
      const double variance =
          usual > 0.0 ? (sample.sigma_mm * sample.sigma_mm + usual * usual) / (usual * usual) : 1.0;
      const double weight = tukey_weight(r, gate) / variance;
      Vector6 row;
      row << (point - fit.center).cross(foot->normal) / fit.lever_mm, foot->normal;
      sums.hessian.noalias() += weight * row * row.transpose();
      sums.gradient += weight * r * row;
      sums.residuals.push_back(std::abs(r));
    }
    return sums;
  };
  RobustProblem problem;
  problem.linearize = [&](double gate) {
    const SampleExtent extent = extent_of(samples, fit.pose);
    fit.center = extent.center;
    fit.lever_mm = extent.lever_mm;
    std::vector<PoseSums> parts((samples.size() + kChunk - 1) / kChunk);
    if (parts.size() == 1) {  // searches run many small fits side by side
      parts[0] = sums_of(0, samples.size(), gate);
    } else {
      interruptible_chunks(samples.size(), kChunk, run, [&](std::size_t begin, std::size_t end) {
        parts[begin / kChunk] = sums_of(begin, end, gate);
      });
    }
    PoseSums all;
    double squares = 0.0;
    for (const PoseSums& part : parts) {
      all.hessian += part.hessian;
      all.gradient += part.gradient;
      all.residuals.insert(all.residuals.end(), part.residuals.begin(), part.residuals.end());
    }
    for (const double r : all.residuals)
      squares += r * r;
    Linearization at;
    at.hessian = all.hessian;
    at.gradient = all.gradient;
    const std::size_t count = all.residuals.size();
    at.solvable = count >= 12;
    at.median_residual = median_in_place(std::span<double>(all.residuals));
    at.unit_weight_sigma = count > 0 ? std::sqrt(squares / static_cast<double>(count)) : 1.0;
    fit.hessian = all.hessian;
    return at;
  };
  problem.update = [&](const Eigen::VectorXd& step) {
    fit.pose = motion_of(step, fit.center, fit.lever_mm) * fit.pose;
    // Products of rotations drift from orthogonality.
    fit.pose.linear() = Eigen::Quaterniond(fit.pose.linear()).normalized().toRotationMatrix();
  };
  GaussNewtonOptions newton;
  newton.gate = options.gate_mm;
  newton.min_gate = options.least_gate_mm;
  newton.max_iterations = options.max_iterations;
  newton.damping = 1e-6;
  newton.tolerance = 0.01;
  const GaussNewtonResult result = minimize_robustly(problem, newton, run);
  fit.iterations = result.iterations;
  fit.gate_mm = result.gate;
  return fit;
}

namespace {

using Eigen::Vector3d;
using Twist = Eigen::Matrix<double, 6, 1>;
using TwistMatrix = Eigen::Matrix<double, 6, 6>;

/// A residual of the fit.
struct PoseResidual {
  Vector3d point_mm;
  Twist row = Twist::Zero();
  double value = 0.0;
  double weight = 0.0;  ///< 0: the sample does not count
};

/// Orders residuals so that blocks of equal counts are compact, by medians along the widest side.
void order_blocks(std::span<PoseResidual> residuals, int levels) {
  if (levels == 0 || residuals.size() < 2) return;
  Eigen::AlignedBox3d box;
  for (const PoseResidual& one : residuals)
    box.extend(one.point_mm);
  Eigen::Index side = 0;
  box.sizes().maxCoeff(&side);
  const std::size_t middle = residuals.size() / 2;
  std::sort(residuals.begin(), residuals.end(), [&](const auto& a, const auto& b) {
    return a.point_mm[side] < b.point_mm[side];
  });
  order_blocks(residuals.first(middle), levels - 1);
  order_blocks(residuals.subspan(middle), levels - 1);
}

}  // namespace

PoseUncertainty pose_covariance(std::span<const MeasuredSample> samples,
                                const FindFoot& find_foot,
                                const PoseFit& fit) {
  std::vector<PoseResidual> residuals(samples.size());
  parallel_chunks(samples.size(), 512, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      PoseResidual& one = residuals[i];
      one.point_mm = fit.pose * samples[i].point_mm;
      const auto foot = find_foot(one.point_mm, 1.5 * fit.gate_mm);
      if (!foot || (fit.pose.linear() * samples[i].normal).dot(foot->normal) < 0.5) continue;
      one.value = foot->normal.dot(one.point_mm - foot->point_mm);
      if (std::abs(one.value) >= fit.gate_mm) continue;
      one.weight = tukey_weight(one.value, fit.gate_mm);
      one.row << (one.point_mm - fit.center).cross(foot->normal) / fit.lever_mm, foot->normal;
    }
  });
  std::erase_if(residuals, [](const PoseResidual& one) { return !(one.weight > 0.0); });
  PoseUncertainty uncertainty;
  uncertainty.center_mm = fit.center;
  constexpr int kLevels = 6;
  constexpr std::size_t kBlocks = std::size_t{1} << static_cast<unsigned>(kLevels);
  if (residuals.size() < 4 * kBlocks) return uncertainty;
  order_blocks(residuals, kLevels);
  TwistMatrix hessian = TwistMatrix::Zero();
  TwistMatrix spread = TwistMatrix::Zero();
  double weight = 0.0;
  double slope = 0.0;
  for (std::size_t block = 0; block < kBlocks; ++block) {
    Twist gradient = Twist::Zero();
    const std::size_t end = (block + 1) * residuals.size() / kBlocks;
    for (std::size_t i = block * residuals.size() / kBlocks; i < end; ++i) {
      const PoseResidual& one = residuals[i];
      weight += one.weight;
      slope += tukey_slope(one.value, fit.gate_mm);
      hessian += one.weight * one.row * one.row.transpose();
      gradient += one.weight * one.value * one.row;
    }
    spread += gradient * gradient.transpose();
  }
  const auto eigen = symmetric_eigen(Eigen::MatrixXd(hessian));
  constexpr double kHeld = 1e-4;  // of the best determined direction
  Twist inverse = Twist::Zero();
  for (Eigen::Index i = 0; i < 6; ++i)
    if (eigen.values[i] > kHeld * eigen.values[5]) inverse[i] = 1.0 / eigen.values[i];
  const TwistMatrix pseudo = eigen.vectors * inverse.asDiagonal() * eigen.vectors.transpose();
  constexpr double kFree = static_cast<double>(kBlocks) / static_cast<double>(kBlocks - 6);
  // The robust weights understate it, see `tukey_slope`.
  constexpr double kMostRobust = 2.0;
  const double robust = slope > 0.0 ? std::clamp(weight / slope, 1.0, kMostRobust) : kMostRobust;
  Twist scale = Twist::Ones();  // the rotations of the fit are times the lever
  scale.head<3>() /= fit.lever_mm;
  uncertainty.covariance = scale.asDiagonal() *
                           (kFree * robust * robust * pseudo * spread * pseudo) *
                           scale.asDiagonal();
  return uncertainty;
}

std::vector<MeasuredSample> measured_samples(const Mesh& mesh,
                                             std::size_t count,
                                             std::uint64_t seed) {
  Mesh measured;
  measured.vertices_mm = mesh.vertices_mm;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (mark_of(mesh, t) != Mark::Synthesized) measured.triangles.push_back(mesh.triangles[t]);
  std::vector<MeasuredSample> samples;
  for (const SurfaceSample& sample : sample_surface(measured, count, seed)) {
    double sigma = 0.0;
    if (!mesh.sigma_mm.empty()) {
      for (const std::uint32_t v : measured.triangles[sample.triangle])
        sigma = std::max(sigma, static_cast<double>(mesh.sigma_mm[v]));
    }
    samples.push_back({sample.point_mm, sample.normal, std::isfinite(sigma) ? sigma : 0.0});
  }
  require(!samples.empty(), "the mesh has no measured triangle with an area to align");
  for (std::size_t i = samples.size() - 1; i > 0; --i) {
    const double random = uniform_from(hash(hash(seed, 77U), i));
    std::swap(samples[i], samples[static_cast<std::size_t>(random * static_cast<double>(i + 1))]);
  }
  return samples;
}

}  // namespace frangia
