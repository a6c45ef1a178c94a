#include "frangia/calibrate/internal/select_wavefront.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "frangia/core/solve_symmetric.h"
#include "frangia/core/symmetric_eigen.h"

namespace frangia {
namespace {

/// Drop of the weighted squares for each term: far above what noise gives (1), because the errors
/// of neighbouring sites are not quite independent.
constexpr double kLeastGain = 20.0;
/// Share of a term that the other parameters leave free; below, its value would be chance.
constexpr double kLeastFree = 1e-6;

/// Drop of the weighted squares for each of the added columns.
double gain_of(const ArtifactLinearization& full,
               const std::vector<Eigen::Index>& active,
               const std::vector<Eigen::Index>& added) {
  if (added.empty()) return 0.0;
  const Eigen::MatrixXd own = full.normal(active, active);
  const Eigen::VectorXd slope_of_own = full.gradient(active);
  const Eigen::MatrixXd coupling = full.normal(active, added);
  const Eigen::MatrixXd alone = full.normal(added, added);
  const Eigen::VectorXd scale = alone.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd free =
      scale.asDiagonal() * (alone - coupling.transpose() * solve_symmetric_columns(own, coupling)) *
      scale.asDiagonal();
  if (symmetric_eigen(free).values[0] < kLeastFree) return 0.0;
  const Eigen::VectorXd slope =
      scale.asDiagonal() *
      (full.gradient(added) - coupling.transpose() * solve_symmetric(own, slope_of_own));
  return slope.dot(solve_symmetric(free, slope)) / static_cast<double>(added.size());
}

}  // namespace

std::array<bool, Wavefront::kTerms> missing_wavefront_terms(const ArtifactProblem& problem,
                                                            const ArtifactNoise& noise,
                                                            const ArtifactParameters& parameters) {
  std::array<bool, Wavefront::kTerms> missing{};
  if (!problem.start.projector.is_angular()) return missing;
  ArtifactProblem whole = problem;
  whole.free_wavefront.fill(true);
  const ArtifactLinearization full = linearize_artifacts(whole, noise, parameters);
  std::vector<Eigen::Index> active;
  std::vector<Eigen::Index> second;
  std::vector<Eigen::Index> third;
  for (std::size_t i = 0; i < full.names.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    std::size_t term = 0;
    while (term < Wavefront::kTerms && full.names[i] != Wavefront::parameter_name(term))
      ++term;
    if (term == Wavefront::kTerms || problem.free_wavefront.at(term)) {
      active.push_back(column);
    } else {
      (term < Wavefront::kSecondOrder ? second : third).push_back(column);
    }
  }
  const bool has_second = gain_of(full, active, second) > kLeastGain;
  std::vector<Eigen::Index> with_second = active;
  with_second.insert(with_second.end(), second.begin(), second.end());
  const bool has_third = gain_of(full, second.empty() ? active : with_second, third) > kLeastGain;
  for (std::size_t term = 0; term < Wavefront::kTerms; ++term) {
    const bool is_second = term < Wavefront::kSecondOrder;
    missing.at(term) = !problem.free_wavefront.at(term) && (is_second ? has_second : has_third);
  }
  return missing;
}

}  // namespace frangia
