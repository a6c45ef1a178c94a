// MATLAB's "Level 5" MAT-file, the format of versions 5 and 7, as its specification describes it.
// libmatio reads it too, but crashes on damaged files.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <new>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <zlib.h>

#include "frangia/core/error.h"
#include "frangia/core/read_file.h"
#include "frangia/exchange/internal/named_values.h"

namespace frangia {
namespace {

using Bytes = std::span<const char>;

constexpr std::size_t kMaxMatBytes = 8'000'000;     // of the file
constexpr std::size_t kMaxMatContent = 64'000'000;  // of its expanded structures
constexpr std::size_t kFirstBytes = 32'768;         // hold any matrix that is kept
constexpr int kMaxMatDepth = 8;                     // of structures

/// Types of data elements and classes of arrays, by their numbers in the specification.
enum MatType : std::uint32_t {
  kInt8 = 1,
  kUint8 = 2,
  kInt16 = 3,
  kUint16 = 4,
  kInt32 = 5,
  kUint32 = 6,
  kSingle = 7,
  kDouble = 9,
  kMatrix = 14,
  kCompressed = 15,
  kUtf8 = 16,
  kUtf16 = 17
};
enum MatClass : std::uint32_t {
  kStructClass = 2,
  kObjectClass = 3,
  kCharClass = 4,
  kOpaqueClass = 17
};

/// The file is damaged at the element that is read.
struct DamagedMat {};
/// Its structures expand beyond the limit.
struct LargeMat {};

template <typename Number>
Number number_at(Bytes bytes, std::size_t at) {
  if (at > bytes.size() || bytes.size() - at < sizeof(Number)) throw DamagedMat{};
  Number number;
  std::memcpy(&number, bytes.data() + at, sizeof(Number));
  return number;
}

struct MatElement {
  std::uint32_t type = 0;
  Bytes data;
};

/// Takes the first element off the bytes.
MatElement next_element(Bytes& bytes) {
  const auto first = number_at<std::uint32_t>(bytes, 0);
  constexpr std::uint32_t kSmallBits = 16;
  if (first >> kSmallBits != 0) {  // type, size and up to four bytes of data in eight bytes
    const std::size_t size = first >> kSmallBits;
    if (size > 4 || bytes.size() < 8) throw DamagedMat{};
    const MatElement element{first & 0xFFFFU, bytes.subspan(4, size)};
    bytes = bytes.subspan(8);
    return element;
  }
  const std::size_t size = number_at<std::uint32_t>(bytes, 4);
  if (size > bytes.size() - 8) throw DamagedMat{};
  const MatElement element{first, bytes.subspan(8, size)};
  const std::size_t padding = first == kCompressed ? 0 : (8 - size % 8) % 8;
  bytes = bytes.subspan(std::min(bytes.size(), 8 + size + padding));
  return element;
}

/// Expands compressed variables one after the other.
class Inflater {
 public:
  explicit Inflater(const Run& run) : run_(run) {
    if (::inflateInit(&stream_) != Z_OK) throw std::bad_alloc();
  }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;
  Inflater(Inflater&&) = delete;
  Inflater& operator=(Inflater&&) = delete;
  ~Inflater() { ::inflateEnd(&stream_); }

  /// The first bytes of a variable, all of it where it has no more.
  Bytes begin(Bytes compressed) {
    run_.check();
    ::inflateReset(&stream_);
    stream_.next_in =
        reinterpret_cast<Bytef*>(const_cast<char*>(compressed.data()));  // zlib does not write
    stream_.avail_in = static_cast<uInt>(compressed.size());
    size_ = 0;
    expand_to(kFirstBytes);
    return {bytes_.data(), size_};
  }

  /// The bytes of the variable that has begun, all `wanted` of them.
  Bytes rest(std::size_t wanted) {
    if (wanted > kMaxMatContent - content_) throw LargeMat{};
    content_ += wanted;
    // The buffer follows what arrives: the size that a file states may be wrong.
    while (size_ < wanted && expand_to(std::min(wanted, 2 * size_)))
      run_.check();
    if (size_ < wanted) throw DamagedMat{};
    return {bytes_.data(), size_};
  }

 private:
  /// Whether there may be more.
  bool expand_to(std::size_t size) {
    if (bytes_.size() < size) bytes_.resize(size);
    stream_.next_out = reinterpret_cast<Bytef*>(bytes_.data() + size_);
    stream_.avail_out = static_cast<uInt>(size - size_);
    const int result = ::inflate(&stream_, Z_SYNC_FLUSH);
    const bool is_full = stream_.avail_out == 0;
    size_ = size - stream_.avail_out;
    if (result != Z_STREAM_END && !(result == Z_OK && is_full)) throw DamagedMat{};
    return result == Z_OK;
  }

  const Run& run_;
  z_stream stream_{};
  std::vector<char> bytes_;
  std::size_t size_ = 0;
  std::size_t content_ = 0;  ///< of all variables that were expanded whole
};

template <typename Number>
std::vector<double> typed_numbers_of(Bytes data) {
  std::vector<double> numbers;
  if (data.size() / sizeof(Number) > kMaxValueNumbers) return numbers;
  for (std::size_t at = 0; at + sizeof(Number) <= data.size(); at += sizeof(Number))
    numbers.push_back(static_cast<double>(number_at<Number>(data, at)));
  return numbers;
}

std::vector<double> mat_numbers_of(const MatElement& element) {
  switch (element.type) {
    case kInt8:
      return typed_numbers_of<std::int8_t>(element.data);
    case kUint8:
    case kUtf8:
      return typed_numbers_of<std::uint8_t>(element.data);
    case kInt16:
      return typed_numbers_of<std::int16_t>(element.data);
    case kUint16:
    case kUtf16:
      return typed_numbers_of<std::uint16_t>(element.data);
    case kInt32:
      return typed_numbers_of<std::int32_t>(element.data);
    case kUint32:
      return typed_numbers_of<std::uint32_t>(element.data);
    case kSingle:
      return typed_numbers_of<float>(element.data);
    case kDouble:
      return typed_numbers_of<double>(element.data);
    default:
      return {};
  }
}

/// Reads the variables of a file into named values.
class MatReader {
 public:
  MatReader(const std::filesystem::path& file, NamedValues& values, const Run& run)
      : file_(file), values_(values), run_(run) {}

  void read_all(Bytes bytes) {
    Inflater inflater(run_);
    while (bytes.size() >= 8) {
      const MatElement element = next_element(bytes);
      if (element.type == kMatrix) read_array(element.data, "", 0);
      if (element.type == kCompressed) read_compressed(element.data, inflater);
    }
  }

  /// Whether a variable was an object of a class, whose content only MATLAB knows.
  [[nodiscard]] bool has_objects() const { return has_objects_; }

 private:
  void read_compressed(Bytes compressed, Inflater& inflater) {
    Bytes bytes = inflater.begin(compressed);
    if (number_at<std::uint32_t>(bytes, 0) != kMatrix) return;
    const std::size_t size = 8 + std::size_t{number_at<std::uint32_t>(bytes, 4)};
    if (size > bytes.size()) {
      Bytes inside = bytes.subspan(8);
      const auto kind = number_at<std::uint32_t>(next_element(inside).data, 0) & 0xFFU;
      if (kind != kStructClass) return;  // a matrix with more numbers than any that is kept
      bytes = inflater.rest(size);
    }
    const MatElement array = next_element(bytes);
    if (array.type == kMatrix) read_array(array.data, "", 0);
  }

  void read_array(Bytes bytes, const std::string& name, int depth) {
    run_.check();
    check_count(values_, file_);
    if (bytes.empty() || depth > kMaxMatDepth) return;
    const auto array_class = number_at<std::uint32_t>(next_element(bytes).data, 0) & 0xFFU;
    if (array_class == kObjectClass || array_class == kOpaqueClass) {
      has_objects_ = true;
      return;
    }
    const std::vector<double> sizes = mat_numbers_of(next_element(bytes));
    const Bytes own_name = next_element(bytes).data;
    const std::string full = depth == 0 ? std::string(own_name.begin(), own_name.end()) : name;
    if (sizes.size() != 2 || full.size() > kMaxNameBytes) return;
    if (array_class == kStructClass) {
      if (sizes[0] == 1.0 && sizes[1] == 1.0) read_structure(bytes, full, depth);
      return;
    }
    if (bytes.empty()) return;
    const std::vector<double> numbers = mat_numbers_of(next_element(bytes));
    if (numbers.empty() || !(sizes[0] >= 1.0) || !(sizes[1] >= 1.0) ||
        sizes[0] * sizes[1] != static_cast<double>(numbers.size()))
      return;
    if (array_class == kCharClass) {
      std::string text;
      for (const double letter : numbers)
        text += letter >= 32.0 && letter < 127.0 ? static_cast<char>(letter) : '?';
      values_.texts.emplace(full, text);
      return;
    }
    // MATLAB stores columns one after the other, as Eigen.
    values_.matrices.emplace(
        full,
        Eigen::Map<const Eigen::MatrixXd>(numbers.data(),
                                          static_cast<Eigen::Index>(sizes[0]),
                                          static_cast<Eigen::Index>(sizes[1])));
  }

  void read_structure(Bytes bytes, const std::string& name, int depth) {
    const auto length = number_at<std::int32_t>(next_element(bytes).data, 0);
    const Bytes names = next_element(bytes).data;
    if (length < 1) throw DamagedMat{};
    const auto step = static_cast<std::size_t>(length);
    for (std::size_t at = 0; at + step <= names.size(); at += step) {
      const std::string_view padded(names.data() + at, step);
      const std::string_view field = padded.substr(0, padded.find('\0'));
      const MatElement element = next_element(bytes);
      if (element.type != kMatrix || name.size() + field.size() > kMaxNameBytes) continue;
      read_array(element.data, fmt::format("{}.{}", name, field), depth + 1);
    }
  }

  const std::filesystem::path& file_;
  NamedValues& values_;
  const Run& run_;
  bool has_objects_ = false;
};

}  // namespace

NamedValues read_mat_values(const std::filesystem::path& file, const Run& run) {
  const std::vector<char> bytes = read_regular_file(file, kMaxMatBytes);
  const auto fail = [&](const char* why) {
    throw Error(ErrorKind::Input, fmt::format("{}: {}", file.string(), why));
  };
  const std::string_view text(bytes.data(), bytes.size());
  if (text.starts_with("MATLAB 7.3")) fail("it has version 7.3; in MATLAB, save it with -v7");
  constexpr std::size_t kHeader = 128;
  if (text.size() < kHeader || text.substr(kHeader - 2, 2) != "IM")
    fail("it is not a MATLAB file of version 5 or 7");
  NamedValues values;
  MatReader reader(file, values, run);
  try {
    reader.read_all(Bytes(bytes).subspan(kHeader));
  } catch (const DamagedMat&) {
    fail("it is damaged or cut off; copy it again");
  } catch (const LargeMat&) {
    fail("its structures hold more than 64 MB; in MATLAB, save the calibration alone");
  }
  if (values.matrices.empty() && reader.has_objects()) {
    fail(
        "it holds an object of a MATLAB class, which other programs cannot read; in MATLAB, save "
        "it by s = toStruct(stereoParams); save('file.mat', '-struct', 's', '-v7')");
  }
  return values;
}

}  // namespace frangia
