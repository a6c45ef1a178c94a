#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/image.h"
#include "frangia/decode/decode_view.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// Whether the phases of a view fit scan.toml and the rig.
struct ViewFit {
  bool decided = false;             ///< at least one check has an answer
  std::vector<std::size_t> used{};  ///< which of `DecodedView::directions` are triangulated
  bool accepted = false;            ///< nothing fits, and `accept_inconsistent` triangulates it
  std::string reason{};  ///< what does not fit, and what would, as a clause; empty if all fits

  /// Whether a phase of the view is to be triangulated.
  [[nodiscard]] bool fits() const { return !used.empty(); }
  /// The direction whose pixels get the points; the first where none fits.
  [[nodiscard]] std::size_t leading() const { return used.empty() ? 0 : used.front(); }
};

/// Decides which directions of a view are triangulated: those whose patterns agree with each other
/// and whose phase rises where the rig makes it rise; all of them with `accept_inconsistent`.
[[nodiscard]] ViewFit check_view(const DecodedView& decoded,
                                 const Rig& rig,
                                 const Image<Eigen::Vector2f>& rays,
                                 bool accept_inconsistent);

}  // namespace frangia
