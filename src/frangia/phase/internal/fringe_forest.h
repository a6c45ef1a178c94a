#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace frangia {

/// Union-find with offsets: each element stores the fringes that lift it to its parent.
class FringeForest {
 public:
  explicit FringeForest(std::size_t count) : parent_(count), fringes_(count, 0) {
    for (std::size_t i = 0; i < count; ++i)
      parent_[i] = static_cast<std::uint32_t>(i);
  }
  struct Root {
    std::uint32_t index;
    std::int32_t fringes;  ///< fringes to add to the element to be level with its root
  };
  [[nodiscard]] Root root(std::size_t element) {
    auto at = static_cast<std::uint32_t>(element);
    std::int32_t fringes = 0;
    while (parent_[at] != at) {
      // Path halving.
      const std::uint32_t up = parent_[at];
      fringes_[at] += fringes_[up];
      parent_[at] = parent_[up];
      fringes += fringes_[at];
      at = parent_[at];
    }
    return {at, fringes};
  }
  /// Joins the sets of `a` and `b`; `fringes` is added to `b` to be level with `a`. The root with
  /// the smaller index stays a root. Elements of the same set are unchanged.
  void join(std::size_t a, std::size_t b, std::int32_t fringes) {
    const Root above = root(a);
    const Root below = root(b);
    if (above.index == below.index) return;
    const std::int32_t apart = fringes + above.fringes - below.fringes;
    if (above.index < below.index) {
      parent_[below.index] = above.index;
      fringes_[below.index] = apart;
    } else {
      parent_[above.index] = below.index;
      fringes_[above.index] = -apart;
    }
  }

 private:
  std::vector<std::uint32_t> parent_;
  std::vector<std::int32_t> fringes_;
};

}  // namespace frangia
