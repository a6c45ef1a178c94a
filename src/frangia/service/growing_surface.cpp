#include "frangia/service/growing_surface.h"

#include <utility>
#include <vector>

#include "frangia/fusion/fuse_views.h"
#include "frangia/registration/find_background.h"
#include "frangia/registration/find_turntable_top.h"
#include "frangia/registration/register_views.h"
#include "frangia/service/encode_arrays.h"
#include "frangia/views/thin_view.h"
#include "frangia/views/view_store.h"

namespace frangia {
namespace {

/// Pixels of a view that are kept, at most: eight views are then one surface in about a second on
/// one core (`./run figures app`).
constexpr double kMostPixels = 90'000.0;

}  // namespace

GrowingSurface::GrowingSurface(const Rig& rig, std::function<void(const GrownSurface&)> on_surface)
    : rig_(rig), on_surface_(std::move(on_surface)) {
  CameraModel& camera = rig_.reference().model;
  step_ = thinning_step(camera, kMostPixels);
  camera = thinned(camera, step_);
  thread_ = std::jthread([this](const std::stop_token& stop) { serve(stop); });
}

GrowingSurface::~GrowingSurface() {
  thread_.request_stop();
  thread_.join();
}

void GrowingSurface::add(std::size_t view, double angle_rad, const RangeGrid& range) {
  Thinned kept{angle_rad, thinned(range, step_)};
  {
    const std::lock_guard lock(mutex_);
    views_[view] = std::move(kept);
    changed_ = true;
  }
  wake_.notify_one();
}

void GrowingSurface::serve(const std::stop_token& stop) {
  Run run;
  run.stop = stop;
  const CameraModel& camera = rig_.reference().model;
  for (int revision = 1;; ++revision) {
    std::vector<Thinned> views;
    std::vector<std::size_t> numbers;
    {
      std::unique_lock lock(mutex_);
      if (!wake_.wait(lock, stop, [this] { return changed_; })) return;
      changed_ = false;
      for (const auto& [number, view] : views_) {
        views.push_back(view);
        numbers.push_back(number);
      }
    }
    try {
      ViewStore store;
      std::vector<Station> stations;
      for (const Thinned& view : views) {
        store.add({.range = view.range,
                   .rig_from_object = rig_.rig_from_object(view.angle_rad),
                   .edge_pixels = {}});
        stations.push_back({.angle_rad = view.angle_rad, .name = {}});
      }
      if (rig_.turntable) {
        clip_background(store, camera, run);
        clip_turntable_top(store, camera, run);
        static_cast<void>(register_views(store, camera, {*rig_.turntable, stations}, {}, run));
      }
      const Mesh mesh = fuse_views(store, camera, {}, run);
      on_surface_({numbers,
                   mesh.triangles.size(),
                   revision,
                   std::make_shared<const std::string>(encode_mesh(mesh, revision))});
    } catch (...) {  // NOLINT(bugprone-empty-catch): the points of the stations are shown instead
    }
  }
}

}  // namespace frangia
