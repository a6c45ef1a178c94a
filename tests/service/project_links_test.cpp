// Links below a project, and files of it that no program of ours wrote.
#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "service/service_fixture.h"

namespace frangia {
namespace {

namespace fs = std::filesystem;
using testing::error_of;

constexpr const char* kSecret = "a secret that is long enough to be found";

/// A project in which names are links to another folder.
class ProjectLinks : public ServiceTest {
 protected:
  ProjectLinks() {
    open_box();
    static_cast<void>(command("close-project"));
    fs::create_directories(outside_);
    std::ofstream(outside_ / "file") << kSecret;
  }
  [[nodiscard]] fs::path project() const { return folder_.path() / "projects" / "box"; }

  static std::string text_of(const fs::path& file) {
    std::ifstream stream(file);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  /// What opening the project says: the refusal, or what its job says.
  std::string opening() {
    const std::string refused = refusal("open-project", R"({"name": "box"})");
    if (!refused.empty()) return refused;
    return finish().value("error", std::string());
  }
  /// The sentence names the link and what to do.
  void expect_named(const std::string& sentence, const fs::path& link) const {
    EXPECT_NE(sentence.find(link.string() + ": is a link to "), std::string::npos) << sentence;
    EXPECT_NE(sentence.find("bind-mount"), std::string::npos) << sentence;
    EXPECT_EQ(sentence.find(kSecret), std::string::npos) << sentence;
  }
  void expect_outside_unchanged() const {
    EXPECT_EQ(text_of(outside_ / "file"), kSecret);
    EXPECT_EQ(std::distance(fs::directory_iterator(outside_), {}), 1);
  }

  fs::path outside_ = folder_.path() / "outside";
};

TEST_F(ProjectLinks, AreNamedWhenTheProjectIsOpened) {
  for (const char* name : {"scan", "exports", "versions.json", "surface.ply", "stations.json"}) {
    const fs::path kept = folder_.path() / "kept";
    const bool present = fs::exists(project() / name);
    if (present) fs::rename(project() / name, kept);
    if (std::string(name).find('.') == std::string::npos)
      fs::create_directory_symlink(outside_, project() / name);
    else
      fs::create_symlink(outside_ / "file", project() / name);
    expect_named(opening(), project() / name);
    fs::remove(project() / name);
    if (present) fs::rename(kept, project() / name);
    EXPECT_EQ(opening(), "") << name;
    expect_outside_unchanged();
  }
}

TEST_F(ProjectLinks, HideNoProjectOfTheList) {
  fs::create_symlink(outside_ / "file", project() / "versions.json");
  fs::create_directories(folder_.path() / "projects" / "other");
  std::ofstream(folder_.path() / "projects" / "other" / "project.json") << "{}";
  static_cast<void>(refusal("open-project", R"({"name": "none"})"));  // lists the projects again
  EXPECT_EQ(state().at("projects").size(), 2U);
}

TEST_F(ProjectLinks, LeadNoDownloadToOtherFiles) {
  ASSERT_EQ(opening(), "");
  fs::create_directories(project() / "exports");
  std::ofstream(project() / "exports" / "plain.stl") << "plain";
  fs::create_symlink(outside_ / "file", project() / "exports" / "linked.stl");
  EXPECT_NE(error_of([&] { static_cast<void>(service_->exported("linked.stl")); }), "");
  const ExportedFile plain = service_->exported("plain.stl");
  std::string bytes(5, ' ');
  EXPECT_EQ(::read(plain.file.number(), bytes.data(), 5), 5);
  EXPECT_EQ(bytes, "plain");
  fs::create_symlink(outside_ / "file", project() / "residuals.json");
  expect_named(error_of([&] { static_cast<void>(service_->residuals()); }),
               project() / "residuals.json");
  fs::rename(project() / "exports", project() / "before");
  fs::create_directory_symlink(project() / "before", project() / "exports");
  expect_named(error_of([&] { static_cast<void>(service_->exported("plain.stl")); }),
               project() / "exports");
}

TEST_F(ProjectLinks, TakeNoByteOfAReference) {
  ASSERT_EQ(opening(), "");
  const auto send = [&](std::size_t offset) {
    return error_of([&] { service_->add_to_reference(offset, "bytes of a client"); });
  };
  fs::create_symlink(outside_ / "file", project() / "reference.part");
  for (const std::size_t offset : {std::size_t{0}, std::string(kSecret).size()})
    expect_named(send(offset), project() / "reference.part");
  fs::remove(project() / "reference.part");
  fs::create_hard_link(outside_ / "file", project() / "reference.part");
  EXPECT_NE(send(std::string(kSecret).size()).find("hard link"), std::string::npos);
  expect_outside_unchanged();
  EXPECT_EQ(send(0), "") << "it is a file of the project from now on";
  EXPECT_EQ(text_of(project() / "reference.part"), "bytes of a client");
  expect_outside_unchanged();
}

TEST_F(ProjectLinks, AreNamedInAPlainScanFolder) {
  const fs::path scan = folder_.path() / "scan";
  fs::create_directories(scan);
  std::ofstream(scan / "scan.toml") << "";
  fs::create_directory_symlink(outside_, scan / "derived");
  expect_named(error_of([&] { service_->open_folder(scan); }), scan / "derived");
  expect_outside_unchanged();
}

TEST_F(ProjectLinks, AreNotWrittenThrough) {
  ASSERT_EQ(opening(), "");
  fs::create_directory_symlink(outside_, project() / "versions");
  static_cast<void>(command("edit", {{"operation", "offset"}, {"value", "0.1mm"}}));
  static_cast<void>(finish());
  fs::create_directory_symlink(outside_, project() / "exports");
  static_cast<void>(refusal("export", R"({"format": "stl"})"));
  static_cast<void>(finish());
  expect_outside_unchanged();
}

/// JSON that a parser or a destructor which recurses does not survive.
std::string nested() {
  return R"({"a": )" + std::string(500'000, '[') + std::string(500'000, ']') + "}";
}

TEST_F(ProjectLinks, AndNestedFilesEndNothing) {
  std::ofstream(project() / "surface.json") << nested();
  ASSERT_EQ(opening(), "");
  const nlohmann::json job = state().at("jobs").back();
  ASSERT_EQ(job.at("log").size(), 1U);
  EXPECT_NE(job.at("log")[0].dump().find("without its figures"), std::string::npos);
  EXPECT_FALSE(state().at("project").at("surface").is_null());
  for (const char* name : {"stations.json", "reference.json", "exports.json", "capture.json"}) {
    std::ofstream(project() / name) << nested();
    EXPECT_EQ(opening(), "") << name;
    EXPECT_FALSE(state().at("project").at("surface").is_null()) << name;
    fs::remove(project() / name);
  }
  std::ofstream(project() / "versions.json") << nested();
  EXPECT_NE(opening().find("versions.json"), std::string::npos);
}

}  // namespace
}  // namespace frangia
