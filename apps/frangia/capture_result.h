#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>

#include <nlohmann/json.hpp>

#include "frangia/acquisition/capture_options.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/reconstruct/watch_views.h"

#include "terminal.h"

namespace frangia {

/// What each view of a capture shows, collected while the views are decoded.
class CapturedViews {
 public:
  /// Sets the hooks of a capture by this rig, which must not outlive this object: each view is
  /// compared with those before it.
  void watch(const Scan& plan, CaptureOptions& options, const Run& run);
  /// The views so far, by their number. Only after the capture.
  [[nodiscard]] nlohmann::ordered_json json() const;

 private:
  struct View {
    ViewAssessment found;
    WatchedView watched;
    double angle_rad = 0.0;
  };
  std::map<std::size_t, View> views_;  ///< the capture decodes one view at a time
  std::optional<ViewWatch> watch_;
};

/// Prints the result of a capture into the folder `output`: one line, and a table of the views that
/// were skipped, or JSON. Skipped views set the exit code of a device fault, 4.
void print_capture(const std::filesystem::path& output,
                   const CaptureReport& report,
                   Terminal& terminal,
                   const CapturedViews& views = {});

}  // namespace frangia
