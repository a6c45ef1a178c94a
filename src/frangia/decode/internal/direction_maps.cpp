#include "frangia/decode/internal/direction_maps.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "frangia/core/error.h"
#include "frangia/decode/internal/wrap_pattern.h"
#include "frangia/decode/select_stacks.h"
#include "frangia/phase/blur/correct_blur.h"
#include "frangia/phase/blur/estimate_blur.h"
#include "frangia/phase/temporal/check_sequence.h"
#include "frangia/phase/waveform/frame_samples.h"
#include "frangia/phase/waveform/systematic_phase.h"
#include "frangia/phase/wrap/decode_sequence.h"
#include "frangia/phase/wrap/merge_exposures.h"

namespace frangia {
namespace {

/// The systematic uncertainty of the slope of phase over frequency through all maps, whose
/// modulations are taken as equal.
SystematicPhase sequence_systematic(const DirectionMaps& maps) {
  const double top = maps.fringes.back()->pattern.fringes_per_unit();
  double weights = 0.0;
  double square = 0.0;
  double differing = 0.0;
  for (std::size_t m = 0; m < maps.fits.size(); ++m) {
    const double ratio = maps.fringes[m]->pattern.fringes_per_unit() / top;
    const double weight = ratio / std::pow(maps.fits[m].algorithm.noise_gain, 2);
    weights += weight * ratio;
    const SystematicPhase part = systematic_phase(maps.fits[m]);
    square += std::pow(weight * part.rad, 2);
    differing += std::pow(weight * part.rad, 2) * part.differing_share;
  }
  if (square == 0.0) return {};
  return {std::sqrt(square) / weights, differing / square};
}

std::vector<SequenceFrames> frames_of(const DirectionInput& input, const DirectionMaps& maps) {
  std::vector<SequenceFrames> frames;
  for (std::size_t m = 0; m < maps.fringes.size(); ++m) {
    frames.push_back({maps.fringes[m], maps.fits[m].algorithm});
    const auto orders = input.orders_rad.find(maps.fringes[m]->pattern.name);
    if (orders != input.orders_rad.end()) frames.back().orders_rad = orders->second;
  }
  return frames;
}

/// Compares the patterns with each other.
SequenceCheck check_of(const DirectionInput& input, const DirectionMaps& maps) {
  return check_sequence(frames_of(input, maps),
                        maps.view.noise,
                        input.rig.projector,
                        input.plan.maps_determine_orders,
                        input.options.wrap,
                        input.options.sequence_check);
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
  for (std::size_t m = 0; m < out.fringes.size(); ++m) {
    input.run.check();
    wrap_pattern(*out.fringes[m], out.fits[m], options, input.run, out.view);
    if (parts == WrappedParts::All || options.keep_maps || options.own.any()) continue;
    out.view.wrapped.back().modulation_counts = {};
    out.view.wrapped.back().mean_counts = {};
  }
  out.view.check = check_of(input, out);
  return out;
}

void undo_blur(const DirectionInput& input, DirectionMaps& maps) {
  constexpr std::size_t kSampledPixels = 200'000;
  if (!input.options.undo_blur || input.options.own.any() || maps.fringes.size() < 2) return;
  const auto bands_of = [&](std::size_t m) {
    return wrap_phase(sample_rows(*maps.fringes[m], kSampledPixels, kBlurBandRows),
                      maps.fits[m].algorithm,
                      maps.view.noise,
                      input.options.wrap);
  };
  maps.view.blur = estimate_blur(bands_of(0), bands_of(maps.fringes.size() - 1));
  if (!maps.view.blur) return;
  const FrameStack* coarsest = maps.fringes.front();
  const WrappedPhase map =
      coarsest->pattern.exposure_count() > 1
          ? merge_exposures(exposures_of(coarsest),
                            maps.fits.front().shifts_rad,
                            maps.view.noise,
                            input.options.wrap)
          : wrap_phase(*coarsest, maps.fits.front().algorithm, maps.view.noise, input.options.wrap);
  correct_blur(maps.view.phase, map.modulation_counts, *maps.view.blur);
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
           return stack->pattern.exposure_count() == 1;
         });
}

DirectionMaps decode_in_one_pass(const DirectionInput& input, DirectionMaps fitted) {
  constexpr std::size_t kAssessedPixels = 200'000;
  DirectionMaps out = std::move(fitted);
  DecodedDirection& view = out.view;
  const DecodeOptions& options = input.options;
  for (std::size_t m = 0; m < out.fringes.size(); ++m) {
    const FrameStack some = sample_rows(*out.fringes[m], kAssessedPixels);
    const WrappedPhase map = wrap_phase(some, out.fits[m].algorithm, view.noise, options.wrap);
    view.assessments.push_back(assess_frames(some, out.fits[m], map, view.noise));
  }
  view.check = check_of(input, out);
  view.phase = decode_sequence(
      frames_of(input, out), view.noise, input.rig.projector, {options.wrap, options.temporal});
  const SystematicPhase systematic = sequence_systematic(out);
  view.phase.systematic_rad = uniform_systematic(systematic.rad, view.phase.status);
  view.phase.differing_share = static_cast<float>(systematic.differing_share);
  return out;
}

}  // namespace frangia
