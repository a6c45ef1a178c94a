#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/core/error.h"
#include "frangia/core/text.h"
#include "frangia/files/internal/check_mesh.h"
#include "frangia/files/internal/file_writer.h"
#include "frangia/files/internal/pcd.h"
#include "frangia/files/internal/text_reader.h"

namespace frangia {
namespace {

constexpr std::array<std::string_view, 13> kKept{"x",
                                                 "y",
                                                 "z",
                                                 "normal_x",
                                                 "normal_y",
                                                 "normal_z",
                                                 "sigma_mm",
                                                 "sigma_noise_mm",
                                                 "sigma_systematic_mm",
                                                 "rgb",
                                                 "r",
                                                 "g",
                                                 "b"};
constexpr std::size_t kRgb = 9;
constexpr std::size_t kFirstChannel = 10;
constexpr std::uint64_t kMaxFieldCount = 65'536;

struct Field {
  std::string_view name;
  std::uint64_t bytes = 4;
  char type = 'F';
  std::uint64_t count = 1;
};

/// One value of a point.
struct Value {
  float number = 0.0F;
  std::uint32_t bits = 0;  ///< of a color packed into four bytes, which a float cannot hold
};

struct Header {
  std::vector<Field> fields;
  std::uint64_t points = 0;
  std::string data;
};

std::string in_small_letters(std::string_view word) {
  std::string lower(word);
  std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char letter) {
    return static_cast<char>(std::tolower(letter));
  });
  return lower;
}

class PcdReader {
 public:
  PcdReader(const std::filesystem::path& path, std::string_view text)
      : path_(path), text_(text), reader_(path, text) {}

  Mesh read(std::size_t& left_out, const Run& run) {
    read_header(run);
    if (slot_of("x") == kNone || slot_of("y") == kNone || slot_of("z") == kNone) {
      reader_.fail("its points have no x, y or z");
    }
    has_normals_ = slot_of("normal_x") != kNone && slot_of("normal_y") != kNone &&
                   slot_of("normal_z") != kNone;
    has_sigma_ = slot_of("sigma_mm") != kNone;
    has_parts_ =
        has_sigma_ && slot_of("sigma_noise_mm") != kNone && slot_of("sigma_systematic_mm") != kNone;
    for (Field& field : header_.fields)
      field.name = kept_name_of(field.name);
    const std::size_t rgb = slot_of(kKept[kRgb]);
    has_colors_ = rgb != kNone && header_.fields[rgb].bytes == 4;
    has_channels_ =
        !has_colors_ && slot_of("r") != kNone && slot_of("g") != kNone && slot_of("b") != kNone;
    Mesh mesh;
    if (header_.data == "ascii") {
      read_points(mesh, left_out, [&](const Field& field) { return ascii(field); });
      warn_of_rest(reader_.rest(), path_, run);
    } else {
      std::string_view body = text_.substr(reader_.position());
      read_points(mesh, left_out, [&](const Field& field) { return binary(field, body); });
      warn_of_rest(body, path_, run);
    }
    if (has_channels_) mesh.colors = colors_of(channels_);
    return mesh;
  }

 private:
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

  [[nodiscard]] std::size_t slot_of(std::string_view name) const {
    for (std::size_t i = 0; i < header_.fields.size(); ++i)
      if (header_.fields[i].name == name) return i;
    return kNone;
  }

  /// The name that a field has here: the alpha of `rgba` is left out, and some programs write a
  /// field for each channel.
  static std::string_view kept_name_of(std::string_view name) {
    if (name == "rgba") return kKept[kRgb];
    return name == "red" ? "r" : name == "green" ? "g" : name == "blue" ? "b" : name;
  }

  /// The value of a channel that stands for full light; that of a float is seen from its values.
  static float full_light_of(const Field& field) {
    if (field.type == 'F') return 1.0F;
    return field.bytes == 2 ? 65'535.0F : 255.0F;
  }

  /// Warns of a pose of the sensor, in whose frame the points are.
  void read_viewpoint(const Run& run) {
    constexpr std::array<float, 7> kIdentity{0, 0, 0, 1, 0, 0, 0};  // position, then w x y z
    std::array<float, 7> pose = kIdentity;
    for (float& number : pose) {
      const std::string_view word = reader_.word_on_line();
      const std::optional<float> read = parse_float(word);
      if (!read && !word.empty()) reader_.fail(fmt::format("{} is not a number", in_quotes(word)));
      if (!read) return;
      number = *read;
    }
    if (pose == kIdentity) return;
    run.warn(
        fmt::format("{}: its VIEWPOINT, the pose of the sensor ({}), is not applied: the points "
                    "stay in the frame in which they are written",
                    path_.string(),
                    fmt::join(pose, " ")));
  }

  void read_header(const Run& run) {
    std::uint64_t width = 0;
    std::uint64_t height = 1;
    std::optional<std::uint64_t> points;
    while (header_.data.empty()) {
      const std::string_view key = reader_.word();
      if (key == "FIELDS" || key == "COLUMNS") {
        read_names();
      } else if (key == "SIZE") {
        for (Field& field : header_.fields)
          field.bytes = whole();
      } else if (key == "TYPE") {
        for (Field& field : header_.fields)
          field.type = letter();
      } else if (key == "COUNT") {
        for (Field& field : header_.fields)
          field.count = whole();
      } else if (key == "WIDTH") {
        width = whole();
      } else if (key == "HEIGHT") {
        height = whole();
      } else if (key == "POINTS") {
        points = whole();
      } else if (key == "DATA") {
        header_.data = in_small_letters(reader_.word_on_line());
      } else if (key == "VIEWPOINT") {
        read_viewpoint(run);
      } else if (key != "VERSION" && !key.starts_with('#')) {
        reader_.fail(fmt::format("{} is not a keyword of a PCD header", in_quotes(key)));
      }
      reader_.skip_line();
    }
    header_.points =
        points.value_or(width > 0xFFFFFFFF || height > 0xFFFFFFFF ? 0 : width * height);
    check_header();
  }

  void read_names() {
    for (auto name = reader_.word_on_line(); !name.empty(); name = reader_.word_on_line())
      header_.fields.push_back({.name = name});
  }

  std::uint64_t whole() {
    const std::string_view word = reader_.word_on_line();
    const auto number = parse_integer(word);
    if (!number || *number < 0) reader_.fail(fmt::format("{} is not a count", in_quotes(word)));
    return static_cast<std::uint64_t>(*number);
  }

  char letter() {
    const std::string_view word = reader_.word_on_line();
    if (word != "F" && word != "I" && word != "U") {
      reader_.fail(fmt::format("{} is not a field type; it must be F, I or U", in_quotes(word)));
    }
    return word[0];
  }

  void check_header() {
    if (header_.data == "binary_compressed") {
      reader_.fail("this PCD is compressed; save it as binary (pcl_convert_pcd_ascii_binary)");
    }
    if (header_.data != "ascii" && header_.data != "binary") {
      reader_.fail(
          fmt::format("the data is {}; it must be ascii or binary", in_quotes(header_.data)));
    }
    std::uint64_t bytes = 0;
    for (const Field& field : header_.fields) {
      const bool fits = field.type == 'F' ? field.bytes == 4 || field.bytes == 8
                                          : std::has_single_bit(field.bytes) && field.bytes <= 8;
      if (!fits || field.count > kMaxFieldCount) {
        reader_.fail(fmt::format("a field of {} x {} bytes of type {} is not valid PCD",
                                 field.count,
                                 field.bytes,
                                 field.type));
      }
      bytes += field.count * (header_.data == "ascii" ? 2 : field.bytes);
    }
    const std::uint64_t max_count = (reader_.bytes_left() + 1) / std::max<std::uint64_t>(bytes, 1);
    if (header_.points > max_count) {
      reader_.fail(
          fmt::format("the header states {} points, but the file can hold at most {}; it "
                      "is truncated or its header is wrong",
                      header_.points,
                      max_count));
    }
  }

  template <typename Next>
  void read_points(Mesh& mesh, std::size_t& left_out, const Next& next) {
    std::vector<std::size_t> slots;
    for (const Field& field : header_.fields) {
      std::size_t slot = 0;
      while (slot < kKept.size() && kKept.at(slot) != field.name)
        ++slot;
      slots.push_back(slot);
    }
    mesh.vertices_mm.reserve(header_.points);
    std::array<float, kKept.size()> kept{};
    std::uint32_t packed = 0;
    const float full_light = has_channels_ ? full_light_of(header_.fields[slot_of("r")]) : 1.0F;
    for (std::uint64_t i = 0; i < header_.points; ++i) {
      for (std::size_t f = 0; f < slots.size(); ++f) {
        for (std::uint64_t k = 0; k < header_.fields[f].count; ++k) {
          const Value value = next(header_.fields[f]);
          if (k > 0 || slots[f] >= kept.size()) continue;
          kept.at(slots[f]) = value.number;
          if (slots[f] == kRgb) packed = value.bits;  // red, green and blue in the low bytes
        }
      }
      const Eigen::Vector3f point(kept[0], kept[1], kept[2]);
      if (!point.allFinite()) {
        ++left_out;
        continue;
      }
      mesh.vertices_mm.push_back(point);
      const Eigen::Vector3f normal(kept[3], kept[4], kept[5]);
      if (has_normals_) {
        mesh.normals.push_back(normal.allFinite() ? normal : Eigen::Vector3f::Zero());
      }
      if (has_colors_) {
        mesh.colors.push_back({static_cast<std::uint8_t>(packed >> 16U),
                               static_cast<std::uint8_t>(packed >> 8U),
                               static_cast<std::uint8_t>(packed)});
      }
      if (has_channels_) {
        channels_.emplace_back(
            kept[kFirstChannel], kept[kFirstChannel + 1], kept[kFirstChannel + 2]);
        channels_.back() /= full_light;
      }
      if (has_sigma_) mesh.sigma_mm.push_back(kept[6]);
      if (!has_parts_) continue;
      mesh.sigma_noise_mm.push_back(kept[7]);
      mesh.sigma_systematic_mm.push_back(kept[8]);
    }
  }

  /// A color as a float (PCL's habit) is its bits; as a whole number, which PCL writes since 1.8,
  /// it may hold alpha in its highest byte.
  Value ascii(const Field& field) {
    const std::string_view word = reader_.word();
    if (field.type != 'F') {
      if (const auto whole = parse_integer(word))
        return {static_cast<float>(*whole), static_cast<std::uint32_t>(*whole)};
    }
    const std::optional<float> number = parse_float(word);
    if (!number) reader_.fail(fmt::format("{} is not a number", in_quotes(word)));
    return {*number, std::bit_cast<std::uint32_t>(*number)};
  }

  template <typename Number>
  static Value take(std::string_view& body) {
    Number number{};
    std::memcpy(&number, body.data(), sizeof number);
    body.remove_prefix(sizeof number);
    std::uint32_t bits = 0;
    if constexpr (sizeof number == sizeof bits) bits = std::bit_cast<std::uint32_t>(number);
    return {static_cast<float>(number), bits};
  }

  Value binary(const Field& field, std::string_view& body) {
    if (body.size() < field.bytes) reader_.fail("the file is truncated");
    if (field.type == 'F') return field.bytes == 4 ? take<float>(body) : take<double>(body);
    const bool has_sign = field.type == 'I';
    switch (field.bytes) {
      case 1:
        return has_sign ? take<std::int8_t>(body) : take<std::uint8_t>(body);
      case 2:
        return has_sign ? take<std::int16_t>(body) : take<std::uint16_t>(body);
      case 4:
        return has_sign ? take<std::int32_t>(body) : take<std::uint32_t>(body);
      default:
        return has_sign ? take<std::int64_t>(body) : take<std::uint64_t>(body);
    }
  }

  std::filesystem::path path_;
  std::string_view text_;
  TextReader reader_;
  Header header_;
  bool has_normals_ = false;
  bool has_sigma_ = false;
  bool has_parts_ = false;
  bool has_colors_ = false;
  bool has_channels_ = false;  ///< red, green and blue in fields of their own
  std::vector<Eigen::Vector3f> channels_;
};

/// Whether the points are text, too.
bool has_text_points(std::string_view bytes) {
  constexpr std::size_t kHeader = 4096;
  return bytes.substr(0, kHeader).find("DATA binary") == std::string_view::npos;
}

}  // namespace

Mesh read_pcd(const std::filesystem::path& path, const Run& run) {
  std::string text = read_bytes(path);
  if (has_text_points(text)) text = plain_text(std::move(text));
  std::size_t left_out = 0;
  Mesh mesh = PcdReader(path, text).read(left_out, run);
  check_mesh(mesh, path);
  if (left_out > 0) {
    run.warn(fmt::format("{}: omitted {} point{} without finite coordinates",
                         path.string(),
                         left_out,
                         left_out == 1 ? "" : "s"));
  }
  return mesh;
}

}  // namespace frangia
