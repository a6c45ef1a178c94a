#include "frangia/cad/cad_model.h"

#include <utility>

#include "frangia/cad/internal/faces.h"

namespace frangia {

CadModel::CadModel(std::unique_ptr<Faces> faces, std::string unit, CadPmi pmi)
    : faces_(std::move(faces)), unit_(std::move(unit)), pmi_(std::move(pmi)) {}

CadModel::~CadModel() = default;

const Mesh& CadModel::mesh() const {
  return faces_->mesh;
}

const std::vector<CadFace>& CadModel::faces() const {
  return faces_->list;
}

std::uint32_t CadModel::face_of(std::uint32_t triangle) const {
  return faces_->face_of_triangle.at(triangle);
}

ExactPoint CadModel::nearest(const Eigen::Vector3d& point_mm, const NearestPoint& start) const {
  return faces_->nearest(point_mm, start);
}

}  // namespace frangia
