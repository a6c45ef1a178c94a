#include "frangia/pattern/fringe_sequence.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"

namespace frangia {
namespace {

/// Least ratio of a plan. Below it more frames per map are better than more maps.
constexpr double kMinRatio = 1.1;

/// Far more fringes than any camera has columns; beyond it the sums lose whole fringes.
constexpr double kMaxFringes = 1e6;

void require_fringes(double fringes) {
  if (std::isfinite(fringes) && fringes >= 1.0 && fringes <= kMaxFringes) return;
  throw Error(
      ErrorKind::Input,
      fmt::format(
          "fringes over the field are {:g}; they must be from 1 to {:g}", fringes, kMaxFringes));
}

}  // namespace

double wrong_order_probability(double sigma_rad) {
  return std::erfc(kPi / (sigma_rad * std::numbers::sqrt2));
}

std::vector<double> fringe_sequence(const std::string& name, double fringes) {
  require_fringes(fringes);
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
  require_fringes(fringes);
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

namespace {

constexpr double kMaxCount = 1e5;

/// Share of the field up to which two orders are compared. Orders a whole field apart lie at its
/// two ends only; the margin absorbs the rounding of the counts.
constexpr double kFieldEnd = 1.0 - 1e-6;

/// Squared distance of two orders of the finest fringes, rad squared.
double squared_distance(std::span<const double> fringes, double finest, double orders_apart) {
  double square = 0.0;
  double along = 0.0;
  double slope = 0.0;
  for (const double count : fringes) {
    const double ratio = count / finest;
    const double apart = wrap_rad(kTwoPi * ratio * orders_apart);
    square += apart * apart;
    along += ratio * apart;
    slope += ratio * ratio;
  }
  return std::max(0.0, square - along * along / slope);
}

/// The probability of confusion. Stops when the sum over the orders reaches `limit`.
double confusion_up_to(double limit, std::span<const double> fringes, double sigma_rad) {
  const double finest = *std::max_element(fringes.begin(), fringes.end());
  double sum = 0.0;
  for (double apart = 1.0; sum < limit && apart < finest * kFieldEnd; apart += 1.0) {
    // The share of the field where the other order is inside it, on either side.
    const double share = 1.0 - apart / finest;
    const double distance = std::sqrt(squared_distance(fringes, finest, apart));
    sum += share * std::erfc(distance / (2.0 * std::numbers::sqrt2 * sigma_rad));
  }
  return sum;
}

/// Replaces each count but the finest by the one of least confusion, until none improves.
double improve(std::vector<double>& fringes, double lowest, double sigma_rad) {
  const double finest = fringes.back();
  double least = confusion_probability(fringes, sigma_rad);
  for (bool improved = true; improved;) {
    improved = false;
    for (std::size_t m = 0; m + 1 < fringes.size(); ++m) {
      double best = fringes[m];
      for (double count = std::ceil(lowest); count < finest; count += 1.0) {
        fringes[m] = count;
        const double found = confusion_up_to(least, fringes, sigma_rad);
        if (found >= least) continue;
        least = found;
        best = count;
        improved = true;
      }
      fringes[m] = best;
    }
  }
  return least;
}

}  // namespace

double confusion_probability(std::span<const double> fringes, double sigma_rad) {
  require(!fringes.empty(), "confusion_probability: no fringe counts given");
  for (const double count : fringes) {
    require(count > 0.0 && count <= kMaxCount,
            "confusion_probability: a fringe count must be above 0 and at most 1e5");
  }
  return std::min(1.0, confusion_up_to(1.0, fringes, sigma_rad));
}

bool determines_order(std::span<const double> fringes) {
  constexpr double kSigma = 0.05;
  constexpr double kMaxConfusion = 1e-3;
  return confusion_probability(fringes, kSigma) < kMaxConfusion;
}

SequencePlan plan_beats(
    double fringes, int maps, double lowest, double sigma_rad, double max_wrong_order) {
  constexpr int kMaxMaps = 16;
  constexpr double kMaxPlanned = 1000.0;
  constexpr int kStarts = 4;
  require(maps >= 2 && maps <= kMaxMaps, "the number of `maps` must be from 2 to 16");
  require(fringes >= 2.0 && fringes <= kMaxPlanned, "`fringes` must be from 2 to 1000 for beats");
  require(lowest >= 1.0 && lowest < fringes, "`lowest` must be from 1 to less than `fringes`");
  require(std::isfinite(sigma_rad) && sigma_rad > 0.0, "a plan needs a sigma above 0 rad");
  SequencePlan plan{.wrong_order = 2.0};
  for (int start = 1; start <= kStarts; ++start) {
    // Spread over a different share of the band each time.
    std::vector<double> counts;
    for (int m = 0; m + 1 < maps; ++m) {
      const double share = start * (maps - 1.0 - m) / (kStarts * (maps - 1.0));
      counts.push_back(
          std::max(std::ceil(lowest), std::floor(fringes - share * (fringes - lowest))));
    }
    counts.push_back(fringes);
    const double found = improve(counts, lowest, sigma_rad);
    if (found >= plan.wrong_order) continue;
    std::sort(counts.begin(), counts.end());
    plan = {counts, found};
  }
  if (plan.wrong_order > max_wrong_order) {
    throw Error(ErrorKind::Input,
                fmt::format("no {} maps from {:g} to {:g} fringes keep the probability of a wrong "
                            "order below {:g} at a sigma of {:g} rad; take more `maps`, a lower "
                            "`lowest`, or more light",
                            maps,
                            lowest,
                            fringes,
                            max_wrong_order,
                            sigma_rad));
  }
  return plan;
}

SequencePlan plan_narrow_band(double fringes, int maps, double sigma_rad, double max_wrong_order) {
  constexpr double kStep = 0.02;
  constexpr double kLowest = 0.5;  // of `fringes`
  for (double band = kStep; band < kLowest; band += kStep) {
    const double lowest = std::floor((1.0 - band) * fringes);
    if (!(lowest >= 1.0 && lowest <= fringes - maps + 1.0)) continue;  // too few whole counts
    try {
      return plan_beats(fringes, maps, lowest, sigma_rad, max_wrong_order);
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::Input) throw;
    }
  }
  return plan_beats(fringes, maps, std::floor(kLowest * fringes), sigma_rad, max_wrong_order);
}

}  // namespace frangia
