#pragma once

#include <cstddef>
#include <future>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/image.h"
#include "frangia/core/run.h"
#include "frangia/frames/frame.h"
#include "frangia/scan/scan_folder.h"

namespace frangia {

/// Decodes views beside the session, while the table turns and the next ones are taken, and says of
/// each what it holds: contrast, saturated share, points.
class ViewVerdicts {
 public:
  ViewVerdicts(const Scan& plan, const Run& run);
  ViewVerdicts(const ViewVerdicts&) = delete;
  ViewVerdicts& operator=(const ViewVerdicts&) = delete;
  ViewVerdicts(ViewVerdicts&&) = delete;
  ViewVerdicts& operator=(ViewVerdicts&&) = delete;
  ~ViewVerdicts() = default;

  /// Begins to decode a view whose frames are all there, in the order of `read_frames`. One at a
  /// time: waits for the view before.
  void begin(std::size_t view, std::vector<std::shared_ptr<const Frame>> frames);
  /// Says the verdict that is ready, if there is one; with `wait`, that of a view not ready yet.
  void tell(bool wait);

 private:
  [[nodiscard]] std::string decode(const std::vector<std::shared_ptr<const Frame>>& frames) const;

  const Scan& plan_;
  const Run& run_;
  Image<Eigen::Vector2f> rays_;
  std::size_t view_ = 0;
  std::future<std::string> decoding_;
};

}  // namespace frangia
