#pragma once

#include <boost/property_map/property_map.hpp>

#include "frangia/core/run.h"

namespace frangia {

/// A vertex point map of a CGAL surface that throws Error(Cancelled) once `run` is stopped.
///
/// CGAL's algorithms have no option to stop them, but read points in each of their loops, and they
/// release their memory when an exception passes through them. Only for sources behind
/// FRANGIA_WITH_CGAL.
template <typename Surface>
class InterruptiblePoints {
 public:
  using key_type = typename Surface::Vertex_index;
  using value_type = typename Surface::Point;
  using reference = const value_type&;
  using category = boost::read_write_property_map_tag;

  /// Both must outlive the map.
  InterruptiblePoints(Surface& surface, const Run& run) : surface_(&surface), run_(&run) {}

  friend const value_type& get(const InterruptiblePoints& map, key_type vertex) {
    map.run_->check();
    return map.surface_->point(vertex);
  }
  friend void put(const InterruptiblePoints& map, key_type vertex, const value_type& point) {
    map.surface_->point(vertex) = point;
  }

 private:
  Surface* surface_;
  const Run* run_;
};

}  // namespace frangia
