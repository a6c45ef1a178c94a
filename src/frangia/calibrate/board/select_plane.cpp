#include "frangia/calibrate/board/select_plane.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "frangia/core/error.h"
#include "frangia/core/linear_algebra.h"
#include "frangia/core/random.h"

namespace frangia {
namespace {

/// Limits of `select_plane`.
struct SelectPlaneLimits {
  int tries = 300;           ///< random sets of five sites
  double tolerance = 0.003;  ///< of the light, as a share of its range over all sites
  std::uint64_t seed = 1;    ///< of the random sets
};
constexpr SelectPlaneLimits kSelectPlaneLimits;

constexpr Eigen::Index kPlaneTerms = 5;
using PlaneTerms = Eigen::Matrix<double, kPlaneTerms, 1>;

/// Terms of a . r = w (b . r) with b's last component 1: a and b's first two components.
PlaneTerms terms_at(const Eigen::Vector2d& ray, double w) {
  return {ray.x(), ray.y(), 1.0, -w * ray.x(), -w * ray.y()};
}

double plane_error(const PlaneTerms& fit, const Eigen::Vector2d& ray, double w) {
  const double below = 1.0 + fit[3] * ray.x() + fit[4] * ray.y();
  return (fit[0] * ray.x() + fit[1] * ray.y() + fit[2]) / below - w;
}

PlaneTerms fit_terms(std::span<const Eigen::Vector2d> rays,
                     std::span<const double> light,
                     std::span<const std::size_t> chosen) {
  Eigen::Matrix<double, kPlaneTerms, kPlaneTerms> normal =
      Eigen::Matrix<double, kPlaneTerms, kPlaneTerms>::Zero();
  PlaneTerms right = PlaneTerms::Zero();
  for (const std::size_t i : chosen) {
    const PlaneTerms terms = terms_at(rays[i], light[i]);
    normal += terms * terms.transpose();
    right += light[i] * terms;
  }
  return solve_symmetric(normal, right);
}

}  // namespace

std::vector<bool> select_plane(std::span<const Eigen::Vector2d> rays,
                               std::span<const double> light) {
  require(rays.size() == light.size(), "each site needs a ray and a light");
  std::vector<std::size_t> measured;
  double least = std::numeric_limits<double>::infinity();
  double most = -least;
  for (std::size_t i = 0; i < light.size(); ++i) {
    if (!std::isfinite(light[i]) || !rays[i].allFinite()) continue;
    measured.push_back(i);
    least = std::min(least, light[i]);
    most = std::max(most, light[i]);
  }
  std::vector<bool> flags(light.size(), false);
  if (measured.size() < 4 * static_cast<std::size_t>(kPlaneTerms)) return flags;
  const double gate = kSelectPlaneLimits.tolerance * (most - least);
  const auto near = [&](const PlaneTerms& fit) {
    std::vector<std::size_t> found;
    for (const std::size_t i : measured)
      if (std::abs(plane_error(fit, rays[i], light[i])) < gate) found.push_back(i);
    return found;
  };
  std::vector<std::size_t> best;
  for (int attempt = 0; attempt < kSelectPlaneLimits.tries; ++attempt) {
    std::vector<std::size_t> some;
    for (std::uint64_t k = 0; k < kPlaneTerms; ++k) {
      const double share =
          uniform_from(hash(hash(kSelectPlaneLimits.seed, static_cast<std::uint64_t>(attempt)), k));
      some.push_back(
          measured[static_cast<std::size_t>(share * static_cast<double>(measured.size()))]);
    }
    std::vector<std::size_t> found = near(fit_terms(rays, light, some));
    if (found.size() > best.size()) best = std::move(found);
  }
  constexpr int kRefinements = 3;
  for (int i = 0; i < kRefinements && best.size() > kPlaneTerms; ++i)
    best = near(fit_terms(rays, light, best));
  for (const std::size_t i : best)
    flags[i] = true;
  return flags;
}

}  // namespace frangia
