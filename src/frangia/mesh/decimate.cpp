#include "frangia/mesh/decimate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <queue>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/error.h"
#include "frangia/mesh/half_edges.h"
#include "frangia/mesh/quadric.h"
#include "frangia/mesh/vertex_data.h"

namespace frangia {
namespace {

using Eigen::Vector3d;

constexpr std::uint32_t kNone = 0xFFFFFFFF;
constexpr double kBoundaryWeight = 10.0;

/// An edge that may go. It is out of date once either end has changed since.
struct Candidate {
  float cost;
  std::uint32_t a, b;
  std::uint32_t version;

  bool operator<(const Candidate& other) const {  // the queue gives the largest first
    if (cost != other.cost) return cost > other.cost;
    return a != other.a ? a > other.a : b > other.b;
  }
};

struct Joint {
  Vector3d place;
  double cost;
  double mean_square;
};

class Decimation {
 public:
  Decimation(Mesh& mesh, const DecimateOptions& options)
      : mesh_(mesh), limit_(options.max_rms_mm * options.max_rms_mm), left_(mesh.triangles.size()) {
    const std::size_t vertices = mesh.vertices_mm.size();
    quadrics_.resize(vertices);
    versions_.resize(vertices);
    seen_.resize(vertices);
    fixed_.resize(vertices);
    open_.resize(vertices);
    first_.assign(vertices, kNone);
    following_.assign(3 * mesh.triangles.size(), kNone);
    alive_.assign(mesh.triangles.size(), 1);
    weigh_vertices();
    const HalfEdges edges(mesh);
    for (std::uint32_t corner = 0; corner < following_.size(); ++corner) {
      following_[corner] = first_[from_of(mesh, corner)];
      first_[from_of(mesh, corner)] = corner;
    }
    prepare(edges);
  }

  void run(std::size_t target, const Run& run) {
    const std::size_t begin = left_;
    std::size_t steps = 0;
    while (left_ > target && !queue_.empty()) {
      const Candidate candidate = queue_.top();
      queue_.pop();
      if (candidate.version != versions_[candidate.a] + versions_[candidate.b]) continue;
      if (gone(candidate.a) || gone(candidate.b)) continue;
      const Joint joint = joint_of(candidate.a, candidate.b);
      if (keeps_shape(candidate.a, candidate.b, joint.place)) {
        join(candidate.a, candidate.b, joint.place);
      }
      if (++steps % 65'536 == 0 && begin > target) {
        run.report(static_cast<double>(begin - left_) / static_cast<double>(begin - target));
      }
    }
    keep_triangles(mesh_, alive_);
    renew_normals(mesh_);
  }

 private:
  [[nodiscard]] Vector3d place(std::uint32_t v) const {
    return mesh_.vertices_mm[v].cast<double>();
  }
  [[nodiscard]] bool gone(std::uint32_t v) const { return first_[v] == kNone; }

  /// Vertices weigh by 1/sigma^2, within a factor of four of the usual one.
  void weigh_vertices() {
    std::vector<float> known;
    for (const float sigma : mesh_.sigma_mm)
      if (std::isfinite(sigma) && sigma > 0.0F) known.push_back(sigma);
    if (known.empty()) return;
    const auto middle = known.begin() + static_cast<std::ptrdiff_t>(known.size() / 2);
    std::nth_element(known.begin(), middle, known.end());
    usual_sigma_ = static_cast<double>(*middle);
  }
  [[nodiscard]] double trust(const Mesh::Triangle& triangle) const {
    if (!(usual_sigma_ > 0.0)) return 1.0;
    double sum = 0.0;
    for (const std::uint32_t vertex : triangle) {
      const auto sigma = static_cast<double>(mesh_.sigma_mm[vertex]);
      const double ratio = sigma > 0.0 ? usual_sigma_ / sigma : 0.5;
      sum += std::clamp(ratio * ratio, 0.25, 4.0) / 3.0;
    }
    return sum;
  }

  void prepare(const HalfEdges& edges) {
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      const auto& triangle = mesh_.triangles[t];
      const Vector3d cross =
          (place(triangle[1]) - place(triangle[0])).cross(place(triangle[2]) - place(triangle[0]));
      const double length = cross.norm();
      if (!(length > 0.0)) continue;
      const double weight = length * trust(triangle);
      for (const std::uint32_t vertex : triangle)
        quadrics_[vertex].add_plane(cross / length, place(triangle[0]), weight);
      for (std::uint32_t edge = 3 * t; edge < 3 * t + 3; ++edge)
        if (edges.is_boundary(edge)) hold_boundary(edge, cross / length);
    }
    for (std::uint32_t edge = 0; edge < edges.count(); ++edge) {
      if (edges.has_twin(edge) || edges.is_boundary(edge)) continue;
      fixed_[from_of(mesh_, edge)] = 1;
      fixed_[to_of(mesh_, edge)] = 1;
    }
    std::vector<Candidate> all;
    for (std::uint32_t edge = 0; edge < edges.count(); ++edge) {
      if (edges.has_twin(edge) && edges.twin(edge) < edge) continue;
      add_candidate(from_of(mesh_, edge), to_of(mesh_, edge), all);
    }
    queue_ = std::priority_queue<Candidate>(std::less<Candidate>(), std::move(all));
  }

  void hold_boundary(std::uint32_t edge, const Vector3d& normal) {
    const std::uint32_t a = from_of(mesh_, edge);
    const std::uint32_t b = to_of(mesh_, edge);
    open_[a] = open_[b] = 1;
    const Vector3d along = place(b) - place(a);
    const Vector3d side = along.cross(normal).stableNormalized();
    for (const std::uint32_t v : {a, b})
      quadrics_[v].add_plane(side, place(a), kBoundaryWeight * along.squaredNorm());
  }

  template <typename Queue>
  void add_candidate(std::uint32_t a, std::uint32_t b, Queue& queue) const {
    if (a > b) std::swap(a, b);
    if (a == b || fixed_[a] != 0 || fixed_[b] != 0) return;
    const Joint joint = joint_of(a, b);
    if (joint.mean_square > limit_) return;
    // A trace of length parts what is equally flat: short edges first.
    const double cost = joint.cost + 1e-12 * (place(a) - place(b)).squaredNorm();
    if constexpr (requires { queue.push_back(Candidate{}); }) {
      queue.push_back({static_cast<float>(cost), a, b, versions_[a] + versions_[b]});
    } else {
      queue.push({static_cast<float>(cost), a, b, versions_[a] + versions_[b]});
    }
  }

  [[nodiscard]] Joint joint_of(std::uint32_t a, std::uint32_t b) const {
    Quadric sum = quadrics_[a];
    sum += quadrics_[b];
    const Vector3d pa = place(a);
    const Vector3d pb = place(b);
    const Vector3d middle = 0.5 * (pa + pb);
    Vector3d best;
    const bool open = sum.minimize(best);
    if (!open || (best - middle).squaredNorm() > (pa - pb).squaredNorm()) {
      best = middle;
      for (const Vector3d& other : {pa, pb})
        if (sum.at(other) < sum.at(best)) best = other;
    }
    const double cost = sum.at(best);
    return {best, cost, sum.weight > 0.0 ? cost / sum.weight : 0.0};
  }

  template <typename Work>
  void around(std::uint32_t vertex, const Work& work) const {
    for (std::uint32_t corner = first_[vertex]; corner != kNone; corner = following_[corner])
      if (alive_[corner / 3] != 0) work(corner);
  }
  [[nodiscard]] std::uint32_t at(std::uint32_t corner) const {
    return mesh_.triangles[corner / 3][corner % 3];
  }

  /// The link condition: ends share no more neighbours than triangles, and no triangle turns over.
  bool keeps_shape(std::uint32_t a, std::uint32_t b, const Vector3d& joint) {
    const std::uint32_t stamp = ++stamp_;
    std::size_t shared_triangles = 0;
    std::size_t beside_a = 0;
    std::size_t beside_b = 0;
    around(a, [&](std::uint32_t corner) {
      ++beside_a;
      const std::uint32_t next = at(HalfEdges::next(corner));
      const std::uint32_t last = at(HalfEdges::before(corner));
      if (next == b || last == b) ++shared_triangles;
      seen_[next] = seen_[last] = stamp;
    });
    if (shared_triangles == 0 || shared_triangles > 2) return false;
    if (shared_triangles == 2 && open_[a] != 0 && open_[b] != 0) return false;
    std::size_t shared = 0;
    const std::uint32_t counted = ++stamp_;
    around(b, [&](std::uint32_t corner) {
      ++beside_b;
      for (const std::uint32_t v : {at(HalfEdges::next(corner)), at(HalfEdges::before(corner))}) {
        if (seen_[v] != stamp) continue;
        seen_[v] = counted;
        ++shared;
      }
    });
    if (shared != shared_triangles) return false;
    if (beside_a + beside_b < 2 * shared_triangles + (shared_triangles == 2 ? 3 : 1)) return false;
    return stays_upright(a, b, joint) && stays_upright(b, a, joint);
  }

  [[nodiscard]] bool stays_upright(std::uint32_t v,
                                   std::uint32_t other,
                                   const Vector3d& joint) const {
    constexpr double kLeastCosine = 0.2;
    constexpr double kLeastShape = 0.02;  // of twice the area over the longest side squared
    bool upright = true;
    around(v, [&](std::uint32_t corner) {
      const std::uint32_t next = at(HalfEdges::next(corner));
      const std::uint32_t last = at(HalfEdges::before(corner));
      if (!upright || next == other || last == other) return;
      const Vector3d side = place(last) - place(next);
      const Vector3d before = (place(next) - place(v)).cross(side);
      const Vector3d after = (place(next) - joint).cross(side);
      const double longest = std::max({side.squaredNorm(),
                                       (place(next) - joint).squaredNorm(),
                                       (place(last) - joint).squaredNorm()});
      const bool turned = before.dot(after) < kLeastCosine * before.norm() * after.norm();
      const bool thin = after.norm() < kLeastShape * longest && after.norm() < before.norm();
      upright = !turned && !thin;
    });
    return upright;
  }

  void join(std::uint32_t a, std::uint32_t b, const Vector3d& joint) {
    around(a, [&](std::uint32_t corner) {
      if (at(HalfEdges::next(corner)) != b && at(HalfEdges::before(corner)) != b) return;
      alive_[corner / 3] = 0;
      --left_;
    });
    relink(a, b);
    mesh_.vertices_mm[a] = joint.cast<float>();
    quadrics_[a] += quadrics_[b];
    open_[a] |= open_[b];
    if (!mesh_.sigma_mm.empty()) mesh_.sigma_mm[a] = std::max(mesh_.sigma_mm[a], mesh_.sigma_mm[b]);
    if (!mesh_.views.empty()) mesh_.views[a] = std::min(mesh_.views[a], mesh_.views[b]);
    if (!mesh_.vertex_marks.empty()) {
      mesh_.vertex_marks[a] = std::max(mesh_.vertex_marks[a], mesh_.vertex_marks[b]);
    }
    versions_[a] += 1 + versions_[b];
    const std::uint32_t stamp = ++stamp_;
    around(a, [&](std::uint32_t corner) {
      for (const std::uint32_t v : {at(HalfEdges::next(corner)), at(HalfEdges::before(corner))}) {
        if (seen_[v] == stamp) continue;
        seen_[v] = stamp;
        add_candidate(a, v, queue_);
      }
    });
  }

  /// Puts the living corners of b and a on one list, of a.
  void relink(std::uint32_t a, std::uint32_t b) {
    std::uint32_t head = kNone;
    for (const std::uint32_t end : {a, b}) {
      for (std::uint32_t corner = first_[end]; corner != kNone;) {
        const std::uint32_t next = following_[corner];
        if (alive_[corner / 3] != 0) {
          mesh_.triangles[corner / 3][corner % 3] = a;
          following_[corner] = head;
          head = corner;
        }
        corner = next;
      }
    }
    first_[b] = kNone;
    first_[a] = head;
  }

  Mesh& mesh_;
  double limit_;
  std::size_t left_;
  double usual_sigma_ = 0.0;
  std::uint32_t stamp_ = 0;
  std::vector<Quadric> quadrics_;
  std::vector<std::uint32_t> versions_;
  std::vector<std::uint32_t> seen_;
  std::vector<std::uint8_t> fixed_;  ///< at a place that is not manifold
  std::vector<std::uint8_t> open_;   ///< on the boundary
  std::vector<std::uint32_t> first_;
  std::vector<std::uint32_t> following_;  ///< the next corner of the same vertex
  std::vector<std::uint8_t> alive_;
  std::priority_queue<Candidate> queue_;
};

}  // namespace

Mesh decimate(Mesh mesh, const DecimateOptions& options, const Run& run) {
  require(options.max_rms_mm > 0.0, "decimate: the tolerance must be positive");
  if (mesh.triangles.size() <= options.triangles) return mesh;
  Decimation(mesh, options).run(options.triangles, run);
  return mesh;
}

}  // namespace frangia
