#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "frangia/core/run.h"
#include "frangia/reconstruct/reconstruct.h"

namespace frangia {

/// Of each setup, for the picture of how they join: a millimetre apart on a part of a hand's size.
inline constexpr std::size_t kPointsOfSetup = 60'000;

/// Writes the files of a new version into a folder, see VersionFiles. All are on the disk when the
/// function returns; whatever was in the folder is not. `warnings` are those of the reconstruction,
/// which stay with its figures.
///
/// @errors   Error(File); Error(Cancelled)
void write_surface_build(const std::filesystem::path& folder,
                         const Reconstruction& result,
                         const std::vector<std::string>& warnings,
                         const Run& run);

/// Likewise for a mesh that no scan of this project made; without figures of a reconstruction.
void write_given_surface(const std::filesystem::path& folder, const Mesh& mesh, const Run& run);

}  // namespace frangia
