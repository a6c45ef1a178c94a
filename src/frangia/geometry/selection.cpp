#include "frangia/geometry/selection.h"

#include <vector>

#include "frangia/core/error.h"
#include "frangia/geometry/vertex_data.h"

namespace frangia {

Selection grow_selection(const Mesh& mesh, Selection selection, int rings) {
  require(selection.size() == mesh.triangles.size(),
          "grow_selection: the selection must have one flag for each triangle");
  std::vector<std::uint8_t> touched(mesh.vertices_mm.size());
  for (int ring = 0; ring < rings; ++ring) {
    for (std::size_t i = 0; i < selection.size(); ++i) {
      if (selection[i] == 0) continue;
      for (const std::uint32_t vertex : mesh.triangles[i])
        touched[vertex] = 1;
    }
    for (std::size_t i = 0; i < selection.size(); ++i) {
      const auto& [a, b, c] = mesh.triangles[i];
      selection[i] = touched[a] | touched[b] | touched[c];
    }
  }
  return selection;
}

Selection shrink_selection(const Mesh& mesh, Selection selection, int rings) {
  return invert_selection(grow_selection(mesh, invert_selection(std::move(selection)), rings));
}

Selection invert_selection(Selection selection) {
  for (std::uint8_t& flag : selection)
    flag ^= 1U;
  return selection;
}

Mesh delete_selected(Mesh mesh, const Selection& selection) {
  keep_triangles(mesh, invert_selection(selection));
  return mesh;
}

}  // namespace frangia
