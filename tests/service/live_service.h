#pragma once

#include <algorithm>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <functional>
#include <string>
#include <thread>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "frangia/rig/read_rig.h"
#include "frangia/rig/write_rig.h"
#include "frangia/service/service.h"

#include "support/all_drivers.h"
#include "support/error_of.h"
#include "support/temporary_folder.h"

namespace frangia::testing {

using Json = nlohmann::json;

/// As after the calibration of a new rig, which says nothing of its turntable.
inline void remove_turntable(const std::filesystem::path& file) {
  Rig rig = read_rig(file);
  rig.turntable.reset();
  const std::filesystem::path fresh = file.parent_path() / "fresh.toml";
  write_rig(fresh, rig, Durability::Buffered, file);
  std::filesystem::rename(fresh, file);
}

/// A service with a project on the simulated rig.
class LiveServiceTest : public ::testing::Test {
 protected:
  LiveServiceTest() : service_(options(), [] {}) {
    command("create-project", {{"name", "live"}, {"part", "plate"}, {"stations", 2}});
    EXPECT_TRUE(wait([&] { return !busy(); }));
  }
  [[nodiscard]] ServiceOptions options() const {
    ServiceOptions options;
    options.projects = folder_.path();
    options.capture.drivers = all_drivers;
    options.capture.board_drivers = board_drivers;
    return options;
  }
  void command(const std::string& name, const Json& arguments = Json::object()) {
    static_cast<void>(service_.command(name, arguments.dump()));
  }
  [[nodiscard]] Json project() const { return Json::parse(service_.state()).at("project"); }
  [[nodiscard]] bool busy() const {
    const Json state = Json::parse(service_.state());
    const Json& jobs = state.at("jobs");
    return std::any_of(jobs.begin(), jobs.end(), [](const Json& job) {
      return job.at("state") == "waiting" || job.at("state") == "running";
    });
  }
  [[nodiscard]] static bool wait(const std::function<bool()>& done) {
    for (int i = 0; i < 12'000; ++i) {
      if (done()) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return false;
  }
  /// The header of the newest picture of a layer that satisfies a condition.
  [[nodiscard]] Json header(LiveLayer layer, const std::function<bool(const Json&)>& accepts) {
    Json header;
    EXPECT_TRUE(wait([&] {
      const LivePicture picture = service_.live_picture(layer, seen_);
      if (!picture.bytes) return false;
      seen_ = picture.revision;
      std::uint32_t length = 0;
      std::memcpy(&length, picture.bytes->data(), sizeof length);
      header = Json::parse(picture.bytes->substr(sizeof length, length));
      return accepts(header.at("values"));
    }));
    return header;
  }
  [[nodiscard]] static std::size_t length_of(const Json& header, const std::string& name) {
    for (const Json& array : header.at("arrays"))
      if (array.at("name") == name) return array.at("length").get<std::size_t>();
    return 0;
  }

  TemporaryFolder folder_;
  Service service_;
  std::uint64_t seen_ = 0;
};

}  // namespace frangia::testing
