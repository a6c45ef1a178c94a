// Calibrations as people and their scripts write them: names, lists, lens models, impossible
// values.
#include <array>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "frangia/exchange/read_calibration_file.h"
#include "frangia/exchange/rig_from_calibration.h"

#include "support/error_of.h"
#include "support/temporary_folder.h"

namespace frangia {
namespace {

using testing::error_of;
using testing::TemporaryFolder;
using Files = std::vector<std::filesystem::path>;

const ImportRigOptions kForeignSizes{.camera_size_px = std::array<int, 2>{1280, 1024},
                                     .projector_size_px = std::array<int, 2>{1280, 800}};

/// A file, and the rig of it with all warnings.
struct ImportedText {
  std::string error;
  std::string warnings;
  Rig rig;
};

ImportedText import_text(const std::string& text,
                         const std::string& name,
                         const CalibrationNames& names = {}) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / name) << text;
  ImportedText result;
  frangia::Run run;
  run.on_warning = [&](const std::string& sentence) { result.warnings += sentence + "\n"; };
  const Files files{folder.path() / name};
  result.error = error_of([&] {
    result.rig =
        rig_from_calibration(read_calibration_files(files, run, names), kForeignSizes, run);
  });
  return result;
}

/// The values that all files of the next tests state.
void expect_the_values(const ImportedText& found, const std::string& which) {
  ASSERT_EQ(found.error, "") << which;
  const auto* projector = std::get_if<PinholeModel>(&found.rig.projector.model);
  ASSERT_NE(projector, nullptr) << which;
  EXPECT_EQ(found.rig.reference().model.focal_px, Eigen::Vector2d(1400.0, 1402.0)) << which;
  EXPECT_EQ(found.rig.reference().model.principal_point_px, Eigen::Vector2d(640.0, 512.0)) << which;
  EXPECT_EQ(found.rig.reference().model.distortion[0], -0.1) << which;
  EXPECT_EQ(projector->focal_px, Eigen::Vector2d(2000.0, 2003.0)) << which;
  EXPECT_TRUE(found.rig.projector.position_mm.isApprox(Eigen::Vector3d(150.0, -3.0, -40.0)))
      << which;
}

constexpr const char* kRowsOfCamera = "[[1400.0, 0.0, 640.0], [0.0, 1402.0, 512.0], [0, 0, 1.0]]";
constexpr const char* kRowsOfProjector = "[[2000.0, 0.0, 640.0], [0.0, 2003.0, 700.0], [0, 0, 1]]";
constexpr const char* kRowsOfNoRotation = "[[1, 0, 0], [0, 1, 0], [0, 0, 1]]";

/// The values under these names, as lists of rows.
std::string yaml_of_rows(const std::array<std::string, 6>& names) {
  std::string text;
  const auto add = [&](std::size_t i, const char* rows) {
    if (!names.at(i).empty()) text += names.at(i) + ": " + rows + "\n";
  };
  add(0, kRowsOfCamera);
  add(1, "[[-0.1, 0.05, 0.0, 0.0, 0.0]]");
  add(2, kRowsOfProjector);
  add(3, "[-0.1, 0.05, 0, 0, 0]");
  add(4, kRowsOfNoRotation);
  add(5, "[[-150.0], [3.0], [40.0]]");
  return text;
}

const std::array<std::string, 6> kUsualNames{
    "camera_matrix", "dist_coeffs", "projector_matrix", "projDist", "R", "T"};

TEST(ForeignCalibrations, AreReadAsPythonWritesThem) {
  expect_the_values(import_text(yaml_of_rows(kUsualNames), "a.yaml"), "rows in brackets");
  // yaml.dump of lists: a line for each number.
  std::string lines;
  for (const auto& [name, rows] : std::vector<std::pair<std::string, std::vector<std::string>>>{
           {"camera_matrix", {"1400.0 0.0 640.0", "0.0 1402.0 512.0", "0.0 0.0 1.0"}},
           {"dist_coeffs", {"-0.1 0.05 0.0 0.0 0.0"}},
           {"projector_matrix", {"2000.0 0.0 640.0", "0.0 2003.0 700.0", "0.0 0.0 1.0"}},
           {"R", {"1.0 0.0 0.0", "0.0 1.0 0.0", "0.0 0.0 1.0"}}}) {
    lines += name + ":\n";
    for (const std::string& row : rows) {
      std::string item;
      for (const char letter : row)
        item += letter == ' ' ? std::string("\n  - ") : std::string(1, letter);
      lines += "- - " + item + "\n";
    }
  }
  lines += "T:\n- -150.0\n- 3.0\n- 40.0\n";
  expect_the_values(import_text(lines, "a.yaml"), lines);
}

TEST(ForeignCalibrations, AreReadInEachFormOfYaml) {
  const std::string rows = yaml_of_rows(kUsualNames);
  const auto with = [](std::string text, const std::string& from, const std::string& to) {
    for (std::size_t at = text.find(from); at != std::string::npos;
         at = text.find(from, at + to.size()))
      text.replace(at, from.size(), to);
    return text;
  };
  const std::string lines = with(with(with(rows, ": [[", ":\n- ["), "], [", "]\n- ["), "]]", "]");
  for (const std::string& text : {lines,
                                  with(lines, "\n- ", "\n  - "),
                                  with(lines, "\n", "\r\n"),
                                  with(rows, "\n", "\r"),
                                  "\xEF\xBB\xBF" + rows,
                                  "%YAML 1.2\n---\n# by hand\n" + rows + "...\n",
                                  with(rows, "], [", "],\n  ["),
                                  with(rows, "]]\n", "]]  # of [one] part\n"),
                                  "\"camera_matrix\": " + rows.substr(rows.find("[["))})
    expect_the_values(import_text(text, "a.yaml"), text);
}

TEST(ForeignCalibrations, AreReadUnderTheNamesOfManyPrograms) {
  for (const auto& names : std::vector<std::array<std::string, 6>>{
           {"K1", "D1", "K2", "D2", "R", "T"},
           {"M1", "D1", "M4", "D4", "Rlp", "Tlp"},
           {"M1", "D1", "M4", "D4", "Rlr", "Tlr"},
           {"cam_K", "cam_kc", "pro_K", "pro_kc", "R", "T"},
           {"cam_K", "cam_kc", "proj_K", "proj_kc", "rotation", "translation"},
           {"mtx", "dist", "K2", "D2", "R", "T"}})
    expect_the_values(import_text(yaml_of_rows(names), "a.yaml"), names[0] + " " + names[2]);
  const ImportedText metres = import_text(
      "{\"cam_int\": " + std::string(kRowsOfCamera) + ", \"proj_int\": " + kRowsOfProjector +
          ", \"rotation\": " + kRowsOfNoRotation + ", \"translation\": [-0.15, 0.003, 0.04]}",
      "a.json");
  EXPECT_EQ(metres.error, "");
  EXPECT_NEAR(metres.rig.projector.position_mm.x(), 150.0, 1e-9);
  expect_the_values(
      import_text("<Calibration><Camera><Matrix>1400 0 640\n0 1402 512\n0 0 1</Matrix>"
                  "<Distortion>-0.1 0.05 0 0 0</Distortion></Camera>"
                  "<Projector><Matrix>2000 0 640 0 2003 700 0 0 1</Matrix></Projector>"
                  "<Rotation>1 0 0 0 1 0 0 0 1</Rotation><Translation>-150 3 40</Translation>"
                  "</Calibration>",
                  "a.xml"),
      "XML of texts");
  expect_the_values(
      import_text(
          "<Scanner><Calibration><Rotation>1,0,0;0,1,0;0,0,1</Rotation>"
          "<Translation>-150, 3, 40</Translation><Projector><Matrix>2000, 0, 640; 0, 2003, "
          "700; 0, 0, 1</Matrix></Projector><Camera><Matrix>1400, 0, 640; 0, 1402, 512; 0, 0, "
          "1</Matrix><Distortion>-0.1, 0.05, 0, 0, 0</Distortion></Camera></Calibration>"
          "</Scanner>",
          "a.xml"),
      "XML of texts with commas");
}

TEST(ForeignCalibrations, StateSizesAsOneValue) {
  const Rig rig = import_text(yaml_of_rows({"cam_K", "cam_kc", "pro_K", "pro_kc", "R", "T"}) +
                                  "cam_size: [1280, 1024]\npro_size: [800, 600]\n",
                              "a.yaml")
                      .rig;
  EXPECT_EQ(rig.reference().model.height_px, 1024);
}

TEST(ForeignCalibrations, ListNamesThatAreUnknownAndTakeThemByAMap) {
  const std::array<std::string, 6> own{"intr", "lens", "intr_p", "lens_p", "turn", "shift"};
  const std::string text = yaml_of_rows(own);
  const std::string error = import_text(text, "a.yaml").error;
  EXPECT_NE(error.find("intr (3 x 3)"), std::string::npos) << error;
  EXPECT_NE(error.find("`map`"), std::string::npos) << error;
  const CalibrationNames names{{"K1", "intr"},
                               {"D1", "lens"},
                               {"K2", "intr_p"},
                               {"D2", "lens_p"},
                               {"R", "turn"},
                               {"T", "shift"}};
  expect_the_values(import_text(text, "a.yaml", names), "mapped");
  EXPECT_NE(import_text(text, "a.yaml", {{"K1", "intrinsic"}}).error.find("intrinsic of `map`"),
            std::string::npos);
  EXPECT_NE(import_text(text, "a.yaml", {{"K3", "intr"}}).error.find("write K1, D1"),
            std::string::npos);
  // What is missing beside known names is listed, too.
  const std::string lacks =
      import_text(yaml_of_rows({"K1", "D1", "K2", "D2", "turn", "shift"}), "a.yaml").error;
  EXPECT_NE(lacks.find("turn (3 x 3)"), std::string::npos) << lacks;
}

TEST(ForeignCalibrations, OfOtherLensModelsAreRefusedByTheirName) {
  const std::string text = yaml_of_rows(kUsualNames);
  for (const char* line : {"distortion_model: equidistant",
                           "distortion_model: fisheye",
                           "camera_model: ds",
                           "camera_model: double_sphere",
                           "fisheye_model: 1",
                           "cam0:\n  camera_model: pinhole\n  distortion_model: equi",
                           "projection_model: kannala_brandt",
                           "fisheye: true",
                           "use_fisheye: \"True\"",
                           "calibration: \"cv::fisheye\"",
                           "camera_model2: pinhole-equi",
                           "model: Inverse Brown Conrady",
                           "xi: 1.2",
                           "fisheye_D: [0.1, 0.2, 0.3, 0.4]",
                           "lens_type: MEI"}) {
    const std::string error = import_text(text + line + "\n", "a.yaml").error;
    EXPECT_NE(error.find("a lens model that no rig can hold"), std::string::npos) << line << error;
  }
  for (const char* json : {"{\"cams\": [{\"camera_type\": \"kb4\"}]}",
                           "{\"fisheye\": true}",
                           "{\"camera\": {\"distortion\": {\"name\": \"equidistant\"}}}",
                           "{\"camera\": {\"model\": \"opencv_fisheye\"}}"}) {
    const std::string error = import_text(json, "a.json").error;
    EXPECT_NE(error.find("a lens model that no rig can hold"), std::string::npos) << json << error;
  }
  for (const char* attribute : {"model=\"fisheye\"", "type='Equidistant'"}) {
    const std::string xml = fmt::format(
        "<Calibration><Camera {}><Matrix>1400 0 640 0 1402 512 0 0 1</Matrix></Camera>"
        "</Calibration>",
        attribute);
    const std::string error = import_text(xml, "a.xml").error;
    EXPECT_NE(error.find("a lens model that no rig can hold"), std::string::npos) << error;
  }
  // As Kalibr writes it.
  const std::string kalibr =
      "cam0:\n  camera_model: pinhole\n  distortion_coeffs: [0.1, 0.2, 0.3,\n    0.4]\n"
      "  distortion_model: equidistant\n  intrinsics: [1400, 1402, 640, 512]\ncam1:\n  T_cn_cnm1:\n"
      "  - [1.0, 0.0, 0.0, -0.15]\n  - [0.0, 1.0, 0.0, 0.0]\n  camera_model: pinhole\n";
  EXPECT_NE(import_text(kalibr, "a.yaml").error.find("cam0.distortion_model is equidistant"),
            std::string::npos);
  for (const char* line : {"distortion_model: plumb_bob",
                           "fisheye_model: 0",
                           "model: radtan",
                           "camera_name: omnivision_fisheye",
                           "fisheye: false"})
    expect_the_values(import_text(text + line + "\n", "a.yaml"), line);
}

TEST(ForeignCalibrations, WithCoefficientsThatAreNoneOfOpenCvAreRefused) {
  const auto error_with = [](const std::string& distortion) {
    return import_text(
               yaml_of_rows({"K1", "other", "K2", "D2", "R", "T"}) + "D1: " + distortion + "\n",
               "a.yaml")
        .error;
  };
  EXPECT_NE(error_with("[0.1, 0.2, 0.3]").find("has 3 distortion coefficients"), std::string::npos);
  EXPECT_NE(error_with("[0.1, 0, 0, 0, 0, 0.1]").find("has 6 distortion coefficients"),
            std::string::npos);
  EXPECT_NE(error_with(kRowsOfCamera).find("a distortion is a matrix of 3 x 3"), std::string::npos);
  for (const char* distortion : {"[-0.1]",
                                 "[-0.1, 0.05]",
                                 "[-0.1, 0.05, 0, 0]",
                                 "[[-0.1], [0.05], [0], [0], [0]]",
                                 "[0, 0, 0]",
                                 "[-0.1, 0.05, 0, 0, 0, 0, 0, 0]"})
    EXPECT_EQ(error_with(distortion), "") << distortion;
}

TEST(ForeignCalibrations, ThatAddNothingAreNamed) {
  const TemporaryFolder folder;
  const Files files{folder.path() / "left.yaml", folder.path() / "right.yaml"};
  for (const auto& file : files)
    std::ofstream(file) << "camera_matrix: " << kRowsOfCamera << "\n";
  std::string warnings;
  frangia::Run run;
  run.on_warning = [&](const std::string& sentence) { warnings += sentence; };
  static_cast<void>(read_calibration_files(files, run));
  EXPECT_NE(warnings.find("right.yaml is ignored"), std::string::npos) << warnings;
  EXPECT_EQ(warnings.find("left.yaml"), std::string::npos) << warnings;
}

TEST(ForeignCalibrations, ThatNoDeviceHasAreNamed) {
  const auto warnings = [](const std::string& camera,
                           const std::string& distortion,
                           const std::string& rotation,
                           const std::string& translation) {
    const ImportedText found =
        import_text("K1: " + camera + "\nD1: " + distortion + "\nK2: " + kRowsOfProjector +
                        "\nR: " + rotation + "\nT: " + translation + "\n",
                    "a.yaml");
    EXPECT_EQ(found.error, "");
    return found.warnings;
  };
  const std::string none = "[0, 0, 0, 0]";
  const std::string aside = "[-150, 3, 40]";
  EXPECT_EQ(warnings(kRowsOfCamera, "[-0.1, 0.05, 0, 0]", kRowsOfNoRotation, aside), "");
  EXPECT_NE(
      warnings(kRowsOfCamera, none, "[[-1, 0, 0], [0, 1, 0], [0, 0, -1]]", "[150, 0, 0]")
          .find("the camera and the projector see no common point: their axes are 180 degree"),
      std::string::npos);
  // Face to face: there are common points, but no surface that both see.
  EXPECT_NE(
      warnings(kRowsOfCamera, none, "[[-1, 0, 0], [0, 1, 0], [0, 0, -1]]", "[0, 0, 500]")
          .find("the camera and the projector see no common point: their axes are 180 degree"),
      std::string::npos);
  EXPECT_NE(
      warnings("[[19950, 0, 640], [0, 19950, 512], [0, 0, 1]]", none, kRowsOfNoRotation, aside)
          .find("a field of 3.7 degrees"),
      std::string::npos);
  EXPECT_NE(warnings("[[3040, 0, 645], [0, 4810, 431], [0, 0, 1]]", none, kRowsOfNoRotation, aside)
                .find("3040 and 4810 px, differ by 37 %"),
            std::string::npos);
  EXPECT_NE(warnings(kRowsOfCamera, "[4, 0, 0, 0]", kRowsOfNoRotation, aside)
                .find("more than a lens has"),
            std::string::npos);
  EXPECT_NE(warnings("[[1400, 0, 640], [0, 1402, 1100], [0, 0, 1]]", none, kRowsOfNoRotation, aside)
                .find("the principal point of the camera"),
            std::string::npos);
  // A projector of diamond pixels.
  EXPECT_EQ(warnings("[[1400, 0, 640], [0, 2800, 512], [0, 0, 1]]", none, kRowsOfNoRotation, aside),
            "");
}

}  // namespace
}  // namespace frangia
