#pragma once

#include <fstream>
#include <map>
#include <sstream>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/acquisition/capture_scan.h"
#include "frangia/rig/write_rig.h"

#include "support/all_drivers.h"
#include "support/small_scan.h"
#include "support/temporary_folder.h"
#include "support/text_of.h"

namespace frangia::testing {

/// A small rig whose devices are simulated, and a plan of three views.
class SimulatedCapture : public ::testing::Test {
 protected:
  SimulatedCapture() { use("angular", 4); }

  /// A preset's rig with its devices, the camera's pixels a `shrink`th of it.
  void use(const std::string& preset, int shrink) {
    plan_.rig = rig_preset(preset);
    make_coarser(plan_.rig.reference().model, shrink);
    plan_.rig.reference().noise = NoiseModel::from_camera(78.4, 8.0);
    plan_.patterns = default_patterns(plan_.rig);
    plan_.folder = folder_.path() / "scan";
    plan_.name = "scan";
    views(3);
    devices_["camera"] = "driver = \"simulated\"\npart = \"plate\"\n";
    devices_["turntable"] = "driver = \"simulated\"\nbacklash_deg = 0.5\n";
    devices_["light"] = "driver = \"simulated\"\n";
    if (plan_.rig.projector.is_angular()) {
      devices_["fringes"] =
          "driver = \"simulated-piezo\"\nmax_command = 12\ncommand_per_turn = 10\n";
      devices_["line"] = "driver = \"simulated\"\n";
    } else {
      devices_["fringes"] = "driver = \"simulated-display\"\n";
    }
  }
  void views(int count) {
    plan_.views.clear();
    for (int i = 0; i < count; ++i)
      plan_.views.push_back({kTwoPi * i / count, "views/00" + std::to_string(i)});
  }

  [[nodiscard]] RigDevices open() const {
    const auto file = folder_.path() / "rig.toml";
    write_rig(file, plan_.rig);
    std::ofstream out(file, std::ios::app);
    for (const auto& [table, text] : devices_)
      out << "\n[devices." << table << "]\n" << text;
    out.close();
    return open_devices(file, plan_.rig, all_drivers(), Deadline::in(10.0));
  }

  CaptureReport capture(const CaptureOptions& options = {}) {
    RigDevices devices = open();
    frangia::Run run;
    run.stop = stop_.get_token();
    run.on_warning = [this](const std::string& sentence) { warnings_.push_back(sentence); };
    run.on_note = [this](const std::string& sentence) { notes_.push_back(sentence); };
    run.progress = [this](double done) {
      if (done > stop_at_) at_the_stop_();
    };
    return capture_scan(plan_, devices, options, run);
  }

  /// The bytes of all images and of the scan's own text, by name. The manifest is without the moves
  /// of the table, which depend on the number of sessions, and without times.
  [[nodiscard]] std::map<std::string, std::string> bytes() const {
    std::map<std::string, std::string> all;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(plan_.folder)) {
      if (!entry.is_regular_file()) continue;
      all[std::filesystem::relative(entry.path(), plan_.folder).string()] = text_of(entry.path());
    }
    std::istringstream lines(std::exchange(all["capture/manifest.txt"], {}));
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with("table ") || line.starts_with("began ")) continue;
      all["capture/manifest.txt"] += line.substr(0, line.find(" at=")) + "\n";
    }
    return all;
  }

  /// The bytes of the images only.
  [[nodiscard]] std::map<std::string, std::string> images() const {
    auto images = bytes();
    std::erase_if(images, [](const auto& file) { return !file.first.ends_with(".png"); });
    return images;
  }

  TemporaryFolder folder_;
  std::map<std::string, std::string> devices_;  ///< the text of each [devices.*]
  Scan plan_;
  std::vector<std::string> warnings_;
  std::vector<std::string> notes_;
  std::stop_source stop_;
  double stop_at_ = 2.0;
  std::function<void()> at_the_stop_ = [this] { stop_.request_stop(); };
};

}  // namespace frangia::testing
