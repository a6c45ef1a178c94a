#include "frangia/phase/waveform/fit_waveform.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <optional>

#include "frangia/core/angles.h"
#include "frangia/phase/internal/fit_residuals.h"
#include "frangia/phase/internal/fringe_curve.h"
#include "frangia/phase/waveform/internal/fit_contrast.h"

namespace frangia {
namespace {

/// Least amplitude of a significant harmonic, in standard deviations.
constexpr double kWaveformMinHarmonicSigmas = 5.0;

/// The same in standard deviations.
constexpr double kMinFlickerSigmas = 6.0;

/// Least RMS of significant gains.
constexpr double kMinFlicker = 0.003;

constexpr int kHighest = 13;  // beyond it a tenth of a pixel of blur leaves nothing
constexpr double kLeastThird = 0.02;
constexpr double kMostEven = 0.2;    // second over third harmonic of a square wave
constexpr double kMostTurned = 0.3;  // imaginary over real part
constexpr double kShare = 0.25;      // of what is added, its standard deviation
constexpr std::size_t kThree =
    3;  // frames that show the third harmonic in the logarithm of their mean

constexpr std::size_t index_of(int order) {
  return static_cast<std::size_t>(order - 2);
}

std::complex<double> harmonic_of(const WaveformFit& fit, int order) {
  const std::size_t i = index_of(order);
  return i < fit.waveform.harmonics.size() ? fit.waveform.harmonics[i] : 0.0;
}

/// Harmonic n of a square wave relative to its fundamental, after a blur with a sigma of `blur_rad`
/// of its phase.
double square_harmonic(int order, double blur_rad) {
  const double n = order;
  const double sign = order % 4 == 3 ? -1.0 : 1.0;
  return order % 2 == 0 ? 0.0 : sign / n * std::exp(-0.5 * (n * n - 1.0) * blur_rad * blur_rad);
}

/// The third harmonic that the fits find in N frames of a blurred square wave. Its harmonics shift
/// the phase to which they refer it, which makes it seem smaller.
double apparent_third(std::size_t frames, double blur_rad, double mean_over_modulation) {
  constexpr int kPhases = 120;
  constexpr std::size_t kSix = 6;  // show it as what alternates from frame to frame
  const auto count = static_cast<double>(frames);
  const bool is_real = frames == kThree || frames == kSix;
  double sums = 0.0;   // of weight, wave and value
  double waves = 0.0;  // of weight and square of the wave
  double mean_wave = 0.0;
  double mean_value = 0.0;
  for (int i = 0; i < kPhases; ++i) {
    const double phase = kTwoPi * (i + 0.5) / kPhases;
    std::complex<double> wave = 0.0;
    std::complex<double> third = 0.0;
    for (std::size_t k = 0; k < frames; ++k) {
      const double shift = kTwoPi * static_cast<double>(k) / count;
      double light = std::cos(phase + shift);
      for (int order = 3; order <= kHighest; order += 2)
        light += square_harmonic(order, blur_rad) * std::cos(order * (phase + shift));
      wave += 2.0 / count * light * std::polar(1.0, -shift);
      third += 2.0 / count * light * std::polar(1.0, frames == kThree ? 0.0 : -3.0 * shift);
    }
    const double modulation = std::abs(wave);
    const double cosine = std::cos(3.0 * std::arg(wave));
    if (frames == kThree) {
      const double value =
          mean_over_modulation * std::log1p(0.5 * third.real() / mean_over_modulation);
      mean_wave += cosine / kPhases;
      mean_value += value / kPhases;
      sums += cosine * value;
      waves += cosine * cosine;
    } else if (is_real) {
      sums += 0.5 * modulation * third.real() * cosine;
      waves += modulation * modulation * cosine * cosine;
    } else {
      sums += (third * std::polar(1.0, -3.0 * std::arg(wave))).real() / modulation;
      waves += 1.0;
    }
  }
  return (sums - kPhases * mean_wave * mean_value) / (waves - kPhases * mean_wave * mean_wave);
}

/// The blur of a square wave for which `value`, which rises from `low` on, is `found`.
template <typename Value>
double blur_of(double found, double low, const Value& value) {
  constexpr int kHalvings = 20;
  double high = 1.5;  // rad: nothing of the third is left
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (value(middle) < found ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// Three frames of a sharp wave measure few different phases, which makes their third harmonic seem
/// up to 7 % smaller, and the blur that follows from it larger.
void add_uncertainty_of_blur(double blur, WaveformFit& fit) {
  constexpr double kApparent = 0.07;
  constexpr double kProbe_rad = 0.01;
  const double mean = std::max(1.0, fit.mean_over_modulation);
  const double slope =
      (apparent_third(kThree, blur + kProbe_rad, mean) - apparent_third(kThree, blur, mean)) /
      kProbe_rad;
  if (!(slope > 0.0)) return;
  const double blur_sigma = -kApparent * apparent_third(kThree, blur, mean) / slope;
  for (int order = 5; order <= kHighest; order += 2) {
    const double size = std::abs(square_harmonic(order, blur));
    const double share = std::min(1.0, (order * order - 1) * blur * blur_sigma);
    fit.sigma[index_of(order)] = std::max(fit.sigma[index_of(order)], share * size);
  }
}

/// Replaces what frames of a square wave seem to show by its odd harmonics.
void add_square_wave(std::size_t frames, double third, WaveformFit& fit) {
  fit.is_square = true;
  constexpr std::size_t kFour = 4;
  // Four frames show the sum of the third and the fifth, which is least at exp(8 x^2) = 1.8.
  const double blur =
      frames == kFour
          ? blur_of(third,
                    std::sqrt(std::log(1.8) / 8.0),
                    [](double at) { return square_harmonic(3, at) + square_harmonic(5, at); })
          : blur_of(third, 0.0, [&](double at) {
              return apparent_third(frames, at, std::max(1.0, fit.mean_over_modulation));
            });
  fit.waveform.harmonics.assign(index_of(kHighest) + 1, 0.0);
  const bool is_fitted = index_of(3) < fit.sigma.size() && std::isfinite(fit.sigma[index_of(3)]);
  const double third_sigma = is_fitted ? fit.sigma[index_of(3)] : 0.0;
  fit.sigma.assign(index_of(kHighest) + 1, 0.0);
  fit.sigma[index_of(3)] = third_sigma;
  for (int order = 3; order <= kHighest; order += 2) {
    fit.waveform.harmonics[index_of(order)] = square_harmonic(order, blur);
    if (order > 3) fit.sigma[index_of(order)] = kShare * std::abs(square_harmonic(order, blur));
  }
  if (frames == kThree) add_uncertainty_of_blur(blur, fit);
  if (frames != kFour) return;
  // A sharper wave has the same sum, within what the contrast tells.
  constexpr double kAmbiguous = -0.12;
  if (third > kAmbiguous) return;
  fit.sigma[index_of(5)] = std::abs(square_harmonic(5, 0.0) - square_harmonic(5, blur)) +
                           std::abs(square_harmonic(3, 0.0) - square_harmonic(3, blur));
}

/// Adds the fourth harmonic of three frames.
void add_power_law(const std::optional<std::complex<double>>& measured_third, WaveformFit& fit) {
  constexpr double kLeastShare = 0.02;  // of the second
  constexpr double kDeparture = 0.5;    // of the third, of the fourth
  const std::complex<double> found = harmonic_of(fit, 2);
  if (found == 0.0) return;
  const double second = found.real();
  const double gamma = (1.0 + 2.0 * second) / (1.0 - second);
  const double third = second * (gamma - 2.0) / (gamma + 3.0);
  const double fourth = third * (gamma - 3.0) / (gamma + 4.0);
  const double departure = measured_third ? std::abs(*measured_third - third) : 0.0;
  const std::size_t size = std::max<std::size_t>(fit.waveform.harmonics.size(), index_of(4) + 1);
  fit.waveform.harmonics.resize(size, 0.0);
  fit.sigma.resize(size, 0.0);
  fit.waveform.harmonics[index_of(4)] = fourth;
  // What the fourth is more, the second was found too large: the phase shifts by more than
  // the fourth says.
  fit.sigma[index_of(4)] = 1.5 * std::hypot(kLeastShare * second, kDeparture * departure);
}

/// Adds the harmonics that few frames do not tell from those that are found: harmonic N + 1 of N
/// frames changes the contrast as N - 1 does and shifts the phase the other way.
///
/// A square wave with any blur has odd harmonics alone, and the third one gives its blur and so all
/// others. Any other response of a projector is near a power law, whose fourth harmonic follows
/// from the second. The standard deviation of an added odd harmonic is a quarter of it; that of the
/// fourth follows from the second and from how far the third departs from a power law.
///
/// @shape    `third`: of three frames, from the ripple of their mean
void add_hidden_harmonics(std::size_t frames,
                          const std::optional<std::complex<double>>& third,
                          WaveformFit& fit) {
  const std::complex<double> odd = frames == 3 ? third.value_or(0.0) : harmonic_of(fit, 3);
  const bool is_square = odd.real() < -kLeastThird &&
                         std::abs(odd.imag()) < -kMostTurned * odd.real() &&
                         std::abs(harmonic_of(fit, 2)) < -kMostEven * odd.real();
  if (is_square) {
    add_square_wave(frames, odd.real(), fit);
  } else if (frames == 3) {
    add_power_law(third, fit);
  }
}

constexpr std::size_t kMinFringePixels = 2000;  ///< fewer do not cover the fringe
/// With more frames, the gains of single frames hardly affect the phase.
constexpr std::size_t kMaxGainFrames = 32;
/// Rounds of the fit of flicker, which shifts the phases by which the frames are sorted.
constexpr int kFlickerRounds = 2;
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
      amplitude > kWaveformMinHarmonicSigmas * fit.harmonic_sigma)
    out.waveform.harmonics[i] = fit.harmonic;
  if (!with_gains) return fit.third;
  // Light that differed between the frames changes the contrast once per fringe, whatever residual
  // it leaves. Motion may do so, too, and shifts the phase alike.
  const double offset = std::abs(fit.offset);
  out.offset_sigma = fit.offset_sigma;
  if (offset > kMinContrastHarmonic && offset > kMinFlickerSigmas * fit.offset_sigma)
    out.flicker_error_rad = offset / std::numbers::sqrt2;
  // Three frames leave no residual.
  out.is_flicker =
      out.flicker_error_rad > 0.0 && (shifts_rad.size() == 3 || residuals.gains_explain);
  return fit.third;
}

/// Rms error of the phase by independent errors of `frames` frames, relative to the modulation.
double phase_error_of(double rms_of_frames, std::size_t frames) {
  return std::sqrt(2.0 / static_cast<double>(frames)) * rms_of_frames;
}

/// Rms of the errors of all frames, where a residual shows some combinations of them.
double rms_shown(const std::vector<double>& errors) {
  double square = 0.0;
  for (const double error : errors)
    square += error * error / (static_cast<double>(errors.size()) - 3.0);
  return std::sqrt(square);
}

/// The effect of flicker on frames whose contrast does not show it, as on a small part: their
/// residual shows some combinations of the gains, and the others are as large.
void add_flicker_by_residual(const ResidualFit& residuals, WaveformFit& out) {
  if (residuals.gain_chi2 < std::pow(kMinFlickerSigmas, 2)) return;
  out.flicker_error_rad =
      phase_error_of(rms_shown(residuals.gains), residuals.gains.size()) * out.mean_over_modulation;
  out.is_flicker = residuals.gains_explain;
}

/// The effect of errors of the shifts on four frames whose contrast excludes gains: their residual
/// shows some combinations of the errors, and the others are as large.
void add_steps_by_residual(const ResidualFit& residuals, WaveformFit& out) {
  if (residuals.gain_chi2 < std::pow(kMinFlickerSigmas, 2)) return;
  // Such errors, in rad, leave what gains of the modulation leave.
  out.flicker_error_rad = phase_error_of(rms_shown(residuals.gains), residuals.gains.size());
  out.is_flicker = false;
}

double rms(const std::vector<double>& gains) {
  double square = 0.0;
  for (const double gain : gains)
    square += gain * gain / static_cast<double>(gains.size());
  return std::sqrt(square);
}

/// Whether the frames flickered, and tell it from motion.
bool determine_gains(const ResidualFit& residuals) {
  if (residuals.gains.size() < kMinGainFrames || !residuals.gains_explain) return false;
  const bool at_fault = std::any_of(residuals.gains.begin(),
                                    residuals.gains.end(),
                                    [](double gain) { return std::abs(gain) > kMaxGain; });
  const double flicker = rms(residuals.gains);
  return !at_fault && flicker >= kMinFlicker && flicker >= kMinFlickerSigmas * residuals.gain_sigma;
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
  return gains.empty() ? 0.0 : rms(gains);
}

void WaveformFit::count_gains() {
  if (gains.empty()) return;
  const double on_mean = (1.0 - steady_share) * mean_over_modulation;
  flicker_error_rad = std::hypot(
      flicker_error_rad, phase_error_of(std::hypot(on_mean, 1.0) * flicker(), gains.size()));
  is_flicker = false;  // more frames would not determine it
  gains.clear();
  steady_share = 0.0;
}

WaveformFit fit_waveform(const FrameStack& stack,
                         const std::vector<double>& shifts_rad,
                         const NoiseModel& noise,
                         const WaveformOptions& options) {
  WaveformFit out;
  out.waveform.period_px = stack.pattern.period_px;
  out.waveform.direction = stack.pattern.direction;
  const std::size_t frames = shifts_rad.size();
  const auto bins_by = [&](const PhaseAlgorithm& algorithm) {
    const std::size_t samples = std::min(options.samples, kMaxSampledCounts / frames);
    return bin_fringes(stack, shifts_rad, noise, samples, algorithm);
  };
  FringeBins bins = bins_by(least_squares(shifts_rad));
  if (bins.pixels < kMinFringePixels) return out;
  // The shifts of an angular projector are not exact: their errors and gains cannot be separated.
  const bool with_gains = stack.pattern.fringes_per_degree == 0.0 && frames <= kMaxGainFrames;
  ResidualFit residuals =
      fit_residuals(bins, shifts_rad, with_gains ? GainFit::Small : GainFit::None);
  const bool has_gains = with_gains && determine_gains(residuals);
  for (int round = 0; round < kFlickerRounds && has_gains; ++round) {
    PhaseAlgorithm algorithm = least_squares(shifts_rad);  // whose phases lack their effect
    compensate_gains(residuals.gains, residuals.steady_share, shifts_rad, algorithm);
    bins = bins_by(algorithm);
    residuals = fit_residuals(bins, shifts_rad, GainFit::Flicker);
  }
  out.mean_over_modulation = (bins.weight * bins.mean_over_modulation).sum() / bins.weight.sum();
  out.waveform.harmonics.assign(residuals.harmonics.size(), 0.0);
  out.sigma = residuals.sigma;
  for (std::size_t i = 0; i < residuals.harmonics.size(); ++i) {
    const double amplitude = std::abs(residuals.harmonics[i]);
    if (residuals.observable[i] && amplitude > options.min_harmonic &&
        amplitude > kWaveformMinHarmonicSigmas * residuals.sigma[i])
      out.waveform.harmonics[i] = residuals.harmonics[i];
  }
  const auto third = add_contrast_fit(bins, shifts_rad, residuals, options, with_gains, out);
  if (with_gains && frames > 3 && out.flicker_error_rad == 0.0) {
    if (!(out.offset_sigma < kMaxOffsetSigma))
      add_flicker_by_residual(residuals, out);
    else if (frames < kMinGainFrames)
      add_steps_by_residual(residuals, out);
  }
  if (with_gains && are_even(shifts_rad)) add_hidden_harmonics(frames, third, out);
  if (!has_gains) return out;
  out.gains = residuals.gains;
  out.steady_share = residuals.steady_share;
  out.flicker_error_rad = 0.0;  // is compensated
  return out;
}

}  // namespace frangia
