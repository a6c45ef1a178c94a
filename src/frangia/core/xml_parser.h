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
  /// `pairs` are names and values in turn, ended by a null, as Expat passes them.
  explicit XmlAttributes(const char** pairs) : pairs_(pairs) {}
  /// The value of an attribute; empty when the element does not have it.
  [[nodiscard]] std::string_view value(std::string_view name) const;

 private:
  const char** pairs_;
};

/// Parses XML that arrives in pieces and calls a handler for each element, and for the text between
/// the tags where one is given. Names are "namespace|name".
///
/// @errors   Error(Input) with the line: not well-formed, or a document type declaration, whose
///          entities could expand without bound. An exception of a handler leaves `feed`.
class XmlParser {
 public:
  using OnBegin = std::function<void(std::string_view, const XmlAttributes&)>;  ///< start tag
  using OnEnd = std::function<void(std::string_view)>;                          ///< end tag
  using OnText = std::function<void(std::string_view)>;  ///< a piece of text, UTF-8
  /// A prefix and the namespace that it stands for from the next start tag on.
  using OnNamespace = std::function<void(std::string_view, std::string_view)>;

  /// `on_text` may be empty: text is then skipped.
  XmlParser(OnBegin on_begin, OnEnd on_end, OnText on_text = {});
  XmlParser(const XmlParser&) = delete;
  XmlParser& operator=(const XmlParser&) = delete;
  XmlParser(XmlParser&&) = delete;
  XmlParser& operator=(XmlParser&&) = delete;
  ~XmlParser();

  /// Calls a handler for each declaration of a namespace, before the start tag that has it.
  void on_namespace(OnNamespace handler);
  /// Parses the next piece.
  void feed(std::string_view piece);
  /// States that there are no more pieces.
  ///
  /// @errors   Error(Input) when elements are still open
  void finish();

 private:
  struct Parser;
  std::unique_ptr<Parser> parser_;
};

}  // namespace frangia
