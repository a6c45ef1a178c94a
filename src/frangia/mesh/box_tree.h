#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/surface/mesh.h"

namespace frangia {

/// Boxes of a mesh's triangles in a tree, along a curve through space: to find those that overlap.
///
/// source   Lauterbach et al. 2009, Fast BVH Construction (the curve of Morton)
class BoxTree {
 public:
  /// errors   Error(Input) when a triangle refers to a vertex that is not there
  explicit BoxTree(const Mesh& mesh);

  /// Calls `work(triangle)` for each triangle whose box touches this one.
  template <typename Work>
  void touching(const Eigen::AlignedBox3f& box, const Work& work) const {
    if (!order_.empty()) visit(1, box, work);
  }
  [[nodiscard]] static Eigen::AlignedBox3f box_of(const Mesh& mesh, std::uint32_t triangle);

 private:
  static constexpr std::size_t kLeaf = 4;

  template <typename Work>
  void visit(std::size_t node, const Eigen::AlignedBox3f& box, const Work& work) const {
    if (!boxes_[node].intersects(box)) return;
    if (node < leaves_) {
      visit(2 * node, box, work);
      visit(2 * node + 1, box, work);
      return;
    }
    const std::size_t begin = (node - leaves_) * kLeaf;
    const std::size_t end = std::min(begin + kLeaf, order_.size());
    for (std::size_t i = begin; i < end; ++i)
      if (own_[i].intersects(box)) work(order_[i]);
  }

  std::vector<std::uint32_t> order_;
  std::vector<Eigen::AlignedBox3f> own_;    ///< of the triangles, in that order
  std::vector<Eigen::AlignedBox3f> boxes_;  ///< node n has 2 n and 2 n + 1
  std::size_t leaves_ = 1;
};

}  // namespace frangia
