#pragma once

#include <filesystem>
#include <string>

#include "frangia/core/error.h"

namespace frangia {

/// Does work with a file that arrived under a name of the server's own: an error of it names the
/// file as people know it. An empty name changes nothing.
template <typename Work>
auto naming(const std::filesystem::path& file, const std::string& name, const Work& work) {
  try {
    return work();
  } catch (const Error& error) {
    if (name.empty() || error.kind() == ErrorKind::Cancelled) throw;
    std::string text = error.what();
    for (const std::string& own : {file.string(), file.filename().string()}) {
      for (std::size_t at = text.find(own); at != std::string::npos;
           at = text.find(own, at + name.size()))
        text.replace(at, own.size(), name);
    }
    throw Error(error.kind(), text);
  }
}

}  // namespace frangia
