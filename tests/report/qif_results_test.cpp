// The QIF document: well-formed, in the order of the schema, with references that resolve.
#include "frangia/report/qif_results.h"

#include <map>
#include <memory>
#include <set>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "frangia/core/xml_parser.h"

namespace frangia {
namespace {

struct QifElement {
  std::string name;
  std::string id, n, uncertainty;
  std::string text;
  std::vector<std::unique_ptr<QifElement>> children;

  [[nodiscard]] const QifElement* child(const std::string& wanted) const {
    for (const auto& one : children)
      if (one->name == wanted) return one.get();
    return nullptr;
  }
  [[nodiscard]] std::string names() const {
    std::string all;
    for (const auto& one : children)
      all += (all.empty() ? "" : " ") + one->name;
    return all;
  }
};

std::unique_ptr<QifElement> parsed(const std::string& document) {
  auto top = std::make_unique<QifElement>();
  std::vector<QifElement*> open{top.get()};
  const std::string space = "http://qifstandards.org/xsd/qif3|";
  XmlParser parser(
      [&](std::string_view name, const XmlAttributes& attributes) {
        auto element = std::make_unique<QifElement>();
        EXPECT_EQ(name.substr(0, space.size()), space);
        element->name = name.substr(space.size());
        element->id = attributes.value("id");
        element->n = attributes.value("n");
        element->uncertainty = attributes.value("combinedUncertainty");
        open.back()->children.push_back(std::move(element));
        open.push_back(open.back()->children.back().get());
      },
      [&](std::string_view) { open.pop_back(); },
      [&](std::string_view text) { open.back()->text += text; });
  parser.feed(document);
  parser.finish();
  return std::move(top->children.at(0));
}

template <typename Visit>
void visit_all(const QifElement& element, const Visit& visit) {
  visit(element);
  for (const auto& one : element.children)
    visit_all(*one, visit);
}

MeasuredCharacteristic qif_row(std::string name,
                               std::optional<Characteristic> kind,
                               std::optional<double> nominal,
                               ToleranceLimits limits,
                               double value) {
  MeasuredCharacteristic row;
  row.name = std::move(name);
  row.kind = kind;
  row.feature = "A";
  row.shape = ShapeKind::Cylinder;
  row.nominal = nominal;
  row.limits = limits;
  row.value = value;
  row.u95 = 0.00391993;
  row.conformity = conformity_of(value, 0.002, limits);
  return row;
}

QifResults some_results() {
  QifResults results;
  Shape cylinder{ShapeKind::Cylinder, {1.0, 2.0, 10.0}, Eigen::Vector3d::UnitZ(), 18.0, 0.0, 0.0};
  ShapeUncertainty u;
  u.u95_mm = 0.00391993;
  results.features = {{"A", cylinder, u, -10.0, 30.0}, {"B", {}, {}, 0.0, 0.0}};
  const ToleranceLimits zone{-std::numeric_limits<double>::infinity(), 0.02};
  results.characteristics = {
      qif_row("A <\"&\x01> diameter", std::nullopt, 36.0, {35.98, 36.02}, 36.001),
      qif_row("A roundness", Characteristic::Roundness, std::nullopt, zone, 0.0199),
      qif_row("A parallelism", Characteristic::Parallelism, std::nullopt, zone, 0.03),
      qif_row("A position", Characteristic::Position, std::nullopt, zone, kMissing),
      qif_row("A angle", Characteristic::Angle, 90.0, {89.5, 90.5}, 90.1)};
  results.characteristics[1].fit = FormReference::MinimumZone;
  results.characteristics[2].datum = "B";
  results.characteristics.push_back(results.characteristics[0]);
  results.characteristics.back().limits.reset();
  results.verdict = Conformity::Out;
  return results;
}

TEST(QifResults, HasTheElementsOfTheSchemaInTheirOrder) {
  const auto document = parsed(qif_of(some_results()));
  EXPECT_EQ(document->name, "QIFDocument");
  EXPECT_EQ(document->names(), "QPId FileUnits Characteristics Results");
  const QifElement& characteristics = *document->child("Characteristics");
  EXPECT_EQ(characteristics.names(),
            "CharacteristicDefinitions CharacteristicNominals CharacteristicItems");
  const QifElement& definitions = *characteristics.children[0];
  EXPECT_EQ(definitions.names(),
            "DiameterCharacteristicDefinition CircularityCharacteristicDefinition "
            "ParallelismCharacteristicDefinition PositionCharacteristicDefinition "
            "AngleBetweenCharacteristicDefinition");
  EXPECT_EQ(definitions.children[0]->child("Tolerance")->names(),
            "MaxValue MinValue DefinedAsLimit");
  EXPECT_EQ(std::stod(definitions.children[0]->child("Tolerance")->child("MinValue")->text), -0.02);
  EXPECT_EQ(definitions.children[2]->names(), "ToleranceValue MaterialCondition ZoneShape");
  EXPECT_EQ(characteristics.children[1]->children[0]->names(),
            "CharacteristicDefinitionId TargetValue");
  const QifElement& results = *document->child("Results")->children[0]->children[0];
  EXPECT_EQ(results.names(), "MeasuredFeatures MeasuredCharacteristics InspectionStatus");
  const QifElement& cylinder = *results.children[0]->children[0];
  EXPECT_EQ(cylinder.names(), "FeatureName Axis Diameter Length");
  EXPECT_EQ(cylinder.child("Axis")->child("AxisPoint")->text,
            "1.000000000 2.000000000 0.000000000");
  const QifElement& measurements = *results.children[1]->children[0];
  EXPECT_EQ(measurements.children[1]->names(),
            "Status CharacteristicItemId FeatureMeasurementIds SubstituteFeatureAlgorithm Value");
}

TEST(QifResults, StatesValuesUncertaintiesAndDecisions) {
  const auto document = parsed(qif_of(some_results()));
  const QifElement& results = *document->child("Results")->children[0]->children[0];
  const QifElement& rows = *results.children[1]->children[0];
  const auto status = [&](std::size_t i) {
    return rows.children.at(i)->children[0]->children[0]->text;
  };
  EXPECT_EQ(status(0), "PASS");
  EXPECT_EQ(status(1), "INDETERMINATE");
  EXPECT_EQ(status(2), "FAIL");
  EXPECT_EQ(status(3), "NOT_ANALYZED");
  EXPECT_EQ(rows.children[3]->child("Value"), nullptr);
  EXPECT_EQ(std::stod(rows.children[0]->child("Value")->text), 36.001);
  EXPECT_NEAR(std::stod(rows.children[0]->child("Value")->uncertainty), 0.002, 1e-8);
  EXPECT_EQ(results.child("InspectionStatus")->children[0]->text, "FAIL");
}

TEST(QifResults, HasUniqueIdentifiersReferencesAndCounts) {
  const auto document = parsed(qif_of(some_results()));
  std::set<std::string> ids;
  visit_all(*document, [&](const QifElement& one) {
    if (!one.id.empty()) {
      EXPECT_TRUE(ids.insert(one.id).second) << one.id;
    }
    if (!one.n.empty()) {
      EXPECT_EQ(one.n, std::to_string(one.children.size())) << one.name;
    }
  });
  std::size_t references = 0;
  visit_all(*document, [&](const QifElement& one) {
    const bool refers =
        one.name == "Id" || (one.name.size() > 2 && one.name.ends_with("Id") && one.name != "QPId");
    if (!refers) return;
    ++references;
    EXPECT_EQ(ids.count(one.text), 1U) << one.name << " " << one.text;
  });
  EXPECT_EQ(references, 5U * 3U + 6U);
  const std::string text = qif_of(some_results());
  EXPECT_NE(text.find(fmt::format("idMax=\"{}\"", ids.size())), std::string::npos);
}

TEST(QifResults, EscapesNamesAndHasTheSameBytesAgain) {
  const std::string text = qif_of(some_results());
  const auto document = parsed(text);
  const QifElement& items = *document->child("Characteristics")->children[2];
  EXPECT_EQ(items.children[0]->child("Name")->text, "A <\"& > diameter");
  EXPECT_EQ(items.children[2]->child("Description")->text, "datum: B");
  EXPECT_EQ(text, qif_of(some_results()));
  const auto empty = parsed(qif_of({}));
  EXPECT_EQ(empty->names(), "QPId FileUnits Results");
}

}  // namespace
}  // namespace frangia
