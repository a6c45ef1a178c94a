#include "frangia/phase/waveform/pooled_gain_error.h"

#include <algorithm>

namespace frangia {

double pooled_gain_error(std::span<const StepEstimate> views) {
  double count = 0.0;
  double mean = 0.0;
  for (const StepEstimate& view : views) {
    if (!view.found) continue;
    count += 1.0;
    mean += view.gain_error();
  }
  if (count == 0.0) return 0.0;
  mean /= count;
  // Independent shift errors of standard deviation sigma shift the phase of a window of four frames
  // by sigma, and change its apparent step by half of that.
  double square = 0.0;
  double noise = 0.0;
  for (const StepEstimate& view : views) {
    if (!view.found) continue;
    const double jitter = 0.5 * view.jitter_rad / view.nominal_rad;
    const double scatter = view.gain_error() - mean;
    const double sigma = view.sigma_rad / view.nominal_rad;
    square += jitter * jitter + scatter * scatter;
    noise += sigma * sigma;
  }
  const double freedom = 2.0 * count - 1.0;
  const double variance = square / freedom / count + noise / (count * count);
  // 4: a mean of two sigmas shrinks to 0.
  const double caution = 4.0 * (1.0 + 5.0 / freedom);
  return mean == 0.0 ? 0.0 : mean * std::max(0.0, 1.0 - caution * variance / (mean * mean));
}

}  // namespace frangia
