#pragma once

#include <cstddef>
#include <cstring>
#include <string>

#include <nlohmann/json.hpp>

namespace frangia {

/// Collects arrays and packs them behind a JSON header, as encode_arrays.h describes.
class ArrayPacker {
 public:
  template <typename T>
  void add(const char* name, const char* type, const T* data, std::size_t length) {
    header_["arrays"].push_back(
        {{"name", name}, {"type", type}, {"length", length}, {"offset", body_.size()}});
    const std::size_t begin = body_.size();
    const std::size_t bytes = length * sizeof(T);
    body_.resize((begin + bytes + kAlignment - 1) / kAlignment * kAlignment);
    if (bytes > 0) std::memcpy(body_.data() + begin, data, bytes);
  }

  /// States values beside the arrays, as "values" of the header.
  void set_values(nlohmann::ordered_json values) { header_["values"] = std::move(values); }

  [[nodiscard]] std::string pack() const;

 private:
  static constexpr std::size_t kAlignment = 4;

  nlohmann::ordered_json header_ = {{"arrays", nlohmann::ordered_json::array()}};
  std::string body_;
};

}  // namespace frangia
