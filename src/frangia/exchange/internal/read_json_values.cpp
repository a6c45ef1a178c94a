#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "frangia/core/check_nesting.h"
#include "frangia/core/error.h"
#include "frangia/core/read_file.h"
#include "frangia/core/text.h"
#include "frangia/exchange/internal/named_values.h"

namespace frangia {
namespace {

using nlohmann::json;

/// The matrix of a value; empty when it is something else.
Eigen::MatrixXd json_matrix_of(const json& value) {
  if (value.is_number()) return Eigen::MatrixXd::Constant(1, 1, value.get<double>());
  if (!value.is_array() || value.empty()) return {};
  const bool nested = value.front().is_array();
  const std::size_t columns = nested ? value.front().size() : value.size();
  const std::size_t rows = nested ? value.size() : 1;
  // Each is compared alone, too: one long row and many short ones name terabytes.
  if (rows > kMaxValueNumbers || columns > kMaxValueNumbers || rows * columns > kMaxValueNumbers)
    return {};
  Eigen::MatrixXd matrix(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(columns));
  for (std::size_t row = 0; row < rows; ++row) {
    const json& list = nested ? value[row] : value;
    if (!list.is_array() || list.size() != columns) return {};
    for (std::size_t column = 0; column < columns; ++column) {
      if (!list[column].is_number()) return {};
      matrix(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)) =
          list[column].get<double>();
    }
  }
  return matrix;
}

/// The matrix of an object with rows, cols and data; empty when it is something else.
Eigen::MatrixXd opencv_matrix_of(const json& value) {
  if (!value.contains("rows") || !value.contains("cols") || !value.contains("data")) return {};
  if (!value["rows"].is_number_integer() || !value["cols"].is_number_integer()) return {};
  const Eigen::MatrixXd list = json_matrix_of(value["data"]);
  return rows_of_list(json_matrix_of(value["data"]),
                      value["rows"].get<Eigen::Index>(),
                      value["cols"].get<Eigen::Index>());
}

void collect_object(const json& object,
                    const std::string& prefix,
                    const std::filesystem::path& file,
                    NamedValues& values) {
  for (const auto& [key, value] : object.items()) {
    if (prefix.size() + key.size() > kMaxNameBytes) continue;
    const std::string name = prefix + key;
    check_count(values, file);
    if (value.is_string()) {
      values.texts.emplace(name, value.get<std::string>());
    } else if (value.is_boolean()) {
      values.texts.emplace(name, value.get<bool>() ? "true" : "false");
    } else if (value.is_array() && !value.empty() && value.front().is_object()) {
      for (std::size_t i = 0; i < value.size(); ++i)
        if (value[i].is_object())
          collect_object(value[i], fmt::format("{}.{}.", name, i), file, values);
    } else if (value.is_object()) {
      Eigen::MatrixXd matrix = opencv_matrix_of(value);
      if (matrix.size() > 0) {
        values.matrices.emplace(name, std::move(matrix));
      } else {
        collect_object(value, name + ".", file, values);
      }
    } else {
      Eigen::MatrixXd matrix = json_matrix_of(value);
      if (matrix.size() > 0) values.matrices.emplace(name, std::move(matrix));
    }
  }
}

}  // namespace

NamedValues read_json_values(const std::filesystem::path& file) {
  const std::string text = plain_text(read_text_file(file));
  check_json_nesting(text, file);
  const json document = json::parse(text, nullptr, /*allow_exceptions=*/false);
  if (!document.is_object()) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: it is not a JSON object; give the text of "
                            "jsonencode(toStruct(stereoParams))",
                            file.string()));
  }
  NamedValues values;
  collect_object(document, "", file, values);
  return values;
}

}  // namespace frangia
