#include "frangia/geometry/median_sigma.h"

#include <cmath>
#include <iterator>
#include <utility>
#include <vector>

#include "frangia/core/median.h"

namespace frangia {
namespace {

double median_of_known(const std::vector<float>& sigmas) {
  std::vector<float> known;
  known.reserve(sigmas.size());
  for (const float sigma : sigmas)
    if (std::isfinite(sigma)) known.push_back(sigma);
  return known.empty() ? kMissing : static_cast<double>(median(std::move(known)));
}

}  // namespace

MedianSigma median_sigma(const Mesh& mesh) {
  return {median_of_known(mesh.sigma_mm),
          median_of_known(mesh.sigma_noise_mm),
          median_of_known(mesh.sigma_systematic_mm)};
}

}  // namespace frangia
