#include "frangia/phase/waveform/frame_mixing.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <variant>

#include <Eigen/Core>
#include <Eigen/LU>
#include <fmt/format.h>

#include "frangia/core/parallel.h"
#include "frangia/phase/internal/fringe_curve.h"

namespace frangia {
namespace {

constexpr std::size_t kMixedPixels = 20'000;  ///< of an image that are looked at, about
constexpr std::size_t kShowsResidual = 4;     ///< frames
constexpr double kLeastMixing = 0.01;
constexpr double kMostMixing = 0.7;
constexpr double kLeftByMixing = 0.3;  ///< of the squared residuals of all patterns
constexpr double kLeftInEach = 0.6;    ///< of those of each: it predicts all of them

/// Sampled pixels of all frames of a view (rows), in the order of capture: those whose light
/// changes by a quarter of what it does at most, thinned to a few thousand: the search for the
/// share goes through all of them many times.
Eigen::MatrixXd sample_view(std::span<const FrameStack> stacks) {
  const Frame& first = stacks.front().frames.front();
  const int stride = std::max(1,
                              static_cast<int>(std::sqrt(static_cast<double>(width_of(first)) *
                                                         height_of(first) / double{kMixedPixels})));
  std::vector<Eigen::VectorXd> kept;
  Eigen::Index frames = 0;
  for (const FrameStack& stack : stacks)
    frames += std::ssize(stack.frames);
  Eigen::VectorXd counts(frames);
  for (int y = stride / 2; y < height_of(first); y += stride) {
    for (int x = stride / 2; x < width_of(first); x += stride) {
      Eigen::Index row = 0;
      bool saturated = false;
      for (const FrameStack& stack : stacks) {
        for (const Frame& frame : stack.frames) {
          counts(row) = counts_at(frame, x, y);
          saturated = saturated || counts(row) >= stack.white_level;
          ++row;
        }
      }
      if (!saturated) kept.push_back(counts);
    }
  }
  if (kept.empty()) return Eigen::MatrixXd(frames, 0);
  const auto change_of = [](const Eigen::VectorXd& one) { return one.maxCoeff() - one.minCoeff(); };
  std::vector<double> changes;
  for (const Eigen::VectorXd& one : kept)
    changes.push_back(change_of(one));
  const auto high = changes.begin() + std::ssize(changes) * 99 / 100;
  std::nth_element(changes.begin(), high, changes.end());
  constexpr double kLeastOfMost = 0.25;
  std::erase_if(kept, [&](const auto& one) { return change_of(one) < kLeastOfMost * *high; });
  constexpr std::size_t kSearched = 3000;
  const std::size_t every = std::max<std::size_t>(1, kept.size() / kSearched);
  Eigen::MatrixXd out(frames, static_cast<Eigen::Index>((kept.size() + every - 1) / every));
  for (Eigen::Index i = 0; i < out.cols(); ++i)
    out.col(i) = kept[static_cast<std::size_t>(i) * every];
  return out;
}

/// The projector onto what no fringe explains.
Eigen::MatrixXd rest_of(const std::vector<double>& shifts_rad) {
  Eigen::MatrixXd model(std::ssize(shifts_rad), 3);
  for (std::size_t k = 0; k < shifts_rad.size(); ++k)
    model.row(static_cast<Eigen::Index>(k)) = fringe_model_row(shifts_rad[k]).transpose();
  return Eigen::MatrixXd::Identity(model.rows(), model.rows()) -
         model * fringe_normal_matrix(shifts_rad).inverse() * model.transpose();
}

/// A pattern whose frames leave a residual, and whose first frame has one before it.
struct JudgedPattern {
  Eigen::Index first = 0;  ///< row of its first frame
  Eigen::MatrixXd rest;
};

/// The frames of all samples without a share of those before.
Eigen::MatrixXd unmixed(const Eigen::MatrixXd& counts, const FrameMixing& mixing) {
  Eigen::MatrixXd out = counts;
  for (Eigen::Index row = 1; row < counts.rows(); ++row) {
    const auto& before = mixing.by_camera ? counts : out;
    out.row(row) =
        (counts.row(row) - mixing.share * before.row(row - 1)).eval() / (1.0 - mixing.share);
  }
  return out;
}

/// Squared residuals of each pattern, of the noise of the frames as they are; each pixel counts up
/// to a limit, for depth edges.
std::vector<double> squares_left(const Eigen::MatrixXd& counts,
                                 const FrameMixing& mixing,
                                 const std::vector<JudgedPattern>& patterns,
                                 double limit) {
  const Eigen::MatrixXd alone = (1.0 - mixing.share) * unmixed(counts, mixing);
  std::vector<double> out;
  for (const JudgedPattern& one : patterns) {
    const Eigen::MatrixXd left = one.rest * alone.middleRows(one.first, one.rest.rows());
    out.push_back(left.colwise().squaredNorm().array().min(limit).sum());
  }
  return out;
}

double sum_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

/// The share that leaves least, by golden section.
FrameMixing best_mixing(const Eigen::MatrixXd& counts,
                        const std::vector<JudgedPattern>& patterns,
                        bool by_camera,
                        double limit) {
  constexpr double kGolden = 0.6180339887498949;
  constexpr int kSteps = 16;
  const auto left = [&](double share) {
    return sum_of(squares_left(counts, {share, by_camera}, patterns, limit));
  };
  double low = 0.0;
  double high = kMostMixing;
  double at_low = left(high - kGolden * (high - low));
  double at_high = left(low + kGolden * (high - low));
  for (int i = 0; i < kSteps; ++i) {
    if (at_low < at_high) {
      high = low + kGolden * (high - low);
      at_high = std::exchange(at_low, left(high - kGolden * (high - low)));
    } else {
      low = high - kGolden * (high - low);
      at_low = std::exchange(at_high, left(low + kGolden * (high - low)));
    }
  }
  return {0.5 * (low + high), by_camera};
}

}  // namespace

std::optional<FrameMixing> find_frame_mixing(std::span<const FrameStack> stacks) {
  std::vector<JudgedPattern> patterns;
  Eigen::Index row = 0;
  for (const FrameStack& stack : stacks) {
    const Pattern& pattern = stack.pattern;
    const Frame& frame = stack.frames.front();
    const Frame& first = stacks.front().frames.front();
    if (pattern.exposure_count() > 1 || width_of(frame) != width_of(first) ||
        height_of(frame) != height_of(first))
      return std::nullopt;
    const bool shows = pattern.kind == PatternKind::Fringe &&
                       stack.frames.size() == pattern.shifts_rad.size() &&
                       stack.frames.size() >= kShowsResidual && pattern.fringes_per_degree == 0.0;
    if (shows && row > 0) patterns.push_back({row, rest_of(pattern.shifts_rad)});
    row += std::ssize(stack.frames);
  }
  if (patterns.empty()) return std::nullopt;
  const Eigen::MatrixXd counts = sample_view(stacks);
  constexpr Eigen::Index kFewestPixels = 300;
  if (counts.cols() < kFewestPixels) return std::nullopt;
  // Depth edges count as much as light that is uncorrelated with that of other frames.
  const double limit = (counts.rowwise() - counts.colwise().mean()).squaredNorm() /
                       static_cast<double>(counts.size());
  const std::vector<double> without = squares_left(counts, {}, patterns, limit);
  std::optional<FrameMixing> best;
  double least = kLeftByMixing * sum_of(without);
  for (const bool by_camera : {true, false}) {
    const FrameMixing tried = best_mixing(counts, patterns, by_camera, limit);
    if (tried.share < kLeastMixing || tried.share > 0.95 * kMostMixing) continue;
    const std::vector<double> left = squares_left(counts, tried, patterns, limit);
    if (sum_of(left) >= least) continue;
    bool in_each = true;
    for (std::size_t i = 0; i < left.size(); ++i)
      in_each = in_each && left[i] < kLeftInEach * without[i];
    if (!in_each) continue;
    least = sum_of(left);
    best = tried;
  }
  return best;
}

std::vector<FrameStack> without_mixing(std::span<const FrameStack> stacks,
                                       const FrameMixing& mixing) {
  std::vector<FrameStack> out(stacks.begin(), stacks.end());
  const Frame* before = nullptr;
  for (std::size_t s = 0; s < stacks.size(); ++s) {
    for (std::size_t k = 0; k < stacks[s].frames.size(); ++k) {
      Frame& made = out[s].frames[k];
      const Frame* previous =
          std::exchange(before, mixing.by_camera ? &stacks[s].frames[k] : &made);
      if (previous == nullptr) continue;
      const int white = stacks[s].white_level;
      std::visit(
          [&](auto& image) {
            using Count = std::remove_cvref_t<decltype(image(0, 0))>;
            parallel_rows(image.height(), [&](int y) {
              for (int x = 0; x < image.width(); ++x) {
                const int mixed = image(x, y);
                if (mixed >= white) continue;
                const double alone =
                    (mixed - mixing.share * counts_at(*previous, x, y)) / (1.0 - mixing.share);
                image(x, y) = static_cast<Count>(
                    std::clamp<long>(std::lround(alone), 0, std::max(0, white - 1)));
              }
            });
          },
          made);
    }
  }
  return out;
}

std::string describe(const FrameMixing& mixing) {
  const double percent = 100.0 * mixing.share;
  if (mixing.by_camera) {
    return fmt::format(
        "each frame holds {:.0f} % of the one before it, as a camera delivers them that reduces "
        "noise over time; it is taken out; switch that off, or capture each frame several times "
        "and keep the last",
        percent);
  }
  return fmt::format(
      "each frame holds {:.0f} % of the light of the one before it, as where exposures begin "
      "before "
      "the projector has switched; it is taken out; leave more time between projecting and "
      "exposing",
      percent);
}

}  // namespace frangia
