// The pictures of a report: every place that matters is labelled in one of them.
#include "frangia/report/report_pictures.h"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "support/test_meshes.h"

namespace frangia {
namespace {

/// A box with the flatness of each of two faces measured.
Inspection box_with_faces(const std::vector<std::pair<std::string, Eigen::Vector3d>>& faces) {
  Inspection part;
  part.mesh = testing::box({-10.0F, -15.0F, -5.0F}, {10.0F, 15.0F, 5.0F});
  for (const auto& [name, normal] : faces) {
    NamedFeature feature;
    feature.name = name;
    feature.shape.kind = ShapeKind::Plane;
    feature.shape.axis = normal;
    feature.shape.center_mm = normal.cwiseProduct(Eigen::Vector3d(10.0, 15.0, 5.0));
    part.named_features.push_back(feature);
    MeasuredCharacteristic row;
    row.name = name + " flatness";
    row.feature = name;
    row.value = 0.01;
    row.u95 = 0.002;
    part.characteristics.push_back(row);
  }
  return part;
}

bool labels(const ReportPicture& picture, const std::string& name) {
  return std::any_of(picture.labels.begin(), picture.labels.end(), [&](const PictureLabel& label) {
    return label.detail == name;
  });
}

TEST(ReportPictures, LabelValuesWithTheirUnit) {
  Inspection part = box_with_faces({{"top", Eigen::Vector3d::UnitZ()}});
  part.characteristics.push_back(part.characteristics.front());
  part.characteristics.back().name = "slope";
  part.characteristics.back().unit = "degrees";
  std::string texts;
  const std::vector<ReportPicture> pictures = report_pictures(part);
  for (const PictureLabel& label : pictures.front().labels)
    texts += label.text + "\n";
  EXPECT_EQ(texts, "0.0100 mm\n0.0100°\n");
}

TEST(ReportPictures, ShowAPlaceBelowThePartFromBelow) {
  const auto pictures = report_pictures(
      box_with_faces({{"top", Eigen::Vector3d::UnitZ()}, {"bottom", -Eigen::Vector3d::UnitZ()}}));
  EXPECT_EQ(std::count_if(
                pictures.begin(),
                pictures.end(),
                [](const ReportPicture& picture) { return labels(picture, "bottom flatness"); }),
            1);
  EXPECT_EQ(pictures.size(), 3U) << "one more than without a place below";
  EXPECT_TRUE(labels(pictures.front(), "top flatness"));
}

/// A box whose faces were found, as the vertices that they were fitted to.
std::vector<Feature> faces_of(const Mesh& mesh) {
  std::vector<Feature> features;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1.0, 1.0}) {
      Feature face;
      face.fit.shape.kind = ShapeKind::Plane;
      face.fit.shape.axis = sign * Eigen::Vector3d::Unit(axis);
      face.fit.shape.center_mm = face.fit.shape.axis.cwiseProduct(Eigen::Vector3d(10.0, 15.0, 5.0));
      for (std::uint32_t i = 0; i < mesh.vertices_mm.size(); ++i) {
        const Eigen::Vector3d point = mesh.vertices_mm[i].cast<double>();
        if ((point - face.fit.shape.center_mm).dot(face.fit.shape.axis) > -1e-6)
          face.vertices.push_back(i);
      }
      features.push_back(face);
    }
  }
  return features;
}

TEST(FeaturePictures, NumberEachFeatureOnceInAsFewPicturesAsShowThem) {
  const Mesh mesh = testing::box({-10.0F, -15.0F, -5.0F}, {10.0F, 15.0F, 5.0F});
  std::vector<ReportPicture> drawn(2);
  drawn[0].azimuth_deg = 35.0;
  drawn[0].elevation_deg = drawn[1].elevation_deg = 20.0;
  drawn[1].azimuth_deg = 215.0;
  for (ReportPicture& picture : drawn)
    picture.picture = Image<Rgb>(3, 2, Rgb{7, 7, 7});
  const auto pictures =
      feature_pictures(mesh, faces_of(mesh), std::vector<std::string>(6, "plane"), drawn);
  ASSERT_EQ(pictures.size(), 3U);
  EXPECT_EQ(pictures[1].picture.width(), 3);  // the picture of before
  EXPECT_EQ(pictures[2].picture.width(), kReportPictureWidth_px);
  EXPECT_LT(pictures[2].elevation_deg, 0.0);  // from below
  std::multiset<std::string> numbers;
  for (const ReportPicture& picture : pictures) {
    for (const PictureLabel& label : picture.labels) {
      EXPECT_TRUE(label.text.ends_with(": plane")) << label.text;
      EXPECT_GT(label.at_px.x(), 0.0);
      numbers.insert(label.text.substr(0, 1));
    }
  }
  EXPECT_EQ(numbers, (std::multiset<std::string>{"1", "2", "3", "4", "5", "6"}));
  EXPECT_TRUE(feature_pictures(mesh, {}, {}, drawn).empty());
}

TEST(ReportPictures, OfTheThicknessSpeakOfItAndLabelTheThinnestWall) {
  Inspection part = box_with_faces({});
  part.walls.emplace();
  part.walls->thickness.thickness_mm.assign(part.mesh.vertices_mm.size(), 10.0F);
  part.walls->summary.min_mm = 10.0;
  part.walls->summary.min_u_mm = 0.01;
  part.walls->summary.min_at_mm = part.mesh.vertices_mm.front().cast<double>();
  const auto pictures = report_pictures(part);
  std::size_t shown = 0;
  for (const ReportPicture& picture : pictures) {
    if (!picture.caption.starts_with("thickness, ")) continue;
    EXPECT_EQ(picture.caption.ends_with("labels: thickness ± U95, mm"), !picture.labels.empty())
        << picture.caption;
    EXPECT_EQ(picture.caption.find("deviation"), std::string::npos) << picture.caption;
    shown += labels(picture, "thinnest") ? 1U : 0U;
    for (const PictureLabel& label : picture.labels)
      EXPECT_EQ(label.text, "10.0000 ± 0.0196");
  }
  EXPECT_EQ(shown, 1U);
}

}  // namespace
}  // namespace frangia
