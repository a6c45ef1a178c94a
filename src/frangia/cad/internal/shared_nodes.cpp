#include "frangia/cad/internal/shared_nodes.h"

#include <cstddef>
#include <limits>

#include <BRep_Tool.hxx>
#include <Poly_PolygonOnTriangulation.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>

#include "frangia/cad/internal/occt_foot.h"
#include "frangia/cad/internal/shape_checks.h"

namespace frangia {
namespace {

constexpr std::uint32_t kNoNumber = std::numeric_limits<std::uint32_t>::max();

}  // namespace

SharedNodes::SharedNodes(const TopoDS_Shape& shape, Mesh& mesh) : mesh_(mesh) {
  TopExp::MapShapes(shape, TopAbs_EDGE, edges_);
  TopExp::MapShapes(shape, TopAbs_VERTEX, vertices_);
  of_edge_.resize(static_cast<std::size_t>(edges_.Extent()) + 1);
  of_vertex_.resize(static_cast<std::size_t>(vertices_.Extent()) + 1, kNoNumber);
}

std::vector<std::uint32_t> SharedNodes::numbers_of(const TopoDS_Face& face,
                                                   std::uint32_t number_of_face,
                                                   const Handle(Poly_Triangulation) & triangles,
                                                   const TopLoc_Location& place) {
  std::vector<std::uint32_t> numbers(static_cast<std::size_t>(triangles->NbNodes()), kNoNumber);
  const auto point_of = [&](std::size_t node) {
    const gp_Pnt at = triangles->Node(static_cast<int>(node) + 1).Transformed(place);
    return Eigen::Vector3f(vector_from(at).cast<float>());
  };
  for (TopExp_Explorer at(face, TopAbs_EDGE); at.More(); at.Next()) {
    const TopoDS_Edge edge = TopoDS::Edge(at.Current());
    const auto polygon = BRep_Tool::PolygonOnTriangulation(edge, triangles, place);
    if (polygon.IsNull()) continue;
    check_polygon(*polygon, *triangles, number_of_face);
    const int count = polygon->NbNodes();
    auto& inner = of_edge_.at(static_cast<std::size_t>(edges_.FindIndex(edge)));
    if (inner.empty()) inner.assign(static_cast<std::size_t>(count), kNoNumber);
    if (inner.size() != static_cast<std::size_t>(count)) continue;
    const bool point = BRep_Tool::Degenerated(edge);
    for (int i = 0; i < count; ++i) {
      const auto node = static_cast<std::size_t>(polygon->Node(i + 1)) - 1;
      std::uint32_t* number = &inner[static_cast<std::size_t>(i)];
      if (i == 0 || point) number = number_of(TopExp::FirstVertex(edge));
      if (i == count - 1 && !point) number = number_of(TopExp::LastVertex(edge));
      if (number == nullptr) continue;
      if (*number == kNoNumber) *number = added(point_of(node));
      numbers[node] = *number;
    }
  }
  for (std::size_t i = 0; i < numbers.size(); ++i)
    if (numbers[i] == kNoNumber) numbers[i] = added(point_of(i));
  return numbers;
}

std::uint32_t SharedNodes::added(const Eigen::Vector3f& point) {
  mesh_.vertices_mm.push_back(point);
  return static_cast<std::uint32_t>(mesh_.vertices_mm.size() - 1);
}

std::uint32_t* SharedNodes::number_of(const TopoDS_Vertex& vertex) {
  if (vertex.IsNull()) return nullptr;
  return &of_vertex_.at(static_cast<std::size_t>(vertices_.FindIndex(vertex)));
}

}  // namespace frangia
