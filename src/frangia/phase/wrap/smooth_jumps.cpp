#include "frangia/phase/wrap/smooth_jumps.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "frangia/core/angles.h"
#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"
#include "frangia/core/statistics.h"
#include "frangia/core/vectorized.h"

namespace frangia {
namespace {

/// Allowed deviation in sigmas of the differences' own noise: 1 of 2 million differences exceeds
/// it.
constexpr float kNoiseSigmas = 5.0F;

/// Wrapped differences between two rows, or between a row and itself shifted by one pixel; NaN
/// where a pixel is missing.
FRANGIA_VECTORIZED void find_jumps(const float* from, const float* to, int count, float* jump) {
  for (int x = 0; x < count; ++x) {
    const float difference = to[x] - from[x];
    const float down = difference > kPiF ? kTwoPiF : 0.0F;
    const float up = difference < -kPiF ? kTwoPiF : 0.0F;
    jump[x] = difference - down + up;
  }
}

struct SmoothLimits {
  float departure;  ///< from the previous and the next difference
  float jump;
};

/// A row of differences and those before and after it.
struct JumpRows {
  const float* before;
  const float* here;
  const float* behind;
};

/// Classifies differences. A missing adjacent difference is ignored; an isolated difference has no
/// deviation.
FRANGIA_VECTORIZED void classify_jumps(JumpRows rows,
                                       int count,
                                       SmoothLimits limits,
                                       std::uint8_t* __restrict smooth) {
  for (int x = 0; x < count; ++x) {
    const float before = rows.before[x];
    const float jump = rows.here[x];
    const float behind = rows.behind[x];
    const float one = before == before ? before : behind;
    const float two = behind == behind ? behind : before;
    const float low = one < two ? one : two;
    const float high = one < two ? two : one;
    const std::int32_t below = low - jump > limits.departure ? 1 : 0;
    const std::int32_t above = jump - high > limits.departure ? 1 : 0;
    const std::int32_t small = std::fabs(jump) <= limits.jump ? 1 : 0;
    smooth[x] = static_cast<std::uint8_t>(small & ~(below | above) & 1);
  }
}

/// Standard deviation of the differences along x (dx = 1) or y, from second differences in a sample
/// of rows.
float jump_noise(const Image<float>& phase, int dx, int dy) {
  constexpr int kSamples = 400'000;
  std::vector<float> differences;
  const int stride = std::max(1, static_cast<int>(phase.pixels().size() / kSamples));
  for (int y = dy; y + dy < phase.height(); y += stride) {
    for (int x = dx; x + dx < phase.width(); ++x) {
      const float second_difference =
          phase(x - dx, y - dy) - 2.0F * phase(x, y) + phase(x + dx, y + dy);
      if (std::isnan(second_difference)) continue;
      differences.push_back(
          std::fabs(second_difference - kTwoPiF * std::round(second_difference / kTwoPiF)));
    }
  }
  // a - 2b + c has variance 6 sigma^2, a first difference 2 sigma^2; 0.6745 sigma is the median of
  // |noise|.
  return median_in_place(std::span(differences)) / 0.6745F / std::sqrt(3.0F);
}

}  // namespace

Image<std::uint8_t> smooth_right(const Image<float>& phase_rad, const JumpOptions& options) {
  const int width = phase_rad.width();
  const auto row = static_cast<std::size_t>(width);
  const SmoothLimits limits{options.tolerance_rad + kNoiseSigmas * jump_noise(phase_rad, 1, 0),
                            options.max_jump_rad};
  Image<std::uint8_t> smooth(width, phase_rad.height(), Uninitialized{});
  parallel_rows(phase_rad.height(), [&](int y) {
    std::vector<float> jump(row + 2, kMissing);  // one more element at each end
    const float* from = phase_rad.pixels().data() + static_cast<std::size_t>(y) * row;
    find_jumps(from, from + 1, width - 1, jump.data() + 1);
    classify_jumps({jump.data(), jump.data() + 1, jump.data() + 2}, width, limits, &smooth(0, y));
  });
  return smooth;
}

Image<std::uint8_t> smooth_below(const Image<float>& phase_rad, const JumpOptions& options) {
  constexpr int kBand = 32;  // rows processed together, so that each difference is computed once
  const int width = phase_rad.width();
  const int height = phase_rad.height();
  const auto row = static_cast<std::size_t>(width);
  const SmoothLimits limits{options.tolerance_rad + kNoiseSigmas * jump_noise(phase_rad, 0, 1),
                            options.max_jump_rad};
  Image<std::uint8_t> smooth(width, height, Uninitialized{});
  parallel_rows((height + kBand - 1) / kBand, [&](int band) {
    std::vector<float> before(row);
    std::vector<float> here(row);
    std::vector<float> behind(row);
    const auto jumps_below = [&](int y, std::vector<float>& jump) {
      if (y < 0 || y + 1 >= height) {
        std::fill(jump.begin(), jump.end(), kMissing);
        return;
      }
      const float* from = phase_rad.pixels().data() + static_cast<std::size_t>(y) * row;
      find_jumps(from, from + row, width, jump.data());
    };
    jumps_below(band * kBand - 1, before);
    jumps_below(band * kBand, here);
    for (int y = band * kBand; y < std::min(height, (band + 1) * kBand); ++y) {
      jumps_below(y + 1, behind);
      classify_jumps({before.data(), here.data(), behind.data()}, width, limits, &smooth(0, y));
      std::swap(before, here);
      std::swap(here, behind);
    }
  });
  return smooth;
}

}  // namespace frangia
