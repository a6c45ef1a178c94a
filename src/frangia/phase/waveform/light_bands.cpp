#include "frangia/phase/waveform/light_bands.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <variant>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/LU>
#include <fmt/format.h>

#include "frangia/core/parallel.h"
#include "frangia/phase/internal/fringe_curve.h"

namespace frangia {
namespace {

constexpr std::size_t kFewestBandFrames = 4;  ///< three leave no residual
constexpr int kBlocks = 64;                   ///< of rows: eight for each of eight bands
constexpr int kFewestBlocks = 8;              ///< with fringes
constexpr std::size_t kFewestInBlock = 20;    ///< pixels
constexpr std::size_t kGridPixels = 60'000;   ///< of the whole image that are looked at, about
constexpr std::size_t kBandPixels = 12'000;   ///< with fringes that are used, about
constexpr double kLeastOfBright = 0.15;       ///< modulation over that of bright pixels
/// Length of the mean of exp(i phase) over a block, from which on it does not show all phases.
constexpr double kOneSided = 0.6;
constexpr double kPriorBand = 0.1;       ///< standard deviation of a gain before the data
constexpr double kMostBand = 1.0 / 3.0;  ///< largest gain of bands
constexpr double kLeastBand = 0.003;     ///< rms that is corrected
/// What bands leave of the squared residuals, over what gains of whole frames leave, and over what
/// these and displacements leave.
constexpr double kLeftByBands = 0.7;
constexpr int kBandRounds = 3;  ///< of the fit, which is linear in small gains

/// Sampled pixels of a fringe pattern.
struct BandSamples {
  Eigen::MatrixXd counts;    ///< frames x pixels
  Eigen::MatrixXd across;    ///< change of the counts from column to column, frames x pixels
  Eigen::MatrixXd down;      ///< the same from row to row
  std::vector<int> block;    ///< of rows, by pixel
  std::vector<bool> is_odd;  ///< of the columns, by pixel
  int rows_per_block = 1;
  int blocks = 0;
};

/// The fringe model of the frames.
struct FringeFit {
  Eigen::MatrixXd model;  ///< frames x 3
  Eigen::MatrixXd fit;    ///< 3 x frames: counts to mean, cosine and sine
  Eigen::MatrixXd rest;   ///< frames x frames: counts to residuals

  explicit FringeFit(const std::vector<double>& shifts_rad) : model(std::ssize(shifts_rad), 3) {
    for (std::size_t k = 0; k < shifts_rad.size(); ++k)
      model.row(static_cast<Eigen::Index>(k)) = fringe_model_row(shifts_rad[k]).transpose();
    fit = fringe_normal_matrix(shifts_rad).inverse() * model.transpose();
    rest = Eigen::MatrixXd::Identity(model.rows(), model.rows()) - model * fit;
  }
};

/// Change of the counts from column to column and from row to row.
Eigen::Vector2d slope_at(const Frame& frame, int x, int y) {
  const auto at = [&](int dx, int dy) {
    return static_cast<double>(counts_at(frame,
                                         std::clamp(x + dx, 0, width_of(frame) - 1),
                                         std::clamp(y + dy, 0, height_of(frame) - 1)));
  };
  return 0.5 * Eigen::Vector2d(at(1, 0) - at(-1, 0), at(0, 1) - at(0, -1));
}

/// The largest odd number up to this one: an odd number of pixels from one to the next keeps odd
/// and even columns.
int odd_up_to(double number) {
  return 2 * static_cast<int>(0.5 * std::max(0.0, number - 0.5)) + 1;
}

/// Reads the counts of a pixel, one per frame; returns whether none is saturated.
bool read_counts(const FrameStack& stack, int x, int y, Eigen::VectorXd& counts) {
  bool saturated = false;
  for (std::size_t k = 0; k < stack.frames.size(); ++k) {
    const int found = counts_at(stack.frames[k], x, y);
    counts(static_cast<Eigen::Index>(k)) = found;
    saturated = saturated || found >= stack.white_level;
  }
  return !saturated;
}

/// A pixel with fringes.
struct LitPixel {
  int x = 0;
  int y = 0;
  double modulation = 0.0;
};

std::vector<LitPixel> lit_pixels(const FrameStack& stack, const FringeFit& fringe) {
  const int width = width_of(stack.frames.front());
  const int height = height_of(stack.frames.front());
  const int stride =
      odd_up_to(static_cast<double>(width) * height / static_cast<double>(kGridPixels));
  std::vector<LitPixel> out;
  std::vector<double> modulations;
  Eigen::VectorXd counts(fringe.model.rows());
  for (int y = 0; y < height; ++y) {
    for (int x = y % stride; x < width; x += stride) {
      if (!read_counts(stack, x, y, counts)) continue;
      const double cosine = fringe.fit.row(1).dot(counts);
      const double sine = fringe.fit.row(2).dot(counts);
      out.push_back({x, y, std::hypot(cosine, sine)});
      modulations.push_back(out.back().modulation);
    }
  }
  if (out.empty()) return out;
  const auto bright = modulations.begin() + std::ssize(modulations) * 99 / 100;
  std::nth_element(modulations.begin(), bright, modulations.end());
  const double least = std::max(1.0, kLeastOfBright * *bright);
  std::erase_if(out, [&](const LitPixel& one) { return one.modulation < least; });
  return out;
}

BandSamples sample_rows(const FrameStack& stack, const FringeFit& fringe) {
  const int height = height_of(stack.frames.front());
  BandSamples out;
  out.rows_per_block = std::max(1, height / kBlocks);
  out.blocks = (height + out.rows_per_block - 1) / out.rows_per_block;
  const std::vector<LitPixel> lit = lit_pixels(stack, fringe);
  if (lit.empty()) return out;
  const auto every = static_cast<std::size_t>(
      odd_up_to(static_cast<double>(lit.size()) / static_cast<double>(kBandPixels)));
  out.counts.resize(fringe.model.rows(),
                    static_cast<Eigen::Index>((lit.size() + every - 1) / every));
  out.across.resize(out.counts.rows(), out.counts.cols());
  out.down.resize(out.counts.rows(), out.counts.cols());
  Eigen::VectorXd counts(fringe.model.rows());
  for (std::size_t i = 0; i < lit.size(); i += every) {
    const auto pixel = static_cast<Eigen::Index>(i / every);
    static_cast<void>(read_counts(stack, lit[i].x, lit[i].y, counts));
    out.counts.col(pixel) = counts;
    for (std::size_t k = 0; k < stack.frames.size(); ++k) {
      const Eigen::Vector2d slope = slope_at(stack.frames[k], lit[i].x, lit[i].y);
      out.across(static_cast<Eigen::Index>(k), pixel) = slope.x();
      out.down(static_cast<Eigen::Index>(k), pixel) = slope.y();
    }
    out.block.push_back(lit[i].y / out.rows_per_block);
    out.is_odd.push_back(lit[i].x % 2 == 1);
  }
  return out;
}

/// Gains by frame (row) and block (column); NaN where a block has too few pixels, or of one phase.
using BlockGains = Eigen::MatrixXd;

/// Which columns a fit uses.
enum class Columns { Even, All };

/// The light of a pixel without gains.
Eigen::VectorXd evened(const BandSamples& samples, std::size_t pixel, const BlockGains& gains) {
  return samples.counts.col(static_cast<Eigen::Index>(pixel)).array() /
         (1.0 + gains.col(samples.block[pixel]).array());
}

BlockGains fit_gains(const BandSamples& samples,
                     const FringeFit& fringe,
                     Columns columns,
                     int rounds) {
  const Eigen::Index frames = fringe.model.rows();
  BlockGains gains = BlockGains::Zero(frames, samples.blocks);
  for (int round = 0; round < rounds; ++round) {
    std::vector<Eigen::MatrixXd> normal(static_cast<std::size_t>(samples.blocks),
                                        Eigen::MatrixXd::Zero(frames, frames));
    std::vector<Eigen::VectorXd> right(normal.size(), Eigen::VectorXd::Zero(frames));
    std::vector<std::complex<double>> turn(normal.size());
    std::vector<std::size_t> count(normal.size());
    std::vector<double> square(normal.size());
    for (std::size_t pixel = 0; pixel < samples.block.size(); ++pixel) {
      if (columns == Columns::Even && samples.is_odd[pixel]) continue;
      const auto block = static_cast<std::size_t>(samples.block[pixel]);
      if (gains.col(samples.block[pixel]).hasNaN()) continue;
      const Eigen::VectorXd light = evened(samples, pixel, gains);
      const Eigen::Vector3d found = fringe.fit * light;
      const Eigen::VectorXd shown = fringe.model * found;
      const Eigen::VectorXd rest = fringe.rest * light;
      normal[block] += shown.asDiagonal() * fringe.rest * shown.asDiagonal();
      right[block] += shown.cwiseProduct(rest);
      turn[block] += std::polar(1.0, std::atan2(found(2), found(1)));
      square[block] += rest.squaredNorm();
      ++count[block];
    }
    for (std::size_t block = 0; block < normal.size(); ++block) {
      const auto pixels = static_cast<double>(count[block]);
      auto of_block = gains.col(static_cast<Eigen::Index>(block));
      if (count[block] < kFewestInBlock || std::abs(turn[block]) > kOneSided * pixels) {
        of_block.setConstant(NAN);
        continue;
      }
      // The prior over the variance of a residual.
      const double variance = square[block] / (pixels * static_cast<double>(frames - 3));
      normal[block].diagonal().array() += variance / (kPriorBand * kPriorBand);
      const Eigen::VectorXd step = normal[block].ldlt().solve(right[block]);
      of_block.array() = (1.0 + of_block.array()) * (1.0 + step.array()) - 1.0;
      of_block.array() -= of_block.mean();
    }
  }
  return gains;
}

/// The gains of whole frames: the mean over the blocks.
BlockGains of_whole_frames(const BlockGains& gains) {
  BlockGains out = gains;
  for (Eigen::Index frame = 0; frame < gains.rows(); ++frame) {
    double sum = 0.0;
    double count = 0.0;
    for (Eigen::Index block = 0; block < gains.cols(); ++block) {
      if (std::isnan(gains(frame, block))) continue;
      sum += gains(frame, block);
      count += 1.0;
    }
    for (Eigen::Index block = 0; block < gains.cols(); ++block)
      if (!std::isnan(gains(frame, block))) out(frame, block) = sum / count;
  }
  return out;
}

/// Sum of the squared residuals of the odd columns.
double left_by(const BandSamples& samples, const FringeFit& fringe, const BlockGains& gains) {
  double sum = 0.0;
  for (std::size_t pixel = 0; pixel < samples.block.size(); ++pixel) {
    if (!samples.is_odd[pixel] || gains.col(samples.block[pixel]).hasNaN()) continue;
    sum += (fringe.rest * evened(samples, pixel, gains)).squaredNorm();
  }
  return sum;
}

/// What is left of the residuals of the odd columns where each frame has a gain and is displaced,
/// as by a camera that shook: frame k changes by its displacement along the slopes of its counts.
/// At the upper and lower border of a part this looks like bands.
double left_by_motion(const BandSamples& samples,
                      const FringeFit& fringe,
                      const BlockGains& gains) {
  constexpr Eigen::Index kUnknowns = 3;  // of each frame: gain, displacement across and down
  const Eigen::Index frames = fringe.model.rows();
  const auto counted = [&](std::size_t pixel) { return !gains.col(samples.block[pixel]).hasNaN(); };
  const auto design = [&](std::size_t pixel) {
    const auto column = static_cast<Eigen::Index>(pixel);
    const Eigen::VectorXd shown = fringe.model * (fringe.fit * samples.counts.col(column));
    Eigen::MatrixXd out(frames, kUnknowns * frames);
    out << fringe.rest * shown.asDiagonal(), fringe.rest * samples.across.col(column).asDiagonal(),
        fringe.rest * samples.down.col(column).asDiagonal();
    return out;
  };
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(kUnknowns * frames, kUnknowns * frames);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(kUnknowns * frames);
  for (std::size_t pixel = 0; pixel < samples.block.size(); ++pixel) {
    if (samples.is_odd[pixel] || !counted(pixel)) continue;
    const Eigen::MatrixXd of_pixel = design(pixel);
    normal += of_pixel.transpose() * of_pixel;
    right +=
        of_pixel.transpose() * fringe.rest * samples.counts.col(static_cast<Eigen::Index>(pixel));
  }
  normal.diagonal() *= 1.0 + 1e-6;  // what all frames share leaves no residual
  const Eigen::VectorXd found = normal.ldlt().solve(right);
  double sum = 0.0;
  for (std::size_t pixel = 0; pixel < samples.block.size(); ++pixel) {
    if (!samples.is_odd[pixel] || !counted(pixel)) continue;
    sum +=
        (fringe.rest * samples.counts.col(static_cast<Eigen::Index>(pixel)) - design(pixel) * found)
            .squaredNorm();
  }
  return sum;
}

/// The gains of each row, between the middles of the blocks that have some.
std::vector<float> by_rows(const Eigen::RowVectorXd& of_blocks, int rows_per_block, int height) {
  std::vector<std::pair<double, double>> known;  // middle of a block, gain
  for (Eigen::Index block = 0; block < of_blocks.size(); ++block) {
    if (std::isnan(of_blocks(block))) continue;
    known.emplace_back((static_cast<double>(block) + 0.5) * rows_per_block - 0.5, of_blocks(block));
  }
  std::vector<float> out;
  std::size_t next = 0;
  for (int y = 0; y < height; ++y) {
    while (next < known.size() && known[next].first < y)
      ++next;
    if (next == 0 || next == known.size()) {
      out.push_back(static_cast<float>(known[next == 0 ? 0 : next - 1].second));
      continue;
    }
    const auto& [from, before] = known[next - 1];
    const auto& [to, after] = known[next];
    out.push_back(static_cast<float>(before + (after - before) * (y - from) / (to - from)));
  }
  return out;
}

template <typename Count>
Image<Count> evened(const Image<Count>& frame, const std::vector<float>& gains, int white_level) {
  Image<Count> out(frame.width(), frame.height());
  parallel_rows(frame.height(), [&](int y) {
    const float factor = 1.0F / (1.0F + gains[static_cast<std::size_t>(y)]);
    for (int x = 0; x < frame.width(); ++x) {
      const Count counts = frame(x, y);
      const float light = std::round(factor * static_cast<float>(counts));
      out(x, y) = counts >= white_level
                      ? counts
                      : static_cast<Count>(std::min(light, static_cast<float>(white_level - 1)));
    }
  });
  return out;
}

}  // namespace

std::optional<LightBands> find_light_bands(const FrameStack& fringes) {
  const Pattern& pattern = fringes.pattern;
  if (pattern.kind != PatternKind::Fringe || pattern.exposure_count() > 1 ||
      fringes.frames.size() != pattern.shifts_rad.size() ||
      fringes.frames.size() < kFewestBandFrames)
    return std::nullopt;
  const FringeFit fringe(pattern.shifts_rad);
  const BandSamples samples = sample_rows(fringes, fringe);
  const BlockGains tried = fit_gains(samples, fringe, Columns::Even, 1);
  const auto with_gains = (tried.row(0).array() == tried.row(0).array()).count();
  if (with_gains < kFewestBlocks) return std::nullopt;
  const double by_bands = left_by(samples, fringe, tried);
  if (by_bands > kLeftByBands * left_by(samples, fringe, of_whole_frames(tried)))
    return std::nullopt;
  if (by_bands > kLeftByBands * left_by_motion(samples, fringe, tried)) return std::nullopt;
  const BlockGains gains = fit_gains(samples, fringe, Columns::All, kBandRounds);
  const Eigen::ArrayXXd known = gains.array().isNaN().select(0.0, gains.array());
  LightBands out;
  out.rms = std::sqrt(known.square().sum() /
                      static_cast<double>((gains.array() == gains.array()).count()));
  if (out.rms < kLeastBand || known.abs().maxCoeff() > kMostBand) return std::nullopt;
  const int height = height_of(fringes.frames.front());
  for (Eigen::Index frame = 0; frame < gains.rows(); ++frame)
    out.gains.push_back(by_rows(gains.row(frame), samples.rows_per_block, height));
  return out;
}

FrameStack without_bands(const FrameStack& fringes, const LightBands& bands) {
  FrameStack out = fringes;
  for (std::size_t k = 0; k < out.frames.size(); ++k) {
    out.frames[k] = std::visit(
        [&](const auto& image) -> Frame {
          return evened(image, bands.gains[k], fringes.white_level);
        },
        fringes.frames[k]);
  }
  return out;
}

std::string describe(const LightBands& bands, const std::string& pattern) {
  return fmt::format(
      "pattern \"{}\": the light differs from row to row by {:.1f} % rms, in bands that move from "
      "frame to frame, as a camera with a rolling shutter sees light that flickers; it is "
      "compensated; expose for whole periods of the projector or the lamp",
      pattern,
      100.0 * bands.rms);
}

}  // namespace frangia
