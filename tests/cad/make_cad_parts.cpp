// Writes the CAD files of the tests and figures into a folder, by OpenCASCADE's primitives.
#include <filesystem>
#include <string>

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_NurbsConvert.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <BRep_Builder.hxx>
#include <IGESControl_Writer.hxx>
#include <Interface_Static.hxx>
#include <STEPControl_Writer.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Edge.hxx>
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
  const double kilometres = 1e8;
  write_step("huge.step", BRepPrimAPI_MakeBox(kilometres, kilometres, kilometres).Solid());
  return 0;
}
