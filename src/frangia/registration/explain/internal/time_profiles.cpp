#include "frangia/registration/explain/internal/time_profiles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "frangia/core/linear_algebra.h"
#include "frangia/core/missing.h"

namespace frangia {
namespace {

/// Time constants of a warm-up, as shares of the time between the first view and the last: below,
/// it is over before the second view, and above it is even. Courses of neighbours differ by 2 % of
/// the way.
constexpr std::array<double, kTimeProfiles - 2> kConstants{0.08, 0.12, 0.18, 0.27, 0.4, 0.6, 0.9};

Eigen::Map<const Eigen::ArrayXd> as_array(std::span<const double> times) {
  return {times.data(), static_cast<Eigen::Index>(times.size())};
}

}  // namespace

bool are_times_stated(std::span<const Station> stations) {
  const bool known = std::all_of(stations.begin(), stations.end(), [](const Station& station) {
    return std::isfinite(station.time_s);
  });
  return known && std::any_of(stations.begin(), stations.end(), [&](const Station& station) {
           return station.time_s != stations.front().time_s;
         });
}

std::vector<double> times_of(std::span<const Station> stations) {
  std::vector<double> times(stations.size());
  std::iota(times.begin(), times.end(), 0.0);
  if (are_times_stated(stations)) {
    std::transform(stations.begin(), stations.end(), times.begin(), [](const Station& station) {
      return station.time_s;
    });
  }
  const auto [first, last] = std::minmax_element(times.begin(), times.end());
  const double begin = *first;
  const double duration = std::max(1e-300, *last - begin);
  for (double& time : times)
    time = (time - begin) / duration - 0.5;
  return times;
}

double time_constant_of(std::size_t profile) {
  return profile == 0 || profile == kSmoothProfile ? kMissing : kConstants.at(profile - 1);
}

Eigen::MatrixXd time_profile(std::size_t profile, std::span<const double> times) {
  const Eigen::ArrayXd t = as_array(times);
  if (profile == 0) return t.matrix();
  if (profile != kSmoothProfile) {
    const double constant = time_constant_of(profile);
    const double all = 1.0 - std::exp(-1.0 / constant);
    return ((1.0 - (-(t + 0.5) / constant).exp()) / all - 0.5).matrix();
  }
  // Legendre's polynomials, from -0.5 to 0.5, each half as large as the one before.
  Eigen::MatrixXd all(t.size(), 3);
  const Eigen::ArrayXd x = 2.0 * t;
  all.col(0) = 0.5 * x;
  all.col(1) = 0.25 * 0.5 * (3.0 * x.square() - 1.0);
  all.col(2) = 0.125 * 0.5 * (5.0 * x.cube() - 3.0 * x);
  return all;
}

Eigen::MatrixXd basis_of_rigs(std::span<const double> times) {
  constexpr Eigen::Index kMost = 48;  // views: 960 unknowns with those of their poses
  const auto views = static_cast<Eigen::Index>(times.size());
  return views <= kMost ? Eigen::MatrixXd::Identity(views, views) : basis_of_profiles(times);
}

Eigen::MatrixXd basis_of_profiles(std::span<const double> times) {
  constexpr Eigen::Index kFunctions = static_cast<Eigen::Index>(kTimeProfiles) + 3;
  const auto views = static_cast<Eigen::Index>(times.size());
  if (views <= kFunctions) return Eigen::MatrixXd::Identity(views, views);
  Eigen::MatrixXd all(views, kFunctions);
  all.col(0).setOnes();
  Eigen::Index next = 1;
  for (std::size_t profile = 0; profile < kTimeProfiles; ++profile) {
    const Eigen::MatrixXd functions = time_profile(profile, times);
    all.middleCols(next, functions.cols()) = functions;
    next += functions.cols();
  }
  return orthonormal_basis(all);
}

}  // namespace frangia
