#include "frangia/features/shape_uncertainty.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/linear_algebra.h"
#include "frangia/core/statistics.h"
#include "frangia/features/internal/weighted_sums.h"
#include "frangia/geometry/robust_gauss_newton.h"

namespace frangia {
namespace {

/// Splits the points into compact blocks of nearly equal counts, by medians along the widest side.
void split_blocks(const FeaturePoints& points, std::span<std::uint32_t> chosen, int levels) {
  if (levels == 0 || chosen.size() < 2) return;
  Eigen::AlignedBox3d box;
  for (const std::uint32_t point : chosen)
    box.extend(points.points_mm[point]);
  Eigen::Index side = 0;
  box.sizes().maxCoeff(&side);
  const auto middle = chosen.begin() + static_cast<std::ptrdiff_t>(chosen.size() / 2);
  std::nth_element(chosen.begin(), middle, chosen.end(), [&](std::uint32_t a, std::uint32_t b) {
    const double at_a = points.points_mm[a][side];
    const double at_b = points.points_mm[b][side];
    return at_a < at_b || (at_a == at_b && a < b);
  });
  split_blocks(points, {chosen.begin(), middle}, levels - 1);
  split_blocks(points, {middle, chosen.end()}, levels - 1);
}

/// Covariance of the parameters from the gradients of 2^levels blocks, times Student's factor
/// squared.
Eigen::MatrixXd block_covariance(const FeaturePoints& points,
                                 std::span<const std::uint32_t> chosen,
                                 const ShapeFit& fit,
                                 const PointWeights& weights,
                                 const Eigen::MatrixXd& inverse,
                                 int levels) {
  std::vector<std::uint32_t> order(chosen.begin(), chosen.end());
  split_blocks(points, order, levels);
  const Eigen::Index count = inverse.rows();
  Eigen::MatrixXd spread = Eigen::MatrixXd::Zero(count, count);
  const std::size_t blocks = std::size_t{1} << static_cast<unsigned>(levels);
  // The same halves as split_blocks makes.
  const auto visit = [&](const auto& self, std::size_t begin, std::size_t end, int depth) -> void {
    if (depth > 0) {
      const std::size_t middle = begin + (end - begin) / 2;
      self(self, begin, middle, depth - 1);
      self(self, middle, end, depth - 1);
      return;
    }
    ShapeSums sums;
    for (std::size_t i = begin; i < end; ++i)
      add_point(sums, points, order[i], fit.shape, weights, fit.gate_mm, true);
    const Eigen::VectorXd gradient = sums.gradient.head(count);
    spread += product_transposed(gradient, gradient);
  };
  visit(visit, 0, order.size(), levels);
  const auto free = static_cast<double>(blocks) - static_cast<double>(count);
  // The variances of the blocks differ, which costs degrees of freedom.
  const double factor = student_95(0.5 * free);
  return factor * factor * static_cast<double>(blocks) / free * congruence(inverse, spread);
}

/// The covariance from 2^levels blocks, and the square root of their number: the share of errors
/// that reach across a border and are missed is in proportion to it.
struct BlockCovariance {
  Eigen::MatrixXd covariance;
  double borders = 0.0;
};

/// The covariance for blocks without borders, from few, many and very many blocks. Many blocks give
/// the result; few where errors of longer reach show in them.
Eigen::MatrixXd without_borders(const BlockCovariance& few,
                                const BlockCovariance& many,
                                const BlockCovariance& most,
                                Eigen::Index size) {
  constexpr double kBeyondChance = 1.5;  // 32 blocks have a standard error of 27 %
  constexpr double kMostMissed = 0.5;
  // The mean over all parameters is more certain than one. Points that lie exactly on the shape
  // have no gradients.
  const double ratio = many.covariance.diagonal().cwiseQuotient(most.covariance.diagonal()).mean();
  const double finer = most.borders / many.borders;
  // (1 - m) / (1 - finer m) = ratio, where m is the share that many blocks miss.
  const double missed = std::isfinite(ratio) && ratio > 1.0 && finer > 1.0
                            ? std::min(kMostMissed, (ratio - 1.0) / (finer * ratio - 1.0))
                            : 0.0;
  const Eigen::MatrixXd by_many = many.covariance / (1.0 - missed);
  const Eigen::MatrixXd by_few = few.covariance / (1.0 - missed * few.borders / many.borders);
  return by_few(size, size) > kBeyondChance * by_many(size, size) ? by_few : by_many;
}

/// The inverse of the normal equations, by equations with a unit diagonal; empty when singular.
Eigen::MatrixXd inverse_of(const Eigen::MatrixXd& hessian) {
  const Eigen::VectorXd scale = hessian.diagonal().cwiseSqrt().cwiseInverse();
  if (!scale.allFinite()) return {};
  const auto eigen = symmetric_eigen(scaled(hessian, scale));
  constexpr double kSingular = 1e-12;
  if (!(eigen.values[0] > kSingular)) return {};
  const Eigen::MatrixXd root = eigen.vectors * eigen.values.cwiseSqrt().cwiseInverse().asDiagonal();
  return scaled(product_transposed(root, root), scale);
}

/// First parameter and number of the parameters of the center or of the axis.
struct ParameterRange {
  Eigen::Index first = 0;
  Eigen::Index count = 0;
};

ParameterRange center_parameters(ShapeKind kind) {
  if (kind == ShapeKind::Plane) return {0, 1};
  if (kind == ShapeKind::Sphere || kind == ShapeKind::Torus) return {0, 3};
  return {0, 2};
}

ParameterRange axis_parameters(ShapeKind kind) {
  if (kind == ShapeKind::Sphere) return {};
  if (kind == ShapeKind::Plane) return {1, 2};
  return {kind == ShapeKind::Torus ? 3 : 2, 2};
}

double worst_direction(const Eigen::MatrixXd& covariance, const ParameterRange& range) {
  if (range.count == 0) return static_cast<double>(kMissing);
  const Eigen::MatrixXd block =
      covariance.block(range.first, range.first, range.count, range.count);
  return std::sqrt(std::max(0.0, symmetric_eigen(block).values[range.count - 1]));
}

/// The changes of the parameters by the displacements of the points, a column for each of them.
Eigen::MatrixXd calibration_response(const FeaturePoints& points,
                                     std::span<const std::uint32_t> chosen,
                                     const ShapeFit& fit,
                                     const PointWeights& weights,
                                     const Eigen::MatrixXd& inverse) {
  if (points.calibration_mm.size() == 0) return {};
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(inverse.rows(), points.calibration_mm.rows());
  for (const std::uint32_t point : chosen) {
    const ShapeDistance at = distance_to(fit.shape, points.points_mm[point]);
    if (!(std::abs(at.distance_mm) < fit.gate_mm) || !at.derivatives.allFinite()) continue;
    const double weight = weights.of(point) * tukey_weight(at.distance_mm, fit.gate_mm);
    const double outward = at.normal.dot(points.normals[point]);
    const Eigen::VectorXd by_parameter = weight * outward * at.derivatives.head(inverse.rows());
    const auto displacement = points.calibration_mm.col(static_cast<Eigen::Index>(point));
    for (Eigen::Index i = 0; i < sums.cols(); ++i)
      sums.col(i) += static_cast<double>(displacement[i]) * by_parameter;
  }
  return -product(inverse, sums);
}

}  // namespace

ShapeUncertainty shape_uncertainty(const FeaturePoints& points,
                                   std::span<const std::uint32_t> chosen,
                                   const ShapeFit& fit) {
  ShapeUncertainty result;
  const int count = parameter_count(fit.shape.kind);
  const PointWeights weights(points, chosen);
  ShapeSums sums;
  for (const std::uint32_t point : chosen)
    add_point(sums, points, point, fit.shape, weights, fit.gate_mm, true);
  const Eigen::MatrixXd inverse = inverse_of(sums.hessian.topLeftCorner(count, count));
  if (inverse.size() == 0) return result;

  const int most =
      static_cast<int>(std::floor(std::log2(std::max(1.0, 0.5 * static_cast<double>(sums.count)))));
  constexpr int kFew = 5;
  constexpr int kMany = 7;
  constexpr int kMost = 9;
  if ((1 << std::min(kFew, most)) <= count) return result;  // too few points to see their spread
  const auto size = static_cast<Eigen::Index>(size_parameter(fit.shape.kind));
  const Eigen::MatrixXd response = sums.robust_factor() * inverse;
  const auto in_blocks = [&](int wanted) {
    const int levels = std::min(wanted, most);
    return BlockCovariance{block_covariance(points, chosen, fit, weights, response, levels),
                           std::exp2(0.5 * levels)};
  };
  Eigen::MatrixXd covariance =
      without_borders(in_blocks(kFew), in_blocks(kMany), in_blocks(kMost), size);
  const Eigen::MatrixXd stated =
      kNormal95 * kNormal95 * congruence(inverse, sums.noise.topLeftCorner(count, count));
  if (stated(size, size) > covariance(size, size)) covariance = stated;
  const Eigen::VectorXd shared = kNormal95 * product(inverse, sums.shared.head(count));
  const bool is_diameter = fit.shape.kind != ShapeKind::Plane;
  const double to_size = is_diameter ? 2.0 : 1.0;
  result.noise_mm = to_size * std::sqrt(covariance(size, size)) / kNormal95;
  covariance += product_transposed(shared, shared);
  result.center_local_u95_mm = worst_direction(covariance, center_parameters(fit.shape.kind));
  result.axis_local_u95_rad = worst_direction(covariance, axis_parameters(fit.shape.kind));
  double systematic = shared[size] * shared[size] / (kNormal95 * kNormal95);
  result.calibration = calibration_response(points, chosen, fit, weights, inverse);
  if (result.calibration.size() > 0) {
    covariance +=
        kNormal95 * kNormal95 * product_transposed(result.calibration, result.calibration);
    systematic += result.calibration.row(size).squaredNorm();
  }
  result.systematic_mm = to_size * std::sqrt(systematic);
  result.u95_mm = to_size * std::sqrt(covariance(size, size));
  result.center_u95_mm = worst_direction(covariance, center_parameters(fit.shape.kind));
  result.axis_u95_rad = worst_direction(covariance, axis_parameters(fit.shape.kind));
  if (fit.shape.kind == ShapeKind::Cone) result.angle_u95_rad = std::sqrt(covariance(5, 5));
  return result;
}

ShapeUncertainty known_uncertainty(const FeaturePoints& points, ShapeUncertainty of_residuals) {
  if (points.noise_mm.empty()) return {.is_known = false};
  return of_residuals;
}

Eigen::MatrixXf thermal_displacement(const Mesh& mesh,
                                     double expansion_per_k,
                                     double temperature_u_k) {
  const std::vector<Eigen::Vector3f> normals = vertex_normals(mesh);
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& vertex : mesh.vertices_mm)
    if (vertex.allFinite()) box.extend(vertex);
  Eigen::Vector3f center = Eigen::Vector3f::Zero();
  if (!box.isEmpty()) center = box.center();
  const auto scale = static_cast<float>(expansion_per_k * temperature_u_k);
  Eigen::MatrixXf out = Eigen::MatrixXf::Zero(1, static_cast<Eigen::Index>(normals.size()));
  for (std::size_t i = 0; i < normals.size(); ++i) {
    if (!mesh.vertices_mm[i].allFinite()) continue;
    out(0, static_cast<Eigen::Index>(i)) = scale * (mesh.vertices_mm[i] - center).dot(normals[i]);
  }
  return out;
}

}  // namespace frangia
