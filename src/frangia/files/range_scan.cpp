#include "frangia/files/range_scan.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <span>
#include <sstream>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "frangia/core/atomic_file.h"
#include "frangia/core/error.h"
#include "frangia/core/median.h"
#include "frangia/core/memory_budget.h"
#include "frangia/core/read_text_file.h"
#include "frangia/files/internal/mesh_memory.h"
#include "frangia/files/internal/ply_source.h"
#include "frangia/files/internal/read_bytes.h"
#include "frangia/files/internal/text_reader.h"
#include "frangia/files/ply.h"

namespace frangia {
namespace {

constexpr std::int64_t kNoPoint = -1;

/// The grid of a range scan: a point index for each cell.
struct Grid {
  std::size_t columns = 0;
  std::size_t rows = 0;
  std::vector<std::int64_t> points;  ///< row-major; kNoPoint in an empty cell
};

/// The number after "obj_info KEY" in the header; 0 when the header has no such number.
std::size_t read_obj_info(std::string_view header, const std::string& key) {
  const auto found = header.find("obj_info " + key + " ");
  if (found == std::string_view::npos) return 0;
  TextReader rest({}, header.substr(found + key.size() + 10, 20));
  const auto number = parse_integer(rest.word_on_line());
  return number && *number > 0 ? static_cast<std::size_t>(*number) : 0;
}

/// Reads a property and returns the last value of a list; -1 for an empty list.
template <typename Source>
double last_of(Source& source, const PlyProperty& property) {
  double last = -1.0;
  const std::uint64_t count = property.count_type ? read_list_length(source, property) : 1;
  for (std::uint64_t i = 0; i < count; ++i)
    last = source.value(property.type);
  return last;
}

/// The point that a cell names; kNoPoint for a negative index.
template <typename Source>
std::int64_t point_of_cell(const Source& source, double last) {
  constexpr double kMax = 4'294'967'295.0;
  if (!(last <= kMax) || last != std::floor(last))
    source.fail(fmt::format("its range_grid refers to point {}, which is not a valid index", last));
  return last < 0.0 ? kNoPoint : static_cast<std::int64_t>(last);
}

template <typename Source>
std::vector<std::int64_t> read_grid(Source source, const PlyHeader& header) {
  std::vector<std::int64_t> points;
  for (const PlyElement& element : header.elements) {
    const bool grid = element.name == "range_grid";
    if (element.properties.empty()) continue;  // it occupies no bytes, whatever its count
    for (std::uint64_t i = 0; i < element.count; ++i) {
      double last = -1.0;
      for (const PlyProperty& property : element.properties)
        last = last_of(source, property);
      if (grid) points.push_back(point_of_cell(source, last));
    }
    if (grid) break;
  }
  return points;
}

Grid read_range_grid(const std::filesystem::path& path) {
  const std::string bytes = read_bytes(path);
  const PlyHeader header = parse_ply_header(path, bytes);
  const bool has_grid =
      std::any_of(header.elements.begin(), header.elements.end(), [](const PlyElement& element) {
        return element.name == "range_grid";
      });
  if (!has_grid) return {};
  const std::string_view all(bytes);
  Grid grid;
  grid.columns = read_obj_info(all.substr(0, header.body), "num_cols");
  grid.rows = read_obj_info(all.substr(0, header.body), "num_rows");
  grid.points =
      header.format == PlyFormat::Ascii
          ? read_grid(AsciiPlySource(path, bytes, header.body), header)
          : read_grid(BinaryPlySource(path, all.substr(header.body), header.format), header);
  if (grid.columns == 0 || grid.points.size() % grid.columns != 0 ||
      grid.points.size() / grid.columns != grid.rows) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: its range_grid has {} cells, but obj_info states {} columns and "
                            "{} rows; export it again",
                            path.string(),
                            grid.points.size(),
                            grid.columns,
                            grid.rows));
  }
  return grid;
}

double median_spacing(const Mesh& mesh, const Grid& grid) {
  std::vector<double> lengths;
  for (std::size_t i = 0; i + 1 < grid.points.size(); ++i) {
    if ((i + 1) % grid.columns == 0 || grid.points[i] < 0 || grid.points[i + 1] < 0) continue;
    const auto& a = mesh.vertices_mm[static_cast<std::size_t>(grid.points[i])];
    const auto& b = mesh.vertices_mm[static_cast<std::size_t>(grid.points[i + 1])];
    lengths.push_back(static_cast<double>((a - b).norm()));
  }
  return median_in_place(std::span(lengths));
}

void triangulate_grid(Mesh& mesh, const Grid& grid, const std::filesystem::path& path) {
  constexpr double kMaxEdge = 6.0;  // median spacings; a longer edge bridges a depth step
  for (const std::int64_t point : grid.points) {
    if (point >= static_cast<std::int64_t>(mesh.vertices_mm.size())) {
      throw Error(
          ErrorKind::Input,
          fmt::format(
              "{}: its range_grid refers to point {}, which does not exist; export it again",
              path.string(),
              point));
    }
  }
  const auto longest = static_cast<float>(kMaxEdge * median_spacing(mesh, grid));
  double up = 0.0;
  const auto add = [&](std::int64_t a, std::int64_t b, std::int64_t c) {
    if (a < 0 || b < 0 || c < 0) return;
    const auto corner = [&](std::int64_t i) {
      return mesh.vertices_mm[static_cast<std::size_t>(i)];
    };
    const Eigen::Vector3f ab = corner(b) - corner(a);
    const Eigen::Vector3f ac = corner(c) - corner(a);
    if (std::max({ab.norm(), ac.norm(), (ab - ac).norm()}) > longest) return;
    up += static_cast<double>(ab.cross(ac).z());
    mesh.triangles.push_back({static_cast<std::uint32_t>(a),
                              static_cast<std::uint32_t>(b),
                              static_cast<std::uint32_t>(c)});
  };
  for (std::size_t row = 0; row + 1 < grid.rows; ++row) {
    for (std::size_t column = 0; column + 1 < grid.columns; ++column) {
      const std::size_t at = row * grid.columns + column;
      const auto a = grid.points[at];
      const auto b = grid.points[at + 1];
      const auto c = grid.points[at + grid.columns + 1];
      const auto d = grid.points[at + grid.columns];
      const bool diagonal_bd = a < 0 || c < 0;  // use the diagonal whose corners both exist
      add(a, b, diagonal_bd ? d : c);
      add(diagonal_bd ? b : a, c, d);
    }
  }
  if (up < 0.0) {
    for (auto& triangle : mesh.triangles)
      std::swap(triangle[1], triangle[2]);
  }
}

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

RangeScan read_range_scan(const std::filesystem::path& path) {
  RangeScan scan;
  scan.path = path;
  scan.mesh = read_ply(path);
  const Grid grid = read_range_grid(path);
  if (!grid.points.empty()) triangulate_grid(scan.mesh, grid, path);
  return scan;
}

std::vector<RangeScan> read_posed_scans(const std::filesystem::path& path,
                                        const ReadOptions& options) {
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
    RangeScan& scan = scans.emplace_back(read_range_scan(posed.path));
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
