#include "frangia/cad/internal/occt_translate.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <new>

#include <BRepBndLib.hxx>
#include <BRepBuilderAPI_MakeSolid.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepLib.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRep_Builder.hxx>
#include <BinTools.hxx>
#include <Bnd_Box.hxx>
#include <IGESControl_Reader.hxx>
#include <IGESData_IGESModel.hxx>
#include <STEPControl_Reader.hxx>
#include <Standard_Failure.hxx>
#include <Standard_OutOfMemory.hxx>
#include <TColStd_SequenceOfAsciiString.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>

#include "frangia/cad/internal/shape_checks.h"
#include "frangia/core/error.h"
#include "frangia/core/text.h"

namespace frangia {
namespace {

constexpr int kMostFaces = 200'000;

/// A text of ASCII letters without capitals.
std::string lowercase(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) {
    return static_cast<char>(std::tolower(c));
  });
  return text;
}

/// The number of faces, at most one more than the limit: nested assemblies can name billions.
int counted_faces(const TopoDS_Shape& shape) {
  int count = 0;
  for (TopExp_Explorer at(shape, TopAbs_FACE); at.More() && count <= kMostFaces; at.Next())
    ++count;
  return count;
}

TopoDS_Shape scaled(const TopoDS_Shape& shape, double factor) {
  if (factor == 1.0) return shape;
  gp_Trsf scale;
  scale.SetScale(gp_Pnt(), factor);
  return BRepBuilderAPI_Transform(shape, scale, true).Shape();
}

/// Warns when not all parts of a file became shapes.
template <typename Reader>
TopoDS_Shape transferred(Reader& reader, CadTranslation& said) {
  const int roots = reader.NbRootsForTransfer();
  const int done = reader.TransferRoots();
  if (const std::string left_out = left_out_text(roots, done); !left_out.empty())
    said.warnings.push_back(left_out);
  return reader.OneShape();
}

TopoDS_Shape read_step(const std::string& path,
                       const std::optional<double>& unit_mm,
                       CadTranslation& said) {
  STEPControl_Reader reader;
  if (reader.ReadFile(path.c_str()) != IFSelect_RetDone) {
    said.error = "it is no valid STEP file; export it again";
    return {};
  }
  said.unit = stated_unit(reader);
  TopoDS_Shape shape = transferred(reader, said);
  if (said.unit.empty() && unit_mm) return scaled(shape, *unit_mm);
  return shape;
}

TopoDS_Shape read_iges(const std::string& path, CadTranslation& said) {
  IGESControl_Reader reader;
  if (reader.ReadFile(path.c_str()) != IFSelect_RetDone) {
    said.error = "it is no valid IGES file; export it again";
    return {};
  }
  constexpr std::array<const char*, 11> kNames{"inch",
                                               "millimetre",
                                               "",
                                               "foot",
                                               "mile",
                                               "metre",
                                               "kilometre",
                                               "mil",
                                               "micrometre",
                                               "centimetre",
                                               "microinch"};
  const int flag = reader.IGESModel()->GlobalSection().UnitFlag();
  if (flag >= 1 && flag <= 11) said.unit = kNames.at(static_cast<std::size_t>(flag - 1));
  if (flag == 3) said.unit = lowercase(reader.IGESModel()->GlobalSection().UnitName()->ToCString());
  return transferred(reader, said);
}

bool has(const TopoDS_Shape& shape, TopAbs_ShapeEnum kind) {
  return TopExp_Explorer(shape, kind).More();
}

/// Joins faces that no solid joins, and turns closed shells outwards.
TopoDS_Shape sewn(const TopoDS_Shape& shape) {
  constexpr double kGapMm = 0.01;
  if (has(shape, TopAbs_SOLID)) return shape;
  BRepBuilderAPI_Sewing sewing(kGapMm);
  sewing.Add(shape);
  sewing.Perform();
  const TopoDS_Shape joined = sewing.SewedShape();
  if (joined.IsNull() || !has(joined, TopAbs_FACE)) return shape;
  TopoDS_Compound all;
  const BRep_Builder builder;
  builder.MakeCompound(all);
  for (TopExp_Explorer at(joined, TopAbs_SHELL); at.More(); at.Next()) {
    const TopoDS_Shell shell = TopoDS::Shell(at.Current());
    if (!shell.Closed() && !BRep_Tool::IsClosed(shell)) {
      builder.Add(all, shell);
      continue;
    }
    TopoDS_Solid solid = BRepBuilderAPI_MakeSolid(shell).Solid();
    BRepLib::OrientClosedSolid(solid);
    builder.Add(all, solid);
  }
  for (TopExp_Explorer at(joined, TopAbs_FACE, TopAbs_SHELL); at.More(); at.Next())
    builder.Add(all, at.Current());
  return all;
}

/// Checks that a shape can be measured. Returns its size.
///
/// @errors   Error(Input) without the name of the file, when it is damaged
double checked_size(const TopoDS_Shape& shape, CadTranslation& said) {
  const int faces = shape.IsNull() ? 0 : counted_faces(shape);
  if (faces == 0)
    said.error = "it has no faces, which a part is measured against; export its surfaces";
  if (faces > kMostFaces)
    said.error = "it has more than " + std::to_string(kMostFaces) + " faces; name one part of it";
  if (!said.error.empty()) return 0.0;
  check_geometry(shape);
  Bnd_Box box;
  BRepBndLib::Add(shape, box, false);
  constexpr double kSmallestMm = 1e-4;
  constexpr double kLargestMm = 1e6;
  const double size = box.IsVoid() ? 0.0 : std::sqrt(box.SquareExtent());
  const bool is_usual = std::isfinite(size) && size >= kSmallestMm && size <= kLargestMm &&
                        !box.IsOpen() && box.CornerMax().Distance(gp_Pnt()) <= 10.0 * kLargestMm;
  if (!is_usual)
    said.error = "its size is none of a part: less than 0.1 um or more than 1 km; check its unit";
  return size;
}

/// The shape of a file, with what it asks for where that is wanted and the file may have it.
TopoDS_Shape read_shape(const std::string& path,
                        const CadRequest& asked,
                        bool step,
                        CadTranslation& said) {
  if (!step) return read_iges(path, said);
  return asked.pmi ? read_step_with_pmi(path, said) : read_step(path, asked.unit_mm, said);
}

void translate(const std::string& path,
               const CadRequest& asked,
               std::ostream& out,
               CadTranslation& said) {
  const std::optional<double>& unit_mm = asked.unit_mm;
  const bool step = lowercase_extension(path).starts_with(".st");
  TopoDS_Shape shape = read_shape(path, asked, step, said);
  if (!said.error.empty()) return;
  if (said.unit.empty() && !(step && unit_mm)) {
    said.error = "it states no unit of length; state it with `units`";
    return;
  }
  if (!said.unit.empty() && unit_mm) {
    said.error = "it states its unit, the " + said.unit + "; leave out `units`";
    return;
  }
  if (said.unit.empty()) said.unit = "as given";
  double size = checked_size(shape, said);
  if (!said.error.empty()) return;
  // Faces that are sewn together have other numbers than those that the file refers to.
  if (said.pmi.requirements.empty()) shape = sewn(shape);
  size = checked_size(shape, said);
  if (!said.error.empty()) return;
  // Of the size of the part: fine enough to start from, to draw and to align.
  constexpr double kDeflection = 5e-5;
  constexpr double kAngleRad = 0.25;
  BRepMesh_IncrementalMesh(shape, kDeflection * size, false, kAngleRad, false);
  BinTools::Write(shape, out);
}

}  // namespace

std::string stated_unit(STEPControl_Reader& reader) {
  TColStd_SequenceOfAsciiString lengths;
  TColStd_SequenceOfAsciiString angles;
  TColStd_SequenceOfAsciiString solid_angles;
  reader.FileUnits(lengths, angles, solid_angles);
  return lengths.Length() > 0 ? lowercase(lengths.First().ToCString()) : std::string();
}

std::string left_out_text(int roots, int done) {
  if (done >= roots) return {};
  return std::to_string(roots - done) + " of its " + std::to_string(roots) +
         " parts cannot be translated and are left out";
}

CadTranslation translate_cad(const std::filesystem::path& path,
                             const CadRequest& asked,
                             std::ostream& shape) {
  CadTranslation said;
  try {
    translate(path.string(), asked, shape, said);
  } catch (const Error& error) {
    said.error = error.what();
  } catch (const Standard_OutOfMemory&) {
    throw std::bad_alloc();
  } catch (const Standard_Failure&) {
    said.error = "its shape is not valid; export it again";
  }
  return said;
}

}  // namespace frangia
