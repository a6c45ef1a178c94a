#include "frangia/phase/waveform/internal/fit_contrast.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "frangia/core/angles.h"
#include "frangia/core/linear_algebra.h"
#include "frangia/phase/algorithm/phase_algorithm.h"

namespace frangia {
namespace {

/// Least number of pixels of a tile.
constexpr double kMinTilePixels = 30.0;

/// The change of the mean with a multiple of the phase.
struct MeanRipple {
  std::complex<double> amplitude = 0.0;  ///< relative to the mean
  double sigma = 0.0;                    ///< of the amplitude
};

/// Fits log mean to cosine and sine of `multiple` times the phase within tiles. Texture is noise.
MeanRipple fit_mean_ripple(const FringeBins& bins, int multiple) {
  Eigen::Matrix2d all_normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d all_right = Eigen::Vector2d::Zero();
  std::vector<std::pair<Eigen::Matrix2d, Eigen::Vector2d>> tiles;
  for (Eigen::Index tile = 0; tile < bins.tile_count.cols(); ++tile) {
    const Eigen::ArrayXd count = bins.tile_count.col(tile);
    const double pixels = count.sum();
    if (pixels < kMinTilePixels) continue;
    const double mean = bins.tile_log_mean.col(tile).sum() / pixels;
    const auto wave = [&](int bin) {
      return Eigen::Vector2d(std::cos(multiple * bin_phase(bin)),
                             -std::sin(multiple * bin_phase(bin)));
    };
    Eigen::Vector2d mean_wave = Eigen::Vector2d::Zero();
    for (int bin = 0; bin < kPhaseBins; ++bin)
      mean_wave += count(bin) / pixels * wave(bin);
    Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
    Eigen::Vector2d right = Eigen::Vector2d::Zero();
    for (int bin = 0; bin < kPhaseBins; ++bin) {
      const Eigen::Vector2d row = wave(bin) - mean_wave;
      normal += count(bin) * row * row.transpose();
      right += row * (bins.tile_log_mean(bin, tile) - count(bin) * mean);
    }
    tiles.emplace_back(normal, right);
    all_normal += normal;
    all_right += right;
  }
  const Eigen::Vector2d found = solve_symmetric(all_normal, all_right);
  double variance = 0.0;
  for (const auto& [normal, right] : tiles) {
    const Eigen::Vector2d without = solve_symmetric(all_normal - normal, all_right - right);
    variance += 0.5 * (without - found).squaredNorm();
  }
  const auto count = static_cast<double>(std::max<std::size_t>(tiles.size(), 2));
  return {{found(0), found(1)}, std::sqrt(variance * (count - 1.0) / count)};
}

/// Projected phases per fringe at which the model is computed.
constexpr int kContrastPhases = 192;
constexpr int kContrastIterations = 6;  ///< the second one changes a harmonic of 20 % by 2 %
constexpr double kMaxAmplitude = 0.45;  ///< two phases would measure alike above 0.5
/// Third harmonic of a projector whose response is not a power law: standard deviation, relative to
/// the fundamental.
constexpr double kPriorThird = 0.01;
/// Least ripple of the mean that is not texture, in sigmas.
constexpr double kMinRippleSigmas = 5.0;
constexpr double kMinRipple = 0.008;  ///< least ripple of the mean that is not texture, relative
constexpr int kMinTiles = 6;          ///< fewer do not give a scatter
constexpr double kConvergedChange = 1e-5;   ///< far below the sigma of a harmonic
constexpr double kMinContrastPivot = 1e-4;  ///< of the normal matrix, relative

using Vector4 = Eigen::Vector4d;
using Matrix4 = Eigen::Matrix4d;

/// Logarithm of contrast over the measured phase, for given harmonics and offset.
class ContrastModel {
 public:
  ContrastModel(const std::vector<double>& shifts_rad,
                FringeWaveform known,
                int order,
                double mean_over_modulation,
                std::optional<std::complex<double>> third)
      : fit_(least_squares(shifts_rad)),
        shifts_(shifts_rad),
        waveform_(std::move(known)),
        order_(static_cast<std::size_t>(order)),
        mean_(mean_over_modulation),
        third_(third) {
    const std::size_t needed = order_ == 2 ? 3 : order_ - 1;
    if (waveform_.harmonics.size() < needed) waveform_.harmonics.resize(needed);
  }

  /// Values at the centres of the bins for (harmonic, offset).
  ///
  /// Three frames change contrast and mean with the same multiple of the phase: `third` replaces
  /// the third harmonic of the power law.
  [[nodiscard]] Eigen::ArrayXd at(const Vector4& unknown) {
    waveform_.harmonics[order_ - 2] = {unknown(0), unknown(1)};
    if (order_ == 2) add_power_law();
    const std::complex<double> offset(unknown(2), unknown(3));
    std::array<double, kContrastPhases + 1> measured{};
    std::array<double, kContrastPhases + 1> value{};
    for (std::size_t i = 0; i <= kContrastPhases; ++i) {
      const double phase = -kPi + kTwoPi * static_cast<double>(i) / kContrastPhases;
      // Gains that offset the wave by the mean times their first harmonic change the measured mean
      // by half of the modulation times it.
      double mean = mean_ + 0.5 * (offset * std::polar(1.0, -phase)).real() / mean_;
      std::complex<double> wave = offset;
      for (std::size_t k = 0; k < shifts_.size(); ++k) {
        const double light = waveform_.light_at(phase + shifts_[k]);
        mean += fit_.mean[k] * light;
        wave += std::complex<double>(fit_.cosine[k], fit_.sine[k]) * light;
      }
      value[i] = std::log(std::abs(wave) / std::max(mean, 1e-3));
      const double angle = std::arg(wave);
      measured[i] = i == 0 ? phase + wrap_rad(angle - phase)
                           : measured[i - 1] + wrap_rad(angle - measured[i - 1]);
    }
    Eigen::ArrayXd out(kPhaseBins);
    for (int bin = 0; bin < kPhaseBins; ++bin) {
      double wanted = bin_phase(bin);
      while (wanted < measured.front())
        wanted += kTwoPi;
      while (wanted > measured.back())
        wanted -= kTwoPi;
      const auto* const above = std::lower_bound(measured.begin() + 1, measured.end() - 1, wanted);
      const auto k = static_cast<std::size_t>(above - measured.begin());
      const double width = std::max(measured[k] - measured[k - 1], 1e-9);
      const double within = std::clamp((wanted - measured[k - 1]) / width, 0.0, 1.0);
      out(bin) = std::lerp(value[k - 1], value[k], within);
    }
    return out;
  }

 private:
  /// Three frames determine no third and fourth harmonic, which change the contrast with the same
  /// phase as the second: they are those of the power law with that second harmonic.
  void add_power_law() {
    const double second = waveform_.harmonics[0].real();
    const double gamma = (1.0 + 2.0 * second) / (1.0 - second);
    const double third = second * (gamma - 2.0) / (gamma + 3.0);
    waveform_.harmonics[1] = third_ ? *third_ : std::complex<double>(third);
    waveform_.harmonics[2] = third * (gamma - 3.0) / (gamma + 4.0);
  }

  PhaseAlgorithm fit_;
  std::vector<double> shifts_;
  FringeWaveform waveform_;
  std::size_t order_;
  double mean_;
  std::optional<std::complex<double>> third_;
};

/// Normal equations of one tile, without its mean contrast.
struct TileEquations {
  int column = 0;
  int row = 0;
  Matrix4 normal = Matrix4::Zero();
  Vector4 right = Vector4::Zero();
};

std::vector<TileEquations> tile_equations(const FringeBins& bins,
                                          const Eigen::ArrayXd& model,
                                          const Eigen::Array<double, Eigen::Dynamic, 4>& slope) {
  std::vector<TileEquations> tiles;
  for (Eigen::Index tile = 0; tile < bins.tile_count.cols(); ++tile) {
    const Eigen::ArrayXd count = bins.tile_count.col(tile);
    const double pixels = count.sum();
    if (pixels < kMinTilePixels) continue;
    const Eigen::ArrayXd departure = bins.tile_log_contrast.col(tile) - count * model;
    const double mean_departure = departure.sum() / pixels;
    Vector4 mean_slope = Vector4::Zero();
    for (int i = 0; i < 4; ++i)
      mean_slope(i) = (count * slope.col(i)).sum() / pixels;
    TileEquations equations{.column = static_cast<int>(tile) % kContrastTiles,
                            .row = static_cast<int>(tile) / kContrastTiles};
    for (int bin = 0; bin < kPhaseBins; ++bin) {
      if (count(bin) == 0.0) continue;
      const Vector4 row = slope.row(bin).transpose().matrix() - mean_slope;
      equations.normal += count(bin) * row * row.transpose();
      equations.right += row * (departure(bin) - count(bin) * mean_departure);
    }
    tiles.push_back(equations);
  }
  return tiles;
}

/// Share of the fringe that the pixels of all tiles cover.
double covered_share(const FringeBins& bins) {
  const Eigen::ArrayXd counts = bins.tile_count.rowwise().sum();
  return static_cast<double>((counts > 0.0).count()) / static_cast<double>(kPhaseBins);
}

/// The third harmonic of three frames, from the ripple of their mean.
struct ThirdHarmonic {
  std::optional<std::complex<double>> value;  ///< none where the power law has to do
  double sigma = 0.0;                         ///< of its error relative to the mean, times the mean
};

ThirdHarmonic third_of(const FringeBins& bins, double mean) {
  ThirdHarmonic third;
  const MeanRipple ripple = fit_mean_ripple(bins, 3);
  third.sigma = std::min(ripple.sigma * mean, kPriorThird);
  const double amplitude = std::abs(ripple.amplitude);
  if (amplitude > kMinRippleSigmas * ripple.sigma && amplitude > kMinRipple)
    third.value = ripple.amplitude * mean;
  return third;
}

TileEquations sum_of(const std::vector<TileEquations>& tiles) {
  TileEquations all;
  for (const TileEquations& tile : tiles) {
    all.normal += tile.normal;
    all.right += tile.right;
  }
  return all;
}

/// Jackknife: the scatter of the estimates without one column or row of tiles each. Light that
/// falls on a round part ever more obliquely changes the contrast alike all along it.
///
/// @shape    `line`: the column or row of a tile
Vector4 jackknife_variance(const std::vector<TileEquations>& tiles,
                           const TileEquations& all,
                           int TileEquations::*line) {
  std::array<TileEquations, kContrastTiles> lines{};
  for (const TileEquations& tile : tiles) {
    TileEquations& own = lines.at(static_cast<std::size_t>(tile.*line));
    own.normal += tile.normal;
    own.right += tile.right;
  }
  Vector4 variance = Vector4::Zero();
  double count = 0.0;
  for (const TileEquations& own : lines) {
    if (own.normal.isZero(0.0)) continue;
    const Vector4 without = solve_symmetric(all.normal - own.normal, all.right - own.right);
    variance += without.cwiseAbs2();
    count += 1.0;
  }
  return variance * (count - 1.0) / count;
}

/// Shortens two of the unknowns to the largest amplitude.
void limit(Eigen::Ref<Eigen::Vector2d> unknown) {
  const double amplitude = unknown.norm();
  if (amplitude > kMaxAmplitude) unknown *= kMaxAmplitude / amplitude;
}

}  // namespace

ContrastFit fit_contrast(const FringeBins& bins,
                         const std::vector<double>& shifts_rad,
                         const FringeWaveform& known,
                         int order) {
  ContrastFit out;
  // On part of a fringe, the contrasts of two surfaces pass for a harmonic or an offset.
  constexpr double kMinCovered = 0.75;
  out.offset_sigma = std::numeric_limits<double>::infinity();
  if (bins.weight.sum() == 0.0 || covered_share(bins) < kMinCovered) return out;
  const double mean = (bins.weight * bins.mean_over_modulation).sum() / bins.weight.sum();
  ThirdHarmonic third;
  if (order == 2) third = third_of(bins, mean);
  out.third = third.value;
  ContrastModel model(shifts_rad, known, order, mean, third.value);
  constexpr double kProbe = 1e-4;
  Vector4 unknown = Vector4::Zero();
  std::vector<TileEquations> tiles;
  TileEquations all;
  bool converged = false;
  for (int iteration = 0; iteration <= kContrastIterations; ++iteration) {
    const Eigen::ArrayXd here = model.at(unknown);
    Eigen::Array<double, Eigen::Dynamic, 4> slope(kPhaseBins, 4);
    for (int i = 0; i < 4; ++i)
      slope.col(i) = (model.at(unknown + kProbe * Vector4::Unit(i)) - here) / kProbe;
    tiles = tile_equations(bins, here, slope);
    if (tiles.size() < kMinTiles) return out;
    all = sum_of(tiles);
    const Eigen::LDLT<Matrix4> factors(all.normal);
    const Vector4 pivots = factors.vectorD();
    if (!(pivots.minCoeff() > kMinContrastPivot * pivots.maxCoeff())) return out;
    if (converged || iteration == kContrastIterations) break;
    const Vector4 change = factors.solve(all.right);
    unknown += change;
    converged = change.norm() < kConvergedChange;
    limit(unknown.head<2>());
    limit(unknown.tail<2>());
  }
  const Vector4 variance = jackknife_variance(tiles, all, &TileEquations::column)
                               .cwiseMax(jackknife_variance(tiles, all, &TileEquations::row));
  out.harmonic = {unknown(0), unknown(1)};
  // An error of the third harmonic of three frames passes for a second one.
  out.harmonic_sigma = std::hypot(std::sqrt(0.5 * (variance(0) + variance(1))), third.sigma / mean);
  out.offset = {unknown(2), unknown(3)};
  out.offset_sigma = std::sqrt(0.5 * (variance(2) + variance(3)));
  if (!std::isfinite(out.offset_sigma)) {
    out.offset = 0.0;
    out.offset_sigma = std::numeric_limits<double>::infinity();
  }
  out.determined = std::isfinite(out.harmonic_sigma);
  return out;
}

}  // namespace frangia
