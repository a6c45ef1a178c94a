#include "frangia/geometry/clean_mesh.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <numeric>
#include <optional>
#include <vector>

#include "frangia/core/disjoint_sets.h"
#include "frangia/core/parallel.h"
#include "frangia/core/pixel_buffer.h"
#include "frangia/geometry/boundary.h"
#include "frangia/geometry/vertex_data.h"

namespace frangia {
namespace {

struct Corner {
  std::uint32_t vertex;
  std::uint32_t triangle;
  std::uint32_t index;  ///< of the vertex in the triangle
};

/// Returns the fan of each corner of one vertex, as the number of one of its corners. Triangles
/// that share an edge belong to one fan.
std::vector<std::uint32_t> fans_of(const Mesh& mesh, const std::vector<Corner>& corners) {
  const auto next = [&](std::uint32_t i) {
    return mesh.triangles[corners[i].triangle][(corners[i].index + 1) % 3];
  };
  const auto previous = [&](std::uint32_t i) {
    return mesh.triangles[corners[i].triangle][(corners[i].index + 2) % 3];
  };
  std::vector<std::uint32_t> by_next(corners.size());
  std::iota(by_next.begin(), by_next.end(), 0U);
  std::stable_sort(by_next.begin(), by_next.end(), [&](std::uint32_t a, std::uint32_t b) {
    return next(a) < next(b);
  });
  DisjointSets parts(corners.size());
  for (std::uint32_t a = 0; a < corners.size(); ++a) {
    auto b = std::partition_point(
        by_next.begin(), by_next.end(), [&](std::uint32_t i) { return next(i) < previous(a); });
    for (; b != by_next.end() && next(*b) == previous(a); ++b)
      parts.join(a, *b);
  }
  std::vector<std::uint32_t> fans(corners.size());
  for (std::uint32_t a = 0; a < corners.size(); ++a)
    fans[a] = parts.find(a);
  return fans;
}

/// The connected components of a mesh that have too few triangles.
class SmallComponents {
 public:
  SmallComponents(const Mesh& mesh, std::size_t min_triangles)
      : components_(mesh.vertices_mm.size()),
        sizes_(mesh.vertices_mm.size(), 0),
        min_triangles_(min_triangles) {
    for (const auto& t : mesh.triangles) {
      components_.join(t[0], t[1]);
      components_.join(t[0], t[2]);
    }
    for (const auto& t : mesh.triangles)
      ++sizes_[components_.find(t[0])];
  }

  void remove_from(Mesh& mesh) {
    if (std::none_of(sizes_.begin(), sizes_.end(), [&](auto size) { return is_small(size); }))
      return;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      if (is_small(sizes_[components_.find(mesh.triangles[i][0])])) continue;
      if (!mesh.triangle_marks.empty()) mesh.triangle_marks[kept] = mesh.triangle_marks[i];
      mesh.triangles[kept++] = mesh.triangles[i];
    }
    mesh.triangles.resize(kept);
    if (!mesh.triangle_marks.empty()) mesh.triangle_marks.resize(kept);
  }

 private:
  [[nodiscard]] bool is_small(std::uint32_t size) const {
    return size != 0 && size < min_triangles_;
  }

  DisjointSets components_;
  LargeVector<std::uint32_t> sizes_;  ///< in triangles, of each component
  std::size_t min_triangles_;
};

void split_at(const std::vector<bool>& boundary, Mesh& mesh) {
  std::vector<Corner> corners;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::uint32_t i = 0; i < 3; ++i) {
      if (boundary[mesh.triangles[t][i]]) corners.push_back({mesh.triangles[t][i], t, i});
    }
  }
  std::stable_sort(corners.begin(), corners.end(), [](const Corner& a, const Corner& b) {
    return a.vertex < b.vertex;
  });
  for (auto begin = corners.begin(); begin != corners.end();) {
    const auto end = std::find_if(
        begin, corners.end(), [&](const Corner& c) { return c.vertex != begin->vertex; });
    const std::vector<Corner> around(begin, end);
    const std::vector<std::uint32_t> fans = fans_of(mesh, around);
    for (std::uint32_t fan = 1; fan < fans.size(); ++fan) {
      if (fans[fan] != fan) continue;
      const std::uint32_t added = copy_vertex(mesh, around[0].vertex);
      for (std::size_t i = 0; i < fans.size(); ++i) {
        if (fans[i] == fan) mesh.triangles[around[i].triangle][around[i].index] = added;
      }
    }
    begin = end;
  }
}

}  // namespace

void remove_small_components(Mesh& mesh, std::size_t min_triangles) {
  SmallComponents(mesh, min_triangles).remove_from(mesh);
}

void split_nonmanifold_vertices(Mesh& mesh) {
  split_at(boundary_vertices(mesh), mesh);
}

void clean_mesh(Mesh& mesh, std::size_t min_triangles) {
  // Both loops read all triangles. Removing small components does not change the boundary of the
  // others, so they can run at the same time.
  std::optional<SmallComponents> small;
  std::vector<bool> boundary;
  parallel_chunks(2, 1, [&](std::size_t which, std::size_t) {
    if (which == 0) {
      small.emplace(mesh, min_triangles);
    } else {
      boundary = boundary_vertices(mesh);
    }
  });
  small->remove_from(mesh);
  split_at(boundary, mesh);
  remove_unused_vertices(mesh);
}

void remove_unused_vertices(Mesh& mesh) {
  constexpr std::uint32_t kUnused = ~0U;
  LargeVector<std::uint32_t> new_index(mesh.vertices_mm.size(), kUnused);
  for (const auto& t : mesh.triangles) {
    for (const std::uint32_t vertex : t)
      new_index[vertex] = 0;
  }
  std::uint32_t next = 0;
  for (std::uint32_t& name : new_index) {
    if (name != kUnused) name = next++;
  }
  if (next == new_index.size()) return;
  const auto keep = [&](auto& values) {
    if (values.empty()) return;
    for (std::size_t i = 0; i < new_index.size(); ++i) {
      if (new_index[i] != kUnused) values[new_index[i]] = values[i];
    }
    values.resize(next);
  };
  keep(mesh.vertices_mm);
  keep(mesh.normals);
  keep(mesh.sigma_mm);
  keep(mesh.sigma_noise_mm);
  keep(mesh.sigma_systematic_mm);
  keep(mesh.views);
  keep(mesh.colors);
  keep(mesh.vertex_marks);
  parallel_chunks(mesh.triangles.size(), 65536, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      for (std::uint32_t& vertex : mesh.triangles[t])
        vertex = new_index[vertex];
    }
  });
}

namespace {

/// Mixes the bits of a number (splitmix64).
std::uint64_t mixed(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

/// Hash of a position; equal for 0 and -0.
std::uint64_t hash_of(const Eigen::Vector3f& position) {
  std::uint64_t hash = 0x9e3779b97f4a7c15ULL;
  for (const float value : position)
    hash = mixed(hash + std::bit_cast<std::uint32_t>(value + 0.0F));
  return hash;
}

/// Hash of the three positions that does not depend on their order.
std::uint64_t hash_of(const Mesh& mesh, const Mesh::Triangle& triangle) {
  std::uint64_t sum = 0;
  for (const std::uint32_t vertex : triangle)
    sum += hash_of(mesh.vertices_mm[vertex]);
  return mixed(sum);
}

bool at_same_positions(const Mesh& mesh, const Mesh::Triangle& one, const Mesh::Triangle& other) {
  return std::is_permutation(
      one.begin(), one.end(), other.begin(), [&](std::uint32_t a, std::uint32_t b) {
        return mesh.vertices_mm[a] == mesh.vertices_mm[b];
      });
}

}  // namespace

std::vector<std::uint32_t> repeated_triangles(const Mesh& mesh) {
  constexpr std::uint32_t kFree = ~0U;
  // Open addressing with at most half of the slots taken.
  std::vector<std::uint32_t> slots(std::bit_ceil(2 * mesh.triangles.size() + 1), kFree);
  const std::size_t last = slots.size() - 1;
  std::vector<std::uint32_t> repeated;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    std::size_t at = hash_of(mesh, mesh.triangles[i]) & last;
    while (slots[at] != kFree &&
           !at_same_positions(mesh, mesh.triangles[slots[at]], mesh.triangles[i]))
      at = (at + 1) & last;
    if (slots[at] == kFree) {
      slots[at] = i;
    } else {
      repeated.push_back(i);
    }
  }
  return repeated;
}

}  // namespace frangia
