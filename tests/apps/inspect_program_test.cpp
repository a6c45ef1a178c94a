// Features and alignment by `frangia inspect`.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "frangia/files/read_mesh.h"
#include "frangia/files/write_mesh.h"
#include "frangia/geometry/transform_mesh.h"
#include "frangia/simulate/parts.h"

#include "support/run_program.h"
#include "support/temporary_folder.h"
#include "support/test_meshes.h"

namespace frangia {
namespace {

using testing::Answer;
using testing::run_program;

class InspectProgram : public ::testing::Test {
 protected:
  [[nodiscard]] std::string at(const std::string& name) const {
    return (folder_.path() / name).string();
  }

 private:
  testing::TemporaryFolder folder_;
};

TEST_F(InspectProgram, StatesTheFieldsOfEachFeature) {
  Mesh mesh = testing::sphere({1, 2, 3}, 20.0);
  mesh.sigma_mm.assign(mesh.vertices_mm.size(), 0.001F);
  write_mesh(at("ball.ply"), mesh);
  const Answer answer = run_program("--json inspect " + at("ball.ply") + " --features");
  ASSERT_EQ(answer.exit_code, 0) << answer.output;
  const auto features = nlohmann::json::parse(answer.output).at("features");
  ASSERT_EQ(features.size(), 1U);
  const auto& ball = features[0];
  EXPECT_EQ(ball.size(), 7U);
  EXPECT_EQ(ball.at("kind"), "sphere");
  EXPECT_NEAR(ball.at("diameter_mm").get<double>(), 40.0, 0.01);
  EXPECT_NEAR(ball.at("center_mm")[2].get<double>(), 3.0, 0.01);
  EXPECT_TRUE(ball.at("axis").is_null());
  EXPECT_GT(ball.at("points").get<int>(), 1000);
  EXPECT_GT(ball.at("u95_mm").get<double>(), 0.0);
  EXPECT_GE(ball.at("form_mm").get<double>(), 0.0);
}

/// The mesh of another program, or a model.
TEST_F(InspectProgram, StatesNoUncertaintyOfAMeshWithoutSigma) {
  write_mesh(at("ball.stl"), testing::sphere({1, 2, 3}, 20.0));
  const std::string inspect = "inspect " + at("ball.stl") + " --features";
  const auto json = nlohmann::json::parse(run_program("--json " + inspect).output);
  EXPECT_TRUE(json.at("features")[0].at("u95_mm").is_null());
  EXPECT_TRUE(json.at("features")[0].at("form_mm").is_number());
  EXPECT_NE(run_program(inspect).output.find("states no sigma"), std::string::npos);
}

TEST_F(InspectProgram, StatesAnErrorAsJsonToo) {
  for (const char* rest : {"/nowhere.ply --features", "/nowhere.ply --bogus"}) {
    const Answer answer = run_program("--json inspect " + at("") + rest + " 2> /dev/null");
    const auto error = nlohmann::json::parse(answer.output).at("error");
    EXPECT_EQ(error.at("exit_code"), answer.exit_code);
    EXPECT_FALSE(error.at("message").get<std::string>().empty());
    EXPECT_EQ(error.at("kind"), answer.exit_code == 2 ? "usage" : "input");
  }
}

TEST_F(InspectProgram, AlignsByPairsOfPoints) {
  write_mesh(at("reference.stl"), make_bracket());
  Eigen::Isometry3d moved = Eigen::Isometry3d::Identity();
  moved.translation() = Eigen::Vector3d(300, -400, 50);
  write_mesh(at("moved.ply"), transform_mesh(make_bracket(), moved));
  const std::string inspect = "--json inspect " + at("moved.ply") + " --reference " +
                              at("reference.stl") + " --align points ";
  const auto answer = run_program(inspect +
                                  "--points 300,-400,50,0,0,0 --points 310,-400,50,10,0,0 "
                                  "--points 300,-400,90,0,0,40");
  ASSERT_EQ(answer.exit_code, 0) << answer.output;
  const auto json = nlohmann::json::parse(answer.output);
  EXPECT_NEAR(json.at("alignment").at("matrix")[1][3].get<double>(), 400.0, 1e-6);
  EXPECT_EQ(json.at("alignment_details").at("points_mm").size(), 3U);
  EXPECT_EQ(json.at("reasons")[0].at("about"), "surface");
  for (const char* points : {"", "--points 1,2,3", "--points 1,2,3,4,5,6"})
    EXPECT_EQ(run_program(inspect + points + " 2> /dev/null").exit_code, 2) << points;
}

TEST_F(InspectProgram, AlignsByTheDatumsOfAPlan) {
  Eigen::Isometry3d moved = Eigen::Isometry3d::Identity();
  moved.linear() =
      Eigen::AngleAxisd(2.0, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  moved.translation() = Eigen::Vector3d(300, -400, 50);
  // The foot, z < 8 mm, is 0.2 mm thicker above: its upper face is the first datum.
  Mesh bracket = make_bracket();
  write_mesh(at("reference.stl"), bracket);
  for (Eigen::Vector3f& vertex : bracket.vertices_mm)
    if (std::abs(vertex.z() - 8.0F) < 1e-3F) vertex.z() += 0.2F;
  write_mesh(at("moved.ply"), transform_mesh(bracket, moved));
  const auto plan = [&](const std::string& datums) {
    std::ofstream(at("plan.toml")) << "format = \"frangia-inspection\"\nversion = 1\n"
                                      "reference = \"reference.stl\"\nalign = \"datum\"\n"
                                      "datums = " +
                                          datums + R"(
[[features]]
name = "foot"
kind = "plane"
near_mm = [4, 0, 8]
[[features]]
name = "bore"
kind = "cylinder"
near_mm = [-6, 0, 66]
diameter_mm = 14
[[features]]
name = "side"
kind = "plane"
near_mm = [-12, 25, 31]
)";
    return run_program("--json inspect " + at("moved.ply") + " --plan " + at("plan.toml") +
                       " 2> /dev/null");
  };
  const Answer answer = plan(R"(["foot", "bore", "side"])");
  ASSERT_EQ(answer.exit_code, 0) << answer.output;
  const auto json = nlohmann::json::parse(answer.output);
  Eigen::Isometry3d found = Eigen::Isometry3d::Identity();
  for (Eigen::Index row = 0; row < 4; ++row)
    for (Eigen::Index column = 0; column < 4; ++column)
      found.matrix()(row, column) =
          json.at("alignment")
              .at("matrix")[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)]
              .get<double>();
  const Eigen::Isometry3d left = found * moved;
  EXPECT_NEAR((left.translation() - Eigen::Vector3d(0, 0, -0.2)).norm(), 0.0, 0.005);
  EXPECT_NEAR(Eigen::AngleAxisd(left.linear()).angle(), 0.0, 1e-4);
  ASSERT_EQ(json.at("alignment_details").at("datums").size(), 3U);
  for (const auto& datum : json.at("alignment_details").at("datums"))
    EXPECT_NEAR(datum.at("distance_mm").get<double>(), 0.0, 0.002);
  EXPECT_TRUE(json.at("alignment_details").at("free_directions").empty());

  EXPECT_EQ(nlohmann::json::parse(plan(R"(["foot"])").output)
                .at("alignment_details")
                .at("free_directions")
                .size(),
            3U);
  const auto refused = nlohmann::json::parse(plan(R"(["foot", "top"])").output);
  EXPECT_NE(refused.at("error").at("message").get<std::string>().find("no name of [[features]]"),
            std::string::npos);
}

TEST_F(InspectProgram, WritesTheAlignedMeshAndStatesItsPose) {
  Eigen::Isometry3d moved = Eigen::Isometry3d::Identity();
  moved.linear() =
      Eigen::AngleAxisd(2.0, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  moved.translation() = Eigen::Vector3d(300, -400, 50);
  write_mesh(at("reference.stl"), make_bracket());
  write_mesh(at("moved.ply"), transform_mesh(make_bracket(), moved));
  const Answer answer = run_program("--json inspect " + at("moved.ply") + " --reference " +
                                    at("reference.stl") + " --align best-fit -o " + at("back.ply"));
  ASSERT_EQ(answer.exit_code, 0) << answer.output;
  const auto alignment = nlohmann::json::parse(answer.output).at("alignment");
  EXPECT_EQ(alignment.size(), 3U);
  EXPECT_GT(alignment.at("overlap").get<double>(), 0.999);
  EXPECT_LT(alignment.at("rms_mm").get<double>(), 0.001);
  const Eigen::Matrix4d back = moved.inverse().matrix();
  for (Eigen::Index row = 0; row < 4; ++row) {
    for (Eigen::Index column = 0; column < 4; ++column) {
      const auto value =
          alignment.at("matrix")[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)]
              .get<double>();
      EXPECT_NEAR(value, back(row, column), column < 3 ? 1e-5 : 1e-2);
    }
  }
  const Mesh written = read_mesh(at("back.ply"));
  const Mesh reference = make_bracket();
  ASSERT_EQ(written.vertices_mm.size(), reference.vertices_mm.size());
  EXPECT_LT((written.vertices_mm[7] - reference.vertices_mm[7]).norm(), 0.01F);
}

TEST_F(InspectProgram, WritesDeviationsReportAndSections) {
  Mesh mesh = testing::sphere({0, 0, 0}, 20.2, 45);
  mesh.sigma_mm.assign(mesh.vertices_mm.size(), 0.01F);
  write_mesh(at("mesh.ply"), mesh);
  write_mesh(at("ball.stl"), testing::sphere({0, 0, 0}, 20.0, 100));
  std::ofstream(at("inspection.toml")) << R"(format = "frangia-inspection"
version = 1
part = "ball"
reference = "ball.stl"
tolerance_mm = [-0.1, 0.1]
[[features]]
name = "ball"
kind = "sphere"
near_mm = [0, 0, 0]
diameter_mm = 40
tolerance_mm = [-0.1, 0.1]
[[sections]]
name = "equator"
point_mm = [0, 0, 1]
normal = [0, 0, 1]
[[sections]]
name = "x=1"
point_mm = [1, 0, 0]
normal = [1, 0, 0]
[[sections]]
name = "x/1"
point_mm = [-1, 0, 0]
normal = [1, 0, 0]
)";
  const Answer answer = run_program(
      "--json inspect " + at("mesh.ply") + " --plan " + at("inspection.toml") + " --report " +
      at("report.html") + " -o " + at("out.ply") + " -o " + at("out.csv") + " -o " + at("out.glb"));
  ASSERT_EQ(answer.exit_code, 0) << answer.output;
  const auto json = nlohmann::json::parse(answer.output);
  EXPECT_EQ(json.at("verdict"), "out");
  EXPECT_EQ(json.at("deviation").at("verdict"), "out");
  EXPECT_NEAR(json.at("deviation").at("mean_mm").get<double>(), 0.2, 0.005);
  EXPECT_NEAR(json.at("deviation").at("median_u_mm").get<double>(), 0.01, 1e-6);
  EXPECT_NEAR(json.at("deviation").at("out_share").get<double>(), 1.0, 0.01);
  EXPECT_EQ(json.at("characteristics")[0].at("conformity"), "out");
  EXPECT_EQ(json.at("sections")[0].at("curves"), 1);
  const auto text_of = [&](const std::string& name) {
    std::ifstream file(at(name), std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  EXPECT_NE(text_of("out.ply").find("property float deviation_mm\nproperty float u_mm\n"),
            std::string::npos);
  EXPECT_TRUE(text_of("out.csv").starts_with(
      "vertex,x_mm,y_mm,z_mm,deviation_mm,u_mm,conformity\n0,0,0,20.2,0.2"));
  EXPECT_EQ(read_mesh(at("out.glb")).colors.size(), mesh.vertices_mm.size());
  EXPECT_NE(text_of("report.html").find("Out of tolerance"), std::string::npos);
  EXPECT_NE(text_of("report.html").find("SHA-256 of the mesh"), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(text_of("report.json")).at("verdict"), "out");
  EXPECT_NE(text_of("report.csv").find("ball diameter"), std::string::npos);
  EXPECT_NE(text_of("report-equator.dxf").find("MEASURED"), std::string::npos);
  EXPECT_NE(text_of("report-equator.svg").find("<svg"), std::string::npos);
  // Names that differ in a character which no file name holds are two files.
  EXPECT_NE(text_of("report-x-1.svg").find("<svg"), std::string::npos);
  EXPECT_NE(text_of("report-x-1-2.svg").find("<svg"), std::string::npos);

  const std::string asked = "inspect " + at("mesh.ply") + " --plan " + at("inspection.toml");
  const Answer failed = run_program(asked + " --fail-out-of-tolerance");
  EXPECT_EQ(failed.exit_code, 1);
  EXPECT_NE(failed.output.find("verdict about the part: out; "), std::string::npos)
      << failed.output;
  EXPECT_EQ(run_program(asked + " --tolerance 1 --fail-out-of-tolerance").exit_code, 1)
      << "the diameter stays out";
  const Answer batch = run_program("inspect " + at("mesh.ply") + " " + at("mesh.ply") + " --plan " +
                                   at("inspection.toml") + " --batch " + at("batch.html"));
  ASSERT_EQ(batch.exit_code, 0) << batch.output;
  EXPECT_NE(text_of("batch.html").find("Cpk"), std::string::npos);
  EXPECT_NE(batch.output.find(",out,\"characteristics: "), std::string::npos) << batch.output;
  const Answer lacking =
      run_program("inspect " + at("absent.ply") + " " + at("mesh.ply") + " --plan " +
                  at("inspection.toml") + " --batch " + at("lacking.csv"));
  EXPECT_EQ(lacking.exit_code, 3) << lacking.output;
  EXPECT_NE(text_of("lacking.csv").find("not inspected"), std::string::npos);
  EXPECT_NE(text_of("lacking.csv").find("mesh.ply"), std::string::npos);
  const Answer two =
      run_program("inspect " + at("mesh.ply") + " " + at("mesh.ply") + " --features");
  EXPECT_EQ(two.exit_code, 2) << two.output;
}

TEST_F(InspectProgram, EndsWithItsExitCodesWithoutAFile) {
  write_mesh(at("plate.ply"), make_plate());
  write_mesh(at("shaft.ply"), make_shaft());
  const std::string out = " --align best-fit -o " + at("out.ply");
  const Answer alike =
      run_program("inspect " + at("plate.ply") + " --reference " + at("plate.ply") + out);
  EXPECT_EQ(alike.exit_code, 5) << alike.output;
  EXPECT_NE(alike.output.find("--start"), std::string::npos) << alike.output;
  const Answer foreign =
      run_program("inspect " + at("plate.ply") + " --reference " + at("shaft.ply") + out);
  EXPECT_EQ(foreign.exit_code, 3) << foreign.output;
  EXPECT_FALSE(std::filesystem::exists(at("out.ply")));
  const Answer without = run_program("inspect " + at("plate.ply") + " --align best-fit");
  EXPECT_EQ(without.exit_code, 2) << without.output;
  EXPECT_NE(without.output.find("--reference"), std::string::npos) << without.output;
}

}  // namespace
}  // namespace frangia
