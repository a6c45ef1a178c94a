#include "frangia/files/internal/range_grid.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/core/statistics.h"
#include "frangia/files/internal/ply_header.h"
#include "frangia/files/internal/text_reader.h"

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

Grid read_range_grid(const PlyHeader& header,
                     std::string_view bytes,
                     const std::filesystem::path& path) {
  Grid grid;
  grid.columns = read_obj_info(bytes.substr(0, header.body), "num_cols");
  grid.rows = read_obj_info(bytes.substr(0, header.body), "num_rows");
  grid.points =
      header.format == PlyFormat::Ascii
          ? read_grid(AsciiPlySource(path, bytes, header.body), header)
          : read_grid(BinaryPlySource(path, bytes.substr(header.body), header.format), header);
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

}  // namespace

bool has_range_grid(const PlyHeader& header) {
  return std::any_of(header.elements.begin(), header.elements.end(), [](const PlyElement& element) {
    return element.name == "range_grid";
  });
}

void add_grid_triangles(Mesh& mesh,
                        const PlyHeader& header,
                        std::string_view bytes,
                        const std::filesystem::path& path) {
  const Grid grid = read_range_grid(header, bytes, path);
  if (!grid.points.empty()) triangulate_grid(mesh, grid, path);
}

}  // namespace frangia
