#include "frangia/phase/waveform/fit_waveform.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <optional>

#include "frangia/core/angles.h"
#include "frangia/phase/internal/fit_residuals.h"
#include "frangia/phase/internal/fringe_bins.h"
#include "frangia/phase/waveform/internal/fit_contrast.h"
#include "frangia/phase/waveform/internal/hidden_harmonics.h"

namespace frangia {
namespace {

constexpr std::size_t kMinFringePixels = 2000;  ///< fewer do not cover the fringe
/// With more frames, the gains of single frames hardly affect the phase.
constexpr std::size_t kMaxGainFrames = 32;
/// Fewer frames do not tell flicker from motion.
constexpr std::size_t kMinGainFrames = 5;
/// Largest gain of a frame that is flicker: the weights of a frame of hardly any light would grow
/// without bounds. Such a frame is at fault.
constexpr double kMaxGain = 0.3;
constexpr std::size_t kMaxSampledCounts = 1'600'000;  ///< pixels times frames
/// Least amplitude of a harmonic, and of an offset, that follows from the contrast. Texture and
/// uneven light leave up to 0.004 in sound scans (`./run figures harmonics`).
constexpr double kMinContrastHarmonic = 0.008;

/// Sets the lowest harmonic that leaves no residual, and the effect of flicker on few frames.
/// Returns the third harmonic of three frames where their mean shows it.
std::optional<std::complex<double>> add_contrast_fit(const FringeBins& bins,
                                                     const std::vector<double>& shifts_rad,
                                                     const ResidualFit& residuals,
                                                     const WaveformOptions& options,
                                                     bool with_gains,
                                                     WaveformFit& out) {
  const auto hidden = std::find(residuals.observable.begin(), residuals.observable.end(), false);
  if (hidden == residuals.observable.end()) return {};
  const auto i = static_cast<std::size_t>(hidden - residuals.observable.begin());
  const ContrastFit fit = fit_contrast(bins, shifts_rad, out.waveform, static_cast<int>(i) + 2);
  if (!fit.determined) return {};
  out.sigma[i] = fit.harmonic_sigma;
  const double amplitude = std::abs(fit.harmonic);
  if (amplitude > std::max(options.min_harmonic, kMinContrastHarmonic) &&
      amplitude > options.min_harmonic_sigmas * fit.harmonic_sigma)
    out.waveform.harmonics[i] = fit.harmonic;
  if (!with_gains) return fit.third;
  // Light that differed between the frames changes the contrast once per fringe, whatever residual
  // it leaves. Motion may do so, too, and shifts the phase alike.
  const double offset = std::abs(fit.offset);
  out.offset_sigma = fit.offset_sigma;
  if (offset > kMinContrastHarmonic && offset > options.min_flicker_sigmas * fit.offset_sigma)
    out.flicker_error_rad = offset / std::numbers::sqrt2;
  // Three frames leave no residual.
  out.is_flicker =
      out.flicker_error_rad > 0.0 && (shifts_rad.size() == 3 || residuals.gains_explain);
  return fit.third;
}

/// The effect of flicker on frames whose contrast does not show it, as on a small part: their
/// residual shows some combinations of the gains, and the others are as large.
void add_flicker_by_residual(const ResidualFit& residuals,
                             const WaveformOptions& options,
                             WaveformFit& out) {
  if (residuals.gain_chi2 < std::pow(options.min_flicker_sigmas, 2)) return;
  const auto frames = static_cast<double>(residuals.gains.size());
  double square = 0.0;
  for (const double gain : residuals.gains)
    square += gain * gain / (frames - 3.0);
  out.flicker_error_rad = std::sqrt(2.0 / frames * square) * out.mean_over_modulation;
  out.is_flicker = residuals.gains_explain;
}

/// Whether the shifts divide a turn evenly, in any order.
bool are_even(const std::vector<double>& shifts_rad) {
  constexpr double kSame_rad = 1e-3;
  const auto count = static_cast<double>(shifts_rad.size());
  std::complex<double> sum = 0.0;
  for (const double shift : shifts_rad) {
    if (std::abs(wrap_rad(count * (shift - shifts_rad.front()))) > count * kSame_rad) return false;
    sum += std::polar(1.0, shift);
  }
  return std::abs(sum) < count * kSame_rad;
}

}  // namespace

int WaveformFit::largest_harmonic() const {
  int largest = 0;
  for (int order = 2; order < 2 + static_cast<int>(waveform.harmonics.size()); ++order) {
    if (waveform.amplitude(order) > (largest == 0 ? 0.0 : waveform.amplitude(largest)))
      largest = order;
  }
  return largest;
}

double WaveformFit::flicker() const {
  double square = 0.0;
  for (const double gain : gains)
    square += gain * gain / static_cast<double>(gains.size());
  return std::sqrt(square);
}

WaveformFit fit_waveform(const FrameStack& stack,
                         const std::vector<double>& shifts_rad,
                         const NoiseModel& noise,
                         const WaveformOptions& options) {
  WaveformFit out;
  out.waveform.period_px = stack.pattern.period_px;
  out.waveform.direction = stack.pattern.direction;
  const std::size_t frames = shifts_rad.size();
  const FringeBins bins =
      bin_fringes(stack, shifts_rad, noise, std::min(options.samples, kMaxSampledCounts / frames));
  if (bins.pixels < kMinFringePixels) return out;
  out.mean_over_modulation = (bins.weight * bins.mean_over_modulation).sum() / bins.weight.sum();
  // The shifts of an angular projector are not exact: their errors and gains cannot be separated.
  const bool with_gains = stack.pattern.fringes_per_degree == 0.0 && frames <= kMaxGainFrames;
  const ResidualFit residuals = fit_residuals(bins, shifts_rad, with_gains);
  out.waveform.harmonics.assign(residuals.harmonics.size(), 0.0);
  out.sigma = residuals.sigma;
  for (std::size_t i = 0; i < residuals.harmonics.size(); ++i) {
    const double amplitude = std::abs(residuals.harmonics[i]);
    if (residuals.observable[i] && amplitude > options.min_harmonic &&
        amplitude > options.min_harmonic_sigmas * residuals.sigma[i])
      out.waveform.harmonics[i] = residuals.harmonics[i];
  }
  const auto third = add_contrast_fit(bins, shifts_rad, residuals, options, with_gains, out);
  if (with_gains && frames > 3 && out.flicker_error_rad == 0.0 &&
      !(out.offset_sigma < kMaxOffsetSigma))
    add_flicker_by_residual(residuals, options, out);
  if (with_gains && are_even(shifts_rad)) add_hidden_harmonics(frames, third, out);
  if (!with_gains || frames < kMinGainFrames || !residuals.gains_explain) return out;
  if (std::any_of(residuals.gains.begin(), residuals.gains.end(), [](double gain) {
        return std::abs(gain) > kMaxGain;
      }))
    return out;
  out.gains = residuals.gains;
  const double flicker = out.flicker();
  if (flicker < options.min_flicker ||
      flicker < options.min_flicker_sigmas * residuals.gain_sigma) {
    out.gains.clear();
  } else {
    out.flicker_error_rad = 0.0;  // is compensated
  }
  return out;
}

}  // namespace frangia
