// OpenCV is expensive to compile: its FileStorage stays in this source and in
// write_calibration_file.cpp.
#include <algorithm>
#include <exception>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <opencv2/core.hpp>

#include "frangia/core/check_nesting.h"
#include "frangia/core/error.h"
#include "frangia/core/read_file.h"
#include "frangia/core/text.h"
#include "frangia/exchange/internal/named_values.h"
#include "frangia/exchange/internal/storage_formats.h"

namespace frangia {
namespace {

constexpr std::uint64_t kMaxStorageBytes = 1'000'000;  // a calibration has some kilobytes
constexpr std::size_t kMaxStorageDepth = 64;           // FileStorage recurses, with 4 kB a level

/// Values within values on one line, "a: b: c: 1" or "- - - 1", are levels, too. Brackets are
/// counted by `check_json_nesting`.
std::size_t levels_of(std::string_view line) {
  line = line.substr(0, line.find_first_of("[{\"'"));
  std::size_t levels = 0;
  for (std::size_t i = 0; i < line.size(); ++i)
    levels += line[i] == ':' || line.substr(i, 2) == "- " ? 1U : 0U;
  return levels;
}

void check_lines(std::string_view text, const std::filesystem::path& file) {
  std::size_t start = 0;
  while (start < text.size()) {
    const std::size_t first = text.find_first_not_of(" -", start);
    if (first != std::string_view::npos && first - start > 4 * kMaxStorageDepth) {
      throw Error(
          ErrorKind::Input,
          fmt::format("{}: a line is indented by more than {} columns; it is no calibration",
                      file.string(),
                      4 * kMaxStorageDepth));
    }
    const std::size_t end = std::min(text.find('\n', start), text.size());
    if (levels_of(text.substr(start, end - start)) > kMaxStorageDepth) {
      throw Error(ErrorKind::Input,
                  fmt::format("{}: a line nests values more than {} deep; it is no calibration",
                              file.string(),
                              kMaxStorageDepth));
    }
    start = end + 1;
  }
}

Eigen::MatrixXd storage_matrix_of(const cv::FileNode& node);

Eigen::MatrixXd storage_rows_of(const cv::FileNode& node) {
  const std::size_t columns = (*node.begin()).size();
  if (columns == 0 || columns * node.size() > kMaxValueNumbers) return {};
  Eigen::MatrixXd matrix(static_cast<Eigen::Index>(node.size()),
                         static_cast<Eigen::Index>(columns));
  Eigen::Index row = 0;
  for (const cv::FileNode& item : node) {
    if (!item.isSeq() || item.size() != columns) return {};
    const Eigen::MatrixXd list = storage_matrix_of(item);
    if (list.rows() != 1 || list.cols() != matrix.cols()) return {};
    matrix.row(row++) = list;
  }
  return matrix;
}

Eigen::MatrixXd storage_list_of(const cv::FileNode& node) {
  if (node.size() > kMaxValueNumbers) return {};
  if (node.size() > 0 && (*node.begin()).isSeq()) return storage_rows_of(node);
  Eigen::MatrixXd list(1, static_cast<Eigen::Index>(node.size()));
  Eigen::Index column = 0;
  for (const cv::FileNode& item : node) {
    if (!item.isReal() && !item.isInt()) return {};
    list(0, column++) = item.real();
  }
  return list;
}

/// The matrix of a node; empty when it is something else.
Eigen::MatrixXd storage_matrix_of(const cv::FileNode& node) {
  if (node.isReal() || node.isInt()) return Eigen::MatrixXd::Constant(1, 1, node.real());
  if (node.isSeq()) return storage_list_of(node);
  if (!node.isMap()) return {};
  const cv::FileNode rows = node["rows"];
  const cv::FileNode cols = node["cols"];
  if (!rows.isInt() || !cols.isInt() || !node["data"].isSeq()) return {};
  const Eigen::MatrixXd list = storage_list_of(node["data"]);
  return rows_of_list(
      storage_list_of(node["data"]), static_cast<int>(rows), static_cast<int>(cols));
}

/// Adds the values below a node. Names of inner structures are joined by dots.
void collect_nodes(const cv::FileNode& node,
                   const std::string& prefix,
                   const std::filesystem::path& file,
                   NamedValues& values) {
  for (const cv::FileNode& inner : node) {
    const std::string name = prefix + inner.name();
    if (name.size() > kMaxNameBytes) continue;
    check_count(values, file);
    Eigen::MatrixXd matrix = storage_matrix_of(inner);
    if (matrix.size() > 0) {
      values.matrices.emplace(name, std::move(matrix));
    } else if (inner.isString()) {
      values.texts.emplace(name, inner.string());
    } else if (inner.isMap()) {
      collect_nodes(inner, name + ".", file, values);
    }
  }
}

/// What OpenCV says in "OpenCV(4.6.0) persistence_yml.cpp:12: error: (-212:Parsing error) a(3):
/// Tabs are prohibited in function 'skipSpaces'".
std::string plain_fault(const std::string& what) {
  const std::size_t begin = what.find("error) ");
  if (begin == std::string::npos) return what;
  const std::string fault = what.substr(begin + 7);
  return fault.substr(0, fault.find(" in function"));
}

/// FileStorage reads YAML only, see storage_formats.cpp.
NamedValues read_opencv_yaml(std::string text, const std::filesystem::path& file) {
  check_json_nesting(text, file);
  check_lines(text, file);
  text = storage_yaml(text);
  NamedValues values;
  const cv::FileStorage storage(
      text, cv::FileStorage::READ | cv::FileStorage::MEMORY | cv::FileStorage::FORMAT_YAML);
  collect_nodes(storage.root(), "", file, values);
  return values;
}

}  // namespace

NamedValues read_opencv_values(const std::filesystem::path& file) {
  std::string text = plain_text(read_text_file(file, kMaxStorageBytes));
  const std::size_t first = text.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  const bool is_xml = first != std::string::npos && text[first] == '<';
  try {
    return is_xml ? read_opencv_xml(text) : read_opencv_yaml(std::move(text), file);
  } catch (const Error& fault) {
    const std::string why = fault.what();
    if (why.starts_with(file.string())) throw;
    throw Error(fault.kind(), fmt::format("{}: {}", file.string(), why));
  } catch (const std::exception& fault) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: OpenCV cannot read it ({}); give a .yml or .xml that OpenCV's "
                            "FileStorage wrote, or lists of numbers",
                            file.string(),
                            plain_fault(fault.what())));
  }
}

}  // namespace frangia
