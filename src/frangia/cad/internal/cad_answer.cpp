#include "frangia/cad/internal/cad_answer.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include "frangia/cad/internal/pmi_record.h"

namespace frangia {
namespace {

enum Kind : char {
  kUnit = 'u',
  kWarning = 'w',
  kGraphics = 'g',
  kRequirement = 'r',
  kError = 'e',
  kShape = 's',
  kEnd = 'z'
};

constexpr std::size_t kHeadBytes = 1 + sizeof(std::uint64_t);
constexpr std::size_t kMaxText = 300;
constexpr std::size_t kMaxWarnings = 20;
constexpr std::size_t kMaxRequirements = 2000;

/// A text that may come from the file: what a terminal could take for a command is replaced.
std::string plain(std::string_view text) {
  std::string out(text.substr(0, kMaxText));
  for (char& letter : out)
    if (letter < ' ' || letter > '~') letter = '?';
  return out;
}

std::string head_of(Kind kind, std::uint64_t size) {
  std::string head(kHeadBytes, kind);
  std::memcpy(head.data() + 1, &size, sizeof size);
  return head;
}

}  // namespace

bool send_answer(const CadTranslation& said,
                 std::string_view shape,
                 const std::function<bool(std::string_view)>& send) {
  const auto send_text = [&](Kind kind, const std::string& text) {
    return send(head_of(kind, text.size()) + text);
  };
  if (!send_text(kUnit, plain(said.unit))) return false;
  for (std::size_t i = 0; i < std::min(said.warnings.size(), kMaxWarnings); ++i)
    if (!send_text(kWarning, plain(said.warnings[i]))) return false;
  if (said.pmi.has_graphics && !send_text(kGraphics, {})) return false;
  for (std::size_t i = 0; i < std::min(said.pmi.requirements.size(), kMaxRequirements); ++i) {
    const std::string record = pmi_record(said.pmi.requirements[i]);
    if (record.size() <= kMaxText && !send_text(kRequirement, record)) return false;
  }
  if (!said.error.empty()) return send_text(kError, plain(said.error)) && send_text(kEnd, {});
  return send(head_of(kShape, shape.size())) && send(shape) && send_text(kEnd, {});
}

std::optional<TranslatedCad> parsed_answer(std::string bytes) {
  TranslatedCad found;
  std::size_t shape_at = 0;
  std::size_t shape_size = 0;
  bool has_content = false;
  for (std::size_t at = 0;;) {
    if (bytes.size() - at < kHeadBytes) return std::nullopt;
    const char kind = bytes[at];
    std::uint64_t size = 0;
    std::memcpy(&size, bytes.data() + at + 1, sizeof size);
    at += kHeadBytes;
    if (size > bytes.size() - at || (kind != kShape && size > kMaxText)) return std::nullopt;
    const std::string_view content = std::string_view(bytes).substr(at, size);
    at += size;
    if (kind == kEnd) {
      if (!has_content || at != bytes.size()) return std::nullopt;
      break;
    }
    if (has_content) return std::nullopt;  // only the end follows
    if (kind == kUnit) {
      found.said.unit = plain(content);
    } else if (kind == kWarning) {
      if (found.said.warnings.size() == kMaxWarnings) return std::nullopt;
      found.said.warnings.push_back(plain(content));
    } else if (kind == kGraphics) {
      found.said.pmi.has_graphics = true;
    } else if (kind == kRequirement) {
      auto requirement = parsed_pmi_record(content);
      if (!requirement || found.said.pmi.requirements.size() == kMaxRequirements)
        return std::nullopt;
      found.said.pmi.requirements.push_back(std::move(*requirement));
    } else if (kind == kError && size > 0) {
      found.said.error = plain(content);
      has_content = true;
    } else if (kind == kShape && size > 0) {
      shape_at = at - size;
      shape_size = size;
      has_content = true;
    } else {
      return std::nullopt;
    }
  }
  bytes.resize(shape_at + shape_size);
  bytes.erase(0, shape_at);
  found.shape.str(std::move(bytes));
  return found;
}

}  // namespace frangia
