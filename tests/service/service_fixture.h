#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>
#include <utility>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "frangia/files/write_mesh.h"
#include "frangia/geometry/vertex_data.h"
#include "frangia/service/service.h"

#include "support/all_drivers.h"
#include "support/error_of.h"
#include "support/temporary_folder.h"
#include "support/test_meshes.h"

namespace frangia {

/// A service whose projects are in a folder of its own.
class ServiceTest : public ::testing::Test {
 protected:
  ServiceTest() { restart(); }

  /// A new service, with the projects of the one before.
  void restart() {
    service_.reset();
    ServiceOptions options;
    options.projects = folder_.path() / "projects";
    options.capture.drivers = testing::all_drivers;
    options.capture.board_drivers = testing::board_drivers;
    options.version = "test";
    options.print_page = [](const std::filesystem::path& page,
                            const std::filesystem::path& pdf,
                            const std::stop_token& /*stop*/) {
      std::filesystem::copy_file(page, pdf, std::filesystem::copy_options::overwrite_existing);
    };
    options.command_lines = [](const ProjectProgress& project) {
      return CommandLines{{"edit", {project.folder.name, std::to_string(project.steps.size())}}};
    };
    service_ = std::make_unique<Service>(std::move(options), [this] {
      ++changes_;
      const std::lock_guard lock(hook_mutex_);
      if (hook_) hook_();
    });
  }
  /// Calls a function at every change of the state, on the thread that made it.
  void at_changes(std::function<void()> hook) {
    const std::lock_guard lock(hook_mutex_);
    hook_ = std::move(hook);
  }
  [[nodiscard]] nlohmann::json state() const { return nlohmann::json::parse(service_->state()); }
  nlohmann::json command(const std::string& name,
                         const nlohmann::json& arguments = nlohmann::json::object()) {
    return nlohmann::json::parse(service_->command(name, arguments.dump()));
  }
  [[nodiscard]] std::string refusal(const std::string& name, const std::string& arguments) {
    return testing::error_of([&] { static_cast<void>(service_->command(name, arguments)); });
  }
  /// Waits for all jobs and returns the last one.
  nlohmann::json finish() {
    for (int i = 0; i < 30'000; ++i) {
      const nlohmann::json jobs = state().at("jobs");
      bool busy = false;
      for (const nlohmann::json& job : jobs)
        busy = busy || job.at("state") == "waiting" || job.at("state") == "running";
      if (!busy) return jobs.empty() ? nlohmann::json() : jobs.back();
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    ADD_FAILURE() << "the jobs do not end";
    return {};
  }
  /// A project with a surface that no scan made: an open box and a separate ball.
  void open_box(int rings = 12) {
    const auto folder = folder_.path() / "projects" / "box";
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "project.json") << "{}";
    Mesh mesh = testing::sphere({20, 0, 0}, 3.0, rings);
    append_mesh(mesh, testing::box({-5, -5, -5}, {5, 5, 5}));
    mesh.triangles.pop_back();
    write_mesh(folder / "surface.ply", mesh);
    static_cast<void>(command("open-project", {{"name", "box"}}));
    static_cast<void>(finish());
  }

  testing::TemporaryFolder folder_;
  std::atomic<int> changes_ = 0;
  std::recursive_mutex hook_mutex_;
  std::function<void()> hook_;
  std::unique_ptr<Service> service_;
};

}  // namespace frangia
