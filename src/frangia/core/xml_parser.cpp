#include "frangia/core/xml_parser.h"

#include <cstdint>
#include <exception>
#include <new>

#include <expat.h>
#include <fmt/format.h>

#include "frangia/core/error.h"

namespace frangia {

struct XmlParser::Parser {
  XML_Parser parser = XML_ParserCreateNS("UTF-8", '|');
  OnBegin on_begin;
  OnEnd on_end;
  OnText on_text;
  OnNamespace on_namespace;
  std::exception_ptr thrown;
  std::int64_t fed = 0;  ///< bytes

  /// Keeps exceptions from unwinding through the C library, which may still call a handler after
  /// one: the end of an empty element.
  template <typename Work>
  void guard(const Work& work) {
    if (thrown) return;
    try {
      work();
    } catch (...) {
      thrown = std::current_exception();
      XML_StopParser(parser, XML_FALSE);
    }
  }

  static Parser& of(void* self) { return *static_cast<Parser*>(self); }
  static void begin(void* self, const char* name, const char** attributes) {
    of(self).guard([&] { of(self).on_begin(name, XmlAttributes(attributes)); });
  }
  static void end(void* self, const char* name) {
    of(self).guard([&] { of(self).on_end(name); });
  }
  static void text(void* self, const char* piece, int size) {
    of(self).guard([&] { of(self).on_text({piece, static_cast<std::size_t>(size)}); });
  }
  static void declare(void* self, const char* prefix, const char* uri) {
    of(self).guard(
        [&] { of(self).on_namespace(prefix == nullptr ? "" : prefix, uri == nullptr ? "" : uri); });
  }
  static void doctype(void* self,
                      const char* /*name*/,
                      const char* /*system*/,
                      const char* /*open*/,
                      int /*inside*/) {
    of(self).guard([] {
      throw Error(ErrorKind::Input,
                  "its XML declares a document type, whose entities can expand without bound; "
                  "export it again");
    });
  }

  /// An element that is longer than this is not XML of a mesh. Expat would parse it from its start
  /// again with each piece.
  static constexpr std::int64_t kMaxElementBytes = 4'000'000;

  void feed(std::string_view piece, bool last) {
    const XML_Status status =
        XML_Parse(parser, piece.data(), static_cast<int>(piece.size()), last ? 1 : 0);
    if (thrown) std::rethrow_exception(std::exchange(thrown, nullptr));
    fed += static_cast<std::int64_t>(piece.size());
    if (status == XML_STATUS_OK && fed - XML_GetCurrentByteIndex(parser) > kMaxElementBytes) {
      throw Error(ErrorKind::Input,
                  fmt::format("its XML has an element of more than {} bytes in line {}; export it "
                              "again",
                              kMaxElementBytes,
                              XML_GetCurrentLineNumber(parser)));
    }
    if (status == XML_STATUS_OK) return;
    throw Error(ErrorKind::Input,
                fmt::format("its XML is invalid in line {}: {}",
                            XML_GetCurrentLineNumber(parser),
                            XML_ErrorString(XML_GetErrorCode(parser))));
  }
};

std::string_view XmlAttributes::value(std::string_view name) const {
  for (const char** pair = pairs_; *pair != nullptr; pair += 2)
    if (name == pair[0]) return pair[1];
  return {};
}

XmlParser::XmlParser(OnBegin on_begin, OnEnd on_end, OnText on_text)
    : parser_(std::make_unique<Parser>()) {
  if (parser_->parser == nullptr) throw std::bad_alloc();
  parser_->on_begin = std::move(on_begin);
  parser_->on_end = std::move(on_end);
  parser_->on_text = std::move(on_text);
  XML_SetUserData(parser_->parser, parser_.get());
  XML_SetElementHandler(parser_->parser, Parser::begin, Parser::end);
  if (parser_->on_text) XML_SetCharacterDataHandler(parser_->parser, Parser::text);
  XML_SetStartDoctypeDeclHandler(parser_->parser, Parser::doctype);
}

XmlParser::~XmlParser() {
  XML_ParserFree(parser_->parser);
}

void XmlParser::on_namespace(OnNamespace handler) {
  parser_->on_namespace = std::move(handler);
  XML_SetStartNamespaceDeclHandler(parser_->parser, Parser::declare);
}

void XmlParser::feed(std::string_view piece) {
  parser_->feed(piece, false);
}

void XmlParser::finish() {
  parser_->feed({}, true);
}

}  // namespace frangia
