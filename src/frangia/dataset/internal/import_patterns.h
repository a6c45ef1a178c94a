#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "frangia/core/run.h"
#include "frangia/dataset/import_frames.h"
#include "frangia/dataset/internal/read_pattern.h"

namespace frangia {

/// What a file of patterns describes.
struct DescribedFrames {
  std::vector<Pattern> patterns;           ///< of `[[pattern]]`
  std::optional<BoardOrArtifact> board{};  ///< of `[board]`, which the views show
};

/// Reads the [[pattern]] tables and [board] of a TOML file.
///
/// @errors   Error(Input) that names the file and the key
[[nodiscard]] DescribedFrames read_patterns_file(const std::filesystem::path& path,
                                                 const Rig& rig,
                                                 const Run& run);

/// Whether a pattern is a white or ambient frame: as described, or without descriptions by its name
/// (white, texture, color; ambient, black, dark).
[[nodiscard]] bool is_light_alone(const std::string& pattern,
                                  const std::vector<Pattern>& described);

/// The fringe patterns that the options describe, and white and ambient ones of one frame by their
/// names, for patterns with these names and numbers of frames. An empty list of names stands for
/// one pattern per value, which share the frames evenly.
///
/// @errors   Error(Input) that names the option
[[nodiscard]] std::vector<Pattern> patterns_from_options(const ImportOptions& options,
                                                         const std::vector<std::string>& names,
                                                         const std::vector<std::size_t>& frames,
                                                         const Rig& rig,
                                                         bool rig_has_projector);

}  // namespace frangia
