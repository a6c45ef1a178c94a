#pragma once

#include <cstddef>
#include <functional>
#include <future>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "frangia/acquisition/capture_options.h"
#include "frangia/core/image.h"
#include "frangia/core/run.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/decode/decoded_views.h"
#include "frangia/frames/frame_stack.h"

namespace frangia {

/// Decodes captured views on a thread of its own and reports contrast, saturated share and number
/// of points of each.
class ViewAssessor {
 public:
  /// Passes each assessment to `options.on_view`, where it is set, and each view to
  /// `options.decoded`. The references must outlive this object.
  ViewAssessor(const Scan& plan, const CaptureOptions& options, const Run& run);
  ViewAssessor(const ViewAssessor&) = delete;
  ViewAssessor& operator=(const ViewAssessor&) = delete;
  ViewAssessor(ViewAssessor&&) = delete;
  ViewAssessor& operator=(ViewAssessor&&) = delete;
  ~ViewAssessor() = default;

  /// Starts to decode a complete view, its frames in the order of `read_frames`. Waits for the
  /// previous view.
  void begin(std::size_t view, std::vector<std::shared_ptr<const Frame>> frames);
  /// Reports the current view when its assessment is ready; with `wait`, waits for it.
  void report(bool wait);

 private:
  /// A view in words, and whether there is nothing to remedy.
  struct Answer {
    std::string text;
    bool good = false;
  };
  [[nodiscard]] Answer decode(std::size_t view,
                              const std::vector<std::shared_ptr<const Frame>>& frames) const;
  [[nodiscard]] ToldView decode_stacks(std::size_t view,
                                       const std::vector<FrameStack>& stacks) const;

  const Scan& plan_;
  /// Lets the options' own check look at a view, and passes it on.
  void pass_on(ViewAssessment& found) const;

  const std::function<std::string(const ViewAssessment&)>& check_view_;
  const std::function<void(const ViewAssessment&)>& on_view_;
  const std::shared_ptr<DecodedViews> keep_;  ///< null: nothing is kept
  const Scan& scan_;                          ///< whose rig and patterns decode
  const Run& run_;
  Image<Eigen::Vector2f> rays_;
  std::size_t view_ = 0;
  std::future<Answer> decoding_;
};

}  // namespace frangia
