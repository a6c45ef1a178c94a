#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "frangia/cad/cad_pmi.h"
#include "frangia/features/shape.h"
#include "frangia/geometry/exact_surface.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// A face of a CAD model. Its number is its place in the model plus 1.
struct CadFace {
  std::optional<Shape> shape;  ///< nominal, its center amid the face; none for a free-form surface
  double area_mm2 = 0.0;       ///< of its tessellation
};

/// A CAD model with its exact faces and a mesh that approximates them.
///
/// @units    mm, whatever the unit of the file
class CadModel final : public ExactSurface {
 public:
  /// The faces as the library that reads them keeps them.
  struct Faces;
  /// Takes over the faces. `unit` is that of the file.
  CadModel(std::unique_ptr<Faces> faces, std::string unit, CadPmi pmi = {});
  CadModel(const CadModel&) = delete;
  CadModel& operator=(const CadModel&) = delete;
  CadModel(CadModel&&) = delete;
  CadModel& operator=(CadModel&&) = delete;
  ~CadModel() override;

  /// Tessellation of all faces, closed where the model is.
  [[nodiscard]] const Mesh& mesh() const;
  /// All faces, in the order of the file.
  [[nodiscard]] const std::vector<CadFace>& faces() const;
  /// The face that a triangle of the mesh belongs to: index into `faces`.
  [[nodiscard]] std::uint32_t face_of(std::uint32_t triangle) const;
  /// Unit of length of the file in words: "millimetre", "inch".
  [[nodiscard]] const std::string& unit() const { return unit_; }

  /// What the file asks for beside its shape, where that was read.
  [[nodiscard]] const CadPmi& pmi() const { return pmi_; }

  /// Newton's method finds the foot point on each face that may be nearest, and on its edges where
  /// the foot is beyond them.
  ///
  /// @source   Piegl & Tiller 1997, The NURBS Book, 6.1
  [[nodiscard]] ExactPoint nearest(const Eigen::Vector3d& point_mm,
                                   const NearestPoint& start) const override;

 private:
  std::unique_ptr<Faces> faces_;
  std::string unit_;
  CadPmi pmi_;
};

}  // namespace frangia
