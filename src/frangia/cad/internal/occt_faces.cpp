#include <algorithm>
#include <cmath>
#include <istream>
#include <limits>
#include <mutex>
#include <new>

#include <BRepTopAdaptor_FClass2d.hxx>
#include <BRep_Tool.hxx>
#include <BinTools.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_Printer.hxx>
#include <Poly_Triangulation.hxx>
#include <Precision.hxx>
#include <Standard_Failure.hxx>
#include <Standard_OutOfMemory.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <fmt/format.h>

#include "frangia/cad/internal/faces.h"
#include "frangia/cad/internal/nominal_shape.h"
#include "frangia/cad/internal/occt_foot.h"
#include "frangia/cad/internal/shape_checks.h"
#include "frangia/cad/internal/shared_nodes.h"
#include "frangia/geometry/aabb_tree.h"

namespace frangia {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// One face for queries.
struct FaceData {
  TopoDS_Face face;
  FootSurface surface;
  double side = 1.0;  ///< -1: outward is against the normal of the parametrization
  Eigen::AlignedBox3d box;
  double margin_mm = 0.0;  ///< between the face and its triangles, at most
  std::vector<std::uint32_t> edges;
  std::uint32_t first_triangle = 0;
  std::vector<std::array<Vector2d, 3>> uvs;  ///< of its triangles, where the surface needs a start
  std::unique_ptr<RayScene> triangles;       ///< likewise
};

/// The classifiers of one thread; each is made when it is needed.
using Classifiers = std::vector<std::unique_ptr<BRepTopAdaptor_FClass2d>>;

/// The nearest point so far.
struct Best {
  double distance = std::numeric_limits<double>::infinity();
  Vector3d point;
  Vector3d normal;
  std::uint32_t face = 0;
  const FootEdge* edge = nullptr;
};

Vector3d weights_in(const Mesh& mesh, std::uint32_t triangle, const Vector3d& point) {
  const auto& [i, j, k] = mesh.triangles[triangle];
  const Vector3d a = mesh.vertices_mm[i].cast<double>();
  const Vector3d ab = mesh.vertices_mm[j].cast<double>() - a;
  const Vector3d ac = mesh.vertices_mm[k].cast<double>() - a;
  const Vector3d normal = ab.cross(ac);
  const double area2 = normal.squaredNorm();
  if (!(area2 > 0.0)) return Vector3d::Constant(1.0 / 3.0);
  const double v = (point - a).cross(ac).dot(normal) / area2;
  const double w = ab.cross(point - a).dot(normal) / area2;
  return {1.0 - v - w, v, w};
}

class OcctFaces final : public CadModel::Faces {
 public:
  OcctFaces(const TopoDS_Shape& shape, const Run& run) {
    check_geometry(shape);
    SharedNodes shared(shape, mesh);
    TopTools_IndexedMapOfShape all;
    TopExp::MapShapes(shape, TopAbs_FACE, all);
    for (int i = 1; i <= all.Extent(); ++i) {
      run.check();
      add_face(TopoDS::Face(all(i)), shared);
    }
    add_edges(shape, all, run);
  }

  /// Prepares queries, on all cores.
  void build_trees(const Run& run) {
    Mesh boxes;  // one triangle spans the box of a face; that of a face without area is a point
    for (FaceData& data : faces_) {
      run.check();
      if (!data.uvs.empty()) data.triangles = std::make_unique<RayScene>(triangles_of(data));
      const auto at = static_cast<std::uint32_t>(boxes.vertices_mm.size());
      const bool has_box = !data.box.isEmpty();
      boxes.vertices_mm.emplace_back(has_box ? data.box.min().cast<float>()
                                             : Eigen::Vector3f(0, 0, 0));
      boxes.vertices_mm.emplace_back(has_box ? data.box.max().cast<float>()
                                             : Eigen::Vector3f(0, 0, 0));
      boxes.triangles.push_back({at, at + 1, at});
    }
    tree_ = std::make_unique<AabbTree>(boxes);
  }

  /// Does once on each face and edge what queries do.
  void try_queries() const {
    Classifiers classifiers(faces_.size());
    for (std::uint32_t face = 0; face < faces_.size(); ++face) {
      const FaceData& data = faces_[face];
      if (data.first_triangle >= mesh.triangles.size() ||
          face_of_triangle[data.first_triangle] != face)
        continue;
      NearestPoint start;
      start.triangle = data.first_triangle;
      const auto& [i, j, k] = mesh.triangles[start.triangle];
      start.point_mm =
          (mesh.vertices_mm[i] + mesh.vertices_mm[j] + mesh.vertices_mm[k]).cast<double>() / 3.0;
      Best best;
      try_face(face, start.point_mm, &start, classifiers, best);
      for (const std::uint32_t edge : data.edges)
        static_cast<void>(foot_on_edge(edges_[edge], start.point_mm));
    }
  }

  [[nodiscard]] ExactPoint nearest(const Vector3d& point,
                                   const NearestPoint& start) const override {
    try {
      return nearest_point(point, start);
    } catch (const Standard_Failure&) {
      throw Error(ErrorKind::Input,
                  fmt::format("face {} of the CAD model cannot be evaluated; export it again",
                              face_of_triangle[start.triangle] + 1));
    }
  }

 private:
  [[nodiscard]] ExactPoint nearest_point(const Vector3d& point, const NearestPoint& start) const {
    std::unique_ptr<Classifiers> classifiers = taken();
    Best best;
    const std::uint32_t first = face_of_triangle[start.triangle];
    try_face(first, point, &start, *classifiers, best);
    // The edges of the first face bound the distance also where its foot lies beyond them.
    const double reach = std::isfinite(best.distance) ? best.distance : start.distance_mm * 2.0;
    const auto radius = static_cast<float>(reach * (1.0 + 1e-5) + 1e-5);
    const Eigen::Vector3f at = point.cast<float>();
    const Eigen::AlignedBox3f around(at.array() - radius, at.array() + radius);
    tree_->overlapping(around, [&](std::uint32_t face) {
      if (face == first ||
          faces_[face].box.squaredExteriorDistance(point) >= best.distance * best.distance)
        return;
      try_face(face, point, nullptr, *classifiers, best);
    });
    give_back(std::move(classifiers));
    return answer(point, start, best);
  }

  void add_face(const TopoDS_Face& face, SharedNodes& shared) {
    TopLoc_Location place;
    const Handle(Poly_Triangulation) triangles = BRep_Tool::Triangulation(face, place);
    const Handle(Geom_Surface) geometry = BRep_Tool::Surface(face);
    CadFace found;
    FaceData data{face, FootSurface(geometry)};
    data.side = face.Orientation() == TopAbs_REVERSED ? -1.0 : 1.0;
    data.first_triangle = static_cast<std::uint32_t>(mesh.triangles.size());
    Vector3d center = Vector3d::Zero();
    const auto number = static_cast<std::uint32_t>(faces_.size());
    if (!triangles.IsNull()) {
      check_triangles(*triangles, number + 1);
      const auto numbers = shared.numbers_of(face, number + 1, triangles, place);
      for (int t = 1; t <= triangles->NbTriangles(); ++t) {
        std::array<int, 3> nodes{};
        triangles->Triangle(t).Get(nodes[0], nodes[1], nodes[2]);
        if (data.side < 0.0) std::swap(nodes[1], nodes[2]);
        Mesh::Triangle corner{};
        std::array<Vector2d, 3> uv;
        for (std::size_t k = 0; k < 3; ++k) {
          corner.at(k) = numbers[static_cast<std::size_t>(nodes.at(k)) - 1];
          if (triangles->HasUVNodes()) {
            const gp_Pnt2d at = triangles->UVNode(nodes.at(k));
            uv.at(k) = {at.X(), at.Y()};
          }
        }
        if (corner[0] == corner[1] || corner[1] == corner[2] || corner[2] == corner[0]) continue;
        mesh.triangles.push_back(corner);
        face_of_triangle.push_back(number);
        if (!data.surface.is_elementary()) data.uvs.push_back(uv);
        std::array<Vector3d, 3> p;
        for (std::size_t k = 0; k < 3; ++k) {
          p.at(k) = mesh.vertices_mm[corner.at(k)].cast<double>();
          data.box.extend(p.at(k));
        }
        const double area = 0.5 * (p[1] - p[0]).cross(p[2] - p[0]).norm();
        found.area_mm2 += area;
        center += area / 3.0 * (p[0] + p[1] + p[2]);
      }
      constexpr double kSlack = 3.0;
      data.margin_mm = kSlack * triangles->Deflection();
      data.box.min().array() -= data.margin_mm;
      data.box.max().array() += data.margin_mm;
    }
    if (found.area_mm2 > 0.0)
      found.shape = nominal_shape(data.surface, data.side, center / found.area_mm2);
    list.push_back(found);
    faces_.push_back(std::move(data));
  }

  /// The triangles of a face with vertices of their own.
  [[nodiscard]] Mesh triangles_of(const FaceData& data) const {
    Mesh own;
    own.vertices_mm.reserve(3 * data.uvs.size());
    for (std::size_t t = data.first_triangle; t < data.first_triangle + data.uvs.size(); ++t) {
      const auto at = static_cast<std::uint32_t>(own.vertices_mm.size());
      for (const std::uint32_t v : mesh.triangles[t])
        own.vertices_mm.push_back(mesh.vertices_mm[v]);
      own.triangles.push_back({at, at + 1, at + 2});
    }
    return own;
  }

  void add_edges(const TopoDS_Shape& shape, const TopTools_IndexedMapOfShape& all, const Run& run) {
    TopTools_IndexedDataMapOfShapeListOfShape parents;
    TopExp::MapShapesAndUniqueAncestors(shape, TopAbs_EDGE, TopAbs_FACE, parents);
    for (int i = 1; i <= parents.Extent(); ++i) {
      run.check();
      const TopoDS_Edge edge = TopoDS::Edge(parents.FindKey(i));
      if (BRep_Tool::Degenerated(edge)) continue;
      FootEdge data;
      data.curve = BRep_Tool::Curve(edge, data.first, data.last);
      if (data.curve.IsNull()) continue;
      double deflection = Precision::Infinite();
      bool seam = false;
      for (const TopoDS_Shape& face : parents(i)) {
        const auto number = static_cast<std::uint32_t>(all.FindIndex(face)) - 1;
        data.faces.push_back(number);
        faces_[number].edges.push_back(static_cast<std::uint32_t>(edges_.size()));
        deflection = std::min(deflection, faces_[number].margin_mm);
        seam = seam || BRep_Tool::IsClosed(edge, TopoDS::Face(face));
      }
      if (data.faces.empty()) continue;
      data.is_free = data.faces.size() == 1 && !seam;
      sample_edge(data, std::max(deflection, Precision::Confusion()));
      edges_.push_back(std::move(data));
    }
  }

  [[nodiscard]] bool contains(std::uint32_t face,
                              const Vector2d& uv,
                              Classifiers& classifiers) const {
    auto& classifier = classifiers[face];
    if (!classifier) {
      const std::scoped_lock lock(mutex_);  // its making may compute what faces share
      classifier =
          std::make_unique<BRepTopAdaptor_FClass2d>(faces_[face].face, Precision::PConfusion());
    }
    const TopAbs_State state = classifier->Perform(gp_Pnt2d(uv.x(), uv.y()));
    return state == TopAbs_IN || state == TopAbs_ON;
  }

  /// The parameters of the triangle's point nearest to `point`, within a distance.
  [[nodiscard]] std::optional<Vector2d> start_on(const FaceData& data,
                                                 const Vector3d& point,
                                                 const NearestPoint* start,
                                                 double reach) const {
    if (data.surface.is_elementary()) return Vector2d::Zero();
    std::uint32_t triangle = 0;
    Vector3d weights;
    if (start != nullptr) {
      triangle = start->triangle - data.first_triangle;
      weights = weights_in(mesh, start->triangle, start->point_mm);
    } else {
      if (!data.triangles) return std::nullopt;
      const auto near = data.triangles->nearest(point, reach + data.margin_mm);
      if (!near) return std::nullopt;
      triangle = near->triangle;
      weights = weights_in(data.triangles->mesh(), near->triangle, near->point_mm);
    }
    const auto& uv = data.uvs[triangle];
    return weights[0] * uv[0] + weights[1] * uv[1] + weights[2] * uv[2];
  }

  void try_face(std::uint32_t face,
                const Vector3d& point,
                const NearestPoint* start,
                Classifiers& classifiers,
                Best& best) const {
    const FaceData& data = faces_[face];
    const auto uv = start_on(data, point, start, best.distance);
    if (!uv) return;
    const SurfaceFoot foot = data.surface.foot(point, *uv);
    const double distance = (foot.point_mm - point).norm();
    if (!(distance < best.distance)) return;
    if (contains(face, foot.uv, classifiers)) {
      best = {distance, foot.point_mm, data.side * foot.normal, face, nullptr};
      if (foot.inside) return;
    }
    for (const std::uint32_t number : data.edges) {
      const FootEdge& edge = edges_[number];
      if (edge.box.squaredExteriorDistance(point) >= best.distance * best.distance) continue;
      const Vector3d at = foot_on_edge(edge, point);
      const double from_edge = (at - point).norm();
      if (from_edge < best.distance) best = {from_edge, at, Vector3d::Zero(), face, &edge};
    }
  }

  [[nodiscard]] ExactPoint answer(const Vector3d& point,
                                  const NearestPoint& start,
                                  Best best) const {
    if (!std::isfinite(best.distance)) {  // a face without valid edges: what its triangles say
      best.distance = start.distance_mm;
      best.point = start.point_mm;
      best.face = face_of_triangle[start.triangle];
      best.normal =
          std::copysign(1.0, start.signed_distance_mm) * (point - start.point_mm).normalized();
    }
    const Vector3d way = point - best.point;
    if (best.edge != nullptr) {
      double largest = -1.0;
      for (const std::uint32_t face : best.edge->faces) {
        const FaceData& data = faces_[face];
        const auto uv =
            start_on(data, best.point, nullptr, std::numeric_limits<double>::infinity());
        if (!uv) continue;
        const Vector3d normal = data.side * data.surface.foot(best.point, *uv).normal;
        const double along = std::abs(way.dot(normal));
        if (!(along > largest)) continue;
        largest = along;
        best.normal = normal;
        best.face = face;
      }
    }
    ExactPoint found;
    found.point_mm = best.point;
    found.normal = best.normal;
    found.distance_mm = best.distance;
    found.signed_distance_mm = std::copysign(best.distance, way.dot(best.normal));
    found.face = best.face;
    found.on_boundary = best.edge != nullptr && best.edge->is_free;
    return found;
  }

  [[nodiscard]] std::unique_ptr<Classifiers> taken() const {
    const std::scoped_lock lock(mutex_);
    if (idle_.empty()) return std::make_unique<Classifiers>(faces_.size());
    auto last = std::move(idle_.back());
    idle_.pop_back();
    return last;
  }
  void give_back(std::unique_ptr<Classifiers> classifiers) const {
    const std::scoped_lock lock(mutex_);
    idle_.push_back(std::move(classifiers));
  }

  std::vector<FaceData> faces_;
  std::vector<FootEdge> edges_;
  std::unique_ptr<AabbTree> tree_;
  mutable std::mutex mutex_;
  mutable std::vector<std::unique_ptr<Classifiers>> idle_;
};

std::unique_ptr<OcctFaces> loaded(std::istream& stream, const Run& run) {
  try {
    Message::DefaultMessenger()->RemovePrinters(STANDARD_TYPE(Message_Printer));
    TopoDS_Shape shape;
    BinTools::Read(shape, stream);
    if (shape.IsNull()) throw Error(ErrorKind::Input, "it has no shape; export it again");
    return std::make_unique<OcctFaces>(shape, run);
  } catch (const Standard_OutOfMemory&) {
    throw std::bad_alloc();
  } catch (const Standard_Failure&) {
    throw Error(ErrorKind::Input, "its shape is not valid; export it again");
  }
}

}  // namespace

std::unique_ptr<CadModel::Faces> load_faces(std::istream& stream, const Run& run) {
  auto faces = loaded(stream, run);
  faces->build_trees(run);
  return faces;
}

void rehearse_faces(std::istream& stream) {
  loaded(stream, {})->try_queries();
}

}  // namespace frangia
