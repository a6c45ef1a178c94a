#pragma once

#include <cstddef>
#include <exception>
#include <functional>
#include <future>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/image.h"
#include "frangia/core/run.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/decode/decoded_views.h"

namespace frangia {

/// Reads and decodes the views of a scan in their order, one view ahead of the caller, on a thread
/// of its own.
///
/// Memory holds two views: the one that `next` returned last and the one that is being decoded.
/// The callbacks of `run` are called inside `next`, on the caller's thread and in the order of the
/// views. The thread ends before the destructor returns.
class ViewDecoder {
 public:
  /// Plans the decoding of all views. `known` holds views that were decoded before. The references
  /// must outlive this object.
  ///
  /// @errors   as plan_decoding
  ViewDecoder(const Scan& scan,
              const Image<Eigen::Vector2f>& rays,
              const DecodeOptions& options,
              const Run& run,
              std::shared_ptr<const DecodedViews> known = nullptr);
  ViewDecoder(const ViewDecoder&) = delete;
  ViewDecoder& operator=(const ViewDecoder&) = delete;
  ViewDecoder(ViewDecoder&&) = delete;
  ViewDecoder& operator=(ViewDecoder&&) = delete;
  ~ViewDecoder();

  /// The next view, from the first one on; to be called once per view. Starts the view after it.
  ///
  /// @errors   as read_frames and decode_view for this view
  [[nodiscard]] DecodedView next();

 private:
  struct Outcome {
    ToldView told;
    std::exception_ptr error;
  };
  void start();
  [[nodiscard]] Outcome decode(std::size_t view) const;

  const Scan& scan_;
  const Image<Eigen::Vector2f>& rays_;
  const DecodeOptions& options_;
  const DecodePlan plan_;
  const Run& run_;
  const std::shared_ptr<const DecodedViews> known_;
  std::stop_source stop_;
  std::stop_callback<std::function<void()>> forward_stop_;
  std::size_t view_ = 0;  ///< that `pending_` decodes
  std::future<Outcome> pending_;
};

}  // namespace frangia
