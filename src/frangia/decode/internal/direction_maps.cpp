#include "frangia/decode/internal/direction_maps.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/core/image.h"
#include "frangia/decode/explain/explain_predicted_frames.h"
#include "frangia/decode/internal/wrap_pattern.h"
#include "frangia/decode/select_stacks.h"
#include "frangia/phase/blur/correct_blur.h"
#include "frangia/phase/blur/correct_pixel_area.h"
#include "frangia/phase/blur/estimate_blur.h"
#include "frangia/phase/temporal/check_sequence.h"
#include "frangia/phase/temporal/predict_frames.h"
#include "frangia/phase/waveform/contradicting_frames.h"
#include "frangia/phase/waveform/frame_samples.h"
#include "frangia/phase/waveform/systematic_phase.h"
#include "frangia/phase/wrap/decode_sequence.h"
#include "frangia/phase/wrap/merge_exposures.h"
#include "frangia/range/measured_volume.h"

namespace frangia {
namespace {

/// The weights of the errors of all maps in the slope of phase over frequency, if their modulations
/// are equal.
std::vector<double> sequence_weights(const DirectionMaps& maps) {
  const double top = maps.fringes.back()->pattern.fringes_per_unit();
  std::vector<double> weights;
  double sum = 0.0;
  for (std::size_t m = 0; m < maps.fits.size(); ++m) {
    const double ratio = maps.fringes[m]->pattern.fringes_per_unit() / top;
    weights.push_back(ratio / std::pow(maps.fits[m].algorithm.noise_gain, 2));
    sum += weights.back() * ratio;
  }
  for (double& weight : weights)
    weight /= sum;
  return weights;
}

/// The systematic uncertainty of the slope of phase over frequency through all maps.
SystematicPhase sequence_systematic(const DirectionMaps& maps) {
  const std::vector<double> weights = sequence_weights(maps);
  double square = 0.0;
  double differing = 0.0;
  for (std::size_t m = 0; m < maps.fits.size(); ++m) {
    const SystematicPhase part = systematic_phase(maps.fits[m]);
    square += std::pow(weights[m] * part.rad, 2);
    differing += std::pow(weights[m] * part.rad, 2) * part.differing_share;
  }
  if (square == 0.0) return {};
  return {std::sqrt(square), differing / square};
}

/// Adds to sigma, pixel by pixel, what the frames of each pattern leave unexplained.
void count_places(const DirectionInput& input, DirectionMaps& maps) {
  const std::vector<double> weights = sequence_weights(maps);
  AbsolutePhase& phase = maps.view.phase;
  for (std::size_t m = 0; m < maps.fits.size(); ++m) {
    if (!maps.view.assessments[m].exceeds_noise) continue;
    const FittedAlgorithm& fit = maps.fits[m];
    const Image<float> unexplained_rad = unexplained_phase(*maps.fringes[m], fit, maps.view.noise);
    const double discarded =
        count_unexplained(unexplained_rad,
                          {fit.unexplained_rad, input.options.wrap.max_sigma_rad, weights[m]},
                          {phase.phase_rad, phase.sigma_rad, phase.status, phase.systematic_rad});
    const std::string warning = describe_contradicting(
        maps.fringes[m]->pattern.name,
        discarded,
        place_of_unexplained(unexplained_rad, input.options.wrap.max_sigma_rad));
    if (warning.empty()) continue;
    input.run.warn(warning);
    if (maps.view.check->consistent && maps.view.check->finding.empty())
      maps.view.check->finding = warning;
  }
}

/// Every how many pixels of an image the maps are kept: a multiple of four, so that views of every
/// second or fourth pixel hold the same ones.
int thinning_px(const FrameStack& stack) {
  constexpr double kPixels = 20'000.0;  // show what the fringes of a view do on the whole
  constexpr int kMultiple = 4;
  const double all = static_cast<double>(width_of(stack.frames.front())) *
                     static_cast<double>(height_of(stack.frames.front()));
  return kMultiple * std::max(1, static_cast<int>(std::sqrt(all / kPixels) / kMultiple));
}

WrappedPhase thinned(const WrappedPhase& map, int step_px) {
  WrappedPhase out{.pattern = map.pattern,
                   .phase_rad = every_nth_pixel(map.phase_rad, step_px),
                   .sigma_rad = every_nth_pixel(map.sigma_rad, step_px),
                   .modulation_counts = every_nth_pixel(map.modulation_counts, step_px),
                   .mean_counts = every_nth_pixel(map.mean_counts, step_px),
                   .status = every_nth_pixel(map.status, step_px),
                   .systematic_rad = {},
                   .differing_share = map.differing_share};
  if (!map.systematic_rad.empty())
    out.systematic_rad = every_nth_pixel(map.systematic_rad, step_px);
  return out;
}

std::vector<SequenceFrames> frames_of(const DirectionInput& input, const DirectionMaps& maps) {
  std::vector<SequenceFrames> frames;
  for (std::size_t m = 0; m < maps.fringes.size(); ++m) {
    frames.push_back({maps.fringes[m], maps.fits[m].algorithm});
    const auto orders = input.orders_rad.find(maps.fringes[m]->pattern.name);
    if (orders != input.orders_rad.end()) frames.back().orders_rad = orders->second;
    frames.back().systematic_rad = systematic_phase(maps.fits[m]).rad;
    frames.back().correction = correction_of(maps.fringes[m]->pattern, maps.fits[m], input.options);
  }
  return frames;
}

/// What the coarser patterns say is wrong with the frames of a pattern that leave no residual by
/// themselves; nothing where no cause is decided.
std::optional<FrameVerdict> judge_by_coarser(const DirectionInput& input,
                                             const DirectionMaps& maps,
                                             std::size_t map) {
  const Pattern& pattern = maps.fringes[map]->pattern;
  if (!maps.view.check->consistent || pattern.shifts_rad.size() > 3) return {};
  const std::optional<PredictedFrames> predicted = predict_frames(frames_of(input, maps),
                                                                  map,
                                                                  maps.view.noise,
                                                                  input.rig.projector,
                                                                  input.options.wrap,
                                                                  input.options.sequence_check);
  if (!predicted) return {};
  FrameVerdict out{explain_predicted_frames(*predicted, pattern, maps.view.noise)};
  if (!out.explanation.has_fault()) return {};
  out.action = FrameAction::LeaveOutView;
  out.finding =
      fmt::format("pattern \"{}\": {}", pattern.name, describe(out.explanation.explanation));
  return out;
}

/// Compares the patterns with each other, and counts what contradicts in each as unexplained.
void check_maps(const DirectionInput& input, DirectionMaps& maps) {
  maps.view.check = check_sequence(frames_of(input, maps),
                                   maps.view.noise,
                                   input.rig.projector,
                                   input.plan.maps_determine_orders,
                                   input.options.wrap,
                                   input.options.sequence_check);
  const std::vector<double>& ripples_rad = maps.view.check->ripples_rad;
  for (std::size_t m = 0; m < ripples_rad.size(); ++m) {
    constexpr double kWarned_rad = 0.1;
    const bool is_large = ripples_rad[m] >= kWarned_rad;
    std::optional<FrameVerdict> verdict;
    if (is_large) verdict = judge_by_coarser(input, maps, m);
    const bool is_explained = verdict.has_value();
    if (is_explained) maps.view.frames.push_back(*std::move(verdict));
    FittedAlgorithm& fit = maps.fits[m];
    // Flicker repeats likewise and is counted.
    const double known_rad = std::hypot(fit.waveform.flicker_error_rad, fit.unexplained_rad);
    if (ripples_rad[m] <= known_rad) continue;
    fit.unexplained_rad =
        std::sqrt(std::pow(ripples_rad[m], 2) - std::pow(fit.waveform.flicker_error_rad, 2));
    if (!is_large || is_explained) continue;
    input.run.warn(fmt::format(
        "pattern \"{}\": its phase is off by {:.2f} rad RMS along each fringe, as the coarser "
        "patterns show, and its frames do not tell why; it is counted in sigma; take five steps or "
        "more, which show the frame at fault",
        maps.fringes[m]->pattern.name,
        ripples_rad[m]));
  }
}

}  // namespace

DirectionMaps fit_maps(const DirectionInput& input) {
  DirectionMaps out;
  out.fringes = fringes_of(input.stacks, input.plan.direction);
  require(out.fringes.size() == input.plan.maps.size(),
          "decode_view: the frames are not those of the plan's patterns");
  out.view.noise = input.noise;
  out.view.coarsest = out.fringes.front()->pattern;
  out.fits = fit_all(out.fringes, out.view.noise, input.options, input.run);
  for (std::size_t m = 0; m < out.fits.size(); ++m) {
    const auto found = input.unexplained_rad.find(out.fringes[m]->pattern.name);
    if (found != input.unexplained_rad.end()) out.fits[m].unexplained_rad = found->second;
  }
  return out;
}

DirectionMaps wrap_maps(const DirectionInput& input, DirectionMaps fitted, WrappedParts parts) {
  DirectionMaps out = std::move(fitted);
  const DecodeOptions& options = input.options;
  check_maps(input, out);
  out.view.thinning_px = thinning_px(*out.fringes.front());
  for (std::size_t m = 0; m < out.fringes.size(); ++m) {
    input.run.check();
    wrap_pattern(*out.fringes[m], out.fits[m], options, input.run, out.view);
    out.view.thinned.push_back(thinned(out.view.wrapped.back(), out.view.thinning_px));
    if (parts == WrappedParts::All || options.keep_maps || options.own.any()) continue;
    out.view.wrapped.back().modulation_counts = {};
    out.view.wrapped.back().mean_counts = {};
  }
  return out;
}

namespace {

/// What of the frames of a direction blur weakens least, on all of their rows or on some bands;
/// none where there is nothing but one pattern of fringes.
class LeastBlurred {
 public:
  LeastBlurred(const DirectionInput& input, const DirectionMaps& maps)
      : input_(input), maps_(maps) {
    const auto gray = gray_of(input.stacks, input.plan.direction);
    if (maps.fringes.size() > 1) {
      coarsest_ = maps.fringes.front();
    } else if (!gray.empty() && gray.front().pattern.inverted != InvertedFrames::None) {
      gray_ = &gray.front();
    }
  }
  [[nodiscard]] bool is_there() const { return coarsest_ != nullptr || gray_ != nullptr; }
  [[nodiscard]] WholeLight on_bands(std::size_t pixels) const {
    if (gray_ != nullptr) return whole_light(sample_rows(*gray_, pixels, kBlurBandRows));
    return whole_light(wrap_phase(sample_rows(*coarsest_, pixels, kBlurBandRows),
                                  maps_.fits.front().algorithm,
                                  maps_.view.noise,
                                  input_.options.wrap));
  }
  [[nodiscard]] WholeLight everywhere() const {
    if (gray_ != nullptr) return whole_light(*gray_);
    const FittedAlgorithm& fit = maps_.fits.front();
    const NoiseModel& noise = maps_.view.noise;
    return whole_light(
        coarsest_->pattern.exposure_count() > 1
            ? merge_exposures(exposures_of(coarsest_), fit.shifts_rad, noise, input_.options.wrap)
            : wrap_phase(*coarsest_, fit.algorithm, noise, input_.options.wrap));
  }

 private:
  const DirectionInput& input_;
  const DirectionMaps& maps_;
  const FrameStack* coarsest_ = nullptr;
  const FrameStack* gray_ = nullptr;
};

/// The wrapped map of a pattern in a box, of all its exposures.
WrappedPhase wrapped_in(const PixelBox& box,
                        const FrameStack& pattern,
                        const FittedAlgorithm& fit,
                        const DirectionInput& input,
                        const NoiseModel& noise) {
  std::vector<FrameStack> cut;
  for (const FrameStack& exposure : exposures_of(&pattern))
    cut.push_back(sample_box(exposure, box));
  return cut.size() > 1 ? merge_exposures(cut, fit.shifts_rad, noise, input.options.wrap)
                        : wrap_phase(cut.front(), fit.algorithm, noise, input.options.wrap);
}

/// Corrects a phase for the area of the pixels alone.
void undo_pixel_area(const DirectionInput& input, DirectionMaps& maps, double variance_px2) {
  const PixelBox box = measured_box(maps.view.phase.phase_rad);
  if (box.empty() || variance_px2 == 0.0) return;
  const WrappedPhase finest =
      wrapped_in(box, *maps.fringes.back(), maps.fits.back(), input, maps.view.noise);
  correct_pixel_area(maps.view.phase, finest.modulation_counts, box, variance_px2);
}

}  // namespace

void undo_blur(const DirectionInput& input, DirectionMaps& maps) {
  constexpr std::size_t kSampledPixels = 200'000;
  if (!input.options.undo_blur || input.options.own.any()) return;
  double averaged_px2 = kPixelAreaVariance;
  const LeastBlurred least(input, maps);
  if (least.is_there()) {
    const WholeLight whole = least.on_bands(kSampledPixels);
    const WrappedPhase fine =
        wrap_phase(sample_rows(*maps.fringes.back(), kSampledPixels, kBlurBandRows),
                   maps.fits.back().algorithm,
                   maps.view.noise,
                   input.options.wrap);
    maps.view.blur = estimate_blur(whole, fine);
    if (maps.view.blur) {
      correct_blur(maps.view.phase, least.everywhere().counts, *maps.view.blur);
      return;
    }
    averaged_px2 = averaged_variance(whole, fine);
  }
  undo_pixel_area(input, maps, averaged_px2);
}

bool allow_one_pass(const DirectionInput& input, const DirectionMaps& fitted) {
  const DecodeOptions& options = input.options;
  const bool corrects =
      undoes_own_response(options) &&
      std::any_of(fitted.fits.begin(), fitted.fits.end(), [](const FittedAlgorithm& fit) {
        return own_correction(fit).has_value();
      });
  return !options.keep_maps && !options.own.any() && !options.recover_saturated &&
         !options.response && options.waveforms.empty() && !corrects &&
         std::all_of(fitted.fringes.begin(), fitted.fringes.end(), [](const FrameStack* stack) {
           return stack->pattern.exposure_count() == 1 && stack->noise_gain.empty();
         });
}

DirectionMaps decode_in_one_pass(const DirectionInput& input, DirectionMaps fitted) {
  constexpr std::size_t kAssessedPixels = 200'000;
  DirectionMaps out = std::move(fitted);
  DecodedDirection& view = out.view;
  const DecodeOptions& options = input.options;
  check_maps(input, out);
  view.thinning_px = thinning_px(*out.fringes.front());
  for (std::size_t m = 0; m < out.fringes.size(); ++m) {
    const FrameStack some = sample_rows(*out.fringes[m], kAssessedPixels);
    const WrappedPhase map = wrap_phase(some, out.fits[m].algorithm, view.noise, options.wrap);
    view.assessments.push_back(assess_frames(some, out.fits[m], map, view.noise));
    view.thinned.push_back(wrap_phase(sample_grid(*out.fringes[m], view.thinning_px),
                                      out.fits[m].algorithm,
                                      view.noise,
                                      options.wrap));
  }
  view.phase = decode_sequence(
      frames_of(input, out), view.noise, input.rig.projector, {options.wrap, options.temporal});
  const SystematicPhase systematic = sequence_systematic(out);
  view.phase.systematic_rad = uniform_systematic(systematic.rad, view.phase.status);
  view.phase.differing_share = static_cast<float>(systematic.differing_share);
  count_places(input, out);
  return out;
}

}  // namespace frangia
