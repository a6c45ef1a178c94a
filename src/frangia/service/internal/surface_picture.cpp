#include "frangia/service/internal/surface_picture.h"

#include "frangia/core/parallel.h"
#include "frangia/service/encode_arrays.h"
#include "frangia/service/internal/array_packer.h"

namespace frangia {

SurfacePicture::SurfacePicture(const Mesh& mesh, int revision, const Run& run)
    : revision_(revision) {
  std::shared_ptr<const DisplayLevel> level;
  const std::size_t most = mesh.triangles.size() <= kSmall ? kSmall : kMovingTriangles;
  constexpr std::size_t kTasks = 2;
  parallel_chunks(kTasks, 1, [&](std::size_t task, std::size_t) {
    if (task == 0) {
      level = std::make_shared<const DisplayLevel>(display_level(mesh, most, run));
      return;
    }
    mesh_ = std::make_shared<const Mesh>(mesh);
    normals_ = std::make_shared<const std::vector<Eigen::Vector3f>>(
        mesh.normals.empty() ? vertex_normals(mesh) : mesh.normals);
  });
  levels_.push_back(std::move(level));
}

bool SurfacePicture::is_coarse() const {
  return levels_.size() == 1 && !levels_.front()->exact;
}

std::shared_ptr<const SurfacePicture> SurfacePicture::refined(const Run& run) const {
  auto finer = std::make_shared<SurfacePicture>(*this);
  finer->levels_.push_back(
      std::make_shared<const DisplayLevel>(display_level(*mesh_, kRestTriangles, run)));
  return finer;
}

std::string SurfacePicture::packed_level(std::size_t level) const {
  if (level >= levels_.size()) return {};
  return encode_level(*mesh_, *normals_, *levels_[level], revision_);
}

std::string SurfacePicture::packed_selection(std::size_t level,
                                             const Selection& selection,
                                             int revision) const {
  if (level >= levels_.size()) return {};
  return encode_selection(selection_of_level(*mesh_, selection, *levels_[level]), revision);
}

std::size_t SurfacePicture::bytes() const {
  std::size_t sum = mesh_->triangles.size() * sizeof(Mesh::Triangle) +
                    mesh_->vertices_mm.size() * 4 * sizeof(Eigen::Vector3f);
  for (const auto& level : levels_)
    sum += level->triangles.size() * sizeof(Mesh::Triangle);
  return sum;
}

}  // namespace frangia
