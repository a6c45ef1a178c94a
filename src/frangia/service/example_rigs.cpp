#include "frangia/service/example_rigs.h"

#include <algorithm>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/core/durable_file.h"
#include "frangia/core/error.h"
#include "frangia/rig/write_rig.h"
#include "frangia/simulate/parts.h"
#include "frangia/simulate/rig_presets.h"
#include "frangia/simulate/simulate_options.h"

namespace frangia {
namespace {

const ExampleRig* find_example(const std::string& name) {
  const auto& all = example_rigs();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const ExampleRig& one) { return one.name == name; });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace

std::string description_of(const ExampleRig& rig) {
  std::istringstream lines(rig.text);
  std::string paragraph;
  for (std::string line; std::getline(lines, line) && line.starts_with("#");) {
    const std::size_t begin = line.find_first_not_of("# ");
    if (begin == std::string::npos) continue;
    if (!paragraph.empty()) paragraph += ' ';
    paragraph.append(line, begin);
  }
  return paragraph;
}

void write_example_rig(const std::filesystem::path& path, const std::string& name) {
  const ExampleRig* example = find_example(name);
  if (example == nullptr) {
    std::vector<std::string> names;
    for (const ExampleRig& one : example_rigs())
      names.push_back(one.name);
    throw Error(
        ErrorKind::Input,
        fmt::format("there is no example '{}'; choose one of {}", name, fmt::join(names, ", ")));
  }
  std::string text = example->text;
  const std::filesystem::path truth = true_rig_beside(path);
  for (const ExampleRig& other : example_rigs()) {
    const std::string named = fmt::format("true_rig = \"{}.toml\"", other.name);
    const std::size_t at = text.find(named);
    if (at == std::string::npos) continue;
    text.replace(at, named.size(), fmt::format("true_rig = \"{}\"", truth.filename().string()));
    write_text_file(truth, other.text);
  }
  write_text_file(path, text);
}

void write_simulated_rig(const std::filesystem::path& path, const std::string& part) {
  const auto parts = part_names();
  if (std::find(parts.begin(), parts.end(), part) == parts.end()) {
    throw Error(
        ErrorKind::Input,
        fmt::format("there is no part '{}'; choose one of {}", part, fmt::join(parts, ", ")));
  }
  constexpr int kWidth = 640;  // of 960: each view is rendered and decoded in half the time
  constexpr int kHeight = 512;
  Rig rig = rig_preset("digital");
  CameraModel& model = rig.reference().model;
  const double scale = static_cast<double>(kWidth) / model.width_px;
  model.width_px = kWidth;
  model.height_px = kHeight;
  model.focal_px *= scale;
  model.principal_point_px = (model.principal_point_px.array() + 0.5) * scale - 0.5;
  const SimulateOptions camera;
  constexpr double kWhite = 255.0;
  rig.reference().noise = NoiseModel::from_camera(camera.full_well_e / kWhite, camera.read_e);
  write_text_file(true_rig_beside(path), rig_text(rig));
  AtomicFile file(path);
  file.stream() << rig_text(rig)
                << fmt::format(R"(
[devices.camera]
driver = "simulated"
part = "{}"
samples = 4
true_rig = "true-rig.toml"

[devices.fringes]
driver = "simulated-display"

[devices.turntable]
driver = "simulated"
home = "switch"
backlash_deg = 0.5
)",
                               part);
  file.commit();
}

std::filesystem::path true_rig_beside(const std::filesystem::path& rig) {
  return rig.parent_path() / "true-rig.toml";
}

}  // namespace frangia
