#pragma once

#include <condition_variable>
#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "frangia/core/run.h"
#include "frangia/range/range_grid.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// A coarse surface of the views that a scan has so far.
struct GrownSurface {
  std::vector<std::size_t> views;             ///< that are in it, ascending
  std::size_t triangles = 0;                  ///< of the mesh
  int revision = 0;                           ///< higher for each later one of a scan
  std::shared_ptr<const std::string> packed;  ///< as `encode_mesh`
};

/// Fuses the views of a scan while it is captured, from every k-th pixel of them, registered: what
/// a person sees of the part while it still stands there. The surface of the scan is another one
/// and does not depend on it. Works on a thread of its own; all functions may be called from any
/// thread.
class GrowingSurface {
 public:
  /// `on_surface` is called on the own thread, each time that a surface is ready. An exception of
  /// it, or of what makes the surface, drops this surface.
  GrowingSurface(const Rig& rig, std::function<void(const GrownSurface&)> on_surface);
  GrowingSurface(const GrowingSurface&) = delete;
  GrowingSurface& operator=(const GrowingSurface&) = delete;
  GrowingSurface(GrowingSurface&&) = delete;
  GrowingSurface& operator=(GrowingSurface&&) = delete;
  /// Drops what is not fused yet.
  ~GrowingSurface();

  /// Adds a view of the reference camera, or replaces it. Views that come while a surface is made
  /// are all in the next one.
  void add(std::size_t view, double angle_rad, const RangeGrid& range);

 private:
  struct Thinned {
    double angle_rad = 0.0;
    RangeGrid range;
  };
  void serve(const std::stop_token& stop);

  Rig rig_;       ///< its reference camera has the pixels that are kept
  int step_ = 1;  ///< pixels from one that is kept to the next
  std::function<void(const GrownSurface&)> on_surface_;
  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::map<std::size_t, Thinned> views_;
  bool changed_ = false;
  std::jthread thread_;  ///< last: starts when everything else exists
};

}  // namespace frangia
