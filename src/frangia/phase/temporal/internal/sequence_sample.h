#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "frangia/phase/temporal/check_sequence.h"
#include "frangia/phase/temporal/internal/sequence_trials.h"
#include "frangia/phase/temporal/predict_frames.h"
#include "frangia/phase/wrap/phase_map.h"

namespace frangia {

/// A sampled pixel: its place in the image, from 0 to 1, and the phase of each map beyond that of
/// the nearest place of the field.
struct PlacedResiduals {
  double x = 0.0;
  double y = 0.0;
  std::vector<double> residuals_rad;
};

/// Lines of pixels of all maps of a sequence, across the fringes, and how well their phases agree.
class SequenceSample {
 public:
  SequenceSample(std::span<const SequenceFrames> maps,
                 const NoiseModel& noise,
                 const Projector& projector,
                 const WrapOptions& wrap,
                 const SequenceCheckOptions& options);

  /// Number of pixels that are measured in all maps, up to `SequenceCheckOptions::compared`.
  [[nodiscard]] std::size_t size() const { return compared_.size(); }
  /// Patterns as declared.
  [[nodiscard]] const std::vector<Pattern>& patterns() const { return patterns_; }

  /// Median distance of the phases from those of one place of the field, rad.
  [[nodiscard]] double misfit(const SequenceTrial& trial = {}) const;
  /// The least misfit over the changed maps, or over all if none is changed, if the phase of one of
  /// them is unrelated to those of the others.
  [[nodiscard]] double chance(const SequenceTrial& trial = {}) const;
  /// The misfit of a sound sequence with the noise of the frames and a systematic error of each
  /// map, rad RMS; none if `systematic_rad` is empty.
  [[nodiscard]] double expected_misfit(std::span<const double> systematic_rad = {}) const;
  /// Share of the lines in which the ends of the field meet on a surface.
  [[nodiscard]] double split_lines(const SequenceTrial& trial = {}) const;
  /// The residuals of all pixels as declared.
  [[nodiscard]] std::vector<PlacedResiduals> residuals() const;
  /// The phase error of a map that repeats with its own phase, RMS, by the coarser maps; 0 where
  /// these do not determine the place in the field, or nothing repeats.
  [[nodiscard]] double ripple(std::size_t map) const;
  /// The frames of a map and what the coarser maps predict of their pixels; nothing where the
  /// coarser maps do not determine the place in the field.
  [[nodiscard]] std::optional<PredictedFrames> predicted(std::size_t map) const;
  /// The number of fringes per unit that the frames of a map show if the other maps are right; 0
  /// if no number fits. Where the other maps do not determine the place in the field, their slopes
  /// do.
  [[nodiscard]] double shown_frequency(std::size_t map) const;

 private:
  using Phases = std::vector<std::vector<float>>;  ///< one list per map

  [[nodiscard]] std::vector<float> wrapped(const Pattern& pattern,
                                           std::size_t frames_of,
                                           std::span<const std::size_t> pixels) const;
  [[nodiscard]] Phases phases_of(const SequenceTrial& trial,
                                 std::span<const std::size_t> pixels) const;
  [[nodiscard]] std::vector<double> frequencies_of(const SequenceTrial& trial) const;
  [[nodiscard]] double median_distance(const std::vector<double>& per_unit,
                                       const Phases& phases) const;
  /// How many times the phase of a map changes as much as that of another, over runs of pixels.
  [[nodiscard]] std::vector<double> slope_ratios(std::size_t map, std::size_t reference) const;
  /// The number of fringes per unit by which the phase of a map changes beside that of another one,
  /// refined by the misfit.
  [[nodiscard]] double frequency_by_slopes(std::size_t map) const;
  [[nodiscard]] bool is_measured(std::size_t pixel) const;  ///< in all maps
  /// The places of all pixels in the field by some of the maps; empty if these do not determine it.
  [[nodiscard]] std::vector<double> places_by(std::span<const std::size_t> maps) const;
  /// The places by the maps that are coarser than one.
  [[nodiscard]] std::vector<double> places_by_coarser(std::size_t map) const;
  void choose_pixels(const SequenceCheckOptions& options);

  const Projector& projector_;
  std::vector<Pattern> patterns_;
  std::vector<std::vector<Frame>> frames_;  ///< sampled lines; a line is a row of these frames
  std::vector<WrappedPhase> maps_;
  std::vector<Image<float>> corrected_rad_;  ///< their phases without the projector's response
  std::vector<std::size_t> compared_;        ///< pixels whose distances are computed
  std::vector<int> lines_;                   ///< in which the ends of the field are looked for
  double first_ = 0.0;                       ///< ends of the field
  double last_ = 0.0;
};

}  // namespace frangia
