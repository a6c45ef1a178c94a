// Writes the CAD files of the tests and figures into a folder, by OpenCASCADE's primitives.
#include <filesystem>
#include <string>

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepBuilderAPI_NurbsConvert.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepExtrema_DistShapeShape.hxx>
#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <BRep_Builder.hxx>
#include <IGESControl_Writer.hxx>
#include <Interface_Static.hxx>
#include <STEPCAFControl_Writer.hxx>
#include <STEPControl_Writer.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TDF_Label.hxx>
#include <TDocStd_Document.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Edge.hxx>
#include <XCAFDimTolObjects_DatumObject.hxx>
#include <XCAFDimTolObjects_DimensionObject.hxx>
#include <XCAFDimTolObjects_GeomToleranceObject.hxx>
#include <XCAFDoc_Datum.hxx>
#include <XCAFDoc_DimTolTool.hxx>
#include <XCAFDoc_Dimension.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_GeomTolerance.hxx>
#include <XCAFDoc_ShapeTool.hxx>
#include <gp_Ax2.hxx>

namespace {

std::filesystem::path folder;

/// OpenCASCADE writes the numbers of the shape as they are and states the unit beside them.
void write_step(const char* name, const TopoDS_Shape& shape, const char* unit = "MM") {
  STEPControl_Writer writer;
  Interface_Static::SetCVal("write.step.unit", unit);
  writer.Transfer(shape, STEPControl_AsIs);
  writer.Write((folder / name).c_str());
}

void write_iges(const char* name, const TopoDS_Shape& shape, const char* unit = "MM") {
  IGESControl_Writer writer(unit, 0);
  writer.AddShape(shape);
  writer.ComputeModel();
  writer.Write((folder / name).c_str());
}

TopoDS_Shape moved(const TopoDS_Shape& shape, double x) {
  gp_Trsf by;
  by.SetTranslation(gp_Vec(x, 0, 0));
  return shape.Moved(by);
}

TopoDS_Shape in_inches(const TopoDS_Shape& shape) {
  gp_Trsf by;
  by.SetScaleFactor(1.0 / 25.4);
  return BRepBuilderAPI_Transform(shape, by, true).Shape();
}

/// Plane, cylinder, sphere, torus and B-splines, 100 mm apart, each about the origin.
TopoDS_Shape primitives() {
  const gp_Ax2 low(gp_Pnt(0, 0, -20), gp_Dir(0, 0, 1));
  TopoDS_Compound all;
  const BRep_Builder builder;
  builder.MakeCompound(all);
  builder.Add(all,
              moved(BRepPrimAPI_MakeBox(gp_Pnt(-15, -15, -15), gp_Pnt(15, 15, 15)).Solid(), 0));
  builder.Add(all, moved(BRepPrimAPI_MakeCylinder(low, 20, 40).Solid(), 100));
  builder.Add(all, moved(BRepPrimAPI_MakeSphere(20).Solid(), 200));
  builder.Add(all, moved(BRepPrimAPI_MakeTorus(20, 6).Solid(), 300));
  const TopoDS_Shape ball = BRepPrimAPI_MakeSphere(20).Solid();
  builder.Add(all, moved(BRepBuilderAPI_NurbsConvert(ball).Shape(), 400));
  const TopoDS_Shape ring = BRepPrimAPI_MakeTorus(20, 6).Solid();
  builder.Add(all, moved(BRepBuilderAPI_NurbsConvert(ring).Shape(), 500));
  return all;
}

/// A block of 40 x 30 x 20 about the origin whose edges are rounded by 4: all faces are trimmed.
TopoDS_Shape rounded_block() {
  const TopoDS_Shape block = BRepPrimAPI_MakeBox(gp_Pnt(-20, -15, -10), gp_Pnt(20, 15, 10)).Solid();
  BRepFilletAPI_MakeFillet fillet(block);
  for (TopExp_Explorer at(block, TopAbs_EDGE); at.More(); at.Next())
    fillet.Add(4.0, TopoDS::Edge(at.Current()));
  return fillet.Shape();
}

/// A plate of 60 x 40 x 10 with a bore of diameter 16 through its middle.
TopoDS_Shape bored_plate() {
  const TopoDS_Shape plate = BRepPrimAPI_MakeBox(gp_Pnt(-30, -20, 0), gp_Pnt(30, 20, 10)).Solid();
  const gp_Ax2 axis(gp_Pnt(0, 0, -1), gp_Dir(0, 0, 1));
  return BRepAlgoAPI_Cut(plate, BRepPrimAPI_MakeCylinder(axis, 8, 12).Solid()).Shape();
}

TopoDS_Shape wire() {
  return BRepBuilderAPI_MakeEdge(gp_Pnt(0, 0, 0), gp_Pnt(10, 0, 0)).Edge();
}

/// A block of 60 x 40 x 20 with a bore of 16 through it, toleranced as on a drawing.
class TolerancedBlock {
 public:
  TolerancedBlock() : document_(new TDocStd_Document("BinXCAF")) {
    XCAFDoc_DocumentTool::Set(document_->Main());
    shapes_ = XCAFDoc_DocumentTool::ShapeTool(document_->Main());
    tolerances_ = XCAFDoc_DocumentTool::DimTolTool(document_->Main());
    const TopoDS_Shape block = BRepPrimAPI_MakeBox(60, 40, 20).Solid();
    const gp_Ax2 axis(gp_Pnt(20, 20, -1), gp_Dir(0, 0, 1));
    shape_ = BRepAlgoAPI_Cut(block, BRepPrimAPI_MakeCylinder(axis, 8, 22).Solid()).Shape();
    part_ = shapes_->AddShape(shape_, false);
  }

  /// The face that holds a point and no other one.
  TDF_Label face_at(const gp_Pnt& point) {
    for (TopExp_Explorer at(shape_, TopAbs_FACE); at.More(); at.Next()) {
      const TopoDS_Shape vertex = BRepBuilderAPI_MakeVertex(point).Vertex();
      if (BRepExtrema_DistShapeShape(vertex, at.Current()).Value() < 1e-6)
        return shapes_->AddSubShape(part_, at.Current());
    }
    return {};
  }

  TDF_Label add_datum(const char* name, const TDF_Label& face, int position = 1) {
    const TDF_Label label = tolerances_->AddDatum();
    Handle(XCAFDoc_Datum) datum;
    label.FindAttribute(XCAFDoc_Datum::GetID(), datum);
    const Handle(XCAFDimTolObjects_DatumObject) object = new XCAFDimTolObjects_DatumObject();
    object->SetName(new TCollection_HAsciiString(name));
    object->SetPosition(position);
    datum->SetObject(object);
    TDF_LabelSequence faces;
    faces.Append(face);
    tolerances_->SetDatum(faces, label);
    return label;
  }

  void add_size(XCAFDimTolObjects_DimensionType type,
                double value,
                double tolerance,
                const TDF_Label& first,
                const TDF_Label& second = {}) {
    const TDF_Label label = tolerances_->AddDimension();
    Handle(XCAFDoc_Dimension) dimension;
    label.FindAttribute(XCAFDoc_Dimension::GetID(), dimension);
    const Handle(XCAFDimTolObjects_DimensionObject) object =
        new XCAFDimTolObjects_DimensionObject();
    object->SetType(type);
    object->SetValue(value);
    object->SetUpperTolValue(tolerance);
    object->SetLowerTolValue(tolerance);
    dimension->SetObject(object);
    if (second.IsNull()) {
      tolerances_->SetDimension(first, label);
    } else {
      tolerances_->SetDimension(first, second, label);
    }
  }

  TDF_Label add_zone(XCAFDimTolObjects_GeomToleranceType type,
                     double width,
                     const TDF_Label& face) {
    const TDF_Label label = tolerances_->AddGeomTolerance();
    Handle(XCAFDoc_GeomTolerance) tolerance;
    label.FindAttribute(XCAFDoc_GeomTolerance::GetID(), tolerance);
    const Handle(XCAFDimTolObjects_GeomToleranceObject) object =
        new XCAFDimTolObjects_GeomToleranceObject();
    object->SetType(type);
    object->SetValue(width);
    tolerance->SetObject(object);
    tolerances_->SetGeomTolerance(face, label);
    return label;
  }

  void refer(const TDF_Label& zone, const TDF_Label& datum) {
    tolerances_->SetDatumToGeomTol(datum, zone);
  }

  void write(const char* name) {
    Interface_Static::SetCVal("write.step.schema", "AP242DIS");
    Interface_Static::SetCVal("write.step.unit", "MM");
    STEPCAFControl_Writer writer;
    writer.SetDimTolMode(true);
    writer.Transfer(document_, STEPControl_AsIs);
    writer.Write((folder / name).c_str());
    Interface_Static::SetCVal("write.step.schema", "AP214IS");
  }

 private:
  Handle(TDocStd_Document) document_;
  Handle(XCAFDoc_ShapeTool) shapes_;
  Handle(XCAFDoc_DimTolTool) tolerances_;
  TopoDS_Shape shape_;
  TDF_Label part_;
};

void write_toleranced() {
  TolerancedBlock block;
  const TDF_Label bottom = block.face_at(gp_Pnt(50, 30, 0));
  const TDF_Label top = block.face_at(gp_Pnt(50, 30, 20));
  const TDF_Label bore = block.face_at(gp_Pnt(28, 20, 10));
  const TDF_Label a = block.add_datum("A", bottom, 1);
  block.add_size(XCAFDimTolObjects_DimensionType_Size_Diameter, 16.0, 0.05, bore);
  block.add_size(XCAFDimTolObjects_DimensionType_Location_LinearDistance, 20.0, 0.1, top, bottom);
  block.add_zone(XCAFDimTolObjects_GeomToleranceType_Flatness, 0.04, top);
  block.refer(block.add_zone(XCAFDimTolObjects_GeomToleranceType_Parallelism, 0.06, top), a);
  block.add_zone(XCAFDimTolObjects_GeomToleranceType_Straightness, 0.02, bore);
  block.write("toleranced.stp");
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) return 2;
  folder = arguments[1];
  write_step("primitives.step", primitives());
  write_step("rounded.step", rounded_block());
  write_step("plate.stp", bored_plate());
  write_step("plate-inch.step", in_inches(bored_plate()), "INCH");
  write_step("wire.step", wire());
  write_iges("plate.igs", bored_plate());
  write_iges("rounded-inch.iges", rounded_block(), "IN");
  write_iges("wire.igs", wire());
  write_toleranced();
  const double kilometres = 1e8;
  write_step("huge.step", BRepPrimAPI_MakeBox(kilometres, kilometres, kilometres).Solid());
  return 0;
}
