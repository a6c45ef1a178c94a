#include "frangia/files/internal/gltf_document.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <optional>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "frangia/core/base64.h"
#include "frangia/core/check_nesting.h"
#include "frangia/core/error.h"
#include "frangia/files/internal/read_bytes.h"
#include "frangia/files/internal/text_reader.h"
#include "frangia/files/internal/without_percent.h"

namespace frangia {
namespace {

using nlohmann::json;

std::uint32_t u32_at(std::string_view bytes, std::size_t place) {
  std::uint32_t number = 0;
  std::memcpy(&number, bytes.data() + place, sizeof number);
  return number;
}

/// The two chunks of a .glb: its JSON and its buffer.
std::pair<std::string_view, std::string_view> chunks_of(const GltfDocument& document,
                                                        std::string_view bytes) {
  constexpr std::size_t kHeader = 12;
  if (bytes.size() < kHeader + 8 || u32_at(bytes, 4) != 2) {
    document.fail("it is not glTF 2.0, or it is truncated; export it again");
  }
  std::string_view text;
  std::string_view binary;
  for (std::size_t place = kHeader; bytes.size() - place >= 8;) {
    const std::size_t length = u32_at(bytes, place);
    const std::string_view kind = bytes.substr(place + 4, 4);
    if (length > bytes.size() - place - 8) {
      document.fail(fmt::format(
          "a chunk of {} bytes exceeds the {} bytes that are left; the file is truncated",
          length,
          bytes.size() - place - 8));
    }
    const std::string_view chunk = bytes.substr(place + 8, length);
    if (kind == "JSON" && text.empty()) text = chunk;
    if (kind == std::string_view("BIN\0", 4) && binary.empty()) binary = chunk;
    place += 8 + length;
  }
  return {text, binary};
}

std::string outside_buffer(const GltfDocument& document, const std::string& uri) {
  const std::filesystem::path name = std::filesystem::path(without_percent(uri)).lexically_normal();
  const bool in_folder = !uri.empty() && name.is_relative() && name.has_filename() &&
                         *name.begin() != ".." && uri.find(':') == std::string::npos &&
                         name.native().find('\0') == std::string::npos;
  if (!in_folder) {
    document.fail(
        fmt::format("its buffer {} is not a file in the same folder or below; export it as .glb",
                    in_quotes(uri)));
  }
  return read_bytes(document.path.parent_path() / name);
}

/// The bytes of a uri; a uri that occurs again refers to the same bytes.
std::string_view bytes_of_uri(GltfDocument& document, const std::string& uri) {
  const auto known = document.files.find(uri);
  if (known != document.files.end()) return known->second;
  std::string bytes;
  const std::size_t comma = uri.find(";base64,");
  if (uri.starts_with("data:") && comma != std::string::npos) {
    auto decoded = decode_base64(std::string_view(uri).substr(comma + 8));
    if (!decoded) document.fail("an embedded buffer is not base64; export it again");
    bytes = std::move(*decoded);
  } else {
    bytes = outside_buffer(document, uri);
    document.total_bytes += bytes.size();
  }
  return document.files.emplace(uri, std::move(bytes)).first->second;
}

std::string_view buffer_of(GltfDocument& document, const json& buffer, std::string_view binary) {
  const json extensions = buffer.value("extensions", json::object());
  for (const auto& [name, extension] : extensions.items()) {
    if (!buffer.contains("uri") && name.find("compression") != std::string::npos)
      document.fail(
          fmt::format("it is compressed ({}); export it without compression", name.substr(0, 80)));
  }
  const std::uint64_t length = document.whole(buffer.at("byteLength"));
  const std::string_view bytes =
      buffer.contains("uri")
          ? bytes_of_uri(document, buffer.at("uri").get_ref<const std::string&>())
          : binary;
  if (length > bytes.size()) {
    document.fail(fmt::format(
        "a buffer of {} bytes holds only {}; the file is truncated", length, bytes.size()));
  }
  return bytes.substr(0, length);
}

/// Refuses a document that requires an extension without which its triangles are not right. Those
/// of materials, textures and lights do not change them.
void check_extensions(const GltfDocument& document) {
  const auto required = document.json.find("extensionsRequired");
  if (required == document.json.end() || !required->is_array()) return;
  constexpr std::array<std::string_view, 10> kHarmless{"KHR_materials_",
                                                       "EXT_materials_",
                                                       "KHR_texture_",
                                                       "EXT_texture_",
                                                       "MSFT_texture_",
                                                       "KHR_lights_",
                                                       "KHR_xmp",
                                                       "KHR_mesh_quantization",
                                                       "KHR_node_visibility",
                                                       "EXT_mesh_gpu_instancing"};
  for (const auto& entry : *required) {
    std::string name = entry.is_string() ? entry.get<std::string>() : entry.dump();
    const bool known = std::any_of(kHarmless.begin(), kHarmless.end(), [&](std::string_view begin) {
      return std::string_view(name).starts_with(begin);
    });
    if (known) continue;
    constexpr std::size_t kMostLetters = 80;
    name.resize(std::min(name.size(), kMostLetters));
    std::replace_if(
        name.begin(), name.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
    const bool is_compressed = name.find("compression") != std::string::npos;
    document.fail(fmt::format("it requires the extension {}, which is not read; export it {}",
                              name,
                              is_compressed ? "without compression" : "without it"));
  }
}

}  // namespace

void GltfDocument::fail(const std::string& why) const {
  throw Error(ErrorKind::Input, fmt::format("{}: {}", path.string(), why));
}

const json& GltfDocument::item(const char* list, std::uint64_t index) const {
  const auto found = json.find(list);
  if (found == json.end() || !found->is_array() || index >= found->size()) {
    fail(fmt::format(
        "it refers to element {} of its {}, which does not exist; export it again", index, list));
  }
  return (*found)[index];
}

bool GltfDocument::is_compressed(const nlohmann::json& primitive) const {
  if (!primitive.contains("extensions") ||
      !primitive.at("extensions").contains("KHR_draco_mesh_compression"))
    return false;
  const std::uint64_t positions = whole(primitive.at("attributes").at("POSITION"));
  return !item("accessors", positions).contains("bufferView");
}

bool GltfDocument::hides(const nlohmann::json& node) {
  const nlohmann::json extensions = node.value("extensions", nlohmann::json::object());
  const auto found = extensions.find("KHR_node_visibility");
  return found != extensions.end() && !found->value("visible", true);
}

std::uint64_t GltfDocument::whole(const nlohmann::json& number) const {
  constexpr double kMax = 9'007'199'254'740'992.0;  // 2^53, up to which a double is exact
  if (number.is_number_unsigned()) return number.get<std::uint64_t>();
  if (number.is_number()) {
    const auto value = number.get<double>();
    if (value >= 0.0 && value <= kMax && value == std::floor(value))
      return static_cast<std::uint64_t>(value);
  }
  fail(fmt::format("{} is not a valid count or index; export it again",
                   in_quotes(number.is_primitive() ? number.dump() : number.type_name())));
}

std::uint64_t GltfDocument::whole_or(const nlohmann::json& object,
                                     const char* key,
                                     std::uint64_t fallback) const {
  const auto found = object.find(key);
  return found == object.end() ? fallback : whole(*found);
}

std::vector<std::uint64_t> GltfDocument::whole_list(const nlohmann::json& object,
                                                    const char* key) const {
  std::vector<std::uint64_t> numbers;
  const auto found = object.find(key);
  if (found == object.end()) return numbers;
  if (!found->is_array()) fail(fmt::format("its {} are not a list; export it again", key));
  numbers.reserve(found->size());
  for (const auto& number : *found)
    numbers.push_back(whole(number));
  return numbers;
}

void read_gltf_document(const std::filesystem::path& path, GltfDocument& document) {
  document.path = path;
  document.bytes = read_bytes(path);
  document.total_bytes = document.bytes.size();
  std::string_view text = document.bytes;
  std::string_view binary;
  if (text.starts_with("glTF")) std::tie(text, binary) = chunks_of(document, document.bytes);
  check_json_nesting(text, path);
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  document.json = nlohmann::json::parse(text, nullptr, false);
  if (!document.json.is_object()) document.fail("its JSON is invalid; export it again");
  check_extensions(document);
  if (const auto found = document.json.find("buffers"); found != document.json.end()) {
    for (const auto& buffer : *found)
      document.buffers.push_back(buffer_of(document, buffer, binary));
  }
}

}  // namespace frangia
