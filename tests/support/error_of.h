#pragma once

#include <string>

#include "frangia/core/error.h"

namespace frangia::testing {

/// The sentence of the Error that `action` throws; empty when it throws none.
template <typename Do>
std::string error_of(const Do& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

}  // namespace frangia::testing
