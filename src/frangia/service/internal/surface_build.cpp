#include "frangia/service/internal/surface_build.h"

#include <cmath>
#include <string>
#include <system_error>

#include <nlohmann/json.hpp>

#include "frangia/core/angles.h"
#include "frangia/core/durable_file.h"
#include "frangia/core/parallel.h"
#include "frangia/files/write_mesh.h"
#include "frangia/service/encode_arrays.h"
#include "frangia/service/internal/array_packer.h"
#include "frangia/service/internal/surface_versions.h"

namespace frangia {
namespace {

/// What the registration did to the turntable, for pages that word it themselves. `plain` where
/// these figures say everything that its own words do.
nlohmann::ordered_json json_of_turntable(const RegistrationReport& report) {
  return {{"plain", report.untrusted_reason().empty() && report.undetermined.empty()},
          {"kept", report.kept_rig},
          {"overlap", report.overlap},
          {"moved_mm", report.axis_moved_mm()},
          {"turned_deg", deg_from_rad(report.axis_turned_rad())},
          {"angles_deg", deg_from_rad(report.largest_turn_rad())},
          {"closure_deg", std::abs(deg_from_rad(report.closure_after_rad))}};  // NaN: null
}

/// Figures of a reconstruction, as surface.json keeps them.
std::string summary_of(const Reconstruction& result, const std::vector<std::string>& warnings) {
  nlohmann::ordered_json json{{"points", result.points}, {"views", result.views}};
  if (result.registration) {
    json["registration"] = result.registration->text();
    json["rms_before_mm"] = result.registration->rms_before_mm;
    json["rms_after_mm"] = result.registration->rms_after_mm;
    json["turntable"] = json_of_turntable(*result.registration);
  }
  json["untrusted_reason"] = result.untrusted_reason;
  json["warnings"] = nlohmann::ordered_json::array();
  for (const RigAgreement& agreement : result.agreements) {
    if (!agreement.is_consistent() && agreement.text() != result.untrusted_reason)
      json["warnings"].push_back(agreement.text());
  }
  for (const std::string& warning : warnings)
    json["warnings"].push_back(warning);
  json["views_of_scan"] = result.view_summaries.size();
  json["setups"] = nlohmann::ordered_json::array();
  for (const SetupJoin& join : result.setups) {
    const Eigen::AngleAxisd turn(join.part_pose.linear());
    json["setups"].push_back({{"number", join.number},
                              {"views", join.views},
                              {"joined", join.joined},
                              {"ambiguous", join.ambiguous},
                              {"turned_deg", deg_from_rad(turn.angle())},
                              {"moved_mm", join.part_pose.translation().norm()},
                              {"overlap", join.overlap},  // NaN is written as null
                              {"violation", join.free_space_violation}});
  }
  return json.dump();
}

}  // namespace

void write_surface_build(const std::filesystem::path& folder,
                         const Reconstruction& result,
                         const std::vector<std::string>& warnings,
                         const Run& run) {
  write_given_surface(folder, result.mesh, run);
  const VersionFiles files{folder, {}};
  write_text_file(files.summary(), summary_of(result, warnings), Durability::Synced);
  if (!result.setup_points.empty()) make_folder(folder / "clouds", Durability::Synced);
  for (std::size_t i = 0; i < result.setup_points.size(); ++i)
    write_text_file(files.setup_cloud(i),
                    encode_points(result.setup_points[i], kPointsOfSetup),
                    Durability::Synced);
  sync_to_disk(folder);
}

void write_given_surface(const std::filesystem::path& folder, const Mesh& mesh, const Run& run) {
  std::error_code ignored;
  std::filesystem::remove_all(folder, ignored);
  make_folder(folder, Durability::Synced);
  const VersionFiles files{folder, {}};
  write_mesh(files.surface(), mesh, {}, run);
  sync_to_disk(files.surface());
  sync_to_disk(folder);
}

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
