#include "frangia/indirect_light/estimate_albedo.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>

#include <Eigen/Core>

#include "frangia/core/angles.h"
#include "frangia/core/linear_algebra.h"

namespace frangia {
namespace {

/// Uncertainty of the model, on top of noise: contrast that varies over the field, geometry.
constexpr double kContrastModel = 0.01;  // relative
constexpr double kPhaseModel = 0.004;    // rad

/// Squared residuals beyond this many are outliers.
constexpr double kMostSquare = 16.0;

double capped(double square) {
  return std::min(square, kMostSquare);
}

/// Squared residuals of one pattern's contrast. mean / modulation is linear in the inverse contrast
/// of the projector and in the ambient light; both are fitted.
double contrast_residuals(std::span<const AlbedoSample> samples, std::size_t m, double albedo) {
  Eigen::Vector2d found = Eigen::Vector2d::Zero();
  double sum = 0.0;
  constexpr int kIterations = 4;
  for (int i = 0; i < kIterations; ++i) {
    Eigen::Matrix2d normal = 1e-12 * Eigen::Matrix2d::Identity();
    Eigen::Vector2d right = Eigen::Vector2d::Zero();
    sum = 0.0;
    for (const AlbedoSample& sample : samples) {
      const MeasuredFringe& at = sample.measured[m];
      const double mean = 1.0 + albedo * sample.predicted.mean;
      const double modulation = std::abs(1.0 + albedo * sample.predicted.fringes[m]);
      const Eigen::Vector2d row(mean / modulation, static_cast<double>(at.modulation_inverse));
      const double y = at.contrast_inverse;
      const double sigma = y * std::hypot(static_cast<double>(at.sigma_rad), kContrastModel);
      const double residual = (y - row.dot(found)) / sigma;
      const double square = i == 0 ? 0.0 : residual * residual;
      sum += capped(square);
      // Outliers lose their weight as their square exceeds the cap.
      const double weight = (square > kMostSquare ? kMostSquare / square : 1.0) / (sigma * sigma);
      normal += weight * row * row.transpose();
      right += weight * y * row;
    }
    found = solve_symmetric(normal, right);
    // Neither is negative.
    if (found.y() < 0.0) found = {right.x() / normal(0, 0), 0.0};
  }
  return sum;
}

/// Squared residuals of the phases of the coarser patterns against the finest one.
double phase_residuals(std::span<const AlbedoSample> samples,
                       std::span<const Pattern> patterns,
                       double albedo) {
  double sum = 0.0;
  for (const AlbedoSample& sample : samples) {
    const double finest = std::arg(1.0 + albedo * sample.predicted.fringes.back());
    for (std::size_t m = 0; m + 1 < patterns.size(); ++m) {
      const double ratio = patterns[m].fringes_per_unit() / patterns.back().fringes_per_unit();
      const double expected = std::arg(1.0 + albedo * sample.predicted.fringes[m]) - ratio * finest;
      const MeasuredFringe& at = sample.measured[m];
      const double sigma =
          std::hypot(static_cast<double>(at.sigma_rad),
                     ratio * static_cast<double>(sample.measured.back().sigma_rad) + kPhaseModel);
      const double residual = wrap_rad(static_cast<double>(at.residual_rad) - expected) / sigma;
      sum += capped(residual * residual);
    }
  }
  return sum;
}

double residuals(std::span<const AlbedoSample> samples,
                 std::span<const Pattern> patterns,
                 double albedo) {
  double sum = phase_residuals(samples, patterns, albedo);
  for (std::size_t m = 0; m < patterns.size(); ++m)
    sum += contrast_residuals(samples, m, albedo);
  return sum;
}

}  // namespace

namespace {

constexpr std::size_t kAlbedos = 21;  // from 0 to 1
constexpr double kStep = 1.0 / (kAlbedos - 1);
/// Least improvement of each sample that sees lit surface. Neighbouring samples share their errors:
/// a sum that falls by a small share says nothing.
constexpr double kMaterial = 0.2;

/// Squared residuals of some samples for each reflectance.
struct ResidualSums {
  std::array<double, kAlbedos> sums{};
  double affected = 0.0;  ///< samples that see lit surface

  ResidualSums(std::span<const AlbedoSample> samples, std::span<const Pattern> patterns) {
    constexpr double kSeesSurface = 0.03;  // share of indirect light
    affected = static_cast<double>(
        std::count_if(samples.begin(), samples.end(), [](const AlbedoSample& sample) {
          return sample.predicted.mean > kSeesSurface;
        }));
    if (affected == 0.0) return;
    for (std::size_t i = 0; i < kAlbedos; ++i)
      sums.at(i) = residuals(samples, patterns, static_cast<double>(i) * kStep);
  }
  [[nodiscard]] std::size_t best() const {
    return static_cast<std::size_t>(std::min_element(sums.begin(), sums.end()) - sums.begin());
  }
  [[nodiscard]] double improvement(std::size_t at) const {
    return affected > 0.0 ? (sums.front() - sums.at(at)) / affected : 0.0;
  }
};

/// Whether the reflectance of either half of the samples predicts the other half better than no
/// indirect light.
bool predicts_left_out(std::span<const AlbedoSample> samples, std::span<const Pattern> patterns) {
  // In the order of the image's rows: the halves are blocks, not neighbours of each other.
  constexpr std::size_t kBlocks = 8;
  std::array<std::vector<AlbedoSample>, 2> halves;
  for (std::size_t i = 0; i < samples.size(); ++i)
    halves.at(i * kBlocks / samples.size() % 2).push_back(samples[i]);
  const ResidualSums first(halves[0], patterns);
  const ResidualSums second(halves[1], patterns);
  // A half that sees no lit surface decides nothing.
  if (first.affected == 0.0 || second.affected == 0.0) return true;
  return second.improvement(first.best()) > kMaterial &&
         first.improvement(second.best()) > kMaterial;
}

}  // namespace

AlbedoEstimate estimate_albedo(std::span<const AlbedoSample> samples,
                               std::span<const Pattern> patterns) {
  AlbedoEstimate out;
  const ResidualSums all(samples, patterns);
  if (all.affected == 0.0) return out;
  const auto& sums = all.sums;
  const std::size_t best = all.best();
  const double least = sums.at(best);
  out.unexplained = sums.front() > 0.0 ? least / sums.front() : 1.0;
  out.improvement = all.improvement(best);
  // At its bound the reflectance is no result: something else is explained by it.
  const bool within_bounds = best > 0 && best + 1 < kAlbedos;
  out.significant =
      within_bounds && out.improvement > kMaterial && predicts_left_out(samples, patterns);
  if (!out.significant) return out;
  // Vertex of the parabola through the least sum and its neighbours.
  const double before = sums.at(best - 1);
  const double after = sums.at(best + 1);
  const double bend = before - 2.0 * least + after;
  const double offset = bend > 0.0 ? 0.5 * (before - after) / bend : 0.0;
  out.albedo = std::clamp((static_cast<double>(best) + offset) * kStep, 0.0, 1.0);
  return out;
}

}  // namespace frangia
