// Files that OpenCV and scipy wrote, against pixels that OpenCV projected; and the way back.
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stop_token>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/resource.h>
#include <zlib.h>

#include "frangia/core/error.h"
#include "frangia/exchange/read_calibration_file.h"
#include "frangia/exchange/rig_from_calibration.h"
#include "frangia/exchange/write_calibration_file.h"

#include "support/error_of.h"
#include "support/temporary_folder.h"

namespace frangia {
namespace {

using testing::error_of;
using testing::TemporaryFolder;
using Files = std::vector<std::filesystem::path>;

Files data(const std::vector<std::string>& names) {
  Files files;
  for (const std::string& name : names)
    files.push_back(std::filesystem::path(FRANGIA_SOURCE_DIR) / "tests/exchange/data" / name);
  return files;
}

const ImportRigOptions kSizes{.camera_size_px = std::array<int, 2>{1280, 1024},
                              .projector_size_px = std::array<int, 2>{1280, 800}};

Rig rig_of(const Files& files, const ImportRigOptions& options = {}) {
  return rig_from_calibration(read_calibration_files(files), options);
}

/// Distance to the pixels that OpenCV projected, at most.
double error_px(const Rig& rig) {
  std::ifstream file(data({"points.json"})[0]);
  const auto truth = nlohmann::json::parse(file);
  double worst = 0.0;
  for (std::size_t i = 0; i < truth["points"].size(); ++i) {
    const auto& p = truth["points"][i];
    const Eigen::Vector3d point(p[0], p[1], p[2]);
    const auto& c = truth["camera_px"][i];
    const auto& q = truth["projector_px"][i];
    const Eigen::Vector2d camera = rig.reference().model.project(point);
    const Eigen::Vector2d projector =
        std::get<PinholeModel>(rig.projector.model).project(rig.projector.from_rig(point));
    worst = std::max(worst, (camera - Eigen::Vector2d(c[0], c[1])).norm());
    worst = std::max(worst, (projector - Eigen::Vector2d(q[0], q[1])).norm());
  }
  return worst;
}

TEST(CalibrationFiles, ProjectAsOpenCvWhateverProgramWroteThem) {
  for (const auto& names :
       std::vector<std::vector<std::string>>{{"slstudio.xml"},
                                             {"scan3d.yml"},
                                             {"intrinsics.yml", "extrinsics.yml"},
                                             {"matlab-v5.mat"},
                                             {"matlab-v7.mat"},
                                             {"matlab.json"},
                                             {"Calib_Results_stereo.mat"},
                                             {"cameras.txt", "extrinsics.yml"}}) {
    const Rig rig = rig_of(data(names), kSizes);
    EXPECT_LT(error_px(rig), 1e-6) << names[0];
    EXPECT_EQ(rig.reference().model.width_px, 1280) << names[0];
    EXPECT_EQ(std::get<PinholeModel>(rig.projector.model).height_px, 800) << names[0];
  }
}

TEST(CalibrationFiles, StateTheSizesWhereTheirProgramWritesThem) {
  for (const char* name : {"slstudio.xml", "matlab-v5.mat", "matlab.json"})
    EXPECT_LT(error_px(rig_of(data({name}))), 1e-6) << name;
  EXPECT_NE(error_of([] { return rig_of(data({"scan3d.yml"})); }).find("`camera_size`"),
            std::string::npos);
}

TEST(CalibrationFiles, OfOneCameraReplaceThatOfABase) {
  ImportRigOptions options;
  options.base = rig_of(data({"slstudio.xml"}));
  options.base->turntable = Turntable{.point_mm = {1.0, 2.0, 480.0}};
  options.base->reference().model.focal_px *= 2.0;
  options.base->calibration = Calibration{.date = "2026-11-23"};
  for (const char* name : {"camera.yml", "ros.yaml", "cameras.txt"}) {
    const Rig rig = rig_of(data({name}), options);
    EXPECT_LT(error_px(rig), 1e-6) << name;
    EXPECT_TRUE(rig.turntable) << name;
    EXPECT_FALSE(rig.calibration) << name;
  }
  EXPECT_NE(error_of([] { return rig_of(data({"camera.yml"})); }).find("`base`"),
            std::string::npos);
}

TEST(CalibrationFiles, ScaleTheBaselineByTheirUnit) {
  ImportRigOptions options = kSizes;
  options.mm_per_unit = 1000.0;
  const double mm = rig_of(data({"scan3d.yml"}), kSizes).projector.position_mm.norm();
  EXPECT_NEAR(
      rig_of(data({"scan3d.yml"}), options).projector.position_mm.norm(), 1000.0 * mm, 1e-6);
}

TEST(CalibrationFiles, WarnOfABaselineThatIsInMetres) {
  ForeignCalibration calibration = read_calibration_files(data({"slstudio.xml"}));
  *calibration.translation /= 1000.0;
  std::vector<std::string> warnings;
  frangia::Run run;
  run.on_warning = [&](const std::string& sentence) { warnings.push_back(sentence); };
  static_cast<void>(rig_from_calibration(calibration, {}, run));
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("metres"), std::string::npos);
}

TEST(CalibrationFiles, ReadBackWhatWasWritten) {
  const TemporaryFolder folder;
  const Rig rig = rig_of(data({"slstudio.xml"}));
  const std::vector<std::pair<std::string, CalibrationLayout>> files{
      {"opencv.yml", CalibrationLayout::OpenCv},
      {"opencv.xml", CalibrationLayout::OpenCv},
      {"slstudio.xml", CalibrationLayout::SlStudio},
      {"scan3d.yml", CalibrationLayout::Scan3d},
      {"matlab.json", CalibrationLayout::Matlab}};
  for (const auto& [name, layout] : files) {
    const auto file = folder.path() / name;
    write_calibration_file(file, rig, layout);
    EXPECT_LT(error_px(rig_of({file}, kSizes)), 1e-6) << name;
  }
  const auto colmap = folder.path() / "cameras.txt";
  write_calibration_file(colmap, rig, layout_of(colmap));
  EXPECT_LT(error_px(rig_of({colmap, data({"extrinsics.yml"})[0]}, kSizes)), 1e-6);
}

TEST(CalibrationFiles, RefuseToDropDistortion) {
  const TemporaryFolder folder;
  Rig rig = rig_of(data({"slstudio.xml"}));
  rig.reference().model.distortion[7] = 0.01;
  EXPECT_NE(error_of([&] {
              write_calibration_file(folder.path() / "a.xml", rig, CalibrationLayout::SlStudio);
              return 0;
            }).find("holds 5 distortion coefficients"),
            std::string::npos);
  write_calibration_file(folder.path() / "a.yml", rig, CalibrationLayout::OpenCv);
  const Rig back = rig_of({folder.path() / "a.yml"});
  EXPECT_EQ(back.reference().model.distortion, rig.reference().model.distortion);
}

/// The message about a .yml with this text.
std::string fault_of(const std::string& text, const std::string& name = "a.yml") {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / name) << text;
  const Files files{folder.path() / name};
  return error_of([&] { return rig_of(files, kSizes); });
}

TEST(CalibrationFiles, RefuseNonsenseInOneSentence) {
  EXPECT_NE(fault_of("%YAML:1.0\n---\na: 1\n").find("states no calibration"), std::string::npos);
  EXPECT_NE(fault_of("%YAML:1.0\n---\na: [1, 2\n").find("OpenCV cannot read it"),
            std::string::npos);
  EXPECT_NE(fault_of(std::string(100'000, '[')), "");
  for (const std::string level : {"a: ", "a:", "- "}) {
    std::string deep = "%YAML:1.0\n---\na: ";
    for (int i = 0; i < 100'000; ++i)
      deep += level;
    EXPECT_NE(fault_of(deep + "1\n").find("nests values more than 64 deep"), std::string::npos);
  }
  EXPECT_NE(fault_of(
                "<?xml version=\"1.0\"?>\n<opencv_storage>" + std::string("<a>") +
                    [] {
                      std::string deep;
                      for (int i = 0; i < 30'000; ++i)
                        deep += "<a>";
                      return deep;
                    }(),
                "a.xml")
                .find("nested"),
            std::string::npos);
  EXPECT_NE(fault_of("no file of MATLAB", "a.mat").find("not a MATLAB file"), std::string::npos);
  EXPECT_NE(fault_of("{\"a\": 1}", "a.json").find("states no calibration"), std::string::npos);
  EXPECT_NE(fault_of("[1]", "a.json").find("not a JSON object"), std::string::npos);
  EXPECT_NE(fault_of("1 FISHEYE 10 10 1\n", "cameras.txt").find("FISHEYE"), std::string::npos);
  EXPECT_NE(fault_of("1 PINHOLE 10 10 1\n", "cameras.txt").find("has 4"), std::string::npos);
  EXPECT_NE(fault_of("", "a.doc").find("ends in"), std::string::npos);
}

TEST(CalibrationFiles, RefuseDamagedXmlInOneSentence) {
  const auto fault = [](const std::string& text) { return fault_of(text, "a.xml"); };
  EXPECT_NE(fault("").find("a.xml"), std::string::npos);
  EXPECT_NE(fault("<opencv_storage><a>1").find("invalid in line 1"), std::string::npos);
  EXPECT_NE(fault("<opencv_storage><a>1</b></opencv_storage>").find("mismatched tag"),
            std::string::npos);
  EXPECT_NE(fault("<calibration/>").find("states no calibration"), std::string::npos);
  EXPECT_NE(fault("<!DOCTYPE a><opencv_storage/>").find("document type"), std::string::npos);
  for (const char* value : {"",
                            "<rows>2</rows>",
                            "<rows>-1</rows><cols>-1</cols><data>1</data>",
                            "<rows>65536</rows><cols>65536</cols><data>1 2</data>",
                            "<rows>1</rows><cols>1</cols><data>.Nan</data>"}) {
    EXPECT_NE(fault(fmt::format("<opencv_storage><Kc>{}</Kc></opencv_storage>", value))
                  .find("states no calibration"),
              std::string::npos)
        << value;
  }
}

/// Each byte of a file lost or replaced: an answer in words, or the same calibration.
TEST(CalibrationFiles, SurviveEveryDamagedByteOfXml) {
  std::ifstream file(data({"slstudio.xml"})[0]);
  const std::string sound((std::istreambuf_iterator<char>(file)), {});
  const TemporaryFolder folder;
  const Files damaged{folder.path() / "a.xml"};
  int refused = 0;
  for (std::size_t i = 0; i < sound.size(); i += 7) {
    std::string text = sound;
    text[i] = i % 2 == 0 ? '<' : '"';
    std::ofstream(damaged[0]) << text;
    refused += error_of([&] { return read_calibration_files(damaged); }).empty() ? 0 : 1;
  }
  EXPECT_GT(refused, 50);
}

/// An element of a .mat: its type, its size and its content.
std::string mat_element(std::uint32_t type, const std::string& content) {
  const auto size = static_cast<std::uint32_t>(content.size());
  std::string bytes(8, '\0');
  std::memcpy(bytes.data(), &type, 4);
  std::memcpy(bytes.data() + 4, &size, 4);
  bytes += content;
  constexpr std::uint32_t kCompressed = 15;
  return type == kCompressed ? bytes : bytes + std::string((8 - size % 8) % 8, '\0');
}

std::string deflated(const std::string& content) {
  std::string bytes(::compressBound(content.size()), '\0');
  uLongf size = bytes.size();
  EXPECT_EQ(::compress2(reinterpret_cast<Bytef*>(bytes.data()),
                        &size,
                        reinterpret_cast<const Bytef*>(content.data()),
                        content.size(),
                        9),
            Z_OK);
  bytes.resize(size);
  return bytes;
}

/// A .mat with these elements.
std::filesystem::path mat_file(const TemporaryFolder& folder, const std::string& elements) {
  const std::filesystem::path file = folder.path() / "a.mat";
  std::ofstream(file, std::ios::binary)
      << "MATLAB 5.0 MAT-file" << std::string(105, ' ') << std::string("\0\1IM", 4) << elements;
  return file;
}

/// A .mat array of a class with its dimensions and name, before its content.
std::string mat_array_head(std::uint32_t array_class, const std::string& name) {
  const std::string flags{static_cast<char>(array_class), 0, 0, 0, 0, 0, 0, 0};
  const std::string one{1, 0, 0, 0};
  return mat_element(6, flags) + mat_element(5, one + one) + mat_element(1, name);
}

/// Pages that the system gave to this process so far.
long pages_so_far() {
  rusage usage{};
  EXPECT_EQ(::getrusage(RUSAGE_SELF, &usage), 0);
  return usage.ru_minflt;
}

TEST(CalibrationFiles, TakeNoMoreMemoryThanAMatFileHolds) {
  const TemporaryFolder folder;
  const std::string small = mat_element(15, deflated(std::string("\2\0\0\0\0\0\0\0", 8)));
  std::string many;
  for (int i = 0; i < 50'000; ++i)
    many += small;
  const Files files{mat_file(folder, many)};
  const long before = pages_so_far();
  EXPECT_NE(error_of([&] { return read_calibration_files(files); }).find("states no calibration"),
            std::string::npos);
  EXPECT_LT(pages_so_far() - before, 20'000) << "the file has 250 pages";
}

TEST(CalibrationFiles, StopInTheMiddleOfAMatFile) {
  const TemporaryFolder folder;
  const Files files{mat_file(folder, mat_element(14, mat_array_head(6, "a")))};
  std::stop_source stop;
  frangia::Run run;
  run.stop = stop.get_token();
  stop.request_stop();
  try {
    static_cast<void>(read_calibration_files(files, run));
    ADD_FAILURE() << "it was not stopped";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::Cancelled);
  }
}

TEST(CalibrationFiles, RefuseAMatFileThatExpandsWithoutEnd) {
  const TemporaryFolder folder;
  // A structure with one field whose name has 40 MB, in 40 kB; two of them are too many.
  constexpr std::uint32_t kNameBytes = 40'000'000;
  std::string length(4, '\0');
  std::memcpy(length.data(), &kNameBytes, 4);
  const std::string structure =
      mat_element(14,
                  mat_array_head(2, "s") + mat_element(5, length) +
                      mat_element(1, std::string(kNameBytes, 'x')) + mat_element(14, ""));
  const std::string packed = mat_element(15, deflated(structure));
  EXPECT_NE(error_of([&] {
              return read_calibration_files(Files{mat_file(folder, packed + packed)});
            }).find("structures hold more than 64 MB"),
            std::string::npos);
  // A matrix that is larger than any calibration is passed over without its content.
  const std::string matrix =
      mat_element(14, mat_array_head(6, "large") + mat_element(9, std::string(8'000'000, '\0')));
  const std::string one = mat_element(15, deflated(matrix).substr(0, 5000));  // also cut off
  std::string matrices;
  for (int i = 0; i < 100; ++i)
    matrices += one;
  EXPECT_NE(error_of([&] {
              return read_calibration_files(Files{mat_file(folder, matrices)});
            }).find("states no calibration"),
            std::string::npos);
}

TEST(CalibrationFiles, AllocateNoMatrixThatAJsonFileOnlyNames) {
  const TemporaryFolder folder;
  const Files files{folder.path() / "a.json"};
  std::string row = "[0";
  for (int i = 0; i < 200'000; ++i)
    row += ",0";
  std::string rows = row + "]";
  for (int i = 0; i < 200'000; ++i)
    rows += ",[]";
  std::ofstream(files[0]) << "{\"K\": [" << rows << "]}";
  EXPECT_NE(error_of([&] { return read_calibration_files(files); }).find("states no calibration"),
            std::string::npos);
}

TEST(CalibrationFiles, RefuseMoreValuesThanACalibrationHas) {
  const TemporaryFolder folder;
  const Files files{folder.path() / "a.json"};
  std::ofstream out(files[0]);
  out << "{\"a\": 1";
  for (int i = 0; i < 20'000; ++i)
    out << ",\"" << i << "\": 1";
  out << "}" << std::flush;
  EXPECT_NE(error_of([&] { return read_calibration_files(files); }).find("more than 10000 values"),
            std::string::npos);
}

TEST(CalibrationFiles, RefuseImpossibleValues) {
  const ForeignCalibration sound = read_calibration_files(data({"slstudio.xml"}));
  const auto fault = [](const ForeignCalibration& calibration) {
    return error_of([&] { return rig_from_calibration(calibration); });
  };
  ForeignCalibration wrong = sound;
  (*wrong.camera.matrix)(0, 1) = 5.0;
  EXPECT_NE(fault(wrong).find("skew"), std::string::npos);
  wrong = sound;
  (*wrong.camera.matrix)(0, 0) = -1.0;
  EXPECT_NE(fault(wrong).find("camera matrix"), std::string::npos);
  wrong = sound;
  *wrong.rotation *= 1.1;
  EXPECT_NE(fault(wrong).find("rotation"), std::string::npos);
  wrong = sound;
  wrong.translation->setZero();
  EXPECT_NE(fault(wrong).find("baseline"), std::string::npos);
  wrong = sound;
  wrong.projector = {};
  EXPECT_NE(fault(wrong).find("no projector"), std::string::npos);
}

}  // namespace
}  // namespace frangia
