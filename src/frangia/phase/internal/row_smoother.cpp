#include "frangia/phase/internal/row_smoother.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>

#include "frangia/core/vectorized.h"

namespace frangia {
namespace {

/// Some pixels of a row and their opposite neighbours at one distance.
struct NeighborPairs {
  const float* center;
  const float* one;
  const float* other;
  const float* limit;  ///< largest difference of a neighbour from the center
};

/// Adds the pairs that agree with their pixel.
FRANGIA_VECTORIZED void add_pairs(const NeighborPairs& pairs,
                                  std::ptrdiff_t count,
                                  double* sum,
                                  float* added) {
  const NeighborPairs from = pairs;
#pragma GCC ivdep
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const float a = from.one[i];
    const float b = from.other[i];
    const bool one_agrees = std::fabs(a - from.center[i]) < from.limit[i];  // false for NaN
    const bool agree = one_agrees & (std::fabs(b - from.center[i]) < from.limit[i]);
    sum[i] += agree ? static_cast<double>(a + b) : 0.0;
    added[i] += agree ? 2.0F : 0.0F;
  }
}

}  // namespace

RowSmoother::RowSmoother(const AbsolutePhase& in, int radius_px)
    : in_(in),
      radius_(radius_px),
      phase_(static_cast<std::size_t>(in.phase_rad.width())),
      sigma_(phase_),
      limit_(phase_),
      added_(phase_),
      sum_(phase_.size()) {}

void RowSmoother::smooth(int y) {
  const int width = in_.phase_rad.width();
  const float* center = &in_.phase_rad(0, y);
  const float* sigma = &in_.sigma_rad(0, y);
  std::copy_n(center, width, phase_.begin());
  std::copy_n(sigma, width, sigma_.begin());
  for (int x = 0; x < width; ++x) {
    if (std::isnan(center[x])) continue;
    int end = x + 1;
    while (end < width && !std::isnan(center[end]))
      ++end;
    smooth_run(y, x, end);
    x = end;
  }
}

void RowSmoother::smooth_run(int y, int begin, int end) {
  const int width = in_.phase_rad.width();
  for (int x = begin; x < end; ++x) {
    const auto i = static_cast<std::size_t>(x);
    limit_[i] = 3.0F * 1.414F * sigma_[i];
    sum_[i] = phase_[i];
    added_[i] = 1.0F;
  }
  for (int dy = 0; dy <= radius_; ++dy) {
    if (y - dy < 0 || y + dy >= in_.phase_rad.height()) continue;
    for (int dx = dy == 0 ? 1 : -radius_; dx <= radius_; ++dx) {
      const int from = std::max(begin, std::abs(dx));
      const int to = std::min(end, width - std::abs(dx));
      if (from >= to) continue;
      add_pairs({&in_.phase_rad(from, y),
                 &in_.phase_rad(from + dx, y + dy),
                 &in_.phase_rad(from - dx, y - dy),
                 limit_.data() + from},
                to - from,
                sum_.data() + from,
                added_.data() + from);
    }
  }
  for (int x = begin; x < end; ++x) {
    const auto i = static_cast<std::size_t>(x);
    phase_[i] = static_cast<float>(sum_[i] / static_cast<double>(added_[i]));
    sigma_[i] /= std::sqrt(added_[i]);
  }
}

}  // namespace frangia
