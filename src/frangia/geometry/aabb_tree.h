#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/geometry/mesh.h"

namespace frangia {

/// A tree of the bounding boxes of a mesh's triangles, in Morton order. It finds overlapping boxes.
///
/// @units    mm
/// @errors   Error(Input) when a triangle refers to a vertex that does not exist
/// @source   Lauterbach et al. 2009, Fast BVH Construction on GPUs
class AabbTree {
 public:
  /// Builds the tree; `mesh` is not needed afterwards.
  explicit AabbTree(const Mesh& mesh);

  /// Returns the number of leaves. Each holds up to four triangles that are near each other.
  [[nodiscard]] std::size_t leaves() const { return (order_.size() + kLeaf - 1) / kLeaf; }

  /// Calls `work(a, b)` for each pair of triangles with overlapping boxes, where `a` is in this
  /// leaf and `b` is in the same or a later leaf. Called for all leaves, this visits each pair
  /// once.
  template <typename Work>
  void overlapping_pairs(std::size_t leaf, const Work& work) const {
    visit_pairs({.node = 1, .begin = 0, .end = leaves_}, leaf, work);
  }
  /// Calls `work(a)` for each triangle whose box overlaps `box`.
  template <typename Work>
  void overlapping(const Eigen::AlignedBox3f& box, const Work& work) const {
    visit({.node = 1, .begin = 0, .end = leaves_}, box, work);
  }
  /// Returns the bounding box of a triangle.
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
  std::vector<Eigen::AlignedBox3f> triangle_boxes_;  ///< of the triangles in `order_`
  std::vector<Eigen::AlignedBox3f> node_boxes_;      ///< the children of node n are 2 n and 2 n + 1
  std::size_t leaves_ = 1;
};

}  // namespace frangia
