#include "frangia/pattern/fringe_sequence.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"

namespace frangia {
namespace {

/// Least ratio of a plan. Below it more frames per map are better than more maps.
constexpr double kMinRatio = 1.1;

}  // namespace

double wrong_order_probability(double sigma_rad) {
  return std::erfc(kPi / (sigma_rad * std::numbers::sqrt2));
}

std::vector<double> fringe_sequence(const std::string& name, double fringes) {
  require(std::isfinite(fringes) && fringes >= 1.0, "a sequence needs at least one fringe");
  std::vector<double> all = {fringes};
  if (name == "doubling") {
    while (all.back() > 1.0)
      all.push_back(std::max(1.0, 0.5 * all.back()));
  } else if (name == "negative-exponential") {
    double less = 1.0;
    while (less <= 0.5 * fringes) {
      all.push_back(fringes - less);
      less *= 2.0;
    }
  } else if (name == "heterodyne") {
    // The beats have one fringe and about sqrt(N) fringes, the geometric mean of 1 and N.
    all.push_back(std::max(1.0, fringes - 1.0));
    all.push_back(std::max(1.0, fringes - std::max(2.0, std::round(std::sqrt(fringes)))));
  } else {
    throw Error(ErrorKind::Input,
                fmt::format("there is no sequence \"{}\"; choose doubling, negative-exponential, "
                            "or heterodyne",
                            name));
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

double sigma_for_wrong_order_probability(double probability) {
  double low = 1e-3;
  double high = 1e3;
  for (int i = 0; i < 60; ++i) {
    const double middle = std::sqrt(low * high);
    (wrong_order_probability(middle) > probability ? high : low) = middle;
  }
  return low;
}

SequencePlan plan_sequence(double fringes, double sigma_rad, double max_wrong_order) {
  require(std::isfinite(fringes) && fringes >= 1.0, "a plan needs at least one fringe");
  require(std::isfinite(sigma_rad) && sigma_rad > 0.0, "a plan needs a sigma above 0 rad");
  for (int steps = 0;; ++steps) {
    const double ratio = steps == 0 ? 1.0 : std::pow(fringes, 1.0 / steps);
    if (steps == 0 && fringes > 1.0) continue;
    if (steps > 0 && ratio < kMinRatio) {
      throw Error(
          ErrorKind::Input,
          fmt::format("no sequence keeps the probability of a wrong order below {:g} at a sigma "
                      "of {:g} rad; take more frames per map or more light",
                      max_wrong_order,
                      sigma_rad));
    }
    const double probability = steps * wrong_order_probability(sigma_rad * std::hypot(1.0, ratio));
    if (probability >= max_wrong_order) continue;
    SequencePlan plan{.wrong_order = probability};
    for (int i = 0; i <= steps; ++i)
      plan.fringes.push_back(std::pow(ratio, i));
    plan.fringes.back() = fringes;
    return plan;
  }
}

}  // namespace frangia
