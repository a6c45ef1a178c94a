#include "frangia/service/internal/surface_versions.h"

#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "frangia/service/encode_arrays.h"

#include "service/project_on_disk.h"
#include "service/service_fixture.h"
#include "support/small_scan.h"
#include "support/text_of.h"

namespace frangia {
namespace {

using testing::text_of;
using Json = nlohmann::json;

/// A service with a project that has been scanned.
class VersionsOfASurface : public ServiceTest {
 protected:
  void open_scanned() {
    std::filesystem::create_directories(project());
    std::ofstream(project() / "project.json") << "{}";
    static_cast<void>(
        testing::small_scan(project() / "scan", "plate", "angular", 1, {.samples_per_px = 1}));
    open();
  }
  void open() {
    static_cast<void>(command("open-project", {{"name", "box"}}));
    static_cast<void>(finish());
  }
  /// The same, stopped before the surface is read.
  void open_and_stop() {
    at_changes([this] {
      for (const Json seen = state(); const Json& job : seen.at("jobs"))
        if (job.at("state") == "running")
          static_cast<void>(service_->command("stop-job", Json{{"job", job.at("number")}}.dump()));
    });
    static_cast<void>(command("open-project", {{"name", "box"}}));
    EXPECT_EQ(finish().at("state"), "stopped");
    at_changes({});
  }
  Json run(const std::string& name, const Json& arguments = Json::object()) {
    static_cast<void>(command(name, arguments));
    return finish();
  }
  [[nodiscard]] std::filesystem::path project() const {
    return folder_.path() / "projects" / "box";
  }
  [[nodiscard]] Json now() const { return state().at("project"); }
};

TEST_F(VersionsOfASurface, AreInspectedWithTheScanThatTheyWereMadeOfUntilAStepMovesThem) {
  open_scanned();
  ASSERT_EQ(run("reconstruct", {{"voxel_mm", 2.0}}).at("state"), "done");
  const auto report = [&] {
    EXPECT_EQ(run("inspect", {{"features", true}}).at("state"), "done");
    EXPECT_EQ(run("report").at("state"), "done");
    return text_of(service_->exported("box report.html").path);
  };
  EXPECT_NE(report().find("SHA-256 of scan.toml"), std::string::npos);
  ASSERT_EQ(run("edit", {{"operation", "mirror"}, {"value", "1,0,0,0"}}).at("state"), "done");
  EXPECT_EQ(report().find("SHA-256 of scan.toml"), std::string::npos);
}

TEST_F(VersionsOfASurface, StayWithTheirEditsWhenTheSurfaceIsBuiltAgain) {
  open_scanned();
  ASSERT_EQ(run("reconstruct", {{"voxel_mm", 2.0}}).at("state"), "done");
  EXPECT_EQ(now().at("versions").size(), 1U);
  ASSERT_EQ(run("edit", {{"operation", "offset"}, {"value", "0.1mm"}}).at("state"), "done");
  ASSERT_EQ(run("edit", {{"operation", "reverse-orientation"}}).at("state"), "done");
  const std::string edited = service_->mesh();
  ASSERT_EQ(run("undo").at("state"), "done");

  const Json built = run("reconstruct", {{"voxel_mm", 2.0}});
  ASSERT_EQ(built.at("state"), "done");
  EXPECT_EQ(built.at("revision"), 5);
  Json shown = now();
  EXPECT_EQ(shown.at("revision"), 5);
  EXPECT_EQ(shown.at("current_version"), 2);
  EXPECT_TRUE(shown.at("surface").at("steps").empty());
  ASSERT_EQ(shown.at("versions").size(), 2U);
  EXPECT_EQ(shown.at("versions")[0].at("steps"), 2);
  EXPECT_EQ(shown.at("versions")[0].at("steps_done"), 1);
  EXPECT_EQ(shown.at("versions")[1].at("previous"), 1);

  // The edits of the surface before are replayed: those that were not undone, each a step.
  ASSERT_EQ(run("replay-edits", {{"version", 1}}).at("state"), "done");
  shown = now();
  ASSERT_EQ(shown.at("surface").at("steps").size(), 1U);
  EXPECT_EQ(shown.at("surface").at("steps")[0].at("operation"), "offset");
  EXPECT_EQ(shown.at("revision"), 6);
  EXPECT_EQ(run("replay-edits", {{"version", 2}}).at("state"), "failed") << "its own";
  EXPECT_EQ(run("replay-edits", {{"version", 7}}).at("state"), "failed");

  // The earlier one comes back with what was undone.
  ASSERT_EQ(run("open-version", {{"version", 1}}).at("state"), "done");
  ASSERT_EQ(run("redo").at("state"), "done");
  restart();
  open();
  EXPECT_EQ(now().at("surface").at("version"), 1);
  EXPECT_EQ(now().at("surface").at("steps_done"), 2);
  const auto disk = testing::read_project(project());
  EXPECT_EQ(disk.current, 1);
  EXPECT_EQ(disk.revision, now().at("revision"));
  EXPECT_EQ(service_->mesh(),
            encode_mesh(testing::mesh_of(project(), disk),
                        now().at("surface").at("mesh_revision").get<int>()));
  EXPECT_EQ(service_->mesh().size(), edited.size());
  EXPECT_EQ(run("open-version", {{"version", 9}}).at("state"), "failed");
}

TEST_F(VersionsOfASurface, AreUntouchedByAReconstructionThatFails) {
  open_scanned();
  ASSERT_EQ(run("reconstruct", {{"voxel_mm", 2.0}}).at("state"), "done");
  ASSERT_EQ(run("edit", {{"operation", "offset"}, {"value", "0.1mm"}}).at("state"), "done");
  const Json before = now();
  std::filesystem::rename(project() / "scan", project() / "elsewhere");
  EXPECT_EQ(run("reconstruct").at("state"), "failed");
  EXPECT_EQ(now().at("surface"), before.at("surface"));
  EXPECT_EQ(now().at("revision"), before.at("revision"));
  restart();
  open();
  EXPECT_EQ(now().at("surface").at("steps"), before.at("surface").at("steps"));
}

TEST_F(VersionsOfASurface, BeginWithWhatAnOlderProgramLeft) {
  open_box();
  const auto surface = text_of(project() / "surface.ply");
  write_edit_script(project() / "edits.json",
                    {{{"keep-largest", "1"}, {"reverse-orientation", ""}}, 1});
  const auto edits = text_of(project() / "edits.json");
  restart();
  open();
  Json found = now();
  EXPECT_EQ(found.at("revision"), 0);
  EXPECT_EQ(found.at("surface").at("steps_done"), 1);
  EXPECT_EQ(found.at("versions")[0].at("steps"), 2);
  EXPECT_FALSE(std::filesystem::exists(project() / "versions.json")) << "nothing was changed";
  ASSERT_EQ(run("redo").at("state"), "done");
  restart();
  open();
  found = now();
  EXPECT_EQ(found.at("revision"), 1);
  EXPECT_EQ(found.at("surface").at("steps_done"), 2);
  EXPECT_EQ(text_of(project() / "surface.ply"), surface);
  EXPECT_EQ(text_of(project() / "edits.json"), edits) << "an older program finds its own state";
}

TEST_F(VersionsOfASurface, AreNamedWhenTheirFileIsDamaged) {
  open_box();
  ASSERT_EQ(run("edit", {{"operation", "keep-largest"}, {"value", "1"}}).at("state"), "done");
  const std::string text = text_of(project() / "versions.json");
  const auto replaced = [&](const std::string& from, const std::string& to) {
    std::string changed = text;
    return changed.replace(changed.find(from), from.size(), to);
  };
  for (const std::string& damaged : {std::string("{"),
                                     std::string("[]"),
                                     std::string(100'000, '['),
                                     text.substr(0, text.size() / 2),
                                     replaced("\"current\": 1", "\"current\": 2"),
                                     replaced("\"current\": 1", "\"current\": \"../..\""),
                                     replaced("\"revision\": 1", "\"revision\": 1e300"),
                                     replaced("\"edits\": 1", "\"edits\": -1"),
                                     replaced("\"number\": 1", "\"number\": 99999999999")}) {
    restart();
    std::ofstream(project() / "versions.json") << damaged;
    static_cast<void>(command("open-project", {{"name", "box"}}));
    const Json job = finish();
    EXPECT_EQ(job.at("state"), "failed") << damaged.substr(0, 100);
    EXPECT_NE(job.at("error").get<std::string>().find("versions.json"), std::string::npos);
    EXPECT_FALSE(now().at("surface_loading").get<bool>());
    EXPECT_EQ(run("reconstruct").at("state"), "failed");
    EXPECT_EQ(run("edit", {{"operation", "invert"}}).at("state"), "failed");
    EXPECT_EQ(text_of(project() / "versions.json"), damaged) << "what can be saved is not lost";
  }
  // The same server reads it again once it is restored.
  std::ofstream(project() / "versions.json") << text;
  EXPECT_EQ(run("edit", {{"operation", "reverse-orientation"}}).at("state"), "done");
  EXPECT_EQ(now().at("surface").at("steps").size(), 2U);
}

TEST_F(VersionsOfASurface, AreThereAfterTheirReadingWasStopped) {
  open_box(200);
  ASSERT_EQ(run("edit", {{"operation", "keep-largest"}, {"value", "1"}}).at("state"), "done");
  const std::string mesh = service_->mesh();
  restart();
  open_and_stop();
  EXPECT_FALSE(now().at("surface_loading").get<bool>());
  EXPECT_TRUE(now().at("surface").is_null());
  ASSERT_EQ(now().at("versions").size(), 1U) << "there is one all the same";
  EXPECT_EQ(now().at("current_version"), 1);
  // Whatever needs it reads it.
  EXPECT_EQ(run("undo").at("state"), "done");
  EXPECT_EQ(run("redo").at("state"), "done");
  EXPECT_EQ(service_->mesh().size(), mesh.size());
  EXPECT_EQ(now().at("surface").at("steps").size(), 1U);
}

TEST_F(VersionsOfASurface, AreThoseOfTheDiskWhenTheirProjectIsOpenedAgain) {
  open_box();
  ASSERT_EQ(run("edit", {{"operation", "keep-largest"}, {"value", "1"}}).at("state"), "done");
  static_cast<void>(command("close-project"));
  std::filesystem::remove(project() / "versions.json");  // somebody restores an older state
  open_and_stop();
  EXPECT_TRUE(now().at("surface").is_null());
  EXPECT_EQ(run("open-version", {{"version", 1}}).at("state"), "done");
  ASSERT_FALSE(now().at("surface").is_null());
  EXPECT_EQ(now().at("surface").at("steps").size(), 0U);
}

TEST_F(VersionsOfASurface, TakeACommandOnceHoweverOftenItArrives) {
  open_box();
  const Json offset = {{"operation", "offset"}, {"value", "0.1mm"}, {"id", "one-of-its-own"}};
  const Json first = command("edit", offset);
  const Json again = command("edit", offset);
  static_cast<void>(finish());
  EXPECT_FALSE(first.contains("repeated"));
  EXPECT_TRUE(again.at("repeated").get<bool>());
  EXPECT_EQ(again.at("job"), first.at("job"));
  EXPECT_EQ(now().at("surface").at("steps").size(), 1U);
  restart();
  open();
  const Json later = command("edit", offset);
  static_cast<void>(finish());
  EXPECT_TRUE(later.at("repeated").get<bool>());
  EXPECT_EQ(later.at("revision"), 1);
  EXPECT_EQ(now().at("surface").at("steps").size(), 1U) << "the id outlives the server";
  Json other = offset;
  other["value"] = "0.2mm";
  EXPECT_NE(refusal("edit", other.dump()).find("another command"), std::string::npos);
  other["id"] = "short";
  EXPECT_NE(refusal("edit", other.dump()).find("id"), std::string::npos);
  other["id"] = "another-of-its-own";
  EXPECT_EQ(command("edit", other).at("revision"), 1) << "at the time of the answer";
  static_cast<void>(finish());
  EXPECT_EQ(now().at("surface").at("steps").size(), 2U);
  // A bounded number is remembered.
  for (int i = 0; i < 70; ++i)
    static_cast<void>(run(i % 2 == 0 ? "undo" : "redo", {{"id", "number-" + std::to_string(i)}}));
  EXPECT_LE(Json::parse(text_of(project() / "versions.json")).at("answered").size(), 64U);
}

TEST_F(VersionsOfASurface, StateTheirRevisionInEveryExport) {
  open_box();
  ASSERT_EQ(run("edit", {{"operation", "keep-largest"}, {"value", "1"}}).at("state"), "done");
  EXPECT_EQ(run("export", {{"format", "ply"}}).at("revision"), 1);
  ASSERT_EQ(run("undo").at("state"), "done");
  EXPECT_EQ(run("export", {{"format", "stl"}}).at("revision"), 2);
  const auto expected = Json::array({1, 2});
  for (int i = 0; i < 2; ++i) {
    const Json exports = now().at("exports");
    ASSERT_EQ(exports.size(), 2U);
    EXPECT_EQ(exports[0].at("name"), "box.ply");
    EXPECT_EQ(exports[0].at("revision"), 1);
    EXPECT_EQ(exports[1].at("revision"), 2);
    EXPECT_EQ(exports[1].at("version"), 1);
    restart();
    open();
  }
  std::ofstream(project() / "exports" / "box.ply", std::ios::app) << "x";
  restart();
  open();
  EXPECT_TRUE(now().at("exports")[0].at("revision").is_null()) << "somebody changed the file";
}

TEST_F(VersionsOfASurface, OfAProjectAreNotThoseOfTheOneBeforeWhenOpeningIsStopped) {
  open_box();
  const auto other = folder_.path() / "projects" / "other";
  std::filesystem::create_directories(other);
  std::ofstream(other / "project.json") << "{}";
  write_mesh(other / "surface.ply", testing::box({0, 0, 0}, {1, 1, 1}));
  // Stopped while it waits: its work never begins.
  at_changes([this] {
    for (const Json seen = state(); const Json& job : seen.at("jobs"))
      if (job.at("state") == "waiting" && job.at("kind") == "open")
        static_cast<void>(service_->command("stop-job", Json{{"job", job.at("number")}}.dump()));
  });
  static_cast<void>(command("open-project", {{"name", "other"}}));
  static_cast<void>(finish());
  at_changes({});
  EXPECT_FALSE(now().at("surface_loading").get<bool>());
  EXPECT_EQ(run("edit", {{"operation", "reverse-orientation"}}).at("state"), "done");
  EXPECT_EQ(now().at("surface").at("triangles"), 12);
  EXPECT_FALSE(std::filesystem::exists(project() / "versions.json"));
  EXPECT_TRUE(std::filesystem::exists(other / "versions.json"));
}

}  // namespace
}  // namespace frangia
