#include "frangia/report/qif_results.h"

#include <cmath>
#include <map>

#include <fmt/format.h>

#include "frangia/core/checksums.h"
#include "frangia/core/statistics.h"
#include "frangia/core/text.h"

namespace frangia {
namespace {

/// A text for XML: markup is escaped, control characters, which XML does not have, become spaces.
std::string xml_text(std::string_view text) {
  std::string plain(text);
  for (char& c : plain)
    if (static_cast<unsigned char>(c) < 0x20U || c == 0x7F) c = ' ';
  return html_escaped(plain);
}

std::string element(std::string_view name, std::string_view content) {
  return fmt::format("<{0}>{1}</{0}>\n", name, content);
}

/// xs:decimal has no exponent.
std::string decimal(double value) {
  return fmt::format("{:.9f}", value);
}

/// A measured value with its standard uncertainty.
std::string measured_value(std::string_view name, double value, double u95) {
  if (!std::isfinite(u95)) return element(name, decimal(value));
  return fmt::format("<{0} combinedUncertainty=\"{1}\">{2}</{0}>\n",
                     name,
                     decimal(u95 / kNormal95),
                     decimal(value));
}

std::string vector_text(const Eigen::Vector3d& vector) {
  return fmt::format("{:.9f} {:.9f} {:.9f}", vector.x(), vector.y(), vector.z());
}

/// The name of a characteristic in QIF, without what follows it: Definition, Nominal, ...
std::string qif_kind(const MeasuredCharacteristic& row) {
  if (!row.kind) {
    return row.shape == ShapeKind::Sphere ? "SphericalDiameterCharacteristic"
                                          : "DiameterCharacteristic";
  }
  switch (*row.kind) {
    case Characteristic::Flatness:
      return "FlatnessCharacteristic";
    case Characteristic::Roundness:
      return "CircularityCharacteristic";
    case Characteristic::Cylindricity:
      return "CylindricityCharacteristic";
    case Characteristic::Parallelism:
      return "ParallelismCharacteristic";
    case Characteristic::Perpendicularity:
      return "PerpendicularityCharacteristic";
    case Characteristic::Position:
      return "PositionCharacteristic";
    case Characteristic::RunOut:
      return "CircularRunoutCharacteristic";
    case Characteristic::TotalRunOut:
      return "TotalRunoutCharacteristic";
    case Characteristic::Distance:
      return "DistanceBetweenCharacteristic";
    case Characteristic::Angle:
      return "AngleBetweenCharacteristic";
    case Characteristic::SurfaceProfile:
      return "SurfaceProfileCharacteristic";
    case Characteristic::LineProfile:
      return "LineProfileCharacteristic";
    case Characteristic::Thickness:
      return "ThicknessCharacteristic";
  }
  return {};
}

std::string status_of(const MeasuredCharacteristic& row) {
  if (!std::isfinite(row.value)) return "NOT_ANALYZED";
  if (row.conformity == Conformity::In) return "PASS";
  return row.conformity == Conformity::Out ? "FAIL" : "INDETERMINATE";
}

/// The tolerance of a definition and the other elements that QIF requires there.
std::string tolerance_of(const MeasuredCharacteristic& row) {
  if (row.nominal) {
    return "<Tolerance>\n" + element("MaxValue", decimal(row.limits->upper - *row.nominal)) +
           element("MinValue", decimal(row.limits->lower - *row.nominal)) +
           element("DefinedAsLimit", "false") + "</Tolerance>\n";
  }
  std::string text = element("ToleranceValue", decimal(row.limits->upper));
  const bool oriented =
      row.kind == Characteristic::Parallelism || row.kind == Characteristic::Perpendicularity;
  if (!oriented && row.kind != Characteristic::Position) return text;
  const bool flat = row.shape == ShapeKind::Plane;
  text += element("MaterialCondition", "NONE");
  std::string zone = "<DiametricalZone/>";
  if (flat) zone = oriented ? "<PlanarZone/>" : "<NonDiametricalZone/>";
  if (row.kind == Characteristic::Position && row.shape == ShapeKind::Sphere)
    zone = "<SphericalZone/>";
  return text + element("ZoneShape", zone);
}

std::string measured_feature(const NamedFeature& feature, std::size_t id) {
  const Shape& shape = feature.shape;
  std::string name;
  std::string content = element("FeatureName", xml_text(feature.name));
  switch (shape.kind) {
    case ShapeKind::Plane:
      name = "PlaneFeatureMeasurement";
      content += element("Location", vector_text(shape.center_mm));
      content += element("Normal", vector_text(shape.axis));
      break;
    case ShapeKind::Cylinder:
      name = "CylinderFeatureMeasurement";
      // The axis begins at one end of the cylinder and points into it.
      content += element(
          "Axis",
          "\n" + element("AxisPoint", vector_text(shape.center_mm + feature.low_mm * shape.axis)) +
              element("Direction", vector_text(shape.axis)));
      content += measured_value("Diameter", 2.0 * shape.radius_mm, feature.uncertainty.u95_mm);
      content += element("Length", decimal(feature.high_mm - feature.low_mm));
      break;
    case ShapeKind::Sphere:
      name = "SphereFeatureMeasurement";
      content += element("Location", vector_text(shape.center_mm));
      content += measured_value("Diameter", 2.0 * shape.radius_mm, feature.uncertainty.u95_mm);
      break;
    case ShapeKind::Line:
      name = "LineFeatureMeasurement";
      break;
    case ShapeKind::Circle:
      name = "CircleFeatureMeasurement";
      break;
    case ShapeKind::Cone:
      name = "ConeFeatureMeasurement";
      break;
    case ShapeKind::Torus:
      name = "TorusFeatureMeasurement";
      break;
  }
  return fmt::format("<{0} id=\"{1}\">\n{2}</{0}>\n", name, id, content);
}

/// The lists of a document, which grow together.
class QifWriter {
 public:
  explicit QifWriter(const QifResults& results) : results_(results) {
    for (const NamedFeature& feature : results.features) {
      feature_ids_[feature.name] = ++id_;
      features_ += measured_feature(feature, id_);
    }
    for (const MeasuredCharacteristic& row : results.characteristics)
      if (row.limits) add(row);
  }

  /// The document without its identifier.
  [[nodiscard]] std::string body() const {
    const std::size_t results_id = id_ + 1;
    std::string text =
        "<FileUnits>\n<PrimaryUnits>\n"
        "<AngularUnit><SIUnitName>radian</SIUnitName><UnitName>degree</UnitName>"
        "<UnitConversion><Factor>0.017453292519943</Factor></UnitConversion></AngularUnit>\n"
        "<LinearUnit><SIUnitName>meter</SIUnitName><UnitName>mm</UnitName>"
        "<UnitConversion><Factor>0.001</Factor></UnitConversion></LinearUnit>\n"
        "</PrimaryUnits>\n</FileUnits>\n";
    if (count_ > 0) {
      text += "<Characteristics>\n" + list("CharacteristicDefinitions", definitions_, count_) +
              list("CharacteristicNominals", nominals_, count_) +
              list("CharacteristicItems", items_, count_) + "</Characteristics>\n";
    }
    text += fmt::format(
        "<Results>\n<MeasurementResultsSet n=\"1\">\n<MeasurementResults id=\"{}\">\n", results_id);
    if (!results_.features.empty())
      text += list("MeasuredFeatures", features_, results_.features.size());
    if (count_ > 0) {
      text += "<MeasuredCharacteristics>\n" +
              list("CharacteristicMeasurements", measurements_, count_) +
              "</MeasuredCharacteristics>\n";
    }
    const char* status = "UNKNOWN";
    if (results_.verdict == Conformity::In) status = "PASS";
    if (results_.verdict == Conformity::Out) status = "FAIL";
    text += element("InspectionStatus", element("InspectionStatusEnum", status));
    return text + "</MeasurementResults>\n</MeasurementResultsSet>\n</Results>\n";
  }

  [[nodiscard]] std::size_t largest_id() const { return id_ + 1; }

 private:
  [[nodiscard]] static std::string list(std::string_view name,
                                        const std::string& content,
                                        std::size_t count) {
    return fmt::format("<{0} n=\"{1}\">\n{2}</{0}>\n", name, count, content);
  }

  void add(const MeasuredCharacteristic& row) {
    const std::string kind = qif_kind(row);
    const std::size_t definition = ++id_;
    const std::size_t nominal = ++id_;
    const std::size_t item = ++id_;
    const std::size_t measurement = ++id_;
    const auto append =
        [&](std::string& to, std::string_view role, std::size_t id, const std::string& content) {
          to += fmt::format("<{0}{1} id=\"{2}\">\n{3}</{0}{1}>\n", kind, role, id, content);
        };
    append(definitions_, "Definition", definition, tolerance_of(row));
    std::string target = element("CharacteristicDefinitionId", fmt::format("{}", definition));
    if (row.nominal) target += element("TargetValue", decimal(*row.nominal));
    append(nominals_, "Nominal", nominal, target);
    std::string description;
    if (!row.datum.empty()) description = element("Description", "datum: " + xml_text(row.datum));
    append(items_,
           "Item",
           item,
           description + element("Name", xml_text(row.name)) +
               element("CharacteristicNominalId", fmt::format("{}", nominal)));
    append(measurements_, "Measurement", measurement, measurement_of(row, item));
    ++count_;
  }

  [[nodiscard]] std::string measurement_of(const MeasuredCharacteristic& row,
                                           std::size_t item) const {
    std::string text = element("Status", element("CharacteristicStatusEnum", status_of(row))) +
                       element("CharacteristicItemId", fmt::format("{}", item));
    std::string ids;
    std::size_t count = 0;
    for (const std::string& name : {row.feature, row.datum}) {
      const auto found = feature_ids_.find(name);
      if (name.empty() || found == feature_ids_.end()) continue;
      ids += element("Id", fmt::format("{}", found->second));
      ++count;
    }
    if (count > 0) text += list("FeatureMeasurementIds", ids, count);
    if (row.fit) {
      const char* fit = *row.fit == FormReference::MinimumZone ? "MINMAX" : "LEASTSQUARES";
      text += element("SubstituteFeatureAlgorithm", element("SubstituteFeatureAlgorithmEnum", fit));
    }
    return std::isfinite(row.value) ? text + measured_value("Value", row.value, row.u95) : text;
  }

  const QifResults& results_;
  std::map<std::string, std::size_t> feature_ids_;
  std::size_t id_ = 0;
  std::size_t count_ = 0;  ///< of characteristics
  std::string features_;
  std::string definitions_;
  std::string nominals_;
  std::string items_;
  std::string measurements_;
};

}  // namespace

std::string qif_of(const QifResults& results) {
  const QifWriter writer(results);
  const std::string body = writer.body();
  const std::string hash = sha256(body);
  // A UUID of version 8, whose digits are those of the hash (RFC 9562, 5.8).
  const std::string identifier = fmt::format("{}-{}-8{}-8{}-{}",
                                             hash.substr(0, 8),
                                             hash.substr(8, 4),
                                             hash.substr(13, 3),
                                             hash.substr(17, 3),
                                             hash.substr(20, 12));
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<QIFDocument xmlns=\"http://qifstandards.org/xsd/qif3\" "
      "xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\" "
      "xsi:schemaLocation=\"http://qifstandards.org/xsd/qif3 QIFDocument.xsd\" "
      "idMax=\"{}\" versionQIF=\"3.0.0\">\n{}{}</QIFDocument>\n",
      writer.largest_id(),
      element("QPId", identifier),
      body);
}

}  // namespace frangia
