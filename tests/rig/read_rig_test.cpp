#include "frangia/rig/read_rig.h"

#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/rig/paper_rig.h"
#include "frangia/rig/write_rig.h"

#include "support/error_of.h"
#include "support/temporary_folder.h"
#include "support/text_of.h"

namespace frangia {
namespace {

using testing::TemporaryFolder;

const std::string kRig = R"(format = "frangia-rig"
version = 1
[camera]
size_px = [1280, 1024]
focal_px = [2400.0, 2400.0]
principal_point_px = [646.8, 507.4]
distortion = [-0.09, 0.05, 4e-4, -3e-4, 0.0]
white_level = 4095
[projector]
model = "angular"
position_mm = [342.0, 0.0, -449.7]
rotation = [[0.93969262, 0, 0.34202014], [0, 1, 0], [-0.34202014, 0, 0.93969262]]
field_deg = [-12, 12]
[line]
normal = [0.936672189, 0.0, 0.350207381]
offset_mm = 162.9
[turntable]
point_mm = [3.5, 55.0, 496.0]
axis = [0.008, -0.9999, 0.011]
)";

std::filesystem::path save(const TemporaryFolder& folder, const std::string& text) {
  auto path = folder.path() / "rig.toml";
  std::ofstream(path) << text;
  return path;
}

std::string with(const std::string& from, const std::string& to) {
  std::string text = kRig;
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(ReadRig, ReadsEveryTable) {
  const TemporaryFolder folder;
  std::vector<std::string> warnings;
  frangia::Run run;
  run.on_warning = [&](const std::string& sentence) { warnings.push_back(sentence); };
  const Rig rig = read_rig(save(folder, kRig), run);
  EXPECT_EQ(rig.reference().model.width_px, 1280);
  EXPECT_EQ(rig.reference().white_level, 4095);
  EXPECT_TRUE(rig.projector.is_angular());
  EXPECT_DOUBLE_EQ(rig.laser_sheet->offset_mm, 162.9);
  EXPECT_NEAR(rig.turntable->axis.norm(), 1.0, 1e-15);
  EXPECT_TRUE(warnings.empty());
}

TEST(ReadRig, ReadsBackAWrittenRig) {
  const TemporaryFolder folder;
  Rig rig = make_paper_rig({});
  rig.turntable = Turntable{.point_mm = {1.0, 2.0, 480.0}, .point_sigma_mm = 0.02};
  rig.turntable->angle_sigma_rad = rad_from_deg(0.05);
  rig.reference().noise = NoiseModel::from_camera(40.0, 11.0);
  write_rig(folder.path() / "rig.toml", rig);
  const Rig back = read_rig(folder.path() / "rig.toml");
  EXPECT_TRUE(back.projector.rotation.isApprox(rig.projector.rotation, 1e-12));
  EXPECT_TRUE(back.projector.position_mm.isApprox(rig.projector.position_mm, 1e-15));
  EXPECT_TRUE(back.laser_sheet->normal.isApprox(rig.laser_sheet->normal, 1e-15));
  EXPECT_EQ(back.turntable->point_sigma_mm, 0.02);
  EXPECT_TRUE(std::isnan(back.turntable->axis_sigma_rad));
  EXPECT_NEAR(back.turntable->angle_sigma_rad, rad_from_deg(0.05), 1e-12);
  EXPECT_NEAR(
      back.reference().noise->variance(100.0), rig.reference().noise->variance(100.0), 1e-9);
  EXPECT_EQ(back.reference().model.distortion, rig.reference().model.distortion);
}

TEST(ReadRig, ReadsBackAWavefront) {
  const TemporaryFolder folder;
  Rig rig = make_paper_rig({});
  auto& wavefront = std::get<AngularModel>(rig.projector.model).wavefront;
  wavefront.coefficients_rad = {1e-4, -2e-4, 3e-5, 0.0, 5e-5, -6e-5};
  write_rig(folder.path() / "rig.toml", rig);
  const Rig back = read_rig(folder.path() / "rig.toml");
  const auto& read = std::get<AngularModel>(back.projector.model).wavefront;
  for (std::size_t i = 0; i < Wavefront::kTerms; ++i)
    EXPECT_NEAR(read.coefficients_rad.at(i), wavefront.coefficients_rad.at(i), 1e-15) << i;
}

TEST(ReadRig, TakesTheLensModelsOfOpenCv) {
  const TemporaryFolder folder;
  const std::string five = "[-0.09, 0.05, 4e-4, -3e-4, 0.0]";
  std::string list = "[-0.09, 0.05, 4e-4, -3e-4";
  for (int count = 4; count <= 14; ++count) {
    const auto path = save(folder, with(five, list + "]"));
    if (count == 4 || count == 5 || count == 8 || count == 12 || count == 14) {
      const Rig rig = read_rig(path);
      const double last = count == 4 ? -3e-4 : 0.001 * count;
      EXPECT_EQ(rig.reference().model.distortion.at(static_cast<std::size_t>(count) - 1), last);
      write_rig(folder.path() / "back.toml", rig);
      EXPECT_EQ(read_rig(folder.path() / "back.toml").reference().model.distortion,
                rig.reference().model.distortion);
    } else {
      const std::string fault = testing::error_of([&] { static_cast<void>(read_rig(path)); });
      EXPECT_NE(fault.find("4, 5, 8, 12 or 14"), std::string::npos) << fault;
    }
    list += ", " + std::to_string(0.001 * (count + 1));
  }
}

TEST(ReadRig, KeepsTheDiamondPixelsOfAProjector) {
  const TemporaryFolder folder;
  Rig rig = make_paper_rig({});
  rig.projector.model = PinholeModel{.width_px = 1824,
                                     .height_px = 1140,
                                     .focal_px = {2600.0, 2600.0},
                                     .principal_point_px = {900.0, 1100.0}};
  rig.projector.pixels = PixelLayout::Diamond;
  write_rig(folder.path() / "rig.toml", rig);
  EXPECT_EQ(read_rig(folder.path() / "rig.toml").projector.pixels, PixelLayout::Diamond);
}

TEST(WriteRig, WritesTheShortestNumbersThatRestoreTheRigExactly) {
  const TemporaryFolder folder;
  Rig rig = make_paper_rig({});
  rig.reference().model.principal_point_px = {490.45, 377.0};
  rig.reference().model.focal_px = {1.0 / 3.0 * 1e4, 1800.1};
  rig.projector.response = ResponseCurve{{0.0, 0.1, 1.0}};
  const auto path = folder.path() / "rig.toml";
  write_rig(path, rig);
  const std::string text = testing::text_of(path);
  EXPECT_NE(text.find("format = \"frangia-rig\"\n"), std::string::npos) << text;
  EXPECT_NE(text.find("principal_point_px = [490.45, 377.0]\n"), std::string::npos) << text;
  EXPECT_NE(text.find("light = [0.0, 0.1, 1.0]\n"), std::string::npos) << text;
  const Rig back = read_rig(path);
  EXPECT_EQ(back.reference().model.principal_point_px, rig.reference().model.principal_point_px);
  EXPECT_EQ(back.reference().model.focal_px, rig.reference().model.focal_px);
  EXPECT_EQ(back.projector.position_mm, rig.projector.position_mm);
  EXPECT_EQ(back.laser_sheet->offset_mm, rig.laser_sheet->offset_mm);
  EXPECT_EQ(back.projector.response->light, rig.projector.response->light);
}

TEST(ReadRig, WarnsAboutUnknownKeysByName) {
  const TemporaryFolder folder;
  std::vector<std::string> warnings;
  frangia::Run run;
  run.on_warning = [&](const std::string& sentence) { warnings.push_back(sentence); };
  static_cast<void>(read_rig(save(folder, with("white_level", "colour = 3\nwhite_level")), run));
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("camera.colour"), std::string::npos);
}

TEST(ReadRig, WarnsThatLengthsMayBeMetres) {
  const TemporaryFolder folder;
  std::vector<std::string> warnings;
  frangia::Run run;
  run.on_warning = [&](const std::string& sentence) { warnings.push_back(sentence); };
  Rig rig = read_rig(save(folder, kRig), run);
  EXPECT_TRUE(warnings.empty());
  rig.projector.position_mm *= 1e-3;
  write_rig(folder.path() / "metres.toml", rig);
  static_cast<void>(read_rig(folder.path() / "metres.toml", run));
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("projector.position_mm"), std::string::npos) << warnings[0];
  EXPECT_NE(warnings[0].find("may be metres"), std::string::npos) << warnings[0];
}

TEST(ReadRig, RefusesAKeyThatIsNearlyOneWithADefault) {
  const TemporaryFolder folder;
  const auto path = save(folder, with("white_level", "white_levle"));
  EXPECT_NE(testing::error_of([&] {
              static_cast<void>(read_rig(path));
            }).find("camera.white_levle is unknown here; perhaps white_level was meant"),
            std::string::npos);
}

struct Fault {
  std::string from;
  std::string to;
  std::string names;  ///< text that the message must contain
};

class ReadRigFault : public ::testing::TestWithParam<Fault> {};

TEST_P(ReadRigFault, IsOneSentenceThatNamesFileAndKey) {
  const TemporaryFolder folder;
  const auto path = save(folder, with(GetParam().from, GetParam().to));
  try {
    static_cast<void>(read_rig(path));
    FAIL() << "accepted " << GetParam().to;
  } catch (const Error& error) {
    const std::string sentence = error.what();
    EXPECT_EQ(error.kind(), ErrorKind::Input);
    EXPECT_NE(sentence.find("rig.toml"), std::string::npos) << sentence;
    EXPECT_NE(sentence.find(GetParam().names), std::string::npos) << sentence;
  }
}

INSTANTIATE_TEST_SUITE_P(
    All,
    ReadRigFault,
    ::testing::Values(
        Fault{"\"angular\"", "\"laser\"", "projector.model"},
        Fault{"[0, 1, 0]", "[0, 0, 0]", "projector.rotation"},
        Fault{"[0, 1, 0]", "[0, -1, 0]", "projector.rotation"},
        Fault{"[0, 1, 0]", "[0, 1]", "projector.rotation"},
        Fault{"offset_mm = 162.9", "offset_mm = nan", "line.offset_mm"},
        Fault{"focal_px = [2400.0, 2400.0]", "focal_px = [2400.0, inf]", "camera.focal_px"},
        Fault{"focal_px = [2400.0, 2400.0]", "focal_px = [2400.0, -1]", "camera.focal_px"},
        Fault{"size_px = [1280, 1024]", "size_px = [1280, 0]", "camera.size_px"},
        Fault{"white_level = 4095", "white_level = \"white\"", "camera.white_level"},
        Fault{"white_level = 4095", "white_level = 0", "camera.white_level"},
        Fault{"field_deg = [-12, 12]", "field_deg = [12, -12]", "projector.field_deg"},
        Fault{"axis = [0.008, -0.9999, 0.011]", "axis = [0, 0, 0]", "turntable.axis"},
        Fault{"axis = [0.008, -0.9999, 0.011]",
              "axis = [0.008, -0.9999, 0.011]\naxis_sigma_deg = -0.1",
              "turntable.axis_sigma_deg"},
        Fault{"position_mm = [342.0, 0.0, -449.7]", "", "projector.position_mm"},
        Fault{"position_mm = [342.0, 0.0, -449.7]", "position_mm = [0, 0, 0]", "position_mm"},
        Fault{"version = 1", "version = 2", "version"},
        Fault{"\"frangia-rig\"", "\"frangia-scan\"", "format"},
        Fault{"[line]", "[line", "line 14"}));

TEST(ReadRig, RefusesKeysAndListsThatWouldOverflowTheStack) {
  const TemporaryFolder folder;
  const auto fault_of = [&](const std::string& end) {
    const auto path = save(folder, kRig);
    std::ofstream(path, std::ios::app) << '\n' << end << '\n';
    return testing::error_of([&] { return read_rig(path); });
  };
  std::string key = "a";
  for (int i = 0; i < 100'000; ++i)
    key += ".a";
  EXPECT_NE(fault_of(key + " = 1").find("a key has more than"), std::string::npos);
  EXPECT_NE(fault_of("[" + key + "]").find("a key has more than"), std::string::npos);
  EXPECT_NE(fault_of("b = " + std::string(100'000, '[')).find("nested"), std::string::npos);
}

TEST(ReadRig, NamesAMissingFile) {
  try {
    static_cast<void>(read_rig("/nowhere/rig.toml"));
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("/nowhere/rig.toml"), std::string::npos);
  }
}

TEST(WithResponse, ReplacesTheResponseAndKeepsCommentsAndDevices) {
  const std::string before = "# measured on Monday\n" + kRig +
                             "[projector.response]\nlight = [0.0, 0.9, 1.0]\n"
                             "[devices.camera]  # left shelf\ndriver = \"simulated\"\n";
  Projector projector;
  projector.response = ResponseCurve{{0.0, 0.3, 1.0}};
  projector.waveforms = {{20.0, FringeDirection::Horizontal, {{0.2, -0.01}, {-0.03, 0.0}}}};
  const std::string after = with_response(before, projector);
  EXPECT_NE(after.find("# measured on Monday\n" + kRig), std::string::npos);
  EXPECT_NE(after.find("[devices.camera]  # left shelf\ndriver = \"simulated\"\n"),
            std::string::npos);
  EXPECT_EQ(after.find("0.9, 1.0"), std::string::npos);
  const TemporaryFolder folder;
  const Projector read = read_rig(save(folder, after)).projector;
  EXPECT_EQ(read.response->light, projector.response->light);
  ASSERT_EQ(read.waveforms.size(), 1U);
  EXPECT_EQ(read.waveforms[0].period_px, 20.0);
  EXPECT_EQ(read.waveforms[0].direction, FringeDirection::Horizontal);
  EXPECT_EQ(read.waveforms[0].harmonics, projector.waveforms[0].harmonics);
  EXPECT_EQ(with_response(after, projector), after);
}

TEST(WithTurntable, ChangesNothingElseToTheLastDigit) {
  const std::string others = kRig.substr(0, kRig.find("[turntable]"));
  const std::string before = "# measured on Monday\n" + kRig +
                             "[devices.turntable]  # left shelf\ndriver = \"simulated\"\n";
  Turntable table{{0.1, 40.0, 300.3}, {0.0, -0.6, 0.8}};
  table.point_sigma_mm = 0.02;
  const std::string after = with_turntable(before, table);
  EXPECT_TRUE(after.starts_with("# measured on Monday\n" + others +
                                "[devices.turntable]  # left shelf\ndriver = \"simulated\"\n"))
      << after;
  EXPECT_EQ(after.find("496"), std::string::npos);
  const TemporaryFolder folder;
  const Turntable read = read_rig(save(folder, after)).turntable.value();
  EXPECT_EQ(read.point_mm, table.point_mm);
  EXPECT_EQ(read.axis, table.axis);
  EXPECT_EQ(read.point_sigma_mm, table.point_sigma_mm);
  EXPECT_TRUE(std::isnan(read.axis_sigma_rad));
  EXPECT_EQ(with_turntable(after, table), after);
}

const std::string kSecondCamera = R"(
[[more_cameras]]
name = "left"
size_px = [640, 480]
focal_px = [900.0, 901.0]
principal_point_px = [320.0, 240.0]
white_level = 255
position_mm = [-200.0, 0.0, 30.0]
rotation = [[0.93969262, 0, 0.34202014], [0, 1, 0], [-0.34202014, 0, 0.93969262]]
[more_cameras.noise]
gain_e_per_count = 70.0
read_e = 8.0
)";

TEST(ReadRig, ReadsAndWritesMoreCameras) {
  const TemporaryFolder folder;
  const Rig rig = read_rig(save(folder, kRig + kSecondCamera));
  ASSERT_EQ(rig.cameras.size(), 2U);
  const PosedCamera& second = rig.cameras.at(1);
  EXPECT_EQ(second.camera.name, "left");
  EXPECT_EQ(second.camera.model.width_px, 640);
  EXPECT_EQ(second.camera.white_level, 255);
  EXPECT_TRUE(second.camera.noise);
  EXPECT_EQ(second.position_mm, Eigen::Vector3d(-200.0, 0.0, 30.0));
  EXPECT_TRUE(rig.reference().name.empty());
  write_rig(folder.path() / "again.toml", rig);
  const Rig again = read_rig(folder.path() / "again.toml");
  ASSERT_EQ(again.cameras.size(), 2U);
  const PosedCamera& read_again = again.cameras.at(1);
  EXPECT_EQ(read_again.camera.name, "left");
  EXPECT_EQ(read_again.camera.model.focal_px, second.camera.model.focal_px);
  EXPECT_EQ(read_again.position_mm, second.position_mm);
  EXPECT_TRUE(read_again.rotation.isApprox(second.rotation, 1e-12));
  EXPECT_TRUE(read_again.camera.noise);
}

TEST(ReadRig, ReadsAProjectorThatIsALabel) {
  const TemporaryFolder folder;
  const std::string one = kRig.substr(0, kRig.find("[projector]")) +
                          "[projector]\nmodel = \"label\"\nsize_px = [1280, 800]\n";
  std::vector<std::string> warnings;
  frangia::Run run;
  run.on_warning = [&](const std::string& sentence) { warnings.push_back(sentence); };
  // The pose of a projector that was calibrated may stay.
  const Rig rig = read_rig(save(folder, one + "position_mm = [100, 0, 0]\n" + kSecondCamera), run);
  EXPECT_TRUE(rig.projector.is_label);
  EXPECT_FALSE(rig.projector.position_mm.allFinite());
  EXPECT_TRUE(warnings.empty());
  EXPECT_TRUE(read_rig(save(folder, rig_text(rig))).projector.is_label);
  EXPECT_NE(testing::error_of([&] {
              static_cast<void>(read_rig(save(folder, one)));
            }).find("needs two cameras"),
            std::string::npos);
}

TEST(ReadRig, RefusesCamerasThatCannotBeNamed) {
  const TemporaryFolder folder;
  const auto refusal = [&](const std::string& text) {
    return testing::error_of([&] { static_cast<void>(read_rig(save(folder, kRig + text))); });
  };
  const auto named = [&](const std::string& name) {
    std::string text = kSecondCamera;
    return text.replace(text.find("left"), 4, name);
  };
  EXPECT_NE(refusal(kSecondCamera + kSecondCamera).find("more_cameras[1].name is \"left\", as of"),
            std::string::npos);
  for (const char* name : {"a/b", "..", "", "a b"}) {
    EXPECT_NE(refusal(named(name)).find("use letters, digits, - and _ only"), std::string::npos)
        << name;
  }
  EXPECT_NE(refusal(named("rejected")).find("choose another"), std::string::npos);
}

}  // namespace
}  // namespace frangia
