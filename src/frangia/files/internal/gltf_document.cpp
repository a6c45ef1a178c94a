#include "frangia/files/internal/gltf_document.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/base64.h"
#include "frangia/core/check_nesting.h"
#include "frangia/core/error.h"
#include "frangia/files/internal/text_reader.h"

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

namespace {

std::size_t bytes_of_component(std::uint64_t type) {
  switch (type) {
    case 5120:
    case 5121:
      return 1;
    case 5122:
    case 5123:
      return 2;
    case 5125:
    case 5126:
      return 4;
    default:
      return 0;
  }
}

template <typename Number>
double number_at(std::string_view bytes, std::size_t place) {
  Number number{};
  std::memcpy(&number, bytes.data() + place, sizeof number);
  return static_cast<double>(number);
}

double component_at(std::string_view bytes, std::size_t place, std::uint64_t type) {
  switch (type) {
    case 5120:
      return number_at<std::int8_t>(bytes, place);
    case 5121:
      return number_at<std::uint8_t>(bytes, place);
    case 5122:
      return number_at<std::int16_t>(bytes, place);
    case 5123:
      return number_at<std::uint16_t>(bytes, place);
    case 5125:
      return number_at<std::uint32_t>(bytes, place);
    default:
      return number_at<float>(bytes, place);
  }
}

/// The integer that stands for 1 in normalized components.
double full_scale(std::uint64_t type) {
  switch (type) {
    case 5120:
      return 127.0;
    case 5121:
      return 255.0;
    case 5122:
      return 32'767.0;
    case 5123:
      return 65'535.0;
    default:
      return 1.0;
  }
}

}  // namespace

std::size_t GltfDocument::width_of(std::uint64_t accessor) const {
  const std::string shape = item("accessors", accessor).at("type").get<std::string>();
  return shape == "SCALAR" ? 1 : shape == "VEC3" ? 3 : shape == "VEC4" ? 4 : 0;
}

GltfNumbers GltfDocument::locate(std::uint64_t accessor, std::size_t width) const {
  const nlohmann::json& a = item("accessors", accessor);
  const bool is_sparse = a.contains("sparse");
  if (!a.contains("bufferView") && !is_sparse)
    fail("compressed data is not supported; export it without compression");
  const std::uint64_t type = whole(a.at("componentType"));
  const std::size_t size = bytes_of_component(type);
  const std::size_t has = width_of(accessor);
  if (size == 0 || has != width)
    fail(fmt::format("accessor {} has the wrong type; export it again", accessor));
  GltfNumbers place{.bytes = {},
                    .count = whole(a.at("count")),
                    .stride = size * width,
                    .type = type,
                    .unit = a.value("normalized", false) ? full_scale(type) : 1.0,
                    .sparse = is_sparse ? &a.at("sparse") : nullptr};
  if (a.contains("bufferView"))
    place.bytes = bytes_of_view(a, place.count, size * width, place.stride);
  return place;
}

std::string_view GltfDocument::bytes_of_view(const nlohmann::json& reference,
                                             std::uint64_t count,
                                             std::uint64_t element_bytes,
                                             std::uint64_t& stride) const {
  const nlohmann::json& view = item("bufferViews", whole(reference.at("bufferView")));
  const std::uint64_t buffer = whole(view.at("buffer"));
  if (buffer >= buffers.size()) fail("it refers to a buffer that does not exist; export it again");
  const std::string_view in = buffers[buffer];
  const std::uint64_t begin = whole_or(view, "byteOffset", 0);
  const std::uint64_t length = whole(view.at("byteLength"));
  const std::uint64_t offset = whole_or(reference, "byteOffset", 0);
  stride = whole_or(view, "byteStride", element_bytes);
  const bool in_buffer = begin <= in.size() && length <= in.size() - begin;
  const bool fits = in_buffer && offset <= length && stride >= element_bytes && stride <= 252 &&
                    count <= (length - offset + stride - element_bytes) / stride;
  if (!fits) {
    fail(
        fmt::format("{} elements exceed their buffer; the file is truncated or its "
                    "counts are wrong",
                    count));
  }
  return in.substr(begin + offset, length - offset);
}

void GltfDocument::replace_sparse(const GltfNumbers& place,
                                  std::size_t width,
                                  std::vector<double>& numbers) const {
  const nlohmann::json& sparse = *place.sparse;
  const nlohmann::json& indices = sparse.at("indices");
  const std::uint64_t count = whole(sparse.at("count"));
  const std::uint64_t index_type = whole(indices.at("componentType"));
  const std::size_t index_bytes = bytes_of_component(index_type);
  const std::size_t size = bytes_of_component(place.type);
  if (index_bytes == 0 || index_type == 5126)
    fail("the indices of a sparse accessor have the wrong type; export it again");
  std::uint64_t index_stride = 0;
  std::uint64_t value_stride = 0;
  const auto index_view = bytes_of_view(indices, count, index_bytes, index_stride);
  const auto value_view = bytes_of_view(sparse.at("values"), count, size * width, value_stride);
  for (std::uint64_t i = 0; i < count; ++i) {
    const double index = component_at(index_view, i * index_stride, index_type);
    if (!(index >= 0.0 && index < static_cast<double>(place.count))) {
      fail(
          fmt::format("a sparse accessor refers to element {}, counted from 0, of only {}; export "
                      "it again",
                      index,
                      place.count));
    }
    for (std::size_t k = 0; k < width; ++k)
      numbers[static_cast<std::size_t>(index) * width + k] =
          component_at(value_view, i * value_stride + k * size, place.type) / place.unit;
  }
}

std::vector<double> GltfDocument::numbers(std::uint64_t accessor, std::size_t width) const {
  const GltfNumbers place = locate(accessor, width);
  const std::size_t size = bytes_of_component(place.type);
  std::vector<double> found;
  found.reserve(place.count * width);
  for (std::uint64_t i = 0; i < place.count && !place.bytes.empty(); ++i) {
    for (std::size_t k = 0; k < width; ++k)
      found.push_back(component_at(place.bytes, i * place.stride + k * size, place.type) /
                      place.unit);
  }
  found.resize(place.count * width);  // a sparse accessor without a view begins as zeros
  if (place.sparse != nullptr) replace_sparse(place, width, found);
  return found;
}

}  // namespace frangia
