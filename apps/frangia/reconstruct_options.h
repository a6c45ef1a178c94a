#pragma once

#include <CLI/CLI.hpp>

#include "frangia/scan/reconstruct.h"

namespace frangia {

/// The options of `reconstruct` that `decode` has too.
inline void add_decode_options(CLI::App& verb, DecodeOptions& options) {
  verb.add_option("--algorithm",
                  options.algorithm,
                  "phase-shift algorithm: auto, or one of `frangia algorithms`")
      ->capture_default_str();
  verb.add_flag("--recover-saturated",
                options.recover_saturated,
                "recover the one saturated frame of four, 90 degrees apart, from the others");
  verb.add_option("--max-sigma",
                  options.wrap.max_sigma_rad,
                  "drop pixels whose phase is less certain than this, in rad")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
}

}  // namespace frangia
