#include "frangia/decode/view_quality.h"

#include <cmath>

namespace frangia {

ViewQuality view_quality(std::span<const FrameAssessment> assessments) {
  ViewQuality out;
  for (const FrameAssessment& assessment : assessments) {  // fmin and fmax ignore NaN
    out.contrast = std::fmin(out.contrast, assessment.contrast);
    out.measured_share = std::fmin(out.measured_share, assessment.measured_fraction);
    out.saturated_share = std::fmax(out.saturated_share, assessment.saturated_fraction);
    if (assessment.frames > 3)
      out.residual_ratio = std::fmax(out.residual_ratio, assessment.residual_ratio);
    out.needs_attention = out.needs_attention || needs_attention(assessment);
  }
  return out;
}

}  // namespace frangia
