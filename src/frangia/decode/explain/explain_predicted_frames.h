#pragma once

#include "frangia/decode/explain/explain_frames.h"
#include "frangia/frames/noise_model.h"
#include "frangia/pattern/pattern.h"
#include "frangia/phase/temporal/predict_frames.h"

namespace frangia {

/// Explains three frames, which leave no residual by themselves, by what coarser patterns predict
/// of them: mean and modulation of each pixel, and where its phase is about.
///
/// Hypotheses are frames that are lost or repeated, at another gain or under another lamp, and
/// errors of the shifts; gains of 3 % and two harmonics are nuisances of all of them. The phase of
/// each pixel is free near the predicted one, since harmonics of coarser patterns move that.
///
/// @shape    three frames
/// @missing  not decided for fewer than 200 pixels
[[nodiscard]] FrameExplanation explain_predicted_frames(const PredictedFrames& frames,
                                                        const Pattern& pattern,
                                                        const NoiseModel& noise);

}  // namespace frangia
