#include "frangia/phase/temporal/internal/sequence_sample.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <numeric>
#include <utility>

#include "frangia/core/angles.h"
#include "frangia/core/missing.h"
#include "frangia/core/random.h"
#include "frangia/core/statistics.h"
#include "frangia/phase/internal/fringe_curve.h"
#include "frangia/phase/internal/fringe_frequency.h"
#include "frangia/phase/internal/jumpless_regions.h"
#include "frangia/phase/internal/sample_columns.h"
#include "frangia/phase/temporal/internal/phase_ripple.h"
#include "frangia/phase/temporal/unwrap_sequence.h"
#include "frangia/phase/waveform/frame_samples.h"
#include "frangia/rig/rig.h"

namespace frangia {
namespace {

double counts_of(const Frame& frame, std::size_t pixel) {
  return std::visit([&](const auto& image) { return static_cast<double>(image.pixels()[pixel]); },
                    frame);
}

/// How far phases gather at one of a turn: from 0, everywhere, to 1, all alike.
double concentration(const std::vector<float>& phases_rad) {
  std::complex<double> sum = 0.0;
  for (const float phase : phases_rad)
    sum += std::polar(1.0, static_cast<double>(phase));
  return std::abs(sum) / static_cast<double>(phases_rad.size());
}

/// Concentration beyond that of the predicted phases above which a map has lost its own.
constexpr double kCollapsed = 0.3;

float random_phase(std::size_t map, std::size_t pixel) {
  return static_cast<float>(kTwoPi * uniform_from(hash(hash(map), pixel)) - kPi);
}

}  // namespace

SequenceSample::SequenceSample(std::span<const SequenceFrames> maps,
                               const NoiseModel& noise,
                               const Projector& projector,
                               const WrapOptions& wrap,
                               const SequenceCheckOptions& options)
    : projector_(projector) {
  for (const SequenceFrames& map : maps) {
    const bool columns = map.stack->pattern.direction == FringeDirection::Horizontal;
    patterns_.push_back(map.stack->pattern);
    FrameStack lines = columns ? sample_columns(*map.stack, options.pixels)
                               : sample_rows(*map.stack, options.pixels);
    maps_.push_back(wrap_phase(lines, map.algorithm, noise, wrap));
    if (map.correction) {
      WrappedPhase corrected = maps_.back();
      correct_response(*map.correction, corrected);
      corrected_rad_.push_back(std::move(corrected.phase_rad));
    } else {
      corrected_rad_.push_back(maps_.back().phase_rad);
    }
    frames_.push_back(std::move(lines.frames));
  }
  const PhaseRange field = phase_range(patterns_.front(), projector);
  const double per_unit = patterns_.front().fringes_per_unit();
  first_ = field.min_rad / (kTwoPi * per_unit);
  last_ = field.max_rad / (kTwoPi * per_unit);
  choose_pixels(options);
}

bool SequenceSample::is_measured(std::size_t pixel) const {
  return std::all_of(maps_.begin(), maps_.end(), [&](const WrappedPhase& map) {
    return map.status.pixels()[pixel] == PixelStatus::Measured;
  });
}

void SequenceSample::choose_pixels(const SequenceCheckOptions& options) {
  const int width = maps_.front().status.width();
  std::vector<std::size_t> measured;
  std::vector<int> lit_lines;
  constexpr std::size_t kMinLine = 32;  // measured pixels of a line
  for (int y = 0; y < maps_.front().status.height(); ++y) {
    const std::size_t before = measured.size();
    for (int x = 0; x < width; ++x) {
      const auto pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                         static_cast<std::size_t>(x);
      if (is_measured(pixel)) measured.push_back(pixel);
    }
    if (measured.size() - before >= kMinLine) lit_lines.push_back(y);
  }
  const std::size_t compared = std::min(measured.size(), options.compared);
  for (std::size_t i = 0; i < compared; ++i)
    compared_.push_back(measured[i * measured.size() / compared]);
  const std::size_t lines = std::min(lit_lines.size(), options.rows);
  for (std::size_t i = 0; i < lines; ++i)
    lines_.push_back(lit_lines[i * lit_lines.size() / lines]);
}

std::vector<float> SequenceSample::wrapped(const Pattern& pattern,
                                           std::size_t frames_of,
                                           std::span<const std::size_t> pixels) const {
  const PhaseAlgorithm algorithm = least_squares(pattern.shifts_rad);
  const std::vector<Frame>& frames = frames_[frames_of];
  std::vector<double> counts(frames.size());
  std::vector<float> phases;
  phases.reserve(pixels.size());
  for (const std::size_t pixel : pixels) {
    for (std::size_t k = 0; k < frames.size(); ++k)
      counts[k] = counts_of(frames[k], pixel);
    phases.push_back(static_cast<float>(phase_of(algorithm, counts)));
  }
  return phases;
}

SequenceSample::Phases SequenceSample::phases_of(const SequenceTrial& trial,
                                                 std::span<const std::size_t> pixels) const {
  Phases phases(maps_.size());
  for (const ChangedPattern& change : trial.changes) {
    const bool same = change.frames_of == change.map &&
                      change.pattern.shifts_rad == patterns_[change.map].shifts_rad;
    if (!same) phases[change.map] = wrapped(change.pattern, change.frames_of, pixels);
  }
  for (std::size_t m = 0; m < maps_.size(); ++m) {
    if (!phases[m].empty()) continue;
    for (const std::size_t pixel : pixels)
      phases[m].push_back(maps_[m].phase_rad.pixels()[pixel]);
  }
  return phases;
}

std::vector<double> SequenceSample::frequencies_of(const SequenceTrial& trial) const {
  std::vector<double> per_unit;
  for (const Pattern& pattern : patterns_)
    per_unit.push_back(pattern.fringes_per_unit());
  for (const ChangedPattern& change : trial.changes)
    per_unit[change.map] = change.pattern.fringes_per_unit();
  return per_unit;
}

double SequenceSample::median_distance(const std::vector<double>& per_unit,
                                       const Phases& phases) const {
  FringeCurve curve(per_unit, first_, last_);
  std::vector<float> distances;
  std::vector<float> pixel(phases.size());
  for (std::size_t i = 0; i < phases.front().size(); ++i) {
    for (std::size_t m = 0; m < phases.size(); ++m)
      pixel[m] = phases[m][i];
    distances.push_back(curve.nearest(pixel).distance_rad);
  }
  return static_cast<double>(median_in_place(std::span(distances)));
}

double SequenceSample::misfit(const SequenceTrial& trial) const {
  return median_distance(frequencies_of(trial), phases_of(trial, compared_));
}

double SequenceSample::chance(const SequenceTrial& trial) const {
  const Phases known = phases_of(trial, compared_);
  std::vector<std::size_t> unrelated;
  for (const ChangedPattern& change : trial.changes)
    unrelated.push_back(change.map);
  if (unrelated.empty()) {
    for (std::size_t m = 0; m < maps_.size(); ++m)
      unrelated.push_back(m);
  }
  double least = std::numeric_limits<double>::max();
  for (const std::size_t m : unrelated) {
    Phases phases = known;
    for (std::size_t i = 0; i < phases[m].size(); ++i)
      phases[m][i] = random_phase(m, i);
    least = std::min(least, median_distance(frequencies_of(trial), phases));
  }
  return least;
}

double SequenceSample::expected_misfit(std::span<const double> systematic_rad) const {
  const std::vector<double> per_unit = frequencies_of({});
  Phases phases(maps_.size());
  for (std::size_t m = 0; m < maps_.size(); ++m) {
    const double systematic = systematic_rad.empty() ? 0.0 : systematic_rad[m];
    for (std::size_t i = 0; i < compared_.size(); ++i) {
      const double unit = first_ + (last_ - first_) * uniform_from(hash(7, i));
      const double noise = std::hypot(maps_[m].sigma_rad.pixels()[compared_[i]], systematic);
      const double phase = kTwoPi * per_unit[m] * unit + noise * normal_from(hash(hash(m), i));
      phases[m].push_back(static_cast<float>(wrap_rad(phase)));
    }
  }
  return median_distance(per_unit, phases);
}

std::vector<PlacedResiduals> SequenceSample::residuals() const {
  const std::vector<double> per_unit = frequencies_of({});
  const Phases phases = phases_of({}, compared_);
  const auto width = static_cast<std::size_t>(maps_.front().status.width());
  const auto height = static_cast<double>(maps_.front().status.height());
  FringeCurve curve(per_unit, first_, last_);
  std::vector<float> pixel(phases.size());
  std::vector<PlacedResiduals> out;
  for (std::size_t i = 0; i < compared_.size(); ++i) {
    for (std::size_t m = 0; m < phases.size(); ++m)
      pixel[m] = phases[m][i];
    const auto unit = static_cast<double>(curve.nearest(pixel).unit);
    const std::size_t row = compared_[i] / width;
    PlacedResiduals placed{
        .x = static_cast<double>(compared_[i] % width) / static_cast<double>(width),
        .y = static_cast<double>(row) / height,
        .residuals_rad = {}};
    for (std::size_t m = 0; m < phases.size(); ++m)
      placed.residuals_rad.push_back(wrap_rad(pixel[m] - kTwoPi * per_unit[m] * unit));
    out.push_back(std::move(placed));
  }
  return out;
}

double SequenceSample::split_lines(const SequenceTrial& trial) const {
  const int width = maps_.front().status.width();
  const double field = last_ - first_;
  FringeCurve curve(frequencies_of(trial), first_, last_);
  std::vector<std::size_t> pixels(static_cast<std::size_t>(width));
  std::vector<float> pixel(maps_.size());
  std::size_t split = 0;
  for (const int y : lines_) {
    for (std::size_t x = 0; x < pixels.size(); ++x)
      pixels[x] = static_cast<std::size_t>(y) * pixels.size() + x;
    const Phases phases = phases_of(trial, pixels);
    std::vector<double> places(pixels.size(), kMissing);
    for (std::size_t x = 0; x < pixels.size(); ++x) {
      if (!is_measured(pixels[x])) continue;
      for (std::size_t m = 0; m < phases.size(); ++m)
        pixel[m] = phases[m][x];
      places[x] = (static_cast<double>(curve.nearest(pixel).unit) - first_) / field;
    }
    if (is_split(places)) ++split;
  }
  return lines_.empty() ? 0.0 : static_cast<double>(split) / static_cast<double>(lines_.size());
}

std::vector<double> SequenceSample::slope_ratios(std::size_t map, std::size_t reference) const {
  constexpr int kRun = 8;             // pixels over which slopes are averaged
  constexpr double kMinChange = 0.8;  // rad over a run, of the reference
  const auto step = [&](std::size_t m, std::size_t pixel) {
    const auto phases = maps_[m].phase_rad.pixels();
    return wrap_rad(static_cast<double>(phases[pixel + 1] - phases[pixel]));
  };
  const int width = maps_.front().status.width();
  std::vector<double> ratios;
  for (int y = 0; y < maps_.front().status.height(); ++y) {
    for (int x = 0; x + kRun < width; x += kRun) {
      const auto first = static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                         static_cast<std::size_t>(x);
      double change = 0.0;
      double of_reference = 0.0;
      bool measured = is_measured(first);
      for (std::size_t pixel = first; measured && pixel < first + kRun; ++pixel) {
        measured = is_measured(pixel + 1);
        change += step(map, pixel);
        of_reference += step(reference, pixel);
      }
      if (measured && std::abs(of_reference) > kMinChange) ratios.push_back(change / of_reference);
    }
  }
  return ratios;
}

double SequenceSample::frequency_by_slopes(std::size_t map) const {
  constexpr std::size_t kFewest = 100;  // runs
  constexpr double kUncertain = 0.04;   // of the ratio of slopes
  std::size_t reference = map == 0 ? 1 : 0;
  for (std::size_t m = 0; m < maps_.size(); ++m) {
    if (m != map && patterns_[m].fringes_per_unit() > patterns_[reference].fringes_per_unit())
      reference = m;
  }
  std::vector<double> ratios = slope_ratios(map, reference);
  if (ratios.size() < kFewest) return 0.0;
  const double about = median_in_place(std::span(ratios)) * patterns_[reference].fringes_per_unit();
  if (!(about > 0.0)) return 0.0;
  // The slopes tell it to some percent, the places within the beat of the other maps to more.
  double best = 0.0;
  double least = std::numeric_limits<double>::max();
  const auto look = [&](double from, double to, double step_per_unit) {
    const auto steps = static_cast<std::size_t>(std::max((to - from) / step_per_unit, 0.0));
    for (std::size_t i = 0; i <= steps; ++i) {
      const double per_unit = from + static_cast<double>(i) * step_per_unit;
      const double found = misfit(period_trial(patterns_, map, per_unit));
      if (found >= least) continue;
      least = found;
      best = per_unit;
    }
  };
  const double fringe = 1.0 / (last_ - first_);
  look((1.0 - kUncertain) * about, (1.0 + kUncertain) * about, 0.1 * fringe);
  look(best - 0.1 * fringe, best + 0.1 * fringe, 0.02 * fringe);
  return best;
}

std::vector<double> SequenceSample::places_by(std::span<const std::size_t> maps) const {
  std::vector<Pattern> patterns;
  std::vector<double> per_unit;
  for (const std::size_t m : maps) {
    patterns.push_back(patterns_[m]);
    per_unit.push_back(patterns_[m].fringes_per_unit());
  }
  if (patterns.empty() || !find_sequence_method(patterns, projector_)) return {};
  FringeCurve curve(per_unit, first_, last_);
  std::vector<float> pixel(maps.size());
  std::vector<double> places;
  for (const std::size_t i : compared_) {
    for (std::size_t m = 0; m < maps.size(); ++m)
      pixel[m] = corrected_rad_[maps[m]].pixels()[i];
    places.push_back(static_cast<double>(curve.nearest(pixel).unit));
  }
  return places;
}

std::vector<double> SequenceSample::places_by_coarser(std::size_t map) const {
  std::vector<std::size_t> coarser(map);
  std::iota(coarser.begin(), coarser.end(), std::size_t{0});
  return places_by(coarser);
}

std::optional<PredictedFrames> SequenceSample::predicted(std::size_t map) const {
  const std::vector<double> places = places_by_coarser(map);
  if (places.empty()) return {};
  const double per_unit = patterns_[map].fringes_per_unit();
  const std::vector<Frame>& frames = frames_[map];
  const auto pixels = std::ssize(places);
  PredictedFrames out{Eigen::ArrayXXd(pixels, std::ssize(frames)),
                      Eigen::ArrayXd::Zero(pixels),
                      Eigen::ArrayXd(pixels),
                      Eigen::ArrayXd(pixels)};
  for (Eigen::Index i = 0; i < pixels; ++i) {
    const auto at = static_cast<std::size_t>(i);
    for (std::size_t k = 0; k < frames.size(); ++k)
      out.counts(i, static_cast<Eigen::Index>(k)) = counts_of(frames[k], compared_[at]);
    for (std::size_t m = 0; m < map; ++m)
      out.mean(i) += static_cast<double>(maps_[m].mean_counts.pixels()[compared_[at]]) /
                     static_cast<double>(map);
    out.modulation(i) = maps_[map - 1].modulation_counts.pixels()[compared_[at]];
    out.phase_rad(i) = wrap_rad(kTwoPi * per_unit * places[at]);
  }
  return out;
}

double SequenceSample::ripple(std::size_t map) const {
  const std::vector<double> places = places_by_coarser(map);
  if (places.empty()) return 0.0;
  const double per_unit = patterns_[map].fringes_per_unit();
  std::vector<float> shown;
  std::vector<float> predicted;
  std::vector<double> errors;
  for (std::size_t i = 0; i < compared_.size(); ++i) {
    shown.push_back(corrected_rad_[map].pixels()[compared_[i]]);
    predicted.push_back(static_cast<float>(wrap_rad(kTwoPi * per_unit * places[i])));
    errors.push_back(wrap_rad(static_cast<double>(shown.back()) - kTwoPi * per_unit * places[i]));
  }
  // A frame of full light leaves few phases, of which none tells the others apart. Elsewhere the
  // predicted phases are the worse ones: the harmonics of coarser patterns are large there.
  const bool collapsed = concentration(shown) > concentration(predicted) + kCollapsed;
  return phase_ripple(collapsed ? predicted : shown, errors);
}

double SequenceSample::shown_frequency(std::size_t map) const {
  std::vector<std::size_t> others;
  for (std::size_t m = 0; m < maps_.size(); ++m)
    if (m != map) others.push_back(m);
  const std::vector<double> places = places_by(others);
  if (places.empty()) return frequency_by_slopes(map);
  std::vector<float> phases;
  for (const std::size_t pixel : compared_)
    phases.push_back(corrected_rad_[map].pixels()[pixel]);
  return best_frequency(places, phases, patterns_[map].fringes_per_unit(), last_ - first_);
}

}  // namespace frangia
