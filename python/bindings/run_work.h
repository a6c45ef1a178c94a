// Long work: on a thread of its own, while the calling one passes on messages and heeds Ctrl-C.
#pragma once

#include <functional>
#include <optional>
#include <type_traits>

#include <pybind11/pybind11.h>

#include "frangia/core/run.h"

namespace frangia::python {

/// Calls `work` on another thread with the GIL released. Notes and warnings go to the logger
/// "frangia", progress to `progress(share, stage)` unless it is None. A signal that raises in
/// Python, such as Ctrl-C, or an exception of `progress` stops the work and leaves this function.
void run_work(const pybind11::object& progress, const std::function<void(const Run&)>& work);

/// The same for work with a result.
template <typename Work>
auto result_of(const pybind11::object& progress, const Work& work) {
  std::optional<std::invoke_result_t<Work, const Run&>> result;
  run_work(progress, [&](const Run& run) { result.emplace(work(run)); });
  return std::move(*result);
}

}  // namespace frangia::python
