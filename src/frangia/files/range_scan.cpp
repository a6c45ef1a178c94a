#include "frangia/files/range_scan.h"

#include <cmath>
#include <cstdint>
#include <set>
#include <sstream>
#include <string>

#include <fmt/format.h>

#include "frangia/core/durable_file.h"
#include "frangia/core/error.h"
#include "frangia/core/memory_budget.h"
#include "frangia/core/read_file.h"
#include "frangia/files/internal/check_mesh.h"
#include "frangia/files/read_mesh.h"

namespace frangia {
namespace {

/// The files and poses of a .conf file, without the scans.
std::vector<RangeScan> read_conf(const std::filesystem::path& path) {
  std::istringstream lines(read_text_file(path));
  std::vector<RangeScan> scans;
  std::string line;
  for (std::size_t number = 1; std::getline(lines, line); ++number) {
    std::istringstream words(line);
    std::string what;
    std::string file;
    if (!(words >> what) || what != "bmesh") continue;
    Eigen::Vector3d translation;
    Eigen::Vector4d quaternion;
    words >> file;
    for (double& value : translation)
      words >> value;
    for (double& value : quaternion)
      words >> value;
    const double length = quaternion.norm();
    if (!words || !translation.allFinite() || !(length > 0.0) || !std::isfinite(length)) {
      throw Error(
          ErrorKind::Input,
          fmt::format(
              "{}, line {}: write \"bmesh FILE tx ty tz qx qy qz qw\"", path.string(), number));
    }
    RangeScan& scan = scans.emplace_back();
    scan.path = path.parent_path() / file;
    const Eigen::Quaterniond scan_from_world(
        quaternion[3], quaternion[0], quaternion[1], quaternion[2]);
    scan.world_from_scan.linear() = scan_from_world.normalized().conjugate().toRotationMatrix();
    scan.world_from_scan.translation() = translation;
  }
  return scans;
}

}  // namespace

RangeScan read_range_scan(const std::filesystem::path& path,
                          const Run& run,
                          const ReadOptions& options) {
  RangeScan scan;
  scan.path = path;
  scan.mesh = read_mesh(path, run, options);
  return scan;
}

std::vector<RangeScan> read_posed_scans(const std::filesystem::path& path,
                                        const ReadOptions& options,
                                        const Run& run) {
  const std::vector<RangeScan> listed = read_conf(path);
  if (listed.empty()) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: it lists no scan; add a line \"bmesh FILE tx ty tz qx qy qz qw\"",
                            path.string()));
  }
  std::uint64_t file_bytes = std::filesystem::file_size(path);
  std::set<std::filesystem::path> files;
  std::vector<RangeScan> scans;
  double used_bytes = 0.0;
  // Registration holds the pairs of scans that overlap: `frangia merge` of 100 scans of 144 points
  // each takes 0.3 GB, of 200 scans 2.4 GB.
  constexpr double kBytesPerCubedScan = 300.0;
  const auto merging_bytes = [](std::size_t count) {
    return kBytesPerCubedScan * std::pow(static_cast<double>(count), 3.0);
  };
  for (const RangeScan& posed : listed) {
    RangeScan& scan = scans.emplace_back(read_range_scan(posed.path, run, options));
    scan.world_from_scan = posed.world_from_scan;
    scan.posed = true;
    if (files.insert(scan.path).second) file_bytes += std::filesystem::file_size(scan.path);
    used_bytes += mesh_memory_bytes(static_cast<double>(scan.mesh.vertices_mm.size()),
                                    static_cast<double>(scan.mesh.triangles.size()));
    const double share = static_cast<double>(scans.size()) / static_cast<double>(listed.size());
    MemoryBudget(path, file_bytes, options.allow_memory_bytes)
        .check(used_bytes + merging_bytes(listed.size()),
               used_bytes / share + merging_bytes(listed.size()));
  }
  return scans;
}

void scale_range_scan(RangeScan& scan, double factor) {
  for (auto& point : scan.mesh.vertices_mm)
    point *= static_cast<float>(factor);
  for (float& sigma_mm : scan.mesh.sigma_mm)
    sigma_mm *= static_cast<float>(factor);
  scan.world_from_scan.translation() *= factor;
}

void write_posed_scans(const std::filesystem::path& path,
                       const std::vector<RangeScan>& scans,
                       double units_per_mm) {
  AtomicFile file(path);
  const auto folder = std::filesystem::absolute(path).parent_path().lexically_normal();
  for (const RangeScan& scan : scans) {
    const auto absolute = std::filesystem::absolute(scan.path).lexically_normal();
    const std::string name = absolute.lexically_relative(folder).generic_string();
    if (name.find_first_of(" \t\n") != std::string::npos) {
      throw Error(ErrorKind::Input,
                  fmt::format("{}: a .conf cannot list a file with a blank in its path; rename it",
                              scan.path.string()));
    }
    // The format holds the conjugate of the rotation.
    const Eigen::Quaterniond q(scan.world_from_scan.linear().transpose().eval());
    const Eigen::Vector3d t = units_per_mm * scan.world_from_scan.translation();
    file.stream() << fmt::format("bmesh {} {:.9g} {:.9g} {:.9g} {:.12g} {:.12g} {:.12g} {:.12g}\n",
                                 name,
                                 t.x(),
                                 t.y(),
                                 t.z(),
                                 q.x(),
                                 q.y(),
                                 q.z(),
                                 q.w());
  }
  file.commit();
}

}  // namespace frangia
