#pragma once

#include <iosfwd>
#include <memory>
#include <vector>

#include "frangia/cad/cad_model.h"
#include "frangia/core/run.h"

namespace frangia {

/// The faces of a model, whatever library keeps them.
struct CadModel::Faces {
  Faces() = default;
  Faces(const Faces&) = delete;
  Faces& operator=(const Faces&) = delete;
  Faces(Faces&&) = delete;
  Faces& operator=(Faces&&) = delete;
  virtual ~Faces() = default;

  /// As `ExactSurface::nearest`.
  [[nodiscard]] virtual ExactPoint nearest(const Eigen::Vector3d& point_mm,
                                           const NearestPoint& start) const = 0;

  Mesh mesh;
  std::vector<std::uint32_t> face_of_triangle;
  std::vector<CadFace> list;
};

/// Loads what `translate_cad` wrote.
///
/// @errors   Error(Input) without the name of the file, when it is damaged; Error(Cancelled)
[[nodiscard]] std::unique_ptr<CadModel::Faces> load_faces(std::istream& shape, const Run& run);

/// Does in the second process what `load_faces` and queries will do in the first one with the same
/// bytes, on one thread: what crashes, does not end or needs too much memory does so there.
///
/// @errors   Error(Input) without the name of the file
void rehearse_faces(std::istream& shape);

}  // namespace frangia
