#include "frangia/geometry/ray_scene.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <utility>
#include <vector>

#include <tbb/task_arena.h>
#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <Eigen/Geometry>

#include "frangia/core/error.h"
#include "frangia/geometry/clean_mesh.h"
#include "frangia/geometry/triangle_predicates.h"

namespace frangia {
namespace {

struct Corners {
  Eigen::Vector3d a, b, c;
};

Corners corners_of(const Mesh& mesh, std::uint32_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  return {mesh.vertices_mm[a].cast<double>(),
          mesh.vertices_mm[b].cast<double>(),
          mesh.vertices_mm[c].cast<double>()};
}

/// Distances that differ by less belong to one nearest point, on an edge or corner; times the size
/// of the mesh.
constexpr double kTie = 1e-9;

/// Margin of Embree's query radius, which is in single precision; times the size of the mesh.
constexpr double kQueryMargin = 1e-6;

/// The triangle of the mesh that Embree knows by its number among the searched ones.
std::uint32_t triangle_of(const std::vector<std::uint32_t>& searched, std::uint32_t number) {
  return searched.empty() ? number : searched[number];
}

struct Search {
  const Mesh* mesh;
  const std::vector<std::uint32_t>* searched;
  Eigen::Vector3d point_mm;
  std::optional<NearestPoint> best;
  double max_distance_mm;
  double size_mm;
  double squareness = 0.0;  ///< |cos| between the best triangle's normal and the direction
};

/// Keeps the nearer triangle; of two equally near ones the squarer, then the first.
bool consider(Search& search, std::uint32_t triangle) {
  const Corners corners = corners_of(*search.mesh, triangle);
  const Eigen::Vector3d normal = (corners.b - corners.a).cross(corners.c - corners.a).normalized();
  if (!(normal.squaredNorm() > 0.5)) return false;
  const Eigen::Vector3d point =
      nearest_on_triangle(corners.a, corners.b, corners.c, search.point_mm);
  const Eigen::Vector3d way = search.point_mm - point;
  const double distance = way.norm();
  if (!(distance <= search.max_distance_mm)) return false;
  const double height = way.dot(normal);
  const double squareness = distance > 0.0 ? std::abs(height) / distance : 1.0;
  if (search.best) {
    if (distance > search.best->distance_mm + kTie * search.size_mm) return false;
    const bool nearer = distance < search.best->distance_mm - kTie * search.size_mm;
    const bool squarer = squareness > search.squareness + 1e-9;
    const bool as_square = squareness >= search.squareness - 1e-9;
    if (!nearer && !squarer && !(as_square && triangle < search.best->triangle)) return false;
  }
  search.best = {point, distance, height < 0.0 ? -distance : distance, triangle};
  search.squareness = squareness;
  return true;
}

bool on_candidate(RTCPointQueryFunctionArguments* arguments) {
  auto& search = *static_cast<Search*>(arguments->userPtr);
  if (!consider(search, triangle_of(*search.searched, arguments->primID))) return false;
  // Embree prunes in single precision: the margin also keeps ties.
  const double radius = search.best->distance_mm * (1.0 + 1e-6) + kQueryMargin * search.size_mm;
  if (radius >= static_cast<double>(arguments->query->radius)) return false;
  arguments->query->radius = static_cast<float>(radius);
  return true;
}

/// Whether Embree accepts a ray: its coordinates must be finite and below 1.8e18.
bool is_valid(const RTCRay& ray) {
  constexpr float kLargest = 1e18F;
  const auto fits = [](float value) { return std::abs(value) < kLargest; };  // false for NaN
  return fits(ray.org_x) && fits(ray.org_y) && fits(ray.org_z) && fits(ray.dir_x) &&
         fits(ray.dir_y) && fits(ray.dir_z) && !std::isnan(ray.tfar);
}

RTCRay ray_of(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, double end) {
  RTCRay ray{};
  ray.org_x = static_cast<float>(origin.x());
  ray.org_y = static_cast<float>(origin.y());
  ray.org_z = static_cast<float>(origin.z());
  ray.dir_x = static_cast<float>(direction.x());
  ray.dir_y = static_cast<float>(direction.y());
  ray.dir_z = static_cast<float>(direction.z());
  ray.tfar = static_cast<float>(end);
  ray.mask = ~0U;
  return ray;
}

/// Copies into a buffer that Embree allocates: it reads some bytes past the last vertex.
template <typename Item>
void copy_buffer(RTCGeometry geometry,
                 RTCBufferType type,
                 RTCFormat format,
                 const std::vector<Item>& items) {
  void* buffer = rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(Item), items.size());
  if (buffer == nullptr) throw std::bad_alloc();
  std::copy(items.begin(), items.end(), static_cast<Item*>(buffer));
}

}  // namespace

struct RayScene::Embree {
  RTCDevice device = rtcNewDevice(nullptr);
  RTCScene scene = rtcNewScene(device);

  Embree() = default;
  Embree(const Embree&) = delete;
  Embree& operator=(const Embree&) = delete;
  Embree(Embree&&) = delete;
  Embree& operator=(Embree&&) = delete;
  ~Embree() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }

  void build(const Mesh& mesh, const std::vector<Mesh::Triangle>& triangles, const Run& run) const {
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneProgressMonitorFunction(
        scene,
        [](void* data, double /*done*/) {
          return !static_cast<const Run*>(data)->stop.stop_requested();
        },
        const_cast<Run*>(&run));  // NOLINT(*-const-cast): Embree passes it back unchanged
    if (!mesh.empty()) {
      RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
      copy_buffer(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, mesh.vertices_mm);
      copy_buffer(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, triangles);
      rtcCommitGeometry(geometry);
      rtcAttachGeometry(scene, geometry);
      rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(scene);
    rtcSetSceneProgressMonitorFunction(scene, nullptr, nullptr);  // `run` may end before the scene
  }
};

RayScene::RayScene(Mesh mesh, const Run& run) : mesh_(std::move(mesh)) {
  for (const auto& triangle : mesh_.triangles) {
    require(*std::max_element(triangle.begin(), triangle.end()) < mesh_.vertices_mm.size(),
            "RayScene: a triangle refers to a vertex that does not exist; repair the mesh first");
  }
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3f& vertex : mesh_.vertices_mm) {
    if (vertex.allFinite()) box.extend(vertex.cast<double>());
  }
  if (!box.isEmpty()) size_mm_ = box.diagonal().norm();
  std::vector<Mesh::Triangle> without_repeated;
  const std::vector<std::uint32_t> repeated = repeated_triangles(mesh_);
  if (!repeated.empty()) {
    auto next = repeated.begin();
    for (std::uint32_t i = 0; i < mesh_.triangles.size(); ++i) {
      if (next != repeated.end() && *next == i) {
        ++next;
      } else {
        searched_.push_back(i);
        without_repeated.push_back(mesh_.triangles[i]);
      }
    }
  }
  run.check();
  // One thread builds the tree: which of two triangles a ray through their edge hits depends on it.
  tbb::task_arena(1).execute([&] {
    embree_ = std::make_unique<Embree>();
    embree_->build(mesh_, repeated.empty() ? mesh_.triangles : without_repeated, run);
  });
  run.check();
}

RayScene::RayScene(RayScene&& other) noexcept = default;
RayScene& RayScene::operator=(RayScene&& other) noexcept = default;
RayScene::~RayScene() = default;

std::optional<RayHit> RayScene::first_hit(const Eigen::Vector3d& origin_mm,
                                          const Eigen::Vector3d& direction,
                                          double max_distance) const {
  RTCRayHit query{};
  query.ray = ray_of(origin_mm, direction, max_distance);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  if (!is_valid(query.ray)) return std::nullopt;
#if RTC_VERSION_MAJOR >= 4
  rtcIntersect1(embree_->scene, &query);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(embree_->scene, &context, &query);
#endif
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;

  const std::uint32_t triangle = triangle_of(searched_, query.hit.primID);
  const Corners t = corners_of(mesh_, triangle);
  const Eigen::Vector3d cross = (t.b - t.a).cross(t.c - t.a);
  RayHit hit;
  hit.triangle = triangle;
  hit.normal = cross.normalized();
  // At grazing incidence the plane's distance is ill-conditioned; Embree's is kept.
  const double steepness = direction.dot(cross);
  const bool grazing = std::abs(steepness) < 1e-6 * direction.norm() * cross.norm();
  hit.distance =
      grazing ? static_cast<double>(query.ray.tfar) : (t.a - origin_mm).dot(cross) / steepness;
  const Eigen::Vector3d p = origin_mm + hit.distance * direction;
  const double area2 = cross.squaredNorm();
  const double b = (p - t.a).cross(t.c - t.a).dot(cross) / area2;
  const double c = (t.b - t.a).cross(p - t.a).dot(cross) / area2;
  hit.barycentric = {1.0 - b - c, b, c};
  return hit;
}

bool RayScene::occluded(const Eigen::Vector3d& from_mm, const Eigen::Vector3d& to_mm) const {
  RTCRay ray = ray_of(from_mm, to_mm - from_mm, 1.0);
  if (!is_valid(ray)) return false;
#if RTC_VERSION_MAJOR >= 4
  rtcOccluded1(embree_->scene, &ray);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(embree_->scene, &context, &ray);
#endif
  return ray.tfar < 0.0F;
}

std::optional<NearestPoint> RayScene::nearest(const Eigen::Vector3d& point_mm,
                                              double max_distance_mm) const {
  Search search{&mesh_, &searched_, point_mm, std::nullopt, max_distance_mm, size_mm_};
  RTCPointQuery query{};
  query.x = static_cast<float>(point_mm.x());
  query.y = static_cast<float>(point_mm.y());
  query.z = static_cast<float>(point_mm.z());
  query.radius = static_cast<float>(max_distance_mm * (1.0 + 1e-6) + kQueryMargin * size_mm_);
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(embree_->scene, &query, &context, on_candidate, &search);
  return search.best;
}

}  // namespace frangia
