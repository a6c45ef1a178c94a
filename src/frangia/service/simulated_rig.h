#pragma once

#include <filesystem>
#include <string>

namespace frangia {

/// Writes the rig.toml of the simulated rig that newcomers try: the preset `digital` with a camera
/// of 640 x 512, a turntable with a home switch, and a built-in part before the camera.
///
/// The simulated devices are the rig in true-rig.toml, in the same folder and at first the same;
/// the calibration of rig.toml may differ from it.
/// @errors   Error(Input) that lists the parts for an unknown one; Error(File)
void write_simulated_rig(const std::filesystem::path& path, const std::string& part);

/// The file beside a rig.toml that states what its simulated devices are.
[[nodiscard]] std::filesystem::path true_rig_beside(const std::filesystem::path& rig);

}  // namespace frangia
