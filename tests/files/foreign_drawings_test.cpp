// Drawings and packages of other programs: units, layers and blocks of DXF, further files of 3MF.
#include <string>
#include <utility>
#include <vector>

#include "frangia/core/error.h"
#include "frangia/files/internal/zip_file.h"

#include "files/foreign_meshes.h"
#include "files/sample_meshes.h"
#include "support/mesh_checks.h"

namespace frangia {
namespace {

using Eigen::Vector3d;
using testing::box_of;
using testing::drawing;
using testing::ForeignMeshes;
using testing::group;
using testing::point_group;
using testing::prism;
using testing::Solid;
using testing::volume_of;

TEST_F(ForeignMeshes, EveryUnitOfADxfIsConverted) {
  const auto face_of = [](double side) {
    return group(0, "3DFACE") + point_group(0, {0, 0, 0}) + point_group(1, {side, 0, 0}) +
           point_group(2, {0, side, 0});
  };
  const auto side_of = [&](int unit, double side) {
    const std::string header = group(0, "SECTION") + group(2, "HEADER") + group(9, "$INSUNITS") +
                               group(70, std::to_string(unit)) + group(0, "ENDSEC");
    return static_cast<double>(read("a.dxf", drawing(face_of(side), header)).vertices_mm[1].x());
  };
  const std::vector<std::pair<int, double>> units{
      {0, 1.0},    {1, 25.4},  {2, 304.8}, {3, 1609344.0},  {4, 1.0},
      {5, 10.0},   {6, 1e3},   {7, 1e6},   {8, 25.4e-6},    {9, 0.0254},
      {10, 914.4}, {11, 1e-7}, {12, 1e-6}, {13, 1e-3},      {14, 100.0},
      {15, 1e4},   {16, 1e5},  {17, 1e12}, {20, 3.0857e19}, {21, 304.8006096}};
  // A side of a billionth: nothing is read that is a parsec long.
  for (const auto& [unit, mm] : units) {
    const double side = mm > 1e12 ? 1e-9 : 1.0;
    EXPECT_NEAR(side_of(unit, side) / (mm * side), 1.0, 1e-5) << unit;
  }
  EXPECT_THROW(side_of(20, 1.0), Error);
  EXPECT_EQ(side_of(99, 1.0), 1.0);
  EXPECT_TRUE(said("$INSUNITS 99 is no unit")) << said();
  EXPECT_FALSE(said("imperial")) << said();
  const std::string imperial = group(0, "SECTION") + group(2, "HEADER") + group(9, "$MEASUREMENT") +
                               group(70, "0") + group(0, "ENDSEC");
  EXPECT_EQ(read("a.dxf", drawing(face_of(1.0), imperial)).vertices_mm[1].x(), 1.0F);
  EXPECT_TRUE(said("an imperial drawing ($MEASUREMENT 0) without a unit")) << said();
}

TEST_F(ForeignMeshes, WhatADrawingDoesNotShowIsLeftOutAndCounted) {
  const auto face = [](const std::string& layer, const char* space) {
    return group(0, "3DFACE") + group(8, layer) + group(67, space) + point_group(0, {0, 0, 0}) +
           point_group(1, {1, 0, 0}) + point_group(2, {0, 1, 0});
  };
  const auto layer = [](const std::string& name, const char* flags, const char* color) {
    return group(0, "LAYER") + group(2, name) + group(70, flags) + group(62, color);
  };
  const std::string tables = group(0, "SECTION") + group(2, "TABLES") + layer("on", "0", "7") +
                             layer("off", "0", "-7") + layer("frozen", "1", "7") +
                             group(0, "ENDSEC");
  const Mesh mesh = read(
      "a.dxf",
      drawing(face("on", "0") + face("off", "0") + face("frozen", "0") + face("on", "1"), tables));
  EXPECT_EQ(mesh.triangles.size(), 1U);
  EXPECT_TRUE(said("left out 2 meshes of layers that are off or frozen, 1 mesh of paper space"))
      << said();
  const auto path = put("b.dxf", drawing(face("off", "0"), tables));
  EXPECT_NE(testing::error_of([&] {
              return read_mesh(path);
            }).find("only 1 mesh of layers that are off or frozen"),
            std::string::npos);
}

/// A drawing whose block "Part" is a box with a corner at its base point (1, 2, 3).
std::string drawing_with_block(const std::string& entities, const std::string& more_blocks = {}) {
  const std::vector<Eigen::Vector2d> outline{{0, 0}, {30, 0}, {30, 20}, {0, 20}};
  Solid box = prism(outline, 0);
  for (Vector3d& vertex : box.vertices)
    vertex += Vector3d(1, 2, 3);
  std::string faces;
  for (const auto& face : box.faces) {
    faces += group(0, "3DFACE") + group(8, "0");
    for (int k = 0; k < 4; ++k)
      faces += point_group(k, box.vertices[face[static_cast<std::size_t>(k)]]);
  }
  const std::string blocks = group(0, "SECTION") + group(2, "BLOCKS") + group(0, "BLOCK") +
                             group(2, "Part") + point_group(0, {1, 2, 3}) + faces +
                             group(0, "ENDBLK") + more_blocks + group(0, "ENDSEC");
  return drawing(entities, blocks);
}

std::string insert_of(const std::string& block, const Vector3d& at, const std::string& more = {}) {
  return group(0, "INSERT") + group(8, "0") + group(2, block) + point_group(0, at) + more;
}

TEST_F(ForeignMeshes, BlocksOfADxfAreReadWhereTheyAreInserted) {
  const auto read_inserts = [&](const std::string& entities, const std::string& blocks = {}) {
    return read("a.dxf", drawing_with_block(entities, blocks));
  };
  const auto expect_box = [](const Mesh& mesh, const Vector3d& low, const Vector3d& high) {
    EXPECT_LT((box_of(mesh).min() - low).norm(), 1e-4) << box_of(mesh).min().transpose();
    EXPECT_LT((box_of(mesh).max() - high).norm(), 1e-4) << box_of(mesh).max().transpose();
  };
  Mesh mesh = read_inserts(insert_of("PART", {100, 0, 0}));
  expect_box(mesh, {100, 0, 0}, {130, 20, 10});
  EXPECT_NEAR(volume_of(mesh), 6000.0, 1e-2);
  EXPECT_EQ(said(), "");
  mesh = read_inserts(insert_of(
      "Part", {100, 0, 0}, group(41, "2") + group(42, "1") + group(43, "0.5") + group(50, "90")));
  expect_box(mesh, {80, 0, 0}, {100, 60, 5});
  mesh = read_inserts(insert_of("Part", {0, 0, 0}, group(41, "-1")));
  expect_box(mesh, {-30, 0, 0}, {0, 20, 10});
  EXPECT_NEAR(volume_of(mesh), 6000.0, 1e-2) << "mirrored, it keeps its outside";
  mesh = read_inserts(insert_of(
      "Part", {0, 0, 0}, group(70, "3") + group(71, "2") + group(44, "40") + group(45, "25")));
  expect_box(mesh, {0, 0, 0}, {110, 45, 10});
  EXPECT_EQ(mesh.triangles.size(), 72U);
  // Seen from below: x becomes -x (the arbitrary axis of -z is (-1, 0, 0)).
  mesh = read_inserts(insert_of("Part", {5, 0, 0}, group(230, "-1")));
  expect_box(mesh, {-35, 0, -10}, {-5, 20, 0});
  const std::string pair = group(0, "BLOCK") + group(2, "pair") + point_group(0, {0, 0, 0}) +
                           insert_of("Part", {0, 0, 0}) + insert_of("part", {0, 0, 10}) +
                           group(0, "ENDBLK");
  mesh = read_inserts(insert_of("pair", {0, 0, 100}, group(41, "0.5")), pair);
  expect_box(mesh, {0, 0, 100}, {15, 20, 120});
  mesh = read_inserts(insert_of("Part", {0, 0, 0}) + insert_of("nowhere", {0, 0, 0}));
  EXPECT_EQ(mesh.triangles.size(), 12U);
  EXPECT_TRUE(said("left out 1 INSERT of blocks that the file does not hold")) << said();
}

TEST_F(ForeignMeshes, BlocksThatContainThemselvesOrExpandWithoutEndAreRefused) {
  const auto fault_of = [&](const std::string& entities, const std::string& blocks) {
    const auto path = put("a.dxf", drawing_with_block(entities, blocks));
    return testing::error_of([&] { return read_mesh(path); });
  };
  const auto block = [](const std::string& name, const std::string& content) {
    return group(0, "BLOCK") + group(2, name) + point_group(0, {0, 0, 0}) + content +
           group(0, "ENDBLK");
  };
  EXPECT_NE(fault_of(insert_of("a", {0, 0, 0}),
                     block("a", insert_of("b", {0, 0, 0})) + block("b", insert_of("a", {0, 0, 0})))
                .find("a block contains itself"),
            std::string::npos);
  const std::string many = group(70, "30000") + group(71, "30000");
  EXPECT_NE(
      fault_of(insert_of("a", {0, 0, 0}, many), block("a", insert_of("Part", {0, 0, 0}, many)))
          .find("of memory, more than"),
      std::string::npos);
}

constexpr const char* kCoreNamespace = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02";

void add_to(ZipWriter& zip, const std::string& name, const std::string& content) {
  zip.begin(name);
  zip.text(content);
}

std::string model_of(const std::string& attributes, const std::string& content) {
  return fmt::format(R"(<model xmlns="{}" {}>{}</model>)", kCoreNamespace, attributes, content);
}

const std::string kProduction =
    R"(xmlns:p="http://schemas.microsoft.com/3dmanufacturing/production/2015/06" requiredextensions="p")";

TEST_F(ForeignMeshes, ObjectsInFurtherFilesOfA3mfAreRead) {
  const std::string tetrahedron =
      R"(<mesh><vertices><vertex x="0" y="0" z="0"/><vertex x="1" y="0" z="0"/><vertex x="0" y="1" z="0"/><vertex x="0" y="0" z="1"/></vertices><triangles><triangle v1="0" v2="2" v3="1"/><triangle v1="0" v2="1" v3="3"/><triangle v1="1" v2="2" v3="3"/><triangle v1="2" v2="0" v3="3"/></triangles></mesh>)";
  const auto package = [&](const std::string& root) {
    ZipWriter zip(at("a.3mf"));
    add_to(zip, "3D/3dmodel.model", root);
    // In centimetres, with the same number as an object of the root.
    add_to(zip,
           "3D/Objects/one.model",
           model_of(R"(unit="centimeter")",
                    "<resources><object id=\"1\">" + tetrahedron + "</object></resources>" +
                        "<build><item objectid=\"1\"/></build>"));
    zip.commit();
    return at("a.3mf");
  };
  const auto root = [&](const std::string& path) {
    return model_of(kProduction,
                    "<resources><object id=\"1\"><components><component objectid=\"1\" p:path=\"" +
                        path +
                        "\" transform=\"1 0 0 0 1 0 0 0 1 100 0 0\"/></components></object>"
                        "</resources><build><item objectid=\"1\"/><item objectid=\"1\" p:path=\"" +
                        path + "\"/></build>");
  };
  const Mesh mesh = read_mesh(package(root("/3D/Objects/one.model")));
  EXPECT_EQ(mesh.triangles.size(), 8U) << "the build of the second file is not built";
  EXPECT_LT((box_of(mesh).min() - Vector3d(0, 0, 0)).norm(), 1e-4);
  EXPECT_LT((box_of(mesh).max() - Vector3d(110, 10, 10)).norm(), 1e-4);
  const auto missing = package(root("/3D/Objects/two.model"));
  EXPECT_NE(testing::error_of([&] { return read_mesh(missing); }).find("3D/Objects/two.model"),
            std::string::npos);
}

TEST_F(ForeignMeshes, A3mfThatRequiresAnUnknownExtensionIsRefusedByName) {
  const auto fault_of = [&](const std::string& attributes) {
    ZipWriter zip(at("a.3mf"));
    add_to(zip, "3D/3dmodel.model", model_of(attributes, "<resources/><build/>"));
    zip.commit();
    return testing::error_of([&] { return read_mesh(at("a.3mf")); });
  };
  const std::string beams = fault_of(
      R"(xmlns:b="http://schemas.microsoft.com/3dmanufacturing/beamlattice/2017/02" requiredextensions="b")");
  EXPECT_NE(beams.find("requires an extension that is not read, http://schemas.microsoft.com/"
                       "3dmanufacturing/beamlattice/2017/02"),
            std::string::npos)
      << beams;
  EXPECT_NE(fault_of(kProduction).find("no triangles"), std::string::npos);
}

}  // namespace
}  // namespace frangia
