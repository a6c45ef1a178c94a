#include <chrono>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "frangia/core/folder_lock.h"
#include "frangia/core/read_file.h"
#include "frangia/editor/edit_script.h"
#include "frangia/files/read_mesh.h"

#include "service/service_fixture.h"

namespace frangia {
namespace {

using testing::error_of;
using Json = nlohmann::json;

TEST_F(ServiceTest, RefusesWhatItDoesNotUnderstandInWords) {
  EXPECT_NE(refusal("no-such-command", "{}"), "");
  EXPECT_NE(refusal("create-project", ""), "");
  EXPECT_NE(refusal("create-project", "{"), "");
  EXPECT_NE(refusal("create-project", "[]"), "");
  EXPECT_NE(refusal("create-project", R"({"name": 3})"), "");
  EXPECT_NE(refusal("create-project", R"({"name": "../x"})"), "");
  EXPECT_NE(refusal("create-project", R"({"name": "x", "part": "no such part"})"), "");
  EXPECT_NE(refusal("create-project", R"({"name": "x", "stations": 0})"), "");
  EXPECT_NE(refusal("create-project", R"({"name": "x", "stations": 1e9})"), "");
  EXPECT_NE(refusal("create-project", R"({"name": "x", "extra": 1})").find("extra"),
            std::string::npos);
  EXPECT_NE(refusal("open-project", R"({"name": "../../etc"})"), "");
  EXPECT_NE(refusal("reconstruct", "{}"), "");
  EXPECT_NE(refusal("undo", "{}"), "");
  EXPECT_NE(refusal("stop-job", R"({"job": 4})"), "");
  EXPECT_NE(refusal("edit", std::string(2'000'000, ' ')), "");
  EXPECT_NE(refusal("edit", std::string(100'000, '[')), "");
  EXPECT_TRUE(state().at("projects").empty()) << "a refused command leaves nothing behind";
}

/// The arrays of a packed answer, without the header, which states the revision that was first
/// shown.
std::string without_header(const std::string& packed) {
  std::uint32_t bytes = 0;
  std::memcpy(&bytes, packed.data(), sizeof bytes);
  return packed.substr(sizeof bytes + bytes);
}

TEST_F(ServiceTest, EditsUndoesAndKeepsTheStepsOverARestart) {
  open_box();
  Json surface = state().at("project").at("surface");
  const auto triangles = surface.at("triangles").get<std::size_t>();
  EXPECT_EQ(surface.at("components"), 2);
  ASSERT_EQ(surface.at("holes").size(), 1U);

  static_cast<void>(command("select-component-of", {{"triangle", 0}}));
  EXPECT_EQ(finish().at("state"), "done");
  const Json selected = state().at("project").at("surface");
  EXPECT_EQ(selected.at("mesh_revision"), surface.at("mesh_revision"));
  EXPECT_NE(selected.at("selection_revision"), surface.at("selection_revision"));
  EXPECT_EQ(selected.at("selected"), triangles - 11);

  static_cast<void>(command("edit", {{"operation", "delete"}}));
  static_cast<void>(command("edit", {{"operation", "fill-hole-flat"}, {"value", "0"}}));
  EXPECT_EQ(finish().at("state"), "done");
  surface = state().at("project").at("surface");
  EXPECT_EQ(surface.at("triangles"), 12);
  EXPECT_EQ(surface.at("hole_count"), 0);
  for (int i = 0; i < 2; ++i) {
    static_cast<void>(command("undo"));
    static_cast<void>(finish());
  }
  const Json undone = state().at("project").at("surface");
  EXPECT_EQ(undone.at("mesh_revision"), selected.at("mesh_revision"));
  EXPECT_EQ(undone.at("selection_revision"), selected.at("selection_revision"))
      << "a client that knows them need not ask again";
  for (int i = 0; i < 2; ++i) {
    static_cast<void>(command("redo"));
    static_cast<void>(finish());
  }
  static_cast<void>(command("undo"));
  static_cast<void>(finish());
  EXPECT_EQ(state().at("project").at("surface").at("triangles"), 11);
  EXPECT_EQ(state().at("project").at("commands").at("edit"), Json::array({"box", "2"}));
  static_cast<void>(command("redo"));
  static_cast<void>(finish());
  const std::string mesh = service_->mesh();

  restart();
  static_cast<void>(command("open-project", {{"name", "box"}}));
  static_cast<void>(finish());
  EXPECT_EQ(without_header(service_->mesh()), without_header(mesh));
  EXPECT_EQ(state().at("project").at("surface").at("steps_done"), 3);
}

TEST_F(ServiceTest, ReplaysItsStepsByTheCommandLineToTheSameMesh) {
  open_box();
  static_cast<void>(command("edit", {{"operation", "keep-largest"}, {"value", "1"}}));
  static_cast<void>(command("edit", {{"operation", "fill-holes-flat"}, {"value", "30mm"}}));
  EXPECT_EQ(finish().at("state"), "done");
  static_cast<void>(command("export", {{"format", "ply"}}));
  EXPECT_EQ(finish().at("state"), "done");
  const Mesh exported = read_mesh(service_->exported("box.ply").path);
  const auto folder = folder_.path() / "projects" / "box";
  EditState state{.mesh = read_mesh(folder / "surface.ply"), .selection = {}};
  const EditScript script = read_edit_script(folder / "edits-2.json");
  for (const EditStep& step : script.steps)
    apply_step(state, step);
  EXPECT_EQ(exported.triangles, state.mesh.triangles);
  EXPECT_EQ(exported.vertices_mm, state.mesh.vertices_mm);
  for (const char* name : {"../surface.ply", "surface.ply", "", "..", "/etc/passwd"})
    EXPECT_NE(error_of([&] { static_cast<void>(service_->exported(name)); }), "") << name;
}

TEST_F(ServiceTest, ShowsLevelsOfALargeMeshAndKnowsAnUndoneMeshAgain) {
  constexpr int kRings = 400;  // 638 400 triangles: more than are drawn at rest
  open_box(kRings);
  const Json before = state().at("project").at("surface");
  ASSERT_EQ(before.at("levels").size(), 2U);
  EXPECT_LE(before.at("levels")[0].at("triangles"), 100'000);
  EXPECT_LE(before.at("levels")[1].at("triangles"), 500'000);
  EXPECT_LT(service_->level(0).size(), service_->level(1).size());
  EXPECT_TRUE(service_->level(2).empty());
  static_cast<void>(
      command("select-component-of", {{"triangle", before.at("triangles").get<int>() - 1}}));
  static_cast<void>(command("edit", {{"operation", "delete"}}));
  EXPECT_EQ(finish().at("state"), "done");
  const Json after = state().at("project").at("surface");
  EXPECT_NE(after.at("mesh_revision"), before.at("mesh_revision"));
  static_cast<void>(command("undo"));
  static_cast<void>(finish());
  const Json undone = state().at("project").at("surface");
  EXPECT_EQ(undone.at("mesh_revision"), before.at("mesh_revision"));
  EXPECT_EQ(undone.at("selected"), 11);
  EXPECT_EQ(undone.at("levels"), before.at("levels"));
  static_cast<void>(command("redo"));
  static_cast<void>(finish());
  EXPECT_EQ(state().at("project").at("surface").at("mesh_revision"), after.at("mesh_revision"));
}

TEST_F(ServiceTest, SaysWhatEachStepChangedAlsoAfterARestart) {
  open_box();
  const auto triangles = state().at("project").at("surface").at("triangles").get<int>();
  static_cast<void>(command("edit", {{"operation", "keep-largest"}, {"value", "1"}}));
  static_cast<void>(command("edit", {{"operation", "fill-holes-flat"}, {"value", "30mm"}}));
  EXPECT_EQ(finish().at("state"), "done");
  const Json steps = state().at("project").at("surface").at("steps");
  ASSERT_EQ(steps.size(), 2U);
  EXPECT_EQ(steps[0].at("change").at("components"), -1);
  EXPECT_EQ(steps[0].at("change").at("triangles"), 11 - triangles) << "the box has 11";
  EXPECT_EQ(steps[1].at("change").at("holes"), -1);
  EXPECT_EQ(steps[1].at("change").at("triangles"), 1);
  restart();
  static_cast<void>(command("open-project", {{"name", "box"}}));
  static_cast<void>(finish());
  EXPECT_EQ(state().at("project").at("surface").at("steps"), steps);
}

TEST_F(ServiceTest, PreviewsAnEditWithoutApplyingIt) {
  open_box();
  const Json before = state().at("project").at("surface");
  EXPECT_TRUE(service_->preview().empty());
  static_cast<void>(command("preview", {{"operation", "fill-hole-flat"}, {"value", "0"}}));
  EXPECT_EQ(finish().at("state"), "done");
  const Json surface = state().at("project").at("surface");
  EXPECT_EQ(surface.at("mesh_revision"), before.at("mesh_revision"));
  EXPECT_EQ(surface.at("triangles"), before.at("triangles"));
  EXPECT_TRUE(surface.at("steps").empty());
  EXPECT_EQ(surface.at("preview").at("change").at("triangles"), 1);
  EXPECT_EQ(surface.at("preview").at("change").at("holes"), -1);
  EXPECT_FALSE(service_->preview().empty());
  static_cast<void>(command("drop-preview"));
  static_cast<void>(finish());
  EXPECT_TRUE(state().at("project").at("surface").at("preview").is_null());
  EXPECT_NE(refusal("preview", R"({"operation": "no-such"})"), "");
}

TEST_F(ServiceTest, EstimatesTheSizeOfAFileBeforeItIsWritten) {
  open_box(60);
  for (const char* format : {"dxf", "stl", "ply", "obj", "glb"}) {
    const Json estimate = command("estimate-export", {{"format", format}});
    static_cast<void>(command("export", {{"format", format}}));
    ASSERT_EQ(finish().at("state"), "done") << format;
    const auto size =
        std::filesystem::file_size(service_->exported(std::string("box.") + format).path);
    EXPECT_NEAR(estimate.at("bytes").get<double>() / static_cast<double>(size), 1.0, 0.1) << format;
  }
  EXPECT_NE(refusal("estimate-export", R"({"format": "zip"})"), "");
  EXPECT_NE(refusal("estimate-export", R"({"format": "exe"})"), "");
}

TEST_F(ServiceTest, OpensASurfaceWithoutTrianglesAndSaysSoAtExport) {
  const auto folder = folder_.path() / "projects" / "points";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "project.json") << "{}";
  std::ofstream(folder / "surface.ply")
      << "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty "
         "float z\nelement face 0\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 "
         "0\n0 1 0\n";
  static_cast<void>(command("open-project", {{"name", "points"}}));
  EXPECT_EQ(finish().at("state"), "done");
  EXPECT_EQ(state().at("project").at("surface").at("triangles"), 0);
  EXPECT_FALSE(service_->level(0).empty());
  EXPECT_TRUE(Json::parse(service_->pick(R"({"eye": [0, 0, 9], "direction": [0, 0, -1]})"))
                  .at("hit")
                  .is_null());
  static_cast<void>(command("export", {{"format", "dxf"}}));
  const Json job = finish();
  EXPECT_EQ(job.at("state"), "failed");
  EXPECT_NE(job.at("error").get<std::string>().find("triangles"), std::string::npos);
}

TEST_F(ServiceTest, TellsOfASurfaceFromTheMomentItsProjectIsOpen) {
  open_box(60);
  restart();
  static_cast<void>(command("open-project", {{"name", "box"}}));
  for (bool busy = true; busy;) {
    const nlohmann::json now = state();
    const nlohmann::json& project = now.at("project");
    busy = project.at("surface_loading").get<bool>();
    ASSERT_NE(busy, project.at("surface").is_object());
  }
  EXPECT_EQ(finish().at("state"), "done");
}

TEST_F(ServiceTest, DoesNotWaitForASurfaceThatCannotBeRead) {
  open_box();
  restart();
  std::ofstream(folder_.path() / "projects" / "box" / "surface.ply") << "no mesh";
  static_cast<void>(command("open-project", {{"name", "box"}}));
  EXPECT_EQ(finish().at("state"), "failed");
  EXPECT_FALSE(state().at("project").at("surface_loading").get<bool>());
  EXPECT_TRUE(state().at("project").at("surface").is_null());
}

TEST_F(ServiceTest, PicksPointsOfTheSurface) {
  open_box();
  const Json hit = Json::parse(service_->pick(R"({"eye": [0, 0, 50], "direction": [0, 0, -1]})"));
  EXPECT_NEAR(hit.at("hit").at("point_mm")[2].get<double>(), 5.0, 1e-6);
  EXPECT_TRUE(hit.at("hit").at("sigma_mm").is_null());
  EXPECT_EQ(hit.at("mesh_revision"), state().at("project").at("surface").at("mesh_revision"));
  for (const char* wrong : {"", "{}", R"({"eye": [0, 0, 1]})", R"({"eye": [0], "direction": [1]})"})
    EXPECT_NE(error_of([&] { static_cast<void>(service_->pick(wrong)); }), "") << wrong;
}

TEST_F(ServiceTest, FitsShapesToTheSelection) {
  open_box(96);
  EXPECT_NE(refusal("fit", R"({"kind": "egg"})"), "");
  static_cast<void>(command("fit", {{"kind", "sphere"}}));
  EXPECT_EQ(finish().at("state"), "failed") << "nothing is selected";
  static_cast<void>(command("select-component-of", {{"triangle", 0}}));
  static_cast<void>(command("fit", {{"kind", "sphere"}}));
  ASSERT_EQ(finish().at("state"), "done");
  const Json fits = state().at("project").at("surface").at("fits");
  ASSERT_EQ(fits.size(), 1U);
  EXPECT_NEAR(fits[0].at("diameter_mm").get<double>(), 6.0, 0.002);
  EXPECT_NEAR(fits[0].at("center_mm")[0].get<double>(), 20.0, 0.001);
  static_cast<void>(command("edit", {{"operation", "delete"}}));
  static_cast<void>(finish());
  EXPECT_TRUE(state().at("project").at("surface").at("fits").empty()) << "of another mesh";
}

TEST_F(ServiceTest, KeepsTheMeshWhenAStepFails) {
  open_box();
  const std::string mesh = service_->mesh();
  static_cast<void>(command("edit", {{"operation", "delete"}}));  // nothing is selected
  const Json job = finish();
  EXPECT_EQ(job.at("state"), "failed");
  EXPECT_NE(job.at("error").get<std::string>().find("select"), std::string::npos);
  EXPECT_EQ(service_->mesh(), mesh);
  EXPECT_NE(refusal("edit", R"({"operation": "decimate", "value": "much"})"), "");
}

TEST_F(ServiceTest, OpensACloudOfPointsToBeLookedAt) {
  const std::string points = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
  static_cast<void>(command("create-project", {{"name", "Points"}, {"devices", true}}));
  static_cast<void>(finish());
  service_->add_to_reference(0, points);
  static_cast<void>(command("open-file", {{"format", "xyz"}, {"bytes", points.size()}}));
  EXPECT_EQ(finish().at("state"), "done");
  EXPECT_EQ(state().at("project").at("surface").at("triangles"), 0);
  EXPECT_FALSE(service_->level(0).empty());
}

TEST_F(ServiceTest, CopiesTheProjectThatItHasOpenAndNoneThatAnotherOneHas) {
  static_cast<void>(command("create-project", {{"name", "Part"}, {"devices", true}}));
  static_cast<void>(finish());
  static_cast<void>(command("duplicate-project", {{"name", "Part"}, {"copy", "Copy"}}));
  EXPECT_EQ(finish().at("state"), "done");
  const FolderLock other(folder_.path() / "projects" / "Copy");
  static_cast<void>(command("duplicate-project", {{"name", "Copy"}, {"copy", "Third"}}));
  EXPECT_EQ(finish().at("state"), "failed");
  EXPECT_EQ(state().at("projects").size(), 2U);
  EXPECT_EQ(state().at("project").at("name"), "Part");
}

TEST_F(ServiceTest, EmptiesTheBinOfWhatIsNamed) {
  for (const char* name : {"A", "B"}) {
    static_cast<void>(command("create-project", {{"name", name}, {"devices", true}}));
    static_cast<void>(finish());
    static_cast<void>(command("discard-project", {{"name", name}}));
  }
  EXPECT_GT(state().at("discarded_bytes"), 0);
  EXPECT_NE(refusal("empty-bin", R"({"names": "A"})"), "");
  EXPECT_NE(refusal("empty-bin", R"({"names": [1]})"), "");
  static_cast<void>(command("empty-bin", {{"names", {"A"}}}));
  EXPECT_EQ(finish().at("state"), "done");
  EXPECT_EQ(state().at("discarded"), Json::array({"B"})) << "what came after the question stays";
  EXPECT_NE(refusal("empty-bin", R"({"names": ["A"]})"), "") << "it is gone";
  EXPECT_NE(refusal("empty-bin", R"({"names": ["../A"]})"), "");
  EXPECT_NE(refusal("empty-bin", R"({"names": []})"), "");
  static_cast<void>(command("empty-bin", {{"names", {"B"}}}));
  EXPECT_EQ(finish().at("state"), "done");
  EXPECT_EQ(state().at("discarded_bytes"), 0);
}

TEST_F(ServiceTest, OpensAMeshInAProjectOfItsOwnAndLeavesNothingOfWhatItCannotRead) {
  const auto send = [&](const std::string& name, const std::string& bytes) {
    static_cast<void>(command("create-project", {{"name", name}, {"devices", true}}));
    static_cast<void>(finish());
    service_->add_to_reference(0, bytes);
  };
  const auto file = folder_.path() / "box.stl";
  write_mesh(file, testing::box({0, 0, 0}, {10, 20, 30}));
  const std::string bytes = read_text_file(file);
  send("Box", bytes);
  EXPECT_NE(refusal("open-file", R"({"format": "../x", "bytes": 3})"), "");
  EXPECT_NE(refusal("open-file", R"({"format": "exe", "bytes": 3})"), "");
  EXPECT_NE(refusal("open-file", R"({"format": "stl", "bytes": 3})"), "") << "not so many arrived";
  static_cast<void>(command("open-file", {{"format", "stl"}, {"bytes", bytes.size()}}));
  EXPECT_EQ(finish().at("state"), "done");
  const Json surface = state().at("project").at("surface");
  EXPECT_EQ(surface.at("triangles"), 12);
  EXPECT_TRUE(surface.at("summary").is_null()) << "no scan made it";
  EXPECT_NE(refusal("open-file", R"({"format": "stl", "bytes": 3})"), "") << "it has a surface";

  send("Broken", "solid x\nfacet");
  static_cast<void>(
      command("open-file", {{"format", "stl"}, {"bytes", 13}, {"name", "my part.stl"}}));
  const Json broken = finish();
  EXPECT_EQ(broken.at("state"), "failed");
  const std::string why = broken.at("error");
  EXPECT_NE(why.find("my part.stl"), std::string::npos) << why;
  EXPECT_EQ(why.find("arrived"), std::string::npos) << why;
  EXPECT_TRUE(state().at("project").at("surface").is_null());
  static_cast<void>(command("discard-project", {{"name", "Broken"}}));
  EXPECT_TRUE(state().at("project").is_null());
  EXPECT_EQ(state().at("discarded"), Json::array({"Broken"}));

  static_cast<void>(command("open-project", {{"name", "Box"}}));
  static_cast<void>(finish());
  static_cast<void>(command("rename-project", {{"name", "Box"}, {"to", "Cuboid"}}));
  static_cast<void>(finish());
  EXPECT_EQ(state().at("project").at("name"), "Cuboid") << "it stays open";
  EXPECT_EQ(state().at("project").at("surface").at("triangles"), 12);
  static_cast<void>(command("set-notes", {{"name", "Cuboid"}, {"text", "of brass"}}));
  EXPECT_EQ(state().at("projects")[0].at("notes"), "of brass");
  EXPECT_NE(refusal("set-thumbnail", R"({"picture": "bm90IGEgcGljdHVyZQ=="})"), "");
  const auto changed = std::filesystem::file_time_type::clock::now() - std::chrono::hours(48);
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(folder_.path() / "projects" / "Cuboid"))
    std::filesystem::last_write_time(entry, changed);
  std::filesystem::last_write_time(folder_.path() / "projects" / "Cuboid", changed);
  static_cast<void>(command("set-thumbnail", {{"picture", "iVBORw0KGgo="}}));
  EXPECT_EQ(state().at("projects")[0].at("modified_s"),
            modified_s(folder_.path() / "projects" / "Cuboid"))
      << "to be pictured is no change";
  EXPECT_EQ(service_->thumbnail("Cuboid").substr(1, 3), "PNG");
  EXPECT_NE(error_of([&] { static_cast<void>(service_->thumbnail("../x")); }), "");
}

}  // namespace
}  // namespace frangia
