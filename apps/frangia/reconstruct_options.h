#pragma once

#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "frangia/core/error.h"
#include "frangia/phase/algorithm/phase_algorithm.h"
#include "frangia/reconstruct/reconstruct.h"
#include "frangia/rig/read_rig.h"

#include "option_values.h"

namespace frangia {

/// The options that `reconstruct` and `decode` share.
inline void add_decode_options(CLI::App& verb, DecodeOptions& options) {
  verb.add_option_function<std::string>(
          "--algorithm",
          [&options](const std::string& name) {
            options.algorithm = name;
            if (name.ends_with(".toml")) options.own_algorithm = read_algorithm(name);
          },
          "phase-shift algorithm: auto, one of `frangia algorithms`, or a .toml file with yours")
      ->default_str(options.algorithm);
  verb.add_option("--unwrap",
                  options.spatial.method,
                  "spatial phase unwrapping: run-merging (default), quality-guided (as in the 1997 "
                  "paper) or "
                  "reliability-sorted")
      ->transform(named<SpatialMethod>());
  verb.add_flag("--recover-saturated",
                options.recover_saturated,
                "recover a pixel that is saturated in one of four frames, 90 degrees apart");
  verb.add_option_function<std::string>(
      "--undo-response",
      [&options](const std::string& path) {
        options.undo_own_response = path == "auto";
        if (path == "auto" || path == "none") return;
        const Projector projector = read_rig(path).projector;
        options.response = projector.response;
        options.waveforms = projector.waveforms;
        if (!options.response) {
          throw Error(ErrorKind::Input,
                      path + " has no [projector.response]; measure one with `frangia response`");
        }
      },
      "what the response of a projector without a look-up table did to the phase: auto (default: "
      "the "
      "harmonics that the frames show are corrected where they shift the phase), none (they are "
      "counted in sigma), or a rig.toml with its [projector.response]");
  verb.add_flag_callback(
      "--ignore-blur",
      [&options] { options.undo_blur = false; },
      "leave what the blur of the camera and the area of its pixels do to the phase where the "
      "brightness changes or the surface bends");
  CLI::Option* phase = verb.add_option_function<std::string>(
      "--phase",
      [&options](const std::string& folder) {
        if (!options.phase_files) options.phase_files.emplace();
        options.phase_files->folder = folder;
      },
      "phase maps of another program: FOLDER/000/PATTERN-phase.tiff and PATTERN-sigma.tiff, rad, "
      "32-bit floating point, NaN where nothing was measured");
  verb.add_option_function<PhaseKind>(
          "--phase-kind",
          [&options](const PhaseKind& kind) {
            if (!options.phase_files) options.phase_files.emplace();
            options.phase_files->kind = kind;
          },
          "what the maps hold: absolute (default; of the finest fringes) or wrapped (one for each "
          "pattern)")
      ->transform(named<PhaseKind>())
      ->needs(phase);
  verb.add_option("--directions",
                  options.directions,
                  "of a scan with vertical and horizontal fringes: fused (default; least squares "
                  "over both), best (at each pixel the one with the smaller sigma), vertical or "
                  "horizontal")
      ->transform(named<DirectionChoice>());
  verb.add_flag("--accept-inconsistent",
                options.accept_inconsistent,
                "triangulate frames that do not fit the patterns of scan.toml or the rig");
  verb.add_flag("--accept-remedy",
                options.accept_remedy,
                "decode with the shifts that fit the frames where those of scan.toml do not");
  verb.add_option("--max-sigma",
                  options.wrap.max_sigma_rad,
                  "discard pixels whose phase has a larger standard deviation, rad")
      ->check(above_zero())
      ->capture_default_str();
}

/// The known length that fixes the scale of a refined rig.
inline CLI::Option* add_known_length(CLI::App& verb, std::optional<double>& length_mm) {
  return verb
      .add_option("--length",
                  length_mm,
                  "known distance of the centers of the two balls of a ball bar in the scan, which "
                  "fixes the scale of the refined rig")
      ->transform(length_above_zero());
}

}  // namespace frangia
