#pragma once

#include <vector>

#include "frangia/phase/gray/internal/gray_code_sample.h"

namespace frangia {

/// Largest start of the fringes at the borders of the stripes that a sound code may show.
[[nodiscard]] double max_start_of(const Pattern& fringes, const GrayCodeCheckOptions& options);

/// Whether code and fringes pass the check with another declaration: they agree, and the fringes
/// begin at the borders of the stripes as it says.
[[nodiscard]] bool passes(const GrayCodeSample& sample,
                          const GrayTrial& trial,
                          const Pattern& fringes,
                          const GrayCodeCheckOptions& options);

/// Frames that show no stripes, or those of the frame before, where the others and the fringes say
/// that they have stripes of their own: they are missing.
[[nodiscard]] std::vector<GrayTrial> missing_trials(const GrayCodeSample& sample,
                                                    const Pattern& code,
                                                    const Pattern& fringes);

/// Widths of the stripes and periods of the fringes with which the fringes lie at the borders of
/// the stripes where they should.
[[nodiscard]] std::vector<GrayTrial> scale_trials(const GrayCodeSample& sample,
                                                  const Pattern& code,
                                                  const Pattern& fringes,
                                                  const GrayCodeCheckOptions& options);

/// The fringes began at another phase than declared, if code and fringes pass with it.
[[nodiscard]] std::vector<GrayTrial> start_trials(const GrayCodeSample& sample,
                                                  const Pattern& code,
                                                  const Pattern& fringes,
                                                  double start_rad,
                                                  const GrayCodeCheckOptions& options);

}  // namespace frangia
