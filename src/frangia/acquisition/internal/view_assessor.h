#pragma once

#include <cstddef>
#include <future>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/image.h"
#include "frangia/core/run.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/frames/frame.h"

namespace frangia {

/// Decodes views beside the session, while the table turns and the next ones are taken, and says of
/// each what it holds: contrast, saturated share, points.
class ViewAssessor {
 public:
  ViewAssessor(const Scan& plan, const Run& run);
  ViewAssessor(const ViewAssessor&) = delete;
  ViewAssessor& operator=(const ViewAssessor&) = delete;
  ViewAssessor(ViewAssessor&&) = delete;
  ViewAssessor& operator=(ViewAssessor&&) = delete;
  ~ViewAssessor() = default;

  /// Begins to decode a view whose frames are all there, in the order of `read_frames`. One at a
  /// time: waits for the view before.
  void begin(std::size_t view, std::vector<std::shared_ptr<const Frame>> frames);
  /// Says the assessment that is ready, if there is one; with `wait`, that of a view not ready yet.
  void report(bool wait);

 private:
  [[nodiscard]] std::string decode(const std::vector<std::shared_ptr<const Frame>>& frames) const;

  const Scan& plan_;
  const Run& run_;
  Image<Eigen::Vector2f> rays_;
  std::size_t view_ = 0;
  std::future<std::string> decoding_;
};

}  // namespace frangia
