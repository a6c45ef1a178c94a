#include "frangia/surface/fans.h"

#include <algorithm>
#include <cstddef>

namespace frangia {

Fans::Fans(const Mesh& mesh) : first_(mesh.vertices_mm.size() + 1, 0) {
  for (const auto& t : mesh.triangles) {
    for (const std::uint32_t v : t)
      ++first_[v + 1];
  }
  for (std::size_t v = 1; v < first_.size(); ++v)
    first_[v] += first_[v - 1];
  triangles_.resize(3 * mesh.triangles.size());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const std::uint32_t v : mesh.triangles[t])
      triangles_[next[v]++] = t;
  }
}

std::vector<std::uint32_t> vertices_around(
    const Mesh& mesh, const Fans& fans, std::uint32_t vertex, int rings, float reach_mm) {
  std::vector<std::uint32_t> found{vertex};
  std::size_t i = 0;
  for (int ring = 0; ring < rings; ++ring) {
    const std::size_t end = found.size();
    for (; i < end; ++i) {
      for (const std::uint32_t t : fans.of(found[i])) {
        for (const std::uint32_t v : mesh.triangles[t]) {
          const float square = (mesh.vertices_mm[v] - mesh.vertices_mm[vertex]).squaredNorm();
          const bool near = square < reach_mm * reach_mm;
          if (near && std::find(found.begin(), found.end(), v) == found.end()) found.push_back(v);
        }
      }
    }
  }
  return found;
}

}  // namespace frangia
