#include "frangia/calibrate/internal/rig_observations.h"

#include <algorithm>

namespace frangia {
namespace {

bool is_lit(const BoardPoint& point) {
  return point.projector_px.allFinite() && (point.projector_sigma_px.array() > 0.0).all();
}

PhaseReading reading_of(const BoardPoint& point) {
  return {point.camera_px, point.projector_by_camera};
}

/// The point of the reference camera that a further camera sees, too; null if there is none.
const BoardPoint* same_point(std::span<const BoardPoint> points, int index) {
  const auto found = std::find_if(
      points.begin(), points.end(), [&](const BoardPoint& one) { return one.index == index; });
  return found == points.end() ? nullptr : &*found;
}

/// The observation of the projector by one point, if there is one.
void add_phase(const BoardView& view,
               const BoardPoint& point,
               bool has_projector,
               RigObservation observation,
               std::vector<RigObservation>& observations) {
  if (!is_lit(point)) return;
  observation.by_projector = true;
  observation.pixel = point.projector_px;
  observation.sigma_px = point.projector_sigma_px;
  observation.reading = reading_of(point);
  if (!has_projector) {
    if (observation.camera == 0) return;
    const BoardPoint* reference = same_point(view.points, point.index);
    if (reference == nullptr || !is_lit(*reference)) return;
    observation.is_label = true;
    observation.pixel -= reference->projector_px;
    observation.sigma_px =
        (observation.sigma_px.cwiseAbs2() + reference->projector_sigma_px.cwiseAbs2()).cwiseSqrt();
    observation.reference = reading_of(*reference);
  }
  observations.push_back(observation);
}

}  // namespace

std::vector<RigObservation> observations_of(const Board& board,
                                            std::span<const BoardView> views,
                                            bool has_projector) {
  const std::vector<Eigen::Vector2d> nominal = board_points_mm(board);
  const Eigen::Vector2d center = 0.5 * (nominal.front() + nominal.back());
  const Eigen::Vector2d half = nominal.back() - center;
  std::vector<RigObservation> observations;
  for (std::size_t view = 0; view < views.size(); ++view) {
    for (std::size_t camera = 0; camera <= views[view].more.size(); ++camera) {
      const std::vector<BoardPoint>& points = points_of(views[view], camera);
      for (std::size_t i = 0; i < points.size(); ++i) {
        const Eigen::Vector2d place = nominal[static_cast<std::size_t>(points[i].index)] - center;
        const Eigen::Vector2d relative = place.cwiseQuotient(half);
        RigObservation seen{
            view, i, {place, board_height_terms(relative.x(), relative.y())}, camera};
        seen.pixel = points[i].camera_px;
        seen.circle_radius_mm = 0.5 * circle_diameter_mm(board);
        observations.push_back(seen);
        add_phase(views[view], points[i], has_projector, seen, observations);
      }
    }
  }
  return observations;
}

}  // namespace frangia
