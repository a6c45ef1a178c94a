// The pictures of a report: every place that matters is labelled in one of them.
#include "frangia/report/report_pictures.h"

#include <algorithm>

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

}  // namespace
}  // namespace frangia
