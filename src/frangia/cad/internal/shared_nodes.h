#pragma once

#include <cstdint>
#include <vector>

#include <Poly_Triangulation.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Vertex.hxx>

#include "frangia/geometry/mesh.h"

namespace frangia {

/// Gives the nodes on shared edges and vertices one number in all faces.
class SharedNodes {
 public:
  /// The nodes become vertices of `mesh`, which must outlive this.
  SharedNodes(const TopoDS_Shape& shape, Mesh& mesh);

  /// The numbers of the nodes of a face.
  ///
  /// @param number  of the face, from 1
  /// @errors   Error(Input) when an edge names a node that the face does not have
  std::vector<std::uint32_t> numbers_of(const TopoDS_Face& face,
                                        std::uint32_t number,
                                        const Handle(Poly_Triangulation) & triangles,
                                        const TopLoc_Location& place);

 private:
  std::uint32_t added(const Eigen::Vector3f& point);
  std::uint32_t* number_of(const TopoDS_Vertex& vertex);

  Mesh& mesh_;
  TopTools_IndexedMapOfShape edges_;
  TopTools_IndexedMapOfShape vertices_;
  std::vector<std::vector<std::uint32_t>> of_edge_;
  std::vector<std::uint32_t> of_vertex_;
};

}  // namespace frangia
