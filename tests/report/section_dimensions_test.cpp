// The sizes that a section shows in true length.
#include "frangia/report/section_dimensions.h"

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/report/section_drawing.h"

namespace frangia {
namespace {

NamedFeature cylinder(const std::string& name, double radius_mm, double low_mm, double high_mm) {
  NamedFeature feature;
  feature.name = name;
  feature.shape.kind = ShapeKind::Cylinder;
  feature.shape.radius_mm = radius_mm;
  feature.low_mm = low_mm;
  feature.high_mm = high_mm;
  feature.uncertainty.u95_mm = 0.01;
  return feature;
}

NamedFeature plane_at(const std::string& name, double z_mm) {
  NamedFeature feature;
  feature.name = name;
  feature.shape.center_mm = {3.0, 0.0, z_mm};
  return feature;
}

/// A shaft along z: 20 mm thick up to z = 30 and 12 mm up to z = 50.
std::vector<NamedFeature> shaft() {
  return {cylinder("thick", 10.0, 0.0, 30.0),
          cylinder("thin", 6.0, 30.0, 50.0),
          plane_at("base", 0.0),
          plane_at("end", 50.0)};
}

std::vector<MeasuredCharacteristic> rows() {
  MeasuredCharacteristic diameter;
  diameter.feature = "thin";
  diameter.value = 12.0;
  diameter.u95 = 0.004;
  diameter.limits = ToleranceLimits{11.9, 11.95};
  diameter.conformity = Conformity::Out;
  MeasuredCharacteristic distance;
  distance.kind = Characteristic::Distance;
  distance.feature = "end";
  distance.datum = "base";
  distance.value = 50.01;
  return {diameter, distance};
}

std::string texts_of(const std::vector<SectionDimension>& dimensions) {
  std::string texts;
  for (const SectionDimension& dimension : dimensions)
    texts += dimension.text + "; ";
  return texts;
}

TEST(SectionDimensions, AreTheDiametersOfWhatThePlaneCutsAcross) {
  const auto across = section_dimensions(section_plane({1, 2, 40}, {0, 0, 1}), shaft(), rows());
  ASSERT_EQ(texts_of(across), "⌀ 12.0000 ± 0.0040; ");
  EXPECT_EQ(across[0].conformity, Conformity::Out);
  EXPECT_NEAR((across[0].to_mm - across[0].from_mm).norm(), 12.0, 1e-12);
  // The axis is the origin of the part, and the plane begins at (1, 2).
  EXPECT_LT((0.5 * (across[0].to_mm + across[0].from_mm) - Eigen::Vector2d(-1, -2)).norm(), 1e-12);
  EXPECT_EQ(texts_of(section_dimensions(section_plane({0, 0, 20}, {0, 0, 1}), shaft(), {})),
            "⌀ 20.000 ± 0.010; ");
  EXPECT_TRUE(section_dimensions(section_plane({0, 0, 60}, {0, 0, 1}), shaft(), rows()).empty());
}

TEST(SectionDimensions, AreDiametersAndDistancesWhereThePlaneHoldsTheAxis) {
  const auto along = section_dimensions(section_plane({0, 0, 0}, {0, 1, 0}), shaft(), rows());
  ASSERT_EQ(texts_of(along), "⌀ 20.000 ± 0.010; ⌀ 12.0000 ± 0.0040; 50.010; ");
  EXPECT_FALSE(along[0].conformity);
  for (const auto& [index, length] : {std::pair(0, 20.0), std::pair(1, 12.0), std::pair(2, 50.0)}) {
    const SectionDimension& dimension = along.at(static_cast<std::size_t>(index));
    EXPECT_NEAR((dimension.to_mm - dimension.from_mm).norm(), length, 1e-9);
  }
  // A plane beside the axis, or inclined to it, shows no diameter in true length.
  const auto beside = section_dimensions(section_plane({0, 2, 0}, {0, 1, 0}), shaft(), rows());
  EXPECT_EQ(texts_of(beside), "50.010; ");
  const Eigen::Vector3d inclined(0.0, std::cos(0.2), std::sin(0.2));
  EXPECT_TRUE(section_dimensions(section_plane({0, 0, 20}, inclined), shaft(), rows()).empty());
}

TEST(SectionDrawing, NamesTheDirectionsOfThePart) {
  SectionResult section;
  section.measured.push_back({{{-10, 0}, {10, 0}, {10, 50}, {-10, 50}}, {}, true});
  const auto drawn = [&](const Eigen::Vector3d& normal) {
    section.plane = section_plane({0, 0, 0}, normal);
    return svg_of(section, {});
  };
  EXPECT_NE(drawn({0, 1, 0}).find(">→ -x  ↑ z<"), std::string::npos);
  EXPECT_NE(drawn({0, -1, 0}).find(">→ x  ↑ z<"), std::string::npos);
  EXPECT_NE(drawn({0, 0, 1}).find(">→ x  ↑ y<"), std::string::npos);
  EXPECT_NE(drawn({0.6, 0.8, 0}).find(">→ (-0.80, 0.60, 0.00)  ↑ z<"), std::string::npos);
}

TEST(SectionDimensions, AreDrawnWhereTheyDoNotCoverEachOther) {
  SectionResult section;
  section.name = "axis";
  section.plane = section_plane({0, 0, 0}, {0, 1, 0});
  section.measured.push_back({{{-10, 0}, {10, 0}, {10, 50}, {-10, 50}}, {}, true});
  const auto dimensions = section_dimensions(section.plane, shaft(), rows());
  const std::string svg = svg_of(section, dimensions);
  std::vector<Eigen::AlignedBox2d> boxes;
  for (std::size_t at = svg.find("<rect x="); at != std::string::npos;
       at = svg.find("<rect x=", at + 1)) {
    double x = 0.0;
    double y = 0.0;
    double wide = 0.0;
    double high = 0.0;
    ASSERT_EQ(std::sscanf(svg.c_str() + at,
                          "<rect x=\"%lf\" y=\"%lf\" width=\"%lf\" height=\"%lf\"",
                          &x,
                          &y,
                          &wide,
                          &high),
              4);
    const Eigen::AlignedBox2d box(Eigen::Vector2d(x, y), Eigen::Vector2d(x + wide, y + high));
    for (const Eigen::AlignedBox2d& other : boxes)
      EXPECT_FALSE(box.intersects(other));
    boxes.push_back(box);
  }
  EXPECT_EQ(boxes.size(), dimensions.size());
  EXPECT_NE(svg.find("⌀ 12.0000 ± 0.0040"), std::string::npos);
}

}  // namespace
}  // namespace frangia
