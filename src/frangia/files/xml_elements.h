#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace frangia {

/// The attributes of an XML element.
class XmlAttributes {
 public:
  explicit XmlAttributes(const char** pairs) : pairs_(pairs) {}
  /// Empty when there is none of this name.
  [[nodiscard]] std::string_view value(std::string_view name) const;

 private:
  const char** pairs_;
};

/// Walks over the elements of an XML text that comes in pieces. Names are "namespace|name".
///
/// errors   Error(Input) with the line: not well-formed, or a document type, whose entities can
///          grow without bound. What a handler throws stops the walk and comes out of `take`.
class XmlElements {
 public:
  using OnBegin = std::function<void(std::string_view, const XmlAttributes&)>;
  using OnEnd = std::function<void(std::string_view)>;

  XmlElements(OnBegin on_begin, OnEnd on_end);
  XmlElements(const XmlElements&) = delete;
  XmlElements& operator=(const XmlElements&) = delete;
  XmlElements(XmlElements&&) = delete;
  XmlElements& operator=(XmlElements&&) = delete;
  ~XmlElements();

  void take(std::string_view piece);
  void finish();

 private:
  struct Parser;
  std::unique_ptr<Parser> parser_;
};

}  // namespace frangia
