#include "frangia/phase/blur/find_sharpening.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <variant>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "frangia/core/angles.h"
#include "frangia/core/image.h"
#include "frangia/core/missing.h"
#include "frangia/core/statistics.h"
#include "frangia/phase/waveform/frame_samples.h"

namespace frangia {
namespace {

constexpr int kSharpnessRows = 16;          // that lie together where some are looked at
constexpr Eigen::Index kMostResiduals = 3;  // of a pattern
constexpr int kFarthest_px = 4;

/// How much of a view is looked at.
struct NoiseExtent {
  std::size_t pixels = 0;  ///< of each pattern
  std::size_t patterns = 0;
  int farthest_px = 0;  ///< distance of pixels whose products are summed
};
/// Tells a camera that sharpens from the others, in a hundredth of the time that decoding takes.
constexpr NoiseExtent kFirstLook{50'000, 2, 1};
constexpr NoiseExtent kWholeLook{400'000, 6, kFarthest_px};

/// Mean products of the noise of two pixels, by their distances along rows and columns.
struct LagProducts {
  using Table = Eigen::Array<double, kFarthest_px + 1, kFarthest_px + 1>;
  Table sum = Table::Zero();
  Table count = Table::Zero();

  [[nodiscard]] double mean(int dx, int dy) const { return sum(dx, dy) / count(dx, dy); }
};

/// What the frames of a pattern show, in the rows that are looked at.
struct FringeRows {
  Image<float> mean_counts;
  Image<float> modulation_counts;
  Image<float> phase_rad;
  std::vector<Image<float>> residuals;  ///< of unit noise gain
  std::vector<bool> usable;             ///< neither saturated nor cut off at 0
};

FringeRows fringe_rows(const FrameStack& stack, std::size_t pixels) {
  const FrameStack some = sample_rows(stack, pixels, kSharpnessRows);
  const std::vector<double>& shifts = stack.pattern.shifts_rad;
  const auto count = static_cast<Eigen::Index>(shifts.size());
  Eigen::MatrixX3f model(count, 3);
  for (Eigen::Index k = 0; k < count; ++k) {
    const double shift = shifts[static_cast<std::size_t>(k)];
    model.row(k) << 1.0F, static_cast<float>(std::cos(shift)), static_cast<float>(-std::sin(shift));
  }
  const Eigen::HouseholderQR<Eigen::MatrixXf> solver(model);
  const Eigen::MatrixXf fit = solver.solve(Eigen::MatrixXf::Identity(count, count));
  const Eigen::MatrixXf all = solver.householderQ() * Eigen::MatrixXf::Identity(count, count);
  const Eigen::MatrixXf left =
      all.rightCols(count - 3).leftCols(std::min(count - 3, kMostResiduals)).transpose();
  const Image<float> empty(width_of(some.frames.front()), height_of(some.frames.front()));
  FringeRows out{empty, empty, empty, {}, {}};
  out.residuals.assign(static_cast<std::size_t>(left.rows()), empty);
  Eigen::MatrixXf counts(count, static_cast<Eigen::Index>(empty.pixels().size()));
  for (Eigen::Index k = 0; k < count; ++k) {
    std::visit(
        [&](const auto& image) {
          for (std::size_t i = 0; i < image.pixels().size(); ++i)
            counts(k, static_cast<Eigen::Index>(i)) = static_cast<float>(image.pixels()[i]);
        },
        some.frames[static_cast<std::size_t>(k)]);
  }
  for (Eigen::Index i = 0; i < counts.cols(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    const Eigen::Vector3f light = fit * counts.col(i);
    const Eigen::VectorXf rest = left * counts.col(i);
    out.mean_counts.pixels()[at] = light[0];
    out.modulation_counts.pixels()[at] = std::hypot(light[1], light[2]);
    out.phase_rad.pixels()[at] = std::atan2(light[2], light[1]);
    for (Eigen::Index r = 0; r < rest.size(); ++r)
      out.residuals[static_cast<std::size_t>(r)].pixels()[at] = rest[r];
    out.usable.push_back(counts.col(i).minCoeff() > 0.0F &&
                         counts.col(i).maxCoeff() < static_cast<float>(stack.white_level));
  }
  return out;
}

/// The pixels that are bright enough to show the noise of a pattern; none where they are few.
std::vector<std::size_t> bright_pixels(const FringeRows& fringes) {
  constexpr float kDark = 0.2F;          // of the modulation of a bright pixel
  constexpr float kLeastCounts = 5.0F;   // of the modulation
  constexpr std::size_t kFewest = 1000;  // pixels
  const std::span<const float> modulation = fringes.modulation_counts.pixels();
  std::vector<float> lit;
  for (std::size_t i = 0; i < modulation.size(); ++i)
    if (fringes.usable[i] && modulation[i] > kLeastCounts) lit.push_back(modulation[i]);
  if (lit.size() < kFewest) return {};
  const auto high = lit.begin() + static_cast<std::ptrdiff_t>(lit.size() * 19 / 20);
  std::nth_element(lit.begin(), high, lit.end());
  const float least = std::max(kLeastCounts, kDark * *high);
  std::vector<std::size_t> bright;
  for (std::size_t i = 0; i < modulation.size(); ++i)
    if (fringes.usable[i] && modulation[i] > least) bright.push_back(i);
  return bright;
}

/// Values beyond four standard deviations, by the median of their sizes, are no noise.
double largest_noise(const std::vector<double>& values) {
  constexpr double kOutlier = 4.0;     // standard deviations
  constexpr double kLeastSigma = 0.3;  // counts: that of the rounding
  std::vector<double> sizes(values);
  for (double& size : sizes)
    size = std::abs(size);
  return kOutlier * std::max(median(std::move(sizes)) / kMedianOfNormal, kLeastSigma);
}

/// Takes off the values of some pixels what repeats with the phase, as harmonics and flicker do,
/// and with the light.
void take_off_repeating(const FringeRows& fringes,
                        const std::vector<std::size_t>& pixels,
                        std::vector<double>& values) {
  constexpr std::size_t kPhases = 64;
  const auto phase_of = [&](std::size_t i) {
    const double share = static_cast<double>(fringes.phase_rad.pixels()[i]) / kTwoPi + 0.5;
    return std::min(kPhases - 1, static_cast<std::size_t>(share * kPhases));
  };
  const auto modulation = [&](std::size_t n) {
    return static_cast<double>(fringes.modulation_counts.pixels()[pixels[n]]);
  };
  const auto light = [&](std::size_t n) {
    return static_cast<double>(fringes.mean_counts.pixels()[pixels[n]]);
  };
  const double most = largest_noise(values);
  std::array<double, kPhases> product{};
  std::array<double, kPhases> square{};
  for (std::size_t n = 0; n < pixels.size(); ++n) {
    if (std::abs(values[n]) > most) continue;
    product[phase_of(pixels[n])] += modulation(n) * values[n];
    square[phase_of(pixels[n])] += modulation(n) * modulation(n);
  }
  double by_light = 0.0;
  double light2 = 0.0;
  for (std::size_t n = 0; n < pixels.size(); ++n) {
    const std::size_t phase = phase_of(pixels[n]);
    if (square[phase] > 0.0) values[n] -= modulation(n) * product[phase] / square[phase];
    if (std::abs(values[n]) > most) continue;
    by_light += light(n) * values[n];
    light2 += light(n) * light(n);
  }
  for (std::size_t n = 0; n < pixels.size() && light2 > 0.0; ++n)
    values[n] -= by_light / light2 * light(n);
}

/// Leaves of a residual what repeats neither with the phase nor with the light. Pixels without
/// noise become NaN: dark ones, and those that differ by more than it.
void keep_noise(const FringeRows& fringes, Image<float>& residual) {
  const std::vector<std::size_t> pixels = bright_pixels(fringes);
  std::vector<double> left;
  for (const std::size_t pixel : pixels)
    left.push_back(static_cast<double>(residual.pixels()[pixel]));
  std::fill(residual.pixels().begin(), residual.pixels().end(), kMissing);
  if (pixels.empty()) return;
  constexpr int kRounds = 2;
  for (int round = 0; round < kRounds; ++round)
    take_off_repeating(fringes, pixels, left);
  const double most = largest_noise(left);
  for (std::size_t n = 0; n < pixels.size(); ++n)
    if (std::abs(left[n]) <= most) residual.pixels()[pixels[n]] = static_cast<float>(left[n]);
}

void add_products(const Image<float>& noise, int farthest_px, LagProducts& products) {
  const int width = noise.width();
  for (int y = 0; y < noise.height(); ++y) {
    const int rows = std::min(kSharpnessRows - y % kSharpnessRows, noise.height() - y);
    for (int x = 0; x < width; ++x) {
      const float here = noise(x, y);
      if (std::isnan(here)) continue;
      for (int dy = 0; dy <= std::min(farthest_px, rows - 1); ++dy) {
        for (int dx = dy == 0 ? 0 : -farthest_px; dx <= farthest_px; ++dx) {
          if (x + dx < 0 || x + dx >= width || std::isnan(noise(x + dx, y + dy))) continue;
          products.sum(std::abs(dx), dy) += static_cast<double>(here * noise(x + dx, y + dy));
          products.count(std::abs(dx), dy) += 1.0;
        }
      }
    }
  }
}

/// The products of the noise of the patterns.
LagProducts products_of(std::span<const FrameStack> stacks, const NoiseExtent& extent) {
  LagProducts products;
  std::optional<FringeRows> before;  // a pattern of three frames
  std::size_t patterns = 0;
  for (const FrameStack& stack : stacks) {
    const bool is_usable = stack.pattern.kind == PatternKind::Fringe && stack.frames.size() >= 3 &&
                           stack.frames.size() == stack.pattern.shifts_rad.size() &&
                           stack.pattern.exposure_count() == 1;
    if (!is_usable || ++patterns > extent.patterns) continue;
    FringeRows fringes = fringe_rows(stack, extent.pixels);
    if (stack.frames.size() == 3) {
      if (before && before->usable.size() == fringes.usable.size()) {
        Image<float> difference = fringes.mean_counts;
        for (std::size_t i = 0; i < difference.pixels().size(); ++i) {
          // The mean of three frames has a third of their variance.
          difference.pixels()[i] -= before->mean_counts.pixels()[i];
          difference.pixels()[i] *= std::sqrt(1.5F);
          fringes.usable[i] = fringes.usable[i] && before->usable[i];
        }
        fringes.residuals.push_back(std::move(difference));
        before.reset();
      } else {
        before = fringes;
      }
    }
    for (Image<float>& residual : fringes.residuals) {
      keep_noise(fringes, residual);
      add_products(residual, extent.farthest_px, products);
    }
  }
  return products;
}

/// Convolves two symmetric lists of weights.
std::vector<double> convolved(const std::vector<double>& a, const std::vector<double>& b) {
  const auto at = [](const std::vector<double>& list, std::ptrdiff_t i) {
    const auto k = static_cast<std::size_t>(std::abs(i));
    return k < list.size() ? list[k] : 0.0;
  };
  std::vector<double> out(a.size() + b.size() - 1, 0.0);
  const auto reach = static_cast<std::ptrdiff_t>(b.size()) - 1;
  for (std::size_t k = 0; k < out.size(); ++k) {
    for (std::ptrdiff_t j = -reach; j <= reach; ++j)
      out[k] += at(b, j) * at(a, static_cast<std::ptrdiff_t>(k) - j);
  }
  return out;
}

/// Products of white noise behind a filter whose weights convolved with themselves these are.
LagProducts::Table products_of(const std::vector<double>& weights) {
  LagProducts::Table out;
  const auto at = [&](Eigen::Index i) {
    const auto k = static_cast<std::size_t>(i);
    return k < weights.size() ? weights[k] : 0.0;
  };
  for (Eigen::Index x = 0; x < out.rows(); ++x) {
    for (Eigen::Index y = 0; y < out.cols(); ++y)
      out(x, y) = at(x) * at(y);
  }
  return out;
}

/// A mask, or none.
struct MaskTried {
  CameraSharpening sharpening;
  double chi2 = std::numeric_limits<double>::infinity();
};

/// The weighted squares that white noise behind one filter, and a constant by what is smooth, leave
/// of the measured products.
double chi2_of(const LagProducts& measured, const LagProducts::Table& shape, double rounding) {
  constexpr double kRound = 4.3;  // px: lags in a circle
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  double square = 0.0;
  for (int dx = 0; dx <= kFarthest_px; ++dx) {
    for (int dy = 0; dy <= kFarthest_px; ++dy) {
      if (std::hypot(dx, dy) > kRound) continue;
      const double weight = measured.count(dx, dy);
      const double y = measured.mean(dx, dy) - (dx == 0 && dy == 0 ? rounding : 0.0);
      const Eigen::Vector2d model(shape(dx, dy), 1.0);
      normal += weight * model * model.transpose();
      right += weight * y * model;
      square += weight * y * y;
    }
  }
  const double left = square - right.dot(normal.ldlt().solve(right));
  return left / std::pow(measured.mean(0, 0), 2);  // the variance of a product of white noise
}

/// The likeliest of all masks.
MaskTried best_mask(const LagProducts& measured, double rounding) {
  constexpr double kLeastShift_px2 = 0.08;  // amount times variance
  constexpr double kMostShift_px2 = 8.0;
  constexpr double kFiner = 1.1;
  constexpr double kMostGain = 6.0;  // of the finest structures
  const LagProducts::Table plain = products_of({1.0});
  MaskTried best;
  for (const double radius_px : {0.4, 0.5, 0.6, 0.7, 0.85, 1.0, 1.2, 1.45, 1.75, 2.1}) {
    const std::vector<double> mask = blur_weights(radius_px);
    const LagProducts::Table once = products_of(mask);
    const LagProducts::Table twice = products_of(convolved(mask, mask));
    double variance_px2 = 0.0;
    double finest = mask.front();  // the spectrum of the blur at two pixels a period
    for (std::size_t k = 1; k < mask.size(); ++k) {
      variance_px2 += 2.0 * static_cast<double>(k * k) * mask[k];
      finest += (k % 2 == 0 ? 2.0 : -2.0) * mask[k];
    }
    for (double shift = kLeastShift_px2; shift < kMostShift_px2; shift *= kFiner) {
      const double a = shift / variance_px2;
      if (1.0 + a * (1.0 - finest * finest) > kMostGain) break;
      const LagProducts::Table shape =
          (1.0 + a) * (1.0 + a) * plain - 2.0 * a * (1.0 + a) * once + a * a * twice;
      const double chi2 = chi2_of(measured, shape, rounding);
      if (chi2 < best.chi2) best = {{a, radius_px}, chi2};
    }
  }
  return best;
}

}  // namespace

std::vector<double> blur_weights(double radius_px) {
  if (radius_px <= 0.0) return {1.0};
  constexpr double kReach = 4.0;
  std::vector<double> weights;
  double sum = 0.0;
  for (int k = 0; k <= static_cast<int>(std::lround(kReach * radius_px)); ++k) {
    weights.push_back(std::exp(-0.5 * std::pow(k / radius_px, 2)));
    sum += (k == 0 ? 1.0 : 2.0) * weights.back();
  }
  for (double& weight : weights)
    weight /= sum;
  return weights;
}

namespace {

/// Whether the pixels beside and below one both differ from it by more than those farther away.
bool contradict_neighbours(const LagProducts& products) {
  constexpr double kLeast = -0.01;      // correlation of neighbours
  constexpr double kSignificant = 2.5;  // standard deviations
  constexpr double kAlike = 0.5;        // both directions
  const double along = products.mean(1, 0) / products.mean(0, 0);
  const double across = products.mean(0, 1) / products.mean(0, 0);
  const double limit = std::min(
      kLeast, -kSignificant / std::sqrt(std::min(products.count(1, 0), products.count(0, 1))));
  return std::max(along, across) <= std::min(limit, kAlike * std::min(along, across));
}

}  // namespace

std::optional<CameraSharpening> find_sharpening(std::span<const FrameStack> stacks,
                                                double storage_counts2) {
  constexpr double kFewest = 3000.0;      // pairs of pixels
  constexpr double kAboveRounding = 2.0;  // times its variance
  constexpr double kDecisive = 40.0;      // of chi squared, for three parameters
  constexpr double kScatter = 40.0;       // of chi squared, twice the number of products
  constexpr double kUnexplained = 0.1;    // of what a mask explains; a compression leaves more
  if (!contradict_neighbours(products_of(stacks, kFirstLook))) return std::nullopt;
  const LagProducts products = products_of(stacks, kWholeLook);
  if (!(products.count.minCoeff() > kFewest)) return std::nullopt;
  const double rounding = 1.0 / 12.0 + storage_counts2;
  if (products.mean(0, 0) < kAboveRounding * rounding) return std::nullopt;
  if (!contradict_neighbours(products)) return std::nullopt;
  const MaskTried best = best_mask(products, rounding);
  const double gained = chi2_of(products, products_of({1.0}), rounding) - best.chi2;
  if (gained < kDecisive || best.chi2 > kScatter + kUnexplained * gained) return std::nullopt;
  return best.sharpening;
}

std::string describe(const CameraSharpening& sharpening) {
  return fmt::format(
      "the camera sharpens its frames, which shifts the phase at edges of brightness: their noise "
      "is "
      "that of an unsharp mask of amount {:.1f} and radius {:.1f} px, and the mask is taken out; "
      "switch the sharpness of the camera off",
      sharpening.amount,
      sharpening.radius_px);
}

}  // namespace frangia
