#pragma once

#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "frangia/core/random.h"
#include "frangia/service/encode_arrays.h"

#include "service/project_on_disk.h"
#include "service/service_fixture.h"
#include "support/file_faults.h"
#include "support/small_scan.h"

namespace frangia {

/// A project in a folder whose operations may fail, with the disk that it would leave.
class TransactionTest : public ServiceTest {
 protected:
  static void SetUpTestSuite() {
    scan_ = std::make_unique<testing::TemporaryFolder>();
    static_cast<void>(
        testing::small_scan(scan_->path() / "scan", "plate", "angular", 1, {.samples_per_px = 1}));
  }
  static void TearDownTestSuite() { scan_.reset(); }

  [[nodiscard]] std::filesystem::path project() const {
    return folder_.path() / "projects" / "box";
  }
  [[nodiscard]] std::uint64_t random(std::uint64_t below) { return hash(seed_, ++drawn_) % below; }

  /// A project with a scan and, for every other seed, a surface and edits of before there were
  /// versions.
  void begin(std::uint64_t seed) {
    testing::FileFault::follow("", nullptr);
    seed_ = seed;
    drawn_ = 0;
    trace_.clear();
    std::filesystem::remove_all(folder_.path() / "projects");
    std::filesystem::create_directories(project());
    std::ofstream(project() / "project.json") << "{}";
    std::filesystem::copy(scan_->path() / "scan",
                          project() / "scan",
                          std::filesystem::copy_options::recursive |
                              std::filesystem::copy_options::create_hard_links);
    if (seed % 2 == 0) {
      Mesh mesh = testing::sphere({20, 0, 0}, 3.0, 8);
      append_mesh(mesh, testing::box({-5, -5, -5}, {5, 5, 5}));
      mesh.triangles.pop_back();
      write_mesh(project() / "surface.ply", mesh);
      if (seed % 4 == 0)
        write_edit_script(project() / "edits.json",
                          {{{"reverse-orientation", ""}, {"offset", "0.2mm"}}, 1});
    }
    disk_.emplace(project(), "scan");
    testing::FileFault::follow(project().string(), &*disk_);
    restart();
    static_cast<void>(command("open-project", {{"name", "box"}}));
    static_cast<void>(finish());
  }
  void TearDown() override { testing::FileFault::follow("", nullptr); }

  [[nodiscard]] std::string said() const { return fmt::format("seed {}: {}", seed_, trace_); }

  /// What the state says of the surface, in one line.
  static std::string shown_in(const nlohmann::json& state) {
    const nlohmann::json& project = state.at("project");
    const nlohmann::json& surface = project.at("surface");
    if (surface.is_null()) return "unread";
    return fmt::format("{} {} {} {}",
                       project.at("revision").get<int>(),
                       surface.at("version").get<int>(),
                       surface.at("steps").size(),
                       surface.at("steps_done").get<int>());
  }
  static std::string shown_in(const testing::ProjectOnDisk& disk) {
    if (disk.current == 0) return "unread";
    return fmt::format("{} {} {} {}",
                       disk.revision,
                       disk.current,
                       disk.shown().script.steps.size(),
                       disk.shown().script.done);
  }

  void stop_running() {
    for (const nlohmann::json now = state(); const nlohmann::json& job : now.at("jobs"))
      if (job.at("state") == "running" || job.at("state") == "waiting")
        static_cast<void>(
            service_->command("stop-job", nlohmann::json{{"job", job.at("number")}}.dump()));
  }

  /// What the service shows is what the disk holds.
  void check_memory(const testing::ProjectOnDisk& disk) {
    nlohmann::json now = state();
    EXPECT_EQ(now.at("project").at("versions").size(), disk.versions.size()) << said();
    EXPECT_EQ(now.at("project").at("current_version"), disk.current) << said();
    if (disk.current == 0) return;
    if (now.at("project").at("surface").is_null()) {  // its reading was stopped
      EXPECT_FALSE(now.at("project").at("surface_loading").get<bool>()) << said();
      static_cast<void>(command("open-version", {{"version", disk.current}}));
      EXPECT_EQ(finish().at("state"), "done") << said();
      now = state();
    }
    EXPECT_EQ(shown_in(now), shown_in(disk)) << said();
    const nlohmann::json& surface = now.at("project").at("surface");
    EXPECT_EQ(service_->mesh(),
              encode_mesh(mesh_of(project(), disk), surface.at("mesh_revision").get<int>()))
        << said();
    for (std::size_t i = 0; i < surface.at("steps").size(); ++i)
      EXPECT_EQ(surface.at("steps")[i].at("operation"), disk.shown().script.steps[i].operation)
          << said();
  }

  void copy_project() {
    copy_ = folder_.path() / "copy";
    std::filesystem::remove_all(copy_);
    std::filesystem::create_directories(copy_);
    for (const auto& entry : std::filesystem::directory_iterator(project())) {
      const auto name = entry.path().filename();
      if (name == "scan") continue;  // nothing here changes it
      std::filesystem::copy(entry.path(), copy_ / name, std::filesystem::copy_options::recursive);
    }
  }

  void cut_power(bool all_names) {
    copy_ = folder_.path() / "copy";
    disk_->write_to(copy_, all_names);
  }

  /// What the copy holds; revision -1 when it cannot be read.
  [[nodiscard]] testing::ProjectOnDisk read_copy() const {
    try {
      return testing::read_project(copy_);
    } catch (const std::exception& fault) {
      ADD_FAILURE() << fault.what() << "; " << said();
      return {.revision = -1};
    }
  }

  // NOLINTNEXTLINE(*-avoid-non-const-global-variables): of the suite
  static inline std::unique_ptr<testing::TemporaryFolder> scan_;
  std::uint64_t seed_ = 0;
  std::uint64_t drawn_ = 0;
  std::string trace_;
  std::filesystem::path copy_;
  std::optional<testing::CertainDisk> disk_;
};

}  // namespace frangia
