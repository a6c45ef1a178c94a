#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "frangia/cad/internal/occt_translate.h"
#include "frangia/cad/internal/separate_process.h"

namespace frangia {

/// The answer of the second process as it goes through the pipe: messages of a letter, a size of
/// eight bytes and that many bytes.

/// Passes on the head of the answer, its shape where there is one, and its end. Returns false once
/// `send` does.
bool send_answer(const CadTranslation& said,
                 std::string_view shape,
                 const std::function<bool(std::string_view)>& send);

/// Reads an answer, in which every size is checked. The shape takes over the memory of `bytes`.
///
/// @missing  none where the answer is cut short or of another form
[[nodiscard]] std::optional<TranslatedCad> parsed_answer(std::string bytes);

}  // namespace frangia
