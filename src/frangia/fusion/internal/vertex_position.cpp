#include "frangia/fusion/internal/vertex_position.h"

#include <algorithm>

#include <Eigen/Eigenvalues>

namespace frangia {
namespace {

/// Quadratic error function: the sum of squared distances from planes, about the mean of their
/// points.
struct Qef {
  Eigen::Vector3f middle;
  Eigen::Matrix3f spread = Eigen::Matrix3f::Zero();
  Eigen::Vector3f gradient = Eigen::Vector3f::Zero();
  Eigen::Matrix3f eigenvectors = Eigen::Matrix3f::Identity();  ///< ascending by eigenvalue
  Eigen::Vector3f eigenvalues = Eigen::Vector3f::Zero();
  Eigen::Vector3f projections = Eigen::Vector3f::Zero();

  explicit Qef(const LoopSamples& loop) : middle(loop.middle) {
    for (const HermiteSample* sample : loop.all())
      add(*sample);
  }
  void add(const HermiteSample& sample) {
    spread += sample.normal * sample.normal.transpose();
    gradient += sample.normal * sample.normal.dot(sample.point - middle);
  }
  void solve() {
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> solver;
    solver.computeDirect(spread);
    eigenvectors = solver.eigenvectors();
    eigenvalues = solver.eigenvalues();
    projections = eigenvectors.transpose() * gradient;
  }

  /// The number of eigenvalues above the noise.
  [[nodiscard]] int rank(float min_eigenvalue) const {
    const auto counts = [&](int i) {
      return eigenvalues[i] > min_eigenvalue * eigenvalues[2] ? 1 : 0;
    };
    return 1 + counts(1) + counts(0);
  }
  /// The minimum in the directions of the `rank` largest eigenvalues.
  [[nodiscard]] Eigen::Vector3f minimum(int rank) const {
    Eigen::Vector3f point = middle;
    for (int i = 3 - rank; i < 3; ++i)
      point += eigenvectors.col(i) * (projections[i] / eigenvalues[i]);
    return point;
  }
};

/// Returns the mean point, moved onto the mean of parallel planes.
///
/// A tangent plane of a curved surface lies on one side of the surface; a point of the surface lies
/// on the other side of the tangent plane at the mean point. The mean of both normals cancels the
/// curvature to second order.
Eigen::Vector3f flat_position(const LoopSamples& loop) {
  float offset = 0.0F;
  for (const HermiteSample* sample : loop.all())
    offset += 0.5F * (sample->normal + loop.normal).dot(sample->point - loop.middle);
  return loop.middle + loop.normal * (offset / static_cast<float>(loop.count));
}

/// Adds the planes of second faces that run through the cell; returns false without any.
bool add_lesser_planes(Qef& qef, const LoopSamples& loop, const CellBox& cell) {
  bool any = false;
  for (const HermiteSample& sample : std::span(loop.lesser).first(loop.lesser_count)) {
    if (!cell.contains(sample.point)) continue;
    qef.add(sample);
    any = true;
  }
  return any;
}

}  // namespace

bool is_flat(const LoopSamples& loop, float parallel_cosine) {
  const auto samples = loop.all();
  return std::all_of(samples.begin(), samples.end(), [&](const HermiteSample* sample) {
    return sample->normal.dot(loop.normal) > parallel_cosine;
  });
}

Eigen::Vector3f solve_position(const LoopSamples& loop,
                               bool flat,
                               float min_eigenvalue,
                               const CellBox& cell) {
  if (loop.lesser_count != 0) {
    Qef qef(loop);
    if (add_lesser_planes(qef, loop, cell)) {
      qef.solve();
      Eigen::Vector3f point = qef.minimum(qef.rank(min_eigenvalue));
      if (cell.contains(point)) return point;
    }
  }
  if (flat) {
    Eigen::Vector3f point = flat_position(loop);
    if (cell.contains(point)) return point;
  }
  Qef qef(loop);
  qef.solve();
  for (int rank = qef.rank(min_eigenvalue); rank > 0; --rank) {
    Eigen::Vector3f point = qef.minimum(rank);
    if (cell.contains(point)) return point;
  }
  return qef.minimum(1).array().max(cell.low).min(cell.high);
}

}  // namespace frangia
