#pragma once

#include <map>
#include <string>

#include <CLI/CLI.hpp>

#include "frangia/core/error.h"
#include "frangia/pipeline/reconstruct.h"
#include "frangia/rig/read_rig.h"

#include "option_values.h"

namespace frangia {

/// The options of `reconstruct` that `decode` has too.
inline void add_decode_options(CLI::App& verb, DecodeOptions& options) {
  verb.add_option("--algorithm",
                  options.algorithm,
                  "phase-shift algorithm: auto, or one of `frangia algorithms`")
      ->capture_default_str();
  static const std::map<std::string, SpatialMethod> kMethods = {
      {"default", SpatialMethod::RunMerging},
      {"takeda-abe", SpatialMethod::QualityGuided},
      {"herraez", SpatialMethod::ReliabilitySorted}};
  verb.add_option("--unwrap",
                  options.spatial.method,
                  "how a phase is unwrapped in space: default, takeda-abe (the paper's growth) or "
                  "herraez (sorted by reliability)")
      ->transform(named(kMethods));
  verb.add_flag("--recover-saturated",
                options.recover_saturated,
                "recover the one saturated frame of four, 90 degrees apart, from the others");
  verb.add_option_function<std::string>(
      "--undo-response",
      [&options](const std::string& path) {
        options.response = read_rig(path).projector.response;
        if (!options.response) {
          throw Error(ErrorKind::Input,
                      path + " has no [projector.response]; `frangia response` writes one");
        }
      },
      "a rig.toml whose [projector.response] the projector had while it showed the patterns "
      "without its look-up table: undone in the phase");
  verb.add_option("--max-sigma",
                  options.wrap.max_sigma_rad,
                  "drop pixels whose phase is less certain than this, in rad")
      ->check(above_zero())
      ->capture_default_str();
}

}  // namespace frangia
