#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "frangia/files/internal/gltf_document.h"

namespace frangia {
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
