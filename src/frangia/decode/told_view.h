#pragma once

#include <cstddef>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/image.h"
#include "frangia/core/run.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/decode/decode_view.h"
#include "frangia/frames/frame_stack.h"

namespace frangia {

/// A sentence that decoding said.
struct DecodeMessage {
  bool warning = false;  ///< otherwise a note
  std::string sentence;  ///< names the view
};

/// A decoded view and what its decoding said.
struct ToldView {
  DecodedView view;                     ///< with its colors
  std::vector<DecodeMessage> messages;  ///< in their order

  /// Says the messages.
  void tell(const Run& run) const;
};

/// Decodes a view of a scan from its frames, which may come from the disk or from a camera. Keeps
/// its notes and warnings, each preceded by the name of the view.
///
/// @shape    as decode_view
/// @errors   as decode_view
[[nodiscard]] ToldView decode_told(const Scan& scan,
                                   std::size_t view,
                                   std::span<const FrameStack> stacks,
                                   const DecodePlan& plan,
                                   const Image<Eigen::Vector2f>& rays,
                                   const DecodeOptions& options,
                                   const std::stop_token& stop = {});

}  // namespace frangia
