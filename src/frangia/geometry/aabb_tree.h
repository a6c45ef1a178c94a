#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/geometry/mesh.h"

namespace frangia {

/// Boxes of a mesh's triangles in a tree, along a curve through space: to find those that overlap.
///
/// source   Lauterbach et al. 2009, Fast BVH Construction (the curve of Morton)
class AabbTree {
 public:
  /// errors   Error(Input) when a triangle refers to a vertex that is not there
  explicit AabbTree(const Mesh& mesh);

  /// Leaves hold a few triangles each that lie near to each other.
  [[nodiscard]] std::size_t leaves() const { return (order_.size() + kLeaf - 1) / kLeaf; }

  /// Calls `work(a, b)` for each pair of triangles whose boxes touch, of which one is in this leaf
  /// and the other in it or in a later one: over all leaves that is every pair once.
  template <typename Work>
  void overlapping_pairs(std::size_t leaf, const Work& work) const {
    visit_pairs({.node = 1, .begin = 0, .end = leaves_}, leaf, work);
  }
  /// Calls `work(a)` for each triangle whose box touches this one.
  template <typename Work>
  void overlapping(const Eigen::AlignedBox3f& box, const Work& work) const {
    visit({.node = 1, .begin = 0, .end = leaves_}, box, work);
  }
  [[nodiscard]] static Eigen::AlignedBox3f box_of(const Mesh& mesh, std::uint32_t triangle);

 private:
  static constexpr std::size_t kLeaf = 4;
  /// A node and the leaves below it.
  struct Branch {
    std::size_t node, begin, end;
  };

  template <typename Work>
  void visit(const Branch& at, const Eigen::AlignedBox3f& box, const Work& work) const {
    if (!node_boxes_[at.node].intersects(box)) return;
    if (at.node < leaves_) {
      const std::size_t middle = (at.begin + at.end) / 2;
      visit({2 * at.node, at.begin, middle}, box, work);
      visit({2 * at.node + 1, middle, at.end}, box, work);
      return;
    }
    for (std::size_t i = at.begin * kLeaf; i < std::min((at.begin + 1) * kLeaf, order_.size()); ++i)
      if (triangle_boxes_[i].intersects(box)) work(order_[i]);
  }

  template <typename Work>
  void visit_pairs(const Branch& at, std::size_t leaf, const Work& work) const {
    if (at.end <= leaf || !node_boxes_[at.node].intersects(node_boxes_[leaves_ + leaf])) return;
    if (at.node < leaves_) {
      const std::size_t middle = (at.begin + at.end) / 2;
      visit_pairs({2 * at.node, at.begin, middle}, leaf, work);
      visit_pairs({2 * at.node + 1, middle, at.end}, leaf, work);
      return;
    }
    const std::size_t end = std::min((at.begin + 1) * kLeaf, order_.size());
    for (std::size_t i = leaf * kLeaf; i < std::min((leaf + 1) * kLeaf, order_.size()); ++i) {
      for (std::size_t k = std::max(at.begin * kLeaf, i + 1); k < end; ++k)
        if (triangle_boxes_[i].intersects(triangle_boxes_[k])) work(order_[i], order_[k]);
    }
  }

  std::vector<std::uint32_t> order_;
  std::vector<Eigen::AlignedBox3f> triangle_boxes_;  ///< of the triangles, in that order
  std::vector<Eigen::AlignedBox3f> node_boxes_;      ///< node n has 2 n and 2 n + 1
  std::size_t leaves_ = 1;
};

}  // namespace frangia
