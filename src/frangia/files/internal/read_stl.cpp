#include <algorithm>
#include <cctype>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/files/internal/check_mesh.h"
#include "frangia/files/internal/plain_text.h"
#include "frangia/files/internal/read_bytes.h"
#include "frangia/files/internal/text_reader.h"
#include "frangia/files/internal/weld_vertices.h"
#include "frangia/files/stl.h"

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

Corners binary_corners(std::string_view bytes) {
  Corners corners;
  corners.reserve(3 * (bytes.size() / kFacetBytes));
  for (std::size_t facet = kHeaderBytes; facet < bytes.size(); facet += kFacetBytes) {
    for (std::size_t corner = 1; corner <= 3; ++corner) {
      Eigen::Vector3f& vertex = corners.emplace_back();
      std::memcpy(vertex.data(), bytes.data() + facet + 12 * corner, 12);
    }
  }
  return corners;
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
      reader.fail(fmt::format(
          "expected '{}', found {}", open ? "facet' or 'endsolid" : "solid", in_quotes(word)));
    }
  }
}

/// The facets of a binary file whose header does not state its size: programs that stream write a
/// count of 0 or -1, others add bytes of their own behind the last facet. Whole facets that are not
/// counted are a contradiction.
std::optional<std::string_view> binary_part(std::string_view bytes,
                                            const std::filesystem::path& path,
                                            const Run& run) {
  const std::size_t stated = stated_bytes(bytes);
  const bool is_whole = (bytes.size() - kHeaderBytes) % kFacetBytes == 0;
  const std::size_t streamed = kHeaderBytes + kFacetBytes * std::size_t{0xFFFFFFFF};
  if (is_whole && bytes.size() > kHeaderBytes && (stated == kHeaderBytes || stated == streamed)) {
    run.warn(fmt::format("{}: its header states no number of facets; all {} are read",
                         path.string(),
                         (bytes.size() - kHeaderBytes) / kFacetBytes));
    return bytes;
  }
  if (is_whole || stated == kHeaderBytes || stated > bytes.size()) return std::nullopt;
  const std::size_t behind = bytes.size() - stated;
  run.warn(fmt::format("{}: {} byte{} left out behind its last facet",
                       path.string(),
                       behind,
                       behind == 1 ? " is" : "s are"));
  return bytes.substr(0, stated);
}

Corners read_corners(const std::filesystem::path& path, std::string_view bytes, const Run& run) {
  // The size decides first, since some binary files also begin with "solid".
  const bool has_header = bytes.size() >= kHeaderBytes;
  if (has_header && stated_bytes(bytes) == bytes.size()) return binary_corners(bytes);
  const bool text = bytes.find('\0') == std::string_view::npos;
  if (text) {
    const std::string plain = plain_text(std::string(bytes));
    if (is(TextReader(path, plain).word(), "solid")) return ascii_corners(path, plain);
  }
  if (has_header)
    if (const auto part = binary_part(bytes, path, run)) return binary_corners(*part);
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
  Mesh mesh = weld_vertices(read_corners(path, bytes, run));
  check_mesh(mesh, path);
  return mesh;
}

}  // namespace frangia
