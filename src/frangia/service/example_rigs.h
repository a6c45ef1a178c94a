#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace frangia {

/// A rig.toml of the folder examples, as this program was built with it.
struct ExampleRig {
  std::string name;  ///< "lab-piezo": its file name without .toml
  std::string text;  ///< of the file
};

/// The rigs of the folder examples, by name.
[[nodiscard]] const std::vector<ExampleRig>& example_rigs();

/// The comment at the beginning of a rig.toml as one paragraph.
[[nodiscard]] std::string description_of(const ExampleRig& rig);

/// Writes the rig.toml of an example. A simulated rig that names another example as what it is in
/// truth gets that one as true-rig.toml in the same folder.
///
/// @errors   Error(Input) that lists the examples for an unknown one; Error(File)
void write_example_rig(const std::filesystem::path& path, const std::string& name);

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
