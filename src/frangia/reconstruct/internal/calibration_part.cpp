#include "frangia/reconstruct/internal/calibration_part.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "frangia/core/missing.h"
#include "frangia/range/calibration_uncertainty.h"

namespace frangia {
namespace {

/// Points of a view on a coarse grid of pixels, NaN where there are none, with their normals.
struct CoarseView {
  Image<Eigen::Vector3d> points_mm;  ///< rig frame
  Image<Eigen::Vector3d> normals;    ///< towards the camera
};

Eigen::Vector3d point_at(const Image<float>& depth_mm,
                         const Image<Eigen::Vector2f>& rays,
                         int x,
                         int y) {
  return static_cast<double>(depth_mm(x, y)) * rays(x, y).cast<double>().homogeneous();
}

CoarseView coarse_view(const Image<float>& depth_mm, const Image<Eigen::Vector2f>& rays, int step) {
  constexpr int kReach = 2;  // pixels to the neighbours that span the normal
  const Eigen::Vector3d none = Eigen::Vector3d::Constant(kMissing);
  CoarseView coarse{{depth_mm.width() / step, depth_mm.height() / step, none},
                    {depth_mm.width() / step, depth_mm.height() / step, none}};
  for (int row = 0; row < coarse.points_mm.height(); ++row) {
    for (int column = 0; column < coarse.points_mm.width(); ++column) {
      const int x = step / 2 + column * step;
      const int y = step / 2 + row * step;
      coarse.points_mm(column, row) = point_at(depth_mm, rays, x, y);
      if (x < kReach || y < kReach || x + kReach >= depth_mm.width() ||
          y + kReach >= depth_mm.height())
        continue;
      const Eigen::Vector3d across =
          point_at(depth_mm, rays, x + kReach, y) - point_at(depth_mm, rays, x - kReach, y);
      const Eigen::Vector3d down =
          point_at(depth_mm, rays, x, y + kReach) - point_at(depth_mm, rays, x, y - kReach);
      coarse.normals(column, row) = -across.cross(down).normalized();
    }
  }
  return coarse;
}

/// A place of one view, to be found in another one.
struct Place {
  std::size_t view;
  Eigen::Vector3d point_mm;
  Eigen::Vector3d normal;
};

/// Whether a view measured the surface at a point, within the distance of its coarse pixels.
bool measures(const CoarseView& view, const CameraModel& camera, int step, const Place& place) {
  constexpr double kLeastCosine = 0.2;    // of the viewing ray and the normal
  constexpr double kSameDirection = 0.7;  // cosine between two normals of one place
  if (!(-place.normal.dot(place.point_mm.normalized()) > kLeastCosine)) return false;
  const Eigen::Vector2d pixel = camera.project(place.point_mm);
  const auto column = static_cast<int>(std::floor(pixel.x() / step));
  const auto row = static_cast<int>(std::floor(pixel.y() / step));
  if (!(column >= 0 && row >= 0 && column < view.points_mm.width() &&
        row < view.points_mm.height()))
    return false;
  const Eigen::Vector3d& there = view.points_mm(column, row);
  const double reach = step * there.z() / camera.focal_px.x();
  return view.normals(column, row).dot(place.normal) > kSameDirection &&
         std::abs(place.normal.dot(there - place.point_mm)) < reach;
}

/// Every n-th of some values, so that at most `most` remain.
template <typename Value>
std::vector<Value> thinned(const std::vector<Value>& all, std::size_t most) {
  std::vector<Value> some;
  for (std::size_t i = 0; i < all.size(); i += all.size() / most + 1)
    some.push_back(all[i]);
  return some;
}

std::vector<SharedPlace> shared_places(const std::vector<CoarseView>& coarse,
                                       const std::vector<Place>& places,
                                       const ViewStore& views,
                                       const CameraModel& camera,
                                       int step) {
  std::vector<SharedPlace> shared;
  for (const Place& first : places) {
    const Eigen::Isometry3d object_from_rig = views.rig_from_object(first.view).inverse();
    for (std::size_t other = first.view + 1; other < views.size(); ++other) {
      const Eigen::Isometry3d motion = views.rig_from_object(other) * object_from_rig;
      const Place second{other, motion * first.point_mm, motion.linear() * first.normal};
      if (measures(coarse[other], camera, step, second))
        shared.push_back({first.point_mm, first.normal, second.point_mm, second.normal});
    }
  }
  return shared;
}

MeasuredVolume measured_volume(const ViewStore& views,
                               const CameraModel& camera,
                               const Image<Eigen::Vector2f>& rays) {
  constexpr int kAcross = 48;           // sampled pixels along the longer side of the image
  constexpr std::size_t kMost = 600;    // enough for a rigid motion, few enough to be quick
  constexpr std::size_t kTried = 3000;  // places that are looked for in the other views
  const int step = std::max(1, std::max(rays.width(), rays.height()) / kAcross);
  std::vector<CoarseView> coarse;
  std::vector<Place> places;
  for (std::size_t i = 0; i < views.size(); ++i) {
    coarse.push_back(coarse_view(views.load_depth_mm(i), rays, step));
    for (std::size_t pixel = 0; pixel < coarse[i].points_mm.pixels().size(); ++pixel) {
      const Eigen::Vector3d& point = coarse[i].points_mm.pixels()[pixel];
      if (point.allFinite()) places.push_back({i, point, coarse[i].normals.pixels()[pixel]});
    }
  }
  MeasuredVolume volume;
  for (const Place& place : thinned(places, kMost))
    volume.points_mm.push_back(place.point_mm);
  std::erase_if(places, [](const Place& place) { return !place.normal.allFinite(); });
  volume.shared =
      thinned(shared_places(coarse, thinned(places, kTried), views, camera, step), kMost);
  return volume;
}

}  // namespace

Rig with_open_parameters(Rig rig, const RigCovariance& open) {
  if (open.empty()) return rig;
  if (!rig.calibration) rig.calibration.emplace();
  RigCovariance& all = rig.calibration->covariance;
  std::vector<Eigen::Index> rows;
  for (const std::string& name : open.parameters) {
    const auto at = std::find(all.parameters.begin(), all.parameters.end(), name);
    rows.push_back(at - all.parameters.begin());
    if (at == all.parameters.end()) all.parameters.push_back(name);
  }
  const auto count = static_cast<Eigen::Index>(all.parameters.size());
  all.covariance.conservativeResizeLike(Eigen::MatrixXd::Zero(count, count));
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t j = 0; j < rows.size(); ++j)
      all.covariance(rows[i], rows[j]) +=
          open.covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
  return rig;
}

std::vector<SigmaTerm> calibration_part(const ViewStore& views,
                                        const Rig& rig,
                                        const Pattern& pattern,
                                        const Image<Eigen::Vector2f>& rays) {
  if (!rig.calibration || rig.calibration->covariance.empty()) return {};
  const MeasuredVolume volume = measured_volume(views, rig.reference().model, rays);
  struct OfCamera {
    CalibrationUncertainty uncertainty;
    std::shared_ptr<const Image<Eigen::Vector2f>> rays;
  };
  const auto cameras = std::make_shared<std::vector<OfCamera>>();
  for (std::size_t camera = rig.cameras.size(); camera-- > 0;) {
    // The store keeps the rays of one camera. Fusion begins with those of the reference camera.
    cameras->insert(cameras->begin(),
                    {{rig, pattern, volume, camera}, views.rays(rig.cameras[camera].camera.model)});
  }
  return {{UncertaintyTerm::Calibration, [cameras](const View& view, std::size_t camera) {
             const OfCamera& own = cameras->at(camera);
             return own.uncertainty.along_rays_mm(view.range.depth_mm, *own.rays);
           }}};
}

}  // namespace frangia
