#include "frangia/files/stl.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/core/text.h"
#include "frangia/files/internal/check_mesh.h"
#include "frangia/files/internal/file_writer.h"
#include "frangia/files/internal/join_soup.h"
#include "frangia/files/internal/polygon_faces.h"
#include "frangia/files/internal/text_reader.h"

namespace frangia {
namespace {

constexpr std::size_t kHeaderBytes = 84;  // 80 of free text, then the count
constexpr std::size_t kFacetBytes = 50;   // normal, three corners, two unused bytes

using Corners = std::vector<Eigen::Vector3f>;

std::size_t stated_bytes(std::string_view bytes) {
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + kHeaderBytes - sizeof count, sizeof count);
  return kHeaderBytes + kFacetBytes * std::size_t{count};
}

/// Appends the corners of the facets of a binary file from its header on.
void add_binary_corners(std::string_view bytes, Corners& corners) {
  corners.reserve(corners.size() + 3 * (bytes.size() / kFacetBytes));
  for (std::size_t facet = kHeaderBytes; facet + kFacetBytes <= bytes.size();
       facet += kFacetBytes) {
    for (std::size_t corner = 1; corner <= 3; ++corner) {
      Eigen::Vector3f& vertex = corners.emplace_back();
      std::memcpy(vertex.data(), bytes.data() + facet + 12 * corner, 12);
    }
  }
}

/// Compares without case: some programs write keywords in upper case.
bool is(std::string_view word, std::string_view keyword) {
  return std::equal(word.begin(), word.end(), keyword.begin(), keyword.end(), [](char a, char b) {
    return std::tolower(static_cast<unsigned char>(a)) == b;
  });
}

void expect(TextReader& reader, std::string_view keyword) {
  const std::string_view word = reader.word();
  if (!is(word, keyword)) {
    reader.fail(fmt::format("expected '{}', found {}", keyword, in_quotes(word)));
  }
}

/// "endloop", or "end loop" of some programs.
void expect_end(TextReader& reader, const std::string& what) {
  const std::string_view word = reader.word();
  if (is(word, "end" + what)) return;
  if (!is(word, "end"))
    reader.fail(fmt::format("expected 'end{}', found {}", what, in_quotes(word)));
  expect(reader, what);
}

void read_facet(TextReader& reader, Corners& corners) {
  expect(reader, "normal");
  for (int i = 0; i < 3; ++i)
    static_cast<void>(reader.word());
  expect(reader, "outer");
  expect(reader, "loop");
  for (int i = 0; i < 3; ++i) {
    expect(reader, "vertex");
    const float x = reader.real();
    const float y = reader.real();
    const float z = reader.real();
    corners.emplace_back(x, y, z);
  }
  expect_end(reader, "loop");
  expect_end(reader, "facet");
}

Corners ascii_corners(const std::filesystem::path& path, std::string_view text) {
  TextReader reader(path, text);
  Corners corners;
  bool open = false;
  for (;;) {
    const std::string_view word = reader.word();
    if (word.empty() && !open) return corners;
    if (is(word, "facet") && open) {
      read_facet(reader, corners);
    } else if (is(word, open ? "endsolid" : "solid") || (open && is(word, "end"))) {
      open = !open;        // "end solid" ends the line with its name
      reader.skip_line();  // an optional name
    } else {
      reader.fail(open ? fmt::format("expected 'facet' or 'endsolid', found {}", in_quotes(word))
                       : fmt::format("expected '{}', found {}", "solid", in_quotes(word)));
    }
  }
}

/// Whether bytes behind the counted facets are facets, too: all of their corners lie where the
/// others do, within three times their box; a padding of zeros is one place.
bool are_facets(std::string_view behind, const Corners& counted) {
  if (behind.size() % kFacetBytes != 0) return false;
  Corners more;
  add_binary_corners(std::string(kHeaderBytes, '\0').append(behind), more);
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& corner : counted)
    box.extend(corner);
  const float reach = 3.0F * box.diagonal().norm();
  const auto is_far = [&](const Eigen::Vector3f& corner) {
    return !((corner - box.center()).norm() <= reach);
  };
  const bool all_same = std::all_of(more.begin(), more.end(), [&](const Eigen::Vector3f& corner) {
    return corner == more.front();
  });
  return !all_same && std::none_of(more.begin(), more.end(), is_far);
}

/// The corners of a binary file. Programs that stream write a count of 0 or -1, some files hold
/// several solids, each with its header, others bytes of their own behind the last facet. Facets
/// that are not counted are a contradiction. Nothing where the header fits in no way.
std::optional<Corners> binary_corners(std::string_view bytes,
                                      const std::filesystem::path& path,
                                      const Run& run) {
  Corners corners;
  const std::size_t stated = stated_bytes(bytes);
  const bool is_whole = (bytes.size() - kHeaderBytes) % kFacetBytes == 0;
  const std::size_t streamed = kHeaderBytes + kFacetBytes * std::size_t{0xFFFFFFFF};
  if (is_whole && bytes.size() > kHeaderBytes && (stated == kHeaderBytes || stated == streamed)) {
    run.warn(fmt::format("{}: its header states no number of facets; all {} are read",
                         path.string(),
                         (bytes.size() - kHeaderBytes) / kFacetBytes));
    add_binary_corners(bytes, corners);
    return corners;
  }
  const auto is_solid = [](std::string_view rest) {
    return rest.size() > kHeaderBytes && stated_bytes(rest) > kHeaderBytes &&
           stated_bytes(rest) <= rest.size();
  };
  std::size_t solids = 0;
  for (; is_solid(bytes); ++solids) {
    add_binary_corners(bytes.substr(0, stated_bytes(bytes)), corners);
    bytes.remove_prefix(stated_bytes(bytes));
  }
  if (solids == 0) return std::nullopt;
  if (solids > 1) run.note(fmt::format("{}: it holds {} solids", path.string(), solids));
  if (bytes.empty()) return corners;
  if (are_facets(bytes, corners)) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: its header states {} facets, but {} more follow; export it again",
                            path.string(),
                            corners.size() / 3,
                            bytes.size() / kFacetBytes));
  }
  run.warn(fmt::format("{}: {} byte{} left out behind its last facet",
                       path.string(),
                       bytes.size(),
                       bytes.size() == 1 ? " is" : "s are"));
  return corners;
}

Corners read_corners(const std::filesystem::path& path, const std::string& bytes, const Run& run) {
  // The size decides first, since some binary files also begin with "solid".
  const bool has_header = bytes.size() >= kHeaderBytes;
  Corners corners;
  if (has_header && stated_bytes(bytes) == bytes.size()) {
    add_binary_corners(bytes, corners);
    return corners;
  }
  const std::string plain = plain_text(bytes);
  const bool is_text = plain.find('\0') == std::string::npos;
  if (is_text && is(TextReader(path, plain).word(), "solid")) return ascii_corners(path, plain);
  if (has_header)
    if (auto found = binary_corners(bytes, path, run)) return std::move(*found);
  throw Error(
      ErrorKind::Input,
      fmt::format("{}: it has {} bytes, but its header states {}; it is truncated or not an "
                  "STL file",
                  path.string(),
                  bytes.size(),
                  has_header ? stated_bytes(bytes) : kHeaderBytes));
}

}  // namespace

Mesh read_stl(const std::filesystem::path& path, const Run& run) {
  const std::string bytes = read_bytes(path);
  const Corners corners = read_corners(path, bytes, run);
  Mesh mesh = weld_vertices(corners);
  OddFaces odd;
  odd.note_without_area(corners.size() / 3 - mesh.triangles.size());
  odd.warn(path, 1.0, run);
  check_mesh(mesh, path);
  return mesh;
}

namespace {

Eigen::Vector3f normal_of(const Mesh& mesh, const Mesh::Triangle& triangle) {
  const Eigen::Vector3f& a = mesh.vertices_mm[triangle[0]];
  const Eigen::Vector3f& b = mesh.vertices_mm[triangle[1]];
  const Eigen::Vector3f& c = mesh.vertices_mm[triangle[2]];
  return (b - a).cross(c - a).stableNormalized();
}

void write_binary(FileWriter& file, const Mesh& mesh) {
  std::string header = "Frangia; binary STL; lengths in mm";  // must not begin with "solid"
  header.resize(80, ' ');
  file.text(header);
  file.binary(static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const Mesh::Triangle& triangle : mesh.triangles) {
    for (const float coordinate : normal_of(mesh, triangle))
      file.binary(coordinate);
    for (const std::uint32_t corner : triangle) {
      for (const float coordinate : mesh.vertices_mm[corner])
        file.binary(coordinate);
    }
    file.binary(std::uint16_t{0});
  }
}

void write_ascii(FileWriter& file, const Mesh& mesh) {
  file.text("solid frangia\n");
  for (const Mesh::Triangle& triangle : mesh.triangles) {
    file.line(" facet normal", normal_of(mesh, triangle));
    file.text("  outer loop\n");
    for (const std::uint32_t corner : triangle)
      file.line("   vertex", mesh.vertices_mm[corner]);
    file.text("  endloop\n endfacet\n");
  }
  file.text("endsolid frangia\n");
}

}  // namespace

void write_stl(const std::filesystem::path& path, const Mesh& mesh, const StlOptions& options) {
  check_triangles(mesh, path);
  FileWriter file(path);
  if (options.ascii) {
    write_ascii(file, mesh);
  } else {
    write_binary(file, mesh);
  }
  file.commit();
}

}  // namespace frangia
