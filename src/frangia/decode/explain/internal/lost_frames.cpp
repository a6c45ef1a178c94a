#include "frangia/decode/explain/internal/lost_frames.h"

#include <algorithm>
#include <limits>

#include "frangia/decode/explain/internal/log_densities.h"

namespace frangia {
namespace {

constexpr double kImpossible = -std::numeric_limits<double>::infinity();

/// Normal density of one value per pixel that is alike in counts, or relative to the scale.
double log_density_alike(const FrameSample& sample,
                         const Eigen::ArrayXd& counts,
                         const Eigen::ArrayXd& scale) {
  const auto n = static_cast<double>(counts.size());
  const double noise = sample.variance.mean();
  const double in_counts =
      std::max((counts - counts.mean()).square().mean(), std::min(noise, 1.0 / 12.0));
  const Eigen::ArrayXd relative = counts / scale;
  const double in_scale = std::max((relative - relative.mean()).square().mean(), 1e-8);
  return std::max(log_normal(n * in_counts, in_counts, n),
                  log_normal(n * in_scale, in_scale, n) - scale.log().sum());
}

double log_density_of_mean(const Eigen::ArrayXd& counts, const Eigen::MatrixXd& values) {
  if (values.size() == 0) return kImpossible;
  const Eigen::ArrayXd mean = values.col(0).array().max(1.0);
  const Eigen::ArrayXd relative = counts / mean;
  const auto n = static_cast<double>(counts.size());
  const double variance = std::max((relative - relative.mean()).square().mean(), 1e-6);
  return log_normal(n * variance, variance, n) - mean.log().sum();
}

}  // namespace

double log_density_of_lost(const FrameSample& sample,
                           std::size_t frame,
                           const Eigen::ArrayXd& shown_scale,
                           const Eigen::MatrixXd& values) {
  const Eigen::ArrayXd counts = sample.counts.col(static_cast<Eigen::Index>(frame));
  double anything = 0.0;
  for (Eigen::Index i = 0; i < counts.size(); ++i)
    anything += log_density_of_anything(counts(i), shown_scale(i));
  return std::max({log_density_alike(sample, counts, shown_scale),
                   log_density_of_mean(counts, values),
                   anything});
}

}  // namespace frangia
