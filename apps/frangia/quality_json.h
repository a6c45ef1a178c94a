#pragma once

#include <nlohmann/json.hpp>

#include "frangia/decode/view_quality.h"

#include "json_number.h"

namespace frangia {

/// The figures of the frames of a view, and one word for them: "rejected" where they do not fit or
/// are left out, "attention" where an assessment deserves a warning, else "good".
inline nlohmann::ordered_json json_of_quality(const ViewQuality& quality, bool rejected) {
  return {{"quality",
           rejected                  ? "rejected"
           : quality.needs_attention ? "attention"
                                     : "good"},
          {"contrast", number_or_null(quality.contrast)},
          {"measured_share", number_or_null(quality.measured_share)},
          {"saturated_share", number_or_null(quality.saturated_share)},
          {"residual_ratio", number_or_null(quality.residual_ratio)}};
}

}  // namespace frangia
