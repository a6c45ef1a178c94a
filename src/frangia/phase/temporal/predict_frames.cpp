#include "frangia/phase/temporal/predict_frames.h"

#include "frangia/core/error.h"
#include "frangia/phase/temporal/internal/sequence_sample.h"

namespace frangia {

std::optional<PredictedFrames> predict_frames(std::span<const SequenceFrames> coarse_to_fine,
                                              std::size_t map,
                                              const NoiseModel& noise,
                                              const Projector& projector,
                                              const WrapOptions& wrap,
                                              const SequenceCheckOptions& options) {
  require(map > 0 && map < coarse_to_fine.size(), "predict_frames: no coarser pattern");
  return SequenceSample(coarse_to_fine, noise, projector, wrap, options).predicted(map);
}

}  // namespace frangia
