#include "frangia/phase/wrap/internal/noise_row_gatherer.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace frangia {

NoiseRowGatherer::NoiseRowGatherer(const FrameStack& stack, std::vector<double> weights)
    : stack_(&stack), weights_(std::move(weights)), harmonics_(stack, weights_) {}

void NoiseRowGatherer::gather(int y, NoiseBins& bins) const {
  const int width = width_of(stack_->frames.front());
  std::vector<double> sum(static_cast<std::size_t>(width), 0.0);
  std::vector<double> mean(sum);
  std::vector<int> brightest(sum.size(), 0);
  std::vector<int> darkest(sum.size(), stack_->white_level);
  for (std::size_t k = 0; k < stack_->frames.size(); ++k) {
    std::visit(
        [&](const auto& image) {
          for (int x = 0; x < width; ++x) {
            const auto i = static_cast<std::size_t>(x);
            sum[i] += weights_[k] * image(x, y);
            mean[i] += image(x, y) / static_cast<double>(stack_->frames.size());
            brightest[i] = std::max(brightest[i], static_cast<int>(image(x, y)));
            darkest[i] = std::min(darkest[i], static_cast<int>(image(x, y)));
          }
        },
        stack_->frames[k]);
  }
  if (harmonics_.found()) {
    for (int x = 0; x < width; ++x)
      sum[static_cast<std::size_t>(x)] -= harmonics_.value_at(*stack_, x, y);
  }
  for (std::size_t i = 1; i + 1 < sum.size(); ++i) {
    if (std::max({brightest[i - 1], brightest[i], brightest[i + 1]}) >= stack_->white_level)
      continue;
    // Clipping at 0 counts would reduce the apparent noise.
    if (std::min({darkest[i - 1], darkest[i], darkest[i + 1]}) <= 0) continue;
    const double difference = (sum[i - 1] - 2.0 * sum[i] + sum[i + 1]) / std::sqrt(6.0);
    const double share = mean[i] / stack_->white_level;
    const auto bin = std::min<std::size_t>(NoiseSamples::kBins - 1,
                                           static_cast<std::size_t>(share * NoiseSamples::kBins));
    bins[bin].push_back(static_cast<float>(std::abs(difference)));
  }
}

}  // namespace frangia
