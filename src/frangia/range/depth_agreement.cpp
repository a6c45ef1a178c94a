#include "frangia/range/depth_agreement.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "frangia/core/statistics.h"

namespace frangia {
namespace {

constexpr std::size_t kSampledPairs = 400;  // of a view: a median then has a standard error of 6 %

/// Square of the differences in units of `sigmas`, by their median.
double chi_squared_of(std::span<const DepthPair> pairs, std::span<const float> sigmas) {
  std::vector<float> ratios;
  for (std::size_t i = 0; i < pairs.size(); ++i)
    ratios.push_back(std::abs(pairs[i].apart_mm) / sigmas[i]);
  return std::pow(static_cast<double>(median(std::move(ratios))) / kMedianOfNormal, 2);
}

double share_beyond(std::span<const DepthPair> pairs, std::span<const float> sigmas) {
  std::size_t beyond = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (std::abs(pairs[i].apart_mm) > static_cast<float>(kContradiction) * sigmas[i]) ++beyond;
  }
  return static_cast<double>(beyond) / static_cast<double>(pairs.size());
}

std::vector<DepthPair> evenly_chosen(std::span<const DepthPair> pairs) {
  const std::size_t every = pairs.size() / kSampledPairs + 1;
  std::vector<DepthPair> some;
  for (std::size_t i = every / 2; i < pairs.size(); i += every)
    some.push_back(pairs[i]);
  return some;
}

}  // namespace

DepthAgreement measure_agreement(std::span<const DepthPair> pairs,
                                 const DifferenceUncertainty& calibration) {
  DepthAgreement out;
  out.pixels = pairs.size();
  if (pairs.empty()) return out;
  std::vector<float> apart;
  std::vector<float> over_noise;
  std::vector<float> sigmas;
  for (const DepthPair& pair : pairs) {
    apart.push_back(std::abs(pair.apart_mm));
    over_noise.push_back(std::abs(pair.apart_mm) / pair.sigma_mm);
    sigmas.push_back(std::hypot(pair.sigma_mm, pair.systematic_mm));
  }
  out.median_mm = static_cast<double>(median(std::move(apart)));
  out.median_over_sigma = static_cast<double>(median(std::move(over_noise)));
  out.chi_squared = chi_squared_of(pairs, sigmas);
  out.beyond = share_beyond(pairs, sigmas);
  out.samples = evenly_chosen(pairs);
  if (!calibration) return out;
  out.by_calibration = out.chi_squared < kConsistent;
  if (out.by_calibration) return out;
  std::vector<float> combined;
  std::vector<DepthPair> samples;
  for (DepthPair pair : out.samples) {
    const auto of_rig = static_cast<float>(calibration(pair.point_mm.cast<double>()));
    if (std::isnan(of_rig)) continue;
    pair.systematic_mm = std::hypot(pair.systematic_mm, of_rig);
    combined.push_back(std::hypot(pair.sigma_mm, pair.systematic_mm));
    samples.push_back(pair);
  }
  out.samples = std::move(samples);
  if (combined.empty()) return out;
  out.chi_squared = chi_squared_of(out.samples, combined);
  out.beyond = share_beyond(out.samples, combined);
  out.by_calibration = out.chi_squared < kConsistent;
  return out;
}

}  // namespace frangia
