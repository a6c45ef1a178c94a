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
[[nodiscard]] std::unique_ptr<CadModel::Faces> load_faces(std::istream& shape, const Run& run);

}  // namespace frangia
