#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <matio.h>

#include "frangia/core/error.h"
#include "frangia/core/read_regular_file.h"
#include "frangia/exchange/internal/named_values.h"

namespace frangia {
namespace {

constexpr std::size_t kMaxMatNumbers = 1000;  // of a matrix that is kept
constexpr std::size_t kMaxMatBytes = 8'000'000;
constexpr int kMaxMatDepth = 8;  // of structures

struct CloseMat {
  void operator()(mat_t* file) const { Mat_Close(file); }
};
struct FreeVariable {
  void operator()(matvar_t* variable) const { Mat_VarFree(variable); }
};

template <typename Number>
Eigen::MatrixXd typed_matrix_of(const matvar_t& variable) {
  // MATLAB stores columns one after the other, as Eigen.
  using Stored = Eigen::Matrix<Number, Eigen::Dynamic, Eigen::Dynamic>;
  return Eigen::Map<const Stored>(static_cast<const Number*>(variable.data),
                                  static_cast<Eigen::Index>(variable.dims[0]),
                                  static_cast<Eigen::Index>(variable.dims[1]))
      .template cast<double>();
}

/// The matrix of a variable; empty when it is not a real matrix of at most `kMaxMatNumbers`.
Eigen::MatrixXd mat_matrix_of(const matvar_t& variable) {
  if (variable.rank != 2 || variable.data == nullptr || variable.isComplex != 0) return {};
  const std::size_t rows = variable.dims[0];
  const std::size_t columns = variable.dims[1];
  if (rows == 0 || columns == 0 || rows > kMaxMatNumbers || columns > kMaxMatNumbers / rows)
    return {};
  switch (variable.data_type) {
    case MAT_T_DOUBLE:
      return typed_matrix_of<double>(variable);
    case MAT_T_SINGLE:
      return typed_matrix_of<float>(variable);
    case MAT_T_INT8:
      return typed_matrix_of<std::int8_t>(variable);
    case MAT_T_UINT8:
      return typed_matrix_of<std::uint8_t>(variable);
    case MAT_T_INT16:
      return typed_matrix_of<std::int16_t>(variable);
    case MAT_T_UINT16:
      return typed_matrix_of<std::uint16_t>(variable);
    case MAT_T_INT32:
      return typed_matrix_of<std::int32_t>(variable);
    case MAT_T_UINT32:
      return typed_matrix_of<std::uint32_t>(variable);
    default:
      return {};
  }
}

/// The text of a row of characters; empty when it is something else.
std::string mat_text_of(const matvar_t& variable) {
  if (variable.class_type != MAT_C_CHAR || variable.rank != 2 || variable.data == nullptr)
    return {};
  const std::size_t count = variable.dims[0] * variable.dims[1];
  if (variable.dims[0] != 1 || count > kMaxMatNumbers) return {};
  std::string text;
  for (std::size_t i = 0; i < count; ++i) {
    text += variable.data_size == 2
                ? static_cast<char>(static_cast<const std::uint16_t*>(variable.data)[i])
                : static_cast<const char*>(variable.data)[i];
  }
  return text;
}

void collect_variable(const matvar_t& variable,
                      const std::string& name,
                      int depth,
                      NamedValues& values) {
  if (depth > kMaxMatDepth) return;
  if (variable.class_type == MAT_C_CHAR) {
    std::string text = mat_text_of(variable);
    if (!text.empty()) values.texts.emplace(name, std::move(text));
    return;
  }
  if (variable.class_type != MAT_C_STRUCT) {
    Eigen::MatrixXd matrix = mat_matrix_of(variable);
    if (matrix.size() > 0) values.matrices.emplace(name, std::move(matrix));
    return;
  }
  const bool single = variable.rank == 2 && variable.dims[0] == 1 && variable.dims[1] == 1;
  if (!single || variable.data == nullptr) return;
  const unsigned fields = Mat_VarGetNumberOfFields(const_cast<matvar_t*>(&variable));
  char* const* names = Mat_VarGetStructFieldnames(&variable);
  const auto* const* members = static_cast<const matvar_t* const*>(variable.data);
  for (unsigned i = 0; i < fields; ++i) {
    if (members[i] != nullptr)
      collect_variable(*members[i], name + "." + names[i], depth + 1, values);
  }
}

}  // namespace

NamedValues read_mat_values(const std::filesystem::path& file) {
  const std::vector<char> bytes = read_regular_file(file, kMaxMatBytes);
  constexpr std::string_view kHdf5Header = "MATLAB 7.3";
  if (std::string_view(bytes.data(), bytes.size()).substr(0, kHdf5Header.size()) == kHdf5Header) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: it has version 7.3; in MATLAB, save it with -v7", file.string()));
  }
  const std::unique_ptr<mat_t, CloseMat> mat(Mat_Open(file.c_str(), MAT_ACC_RDONLY));
  if (mat == nullptr) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: it is not a MATLAB file of version 5 or 7", file.string()));
  }
  NamedValues values;
  std::string objects;
  while (true) {
    const std::unique_ptr<matvar_t, FreeVariable> variable(Mat_VarReadNext(mat.get()));
    if (variable == nullptr) break;
    if (variable->class_type == MAT_C_OPAQUE || variable->class_type == MAT_C_OBJECT) {
      objects = variable->name == nullptr ? "a variable" : variable->name;
      continue;
    }
    if (variable->name != nullptr) collect_variable(*variable, variable->name, 0, values);
  }
  if (values.matrices.empty() && !objects.empty()) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: {} is an object of a MATLAB class, which other programs cannot "
                            "read; in MATLAB, save it by s = toStruct({}); save file.mat -struct s",
                            file.string(),
                            objects,
                            objects));
  }
  return values;
}

}  // namespace frangia
