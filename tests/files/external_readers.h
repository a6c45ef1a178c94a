#pragma once

#include <array>
#include <cstdio>
#include <filesystem>
#include <string>

#include <sys/wait.h>

namespace frangia::testing {

/// The output of a program and whether it succeeded.
struct ReaderAnswer {
  bool succeeded = false;
  std::string text;
};

inline ReaderAnswer ask(const std::string& command) {
  ReaderAnswer answer;
  std::FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
  std::array<char, 4096> piece{};
  while (const std::size_t got = std::fread(piece.data(), 1, piece.size(), pipe))
    answer.text.append(piece.data(), got);
  answer.succeeded = ::pclose(pipe) == 0;
  return answer;
}

inline bool have_ezdxf() {
  return ask("/usr/bin/python3 -c 'import ezdxf'").succeeded;
}
inline bool have_assimp() {
  return ask("assimp version").succeeded;
}

inline ReaderAnswer ask_ezdxf(const std::filesystem::path& dxf) {
  return ask("/usr/bin/python3 " FRANGIA_SOURCE_DIR "/tests/files/check_ezdxf.py " + dxf.string());
}
inline ReaderAnswer ask_libdime(const std::filesystem::path& dxf) {
  return ask(FRANGIA_CHECK_LIBDIME " " + dxf.string());
}

inline bool have_3mf() {
  return ask("/usr/bin/python3 -c 'import ctypes; ctypes.CDLL(\"lib3MF.so.1\")'").succeeded;
}
inline ReaderAnswer ask_3mf(const std::filesystem::path& path) {
  return ask("/usr/bin/python3 " FRANGIA_SOURCE_DIR "/tests/files/check_3mf.py " + path.string());
}
inline bool have_admesh() {
  return ask("admesh --version").succeeded;
}
inline bool have_numpy() {
  return ask("/usr/bin/python3 -c 'import numpy'").succeeded;
}
inline bool have_pcl() {
  return ask("/usr/bin/python3 -c 'import pcl'").succeeded;
}

/// The number of faces that assimp finds in a file; -1 when it cannot read it.
inline int assimp_faces(const std::filesystem::path& path) {
  const ReaderAnswer answer = ask("assimp info " + path.string());
  const std::size_t line = answer.text.find("\nFaces:");
  if (!answer.succeeded || line == std::string::npos) return -1;
  return std::stoi(answer.text.substr(line + 7));
}

}  // namespace frangia::testing
