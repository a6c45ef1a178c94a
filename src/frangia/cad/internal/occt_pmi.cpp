// The product and manufacturing information of a STEP file, by XCAF.
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <Interface_InterfaceModel.hxx>
#include <STEPCAFControl_Reader.hxx>
#include <Standard_Type.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TDF_Label.hxx>
#include <TDF_LabelSequence.hxx>
#include <TDocStd_Document.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS_Shape.hxx>
#include <XCAFDimTolObjects_DatumObject.hxx>
#include <XCAFDimTolObjects_DimensionObject.hxx>
#include <XCAFDimTolObjects_GeomToleranceObject.hxx>
#include <XCAFDoc_Datum.hxx>
#include <XCAFDoc_DimTolTool.hxx>
#include <XCAFDoc_Dimension.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_GeomTolerance.hxx>
#include <XCAFDoc_ShapeTool.hxx>
#include <XSControl_WorkSession.hxx>

#include "frangia/cad/internal/occt_translate.h"

namespace frangia {
namespace {

using PmiKind = CadRequirementKind;

std::string text_of_name(const Handle(TCollection_HAsciiString) & name) {
  return name.IsNull() ? std::string() : std::string(name->ToCString());
}

/// What a dimension is, and what it is called where it is not read.
std::pair<PmiKind, const char*> kind_of(XCAFDimTolObjects_DimensionType type) {
  switch (type) {
    case XCAFDimTolObjects_DimensionType_Size_Diameter:
    case XCAFDimTolObjects_DimensionType_Size_SphericalDiameter:
    case XCAFDimTolObjects_DimensionType_Size_Radius:
    case XCAFDimTolObjects_DimensionType_Size_SphericalRadius:
      return {PmiKind::Diameter, ""};
    case XCAFDimTolObjects_DimensionType_Location_LinearDistance:
    case XCAFDimTolObjects_DimensionType_Size_Thickness:
      return {PmiKind::Distance, ""};
    case XCAFDimTolObjects_DimensionType_Location_Angular:
    case XCAFDimTolObjects_DimensionType_Size_Angular:
      return {PmiKind::Angle, ""};
    case XCAFDimTolObjects_DimensionType_Location_CurvedDistance:
    case XCAFDimTolObjects_DimensionType_Size_CurveLength:
      return {PmiKind::Other, "length of a curve"};
    case XCAFDimTolObjects_DimensionType_Location_Oriented:
    case XCAFDimTolObjects_DimensionType_Location_WithPath:
    case XCAFDimTolObjects_DimensionType_Size_WithPath:
      return {PmiKind::Other, "dimension along a direction"};
    case XCAFDimTolObjects_DimensionType_CommonLabel:
    case XCAFDimTolObjects_DimensionType_DimensionPresentation:
      return {PmiKind::Other, "note"};
    default:
      break;
  }
  const bool torus = type >= XCAFDimTolObjects_DimensionType_Size_ToroidalMinorDiameter &&
                     type <= XCAFDimTolObjects_DimensionType_Size_ToroidalLowMajorRadius;
  return {PmiKind::Other, torus ? "size of a torus" : "distance from an edge of a feature"};
}

std::pair<PmiKind, const char*> kind_of(XCAFDimTolObjects_GeomToleranceType type) {
  switch (type) {
    case XCAFDimTolObjects_GeomToleranceType_Flatness:
      return {PmiKind::Flatness, ""};
    case XCAFDimTolObjects_GeomToleranceType_CircularityOrRoundness:
      return {PmiKind::Roundness, ""};
    case XCAFDimTolObjects_GeomToleranceType_Cylindricity:
      return {PmiKind::Cylindricity, ""};
    case XCAFDimTolObjects_GeomToleranceType_Parallelism:
      return {PmiKind::Parallelism, ""};
    case XCAFDimTolObjects_GeomToleranceType_Perpendicularity:
      return {PmiKind::Perpendicularity, ""};
    case XCAFDimTolObjects_GeomToleranceType_Position:
      return {PmiKind::Position, ""};
    case XCAFDimTolObjects_GeomToleranceType_CircularRunout:
      return {PmiKind::RunOut, ""};
    case XCAFDimTolObjects_GeomToleranceType_TotalRunout:
      return {PmiKind::TotalRunOut, ""};
    case XCAFDimTolObjects_GeomToleranceType_ProfileOfSurface:
      return {PmiKind::SurfaceProfile, ""};
    case XCAFDimTolObjects_GeomToleranceType_ProfileOfLine:
      return {PmiKind::Other, "profile of a line"};
    case XCAFDimTolObjects_GeomToleranceType_Angularity:
      return {PmiKind::Other, "angularity"};
    case XCAFDimTolObjects_GeomToleranceType_Coaxiality:
    case XCAFDimTolObjects_GeomToleranceType_Concentricity:
      return {PmiKind::Other, "coaxiality"};
    case XCAFDimTolObjects_GeomToleranceType_Straightness:
      return {PmiKind::Other, "straightness"};
    case XCAFDimTolObjects_GeomToleranceType_Symmetry:
      return {PmiKind::Other, "symmetry"};
    case XCAFDimTolObjects_GeomToleranceType_None:
      break;
  }
  return {PmiKind::Other, "geometrical tolerance without a kind"};
}

bool is_radius(XCAFDimTolObjects_DimensionType type) {
  return type == XCAFDimTolObjects_DimensionType_Size_Radius ||
         type == XCAFDimTolObjects_DimensionType_Size_SphericalRadius;
}

/// Reads the requirements of a document.
class PmiFinder {
 public:
  PmiFinder(const Handle(TDocStd_Document) & document, const TopoDS_Shape& shape)
      : tool_(XCAFDoc_DocumentTool::DimTolTool(document->Main())) {
    TopExp::MapShapes(shape, TopAbs_FACE, numbers_);
    for (int i = 1; i <= numbers_.Extent(); ++i)
      bare_.Add(numbers_(i).Located(TopLoc_Location()));
  }

  [[nodiscard]] std::vector<CadRequirement> all() const {
    std::vector<CadRequirement> found;
    TDF_LabelSequence labels;
    tool_->GetDatumLabels(labels);
    for (const TDF_Label& label : labels)
      add_datum(label, found);
    labels.Clear();
    tool_->GetDimensionLabels(labels);
    for (const TDF_Label& label : labels)
      add_dimension(label, found);
    labels.Clear();
    tool_->GetGeomToleranceLabels(labels);
    for (const TDF_Label& label : labels)
      add_tolerance(label, found);
    return found;
  }

 private:
  /// Numbers of the faces that labels name, those of a whole solid left out.
  [[nodiscard]] std::vector<std::size_t> faces_of(const TDF_LabelSequence& labels) const {
    std::vector<std::size_t> faces;
    for (const TDF_Label& label : labels) {
      const TopoDS_Shape shape = XCAFDoc_ShapeTool::GetShape(label);
      if (shape.IsNull() || shape.ShapeType() <= TopAbs_SHELL) continue;
      for (TopExp_Explorer at(shape, TopAbs_FACE); at.More(); at.Next()) {
        int number = numbers_.FindIndex(at.Current());
        if (number == 0) number = bare_.FindIndex(at.Current().Located(TopLoc_Location()));
        if (number > 0) faces.push_back(static_cast<std::size_t>(number));
      }
    }
    return faces;
  }

  void find_faces(const TDF_Label& label, CadRequirement& found) const {
    TDF_LabelSequence first;
    TDF_LabelSequence second;
    if (!tool_->GetRefShapeLabel(label, first, second)) return;
    found.faces = faces_of(first);
    found.other_faces = faces_of(second);
  }

  void add_datum(const TDF_Label& label, std::vector<CadRequirement>& out) const {
    Handle(XCAFDoc_Datum) attribute;
    if (!label.FindAttribute(XCAFDoc_Datum::GetID(), attribute)) return;
    CadRequirement found;
    found.kind = PmiKind::Datum;
    found.name = text_of_name(attribute->GetObject()->GetName());
    find_faces(label, found);
    for (CadRequirement& known : out) {  // one label for each use of a datum
      if (known.name != found.name) continue;
      if (known.faces.empty()) known.faces = found.faces;
      return;
    }
    out.push_back(std::move(found));
  }

  void add_dimension(const TDF_Label& label, std::vector<CadRequirement>& out) const {
    Handle(XCAFDoc_Dimension) attribute;
    if (!label.FindAttribute(XCAFDoc_Dimension::GetID(), attribute)) return;
    const Handle(XCAFDimTolObjects_DimensionObject) object = attribute->GetObject();
    CadRequirement found;
    const auto [kind, other] = kind_of(object->GetType());
    found.kind = kind;
    found.name = kind == PmiKind::Other ? other : text_of_name(object->GetSemanticName());
    const double scale = is_radius(object->GetType()) ? 2.0 : 1.0;
    if (object->IsDimWithRange()) {
      const double lower = scale * object->GetLowerBound();
      const double upper = scale * object->GetUpperBound();
      found.value = 0.5 * (lower + upper);
      found.lower = lower - found.value;
      found.upper = upper - found.value;
    } else {
      found.value = scale * object->GetValue();
      if (object->IsDimWithPlusMinusTolerance()) {
        found.lower = -scale * std::abs(object->GetLowerTolValue());
        found.upper = scale * object->GetUpperTolValue();
      }
    }
    if (object->IsDimWithClassOfTolerance()) {
      found.kind = PmiKind::Other;
      found.name = "tolerance class of ISO 286";
    }
    find_faces(label, found);
    out.push_back(std::move(found));
  }

  void add_tolerance(const TDF_Label& label, std::vector<CadRequirement>& out) const {
    Handle(XCAFDoc_GeomTolerance) attribute;
    if (!label.FindAttribute(XCAFDoc_GeomTolerance::GetID(), attribute)) return;
    const Handle(XCAFDimTolObjects_GeomToleranceObject) object = attribute->GetObject();
    CadRequirement found;
    const auto [kind, other] = kind_of(object->GetType());
    found.kind = kind;
    found.name = kind == PmiKind::Other ? other : text_of_name(object->GetSemanticName());
    found.value = object->GetValue();
    if (object->GetMaterialRequirementModifier() !=
        XCAFDimTolObjects_GeomToleranceMatReqModif_None) {
      found.kind = PmiKind::Other;
      found.name = std::string(name_of(kind)) + " at maximum or least material";
    }
    find_faces(label, found);
    TDF_LabelSequence datums;
    tool_->GetDatumWithObjectOfTolerLabels(label, datums);
    for (const TDF_Label& datum : datums) {
      Handle(XCAFDoc_Datum) used;
      if (datum.FindAttribute(XCAFDoc_Datum::GetID(), used))
        found.datums.push_back(text_of_name(used->GetObject()->GetName()));
    }
    out.push_back(std::move(found));
  }

  Handle(XCAFDoc_DimTolTool) tool_;
  TopTools_IndexedMapOfShape numbers_;  ///< faces by their number
  TopTools_IndexedMapOfShape bare_;     ///< the same without the places of parts
};

/// Whether a file holds drawn annotations, which people read and programs do not.
bool holds_annotations(const Handle(Interface_InterfaceModel) & model) {
  for (int i = 1; i <= model->NbEntities(); ++i) {
    const std::string name = model->Value(i)->DynamicType()->Name();
    if (name.find("Annotation") != std::string::npos ||
        name.find("Draughting") != std::string::npos)
      return true;
  }
  return false;
}

}  // namespace

TopoDS_Shape read_step_with_pmi(const std::string& path, CadTranslation& said) {
  STEPCAFControl_Reader reader;
  reader.SetColorMode(false);
  reader.SetNameMode(false);
  reader.SetLayerMode(false);
  reader.SetPropsMode(false);
  reader.SetMatMode(false);
  reader.SetViewMode(false);
  reader.SetGDTMode(true);
  if (reader.ReadFile(path.c_str()) != IFSelect_RetDone) {
    said.error = "it is no valid STEP file; export it again";
    return {};
  }
  said.unit = stated_unit(reader.ChangeReader());
  if (said.unit.empty()) {
    said.error =
        "it states no unit of length, so its tolerances have none; export it with its unit";
    return {};
  }
  Handle(TDocStd_Document) document = new TDocStd_Document("BinXCAF");
  XCAFDoc_DocumentTool::Set(document->Main());
  if (!reader.Transfer(document)) {
    said.error = "its parts cannot be translated; export it again";
    return {};
  }
  const STEPControl_Reader& parts = reader.Reader();
  const TopoDS_Shape shape = parts.OneShape();
  const int roots = reader.ChangeReader().NbRootsForTransfer();
  if (const std::string left_out = left_out_text(roots, parts.NbShapes()); !left_out.empty())
    said.warnings.push_back(left_out);
  said.pmi.has_graphics = holds_annotations(reader.Reader().WS()->Model());
  said.pmi.requirements = PmiFinder(document, shape).all();
  return shape;
}

}  // namespace frangia
