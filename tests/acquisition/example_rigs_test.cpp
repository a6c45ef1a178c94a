// The rigs under examples/: those of real devices are read whole, those of simulated ones scan.
#include <filesystem>
#include <map>

#include <gtest/gtest.h>

#include "frangia/rig/read_rig.h"

#include "support/all_drivers.h"

namespace frangia {
namespace {

std::vector<std::filesystem::path> examples() {
  std::vector<std::filesystem::path> files;
  const auto folder = std::filesystem::path(FRANGIA_SOURCE_DIR) / "examples";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  }
  return files;
}

/// What the drivers say of each device; all they may miss here is the device itself.
std::vector<std::string> faults_of(const std::filesystem::path& file,
                                   const std::vector<std::string>& devices) {
  // A maker's rig is not calibrated yet.
  const bool maker = file.stem().string().find("maker") != std::string::npos;
  const Rig rig = read_rig(file, {}, maker ? RigContent::StartValues : RigContent::Complete);
  const auto drivers = testing::all_drivers();
  std::vector<std::string> faults;
  std::vector<std::string> tables;
  for (DeviceSettings& settings : read_device_settings(file)) {
    tables.push_back(settings.device());
    try {
      static_cast<void>(driver_for(settings, drivers).open(settings, rig, Deadline::in(0.5)));
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::Device) faults.emplace_back(error.what());
    }
    frangia::Run run;
    run.on_warning = [&](const std::string& sentence) { faults.push_back(sentence); };
    if (faults.empty() && settings.driver().find("simulated") == 0)
      settings.warn_of_unused_keys(run);
  }
  EXPECT_EQ(tables, devices) << file;
  return faults;
}

TEST(ExampleRigs, HaveEveryKeyThatTheirDriversAskFor) {
  const std::map<std::string, std::vector<std::string>> tables = {
      {"lab-piezo", {"camera", "fringes", "light", "line", "turntable"}},
      {"maker-projector", {"camera", "fringes", "turntable"}},
      {"simulated-binocular", {"camera", "camera-left", "fringes", "turntable"}},
      {"simulated-digital", {"camera", "fringes", "turntable"}},
      {"simulated-maker", {"camera", "fringes", "turntable"}},
      {"simulated-maker-unpacked", {"camera", "fringes", "turntable"}},
      {"simulated-interferometer", {"camera", "fringes", "light", "line", "turntable"}}};
  std::size_t rigs = 0;
  for (const auto& file : examples()) {
    const auto known = tables.find(file.stem().string());
    ASSERT_NE(known, tables.end()) << file;
    const auto faults = faults_of(file, known->second);
    EXPECT_TRUE(faults.empty()) << file << ": " << faults.front();
    ++rigs;
  }
  EXPECT_EQ(rigs, tables.size());
}

}  // namespace
}  // namespace frangia
