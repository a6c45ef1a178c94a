#include "frangia/core/open_below.h"

#include <array>
#include <cerrno>
#include <system_error>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include "frangia/core/check_nesting.h"
#include "frangia/core/error.h"

namespace frangia {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse_below(const fs::path& path, const std::string& what) {
  throw Error(ErrorKind::Input, fmt::format("{}: {}", path.c_str(), what));  // up to a NUL
}

/// The components of a path that stays inside.
std::vector<std::string> components_of(const fs::path& folder, const fs::path& inner) {
  std::vector<std::string> components;
  const std::string text = inner.generic_string();
  if (inner.is_absolute() || text.find('\0') != std::string::npos)
    refuse_below(folder / inner.relative_path(), "leads out of its folder; name a file inside");
  for (const fs::path& part : inner) {
    const std::string name = part.string();
    if (name == "..") refuse_below(folder / inner, "leads out of its folder; name a file inside");
    if (!name.empty() && name != ".") components.push_back(name);
  }
  if (components.empty()) refuse_below(folder, "is a folder; name a file inside");
  return components;
}

[[noreturn]] void refuse_link(int folder, const std::string& name, const fs::path& shown) {
  std::array<char, 4096> target{};
  const auto count = ::readlinkat(folder, name.c_str(), target.data(), target.size() - 1);
  refuse_below(
      shown,
      fmt::format("is a link to {}, and links in a scan, in a project and beside a rig are not "
                  "followed; put the files themselves here, or bind-mount the other disk here",
                  count > 0 ? target.data() : "another place"));
}

[[noreturn]] void refuse_error(int error, const fs::path& shown) {
  if (error == ENOENT || error == ENOTDIR) refuse_below(shown, "does not exist; check the path");
  refuse_below(shown, fmt::format("cannot be opened: {}", std::generic_category().message(error)));
}

/// Whether a name in an open folder is a link; it may be anything else, or missing.
///
/// @errors   Error(Input) when the system does not say what it is
bool is_link(int folder, const std::string& name, const fs::path& shown) {
  struct ::stat state {};
  if (::fstatat(folder, name.c_str(), &state, AT_SYMLINK_NOFOLLOW) == 0)
    return S_ISLNK(state.st_mode);
  if (errno != ENOENT) refuse_error(errno, shown);
  return false;
}

/// The path without "." and doubled slashes, for messages.
fs::path joined(fs::path folder, const std::vector<std::string>& components) {
  for (const std::string& component : components)
    folder /= component;
  return folder;
}

/// A folder on the way: opened, missing, or neither a folder nor a link.
struct BelowStep {
  FileDescriptor folder;
  int error = 0;
};

/// Goes from an open folder to one in it.
BelowStep step_into(int from, const std::string& name, const fs::path& shown) {
  constexpr int kFlags = O_PATH | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC;
  BelowStep step;
  step.folder = FileDescriptor(::openat(from, name.c_str(), kFlags));  // NOLINT(*-vararg)
  if (step.folder.is_open()) return step;
  step.error = errno;
  if (is_link(from, name, shown)) refuse_link(from, name, shown);
  return step;
}

/// The folder of the last component, or the error that ended the way to it.
BelowStep walk_below(const fs::path& folder, const std::vector<std::string>& components) {
  BelowStep step;
  step.folder =
      FileDescriptor(::open(folder.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));  // NOLINT(*-vararg)
  if (!step.folder.is_open()) step.error = errno;
  fs::path shown = folder;
  for (std::size_t i = 0; step.error == 0 && i + 1 < components.size(); ++i) {
    shown /= components[i];
    step = step_into(step.folder.number(), components[i], shown);
  }
  return step;
}

const char* kind_of_mode(::mode_t mode) {
  if (S_ISDIR(mode)) return "a folder";
  if (S_ISFIFO(mode)) return "a named pipe";
  if (S_ISSOCK(mode)) return "a socket";
  return "a device";
}

}  // namespace

FileDescriptor open_below(const fs::path& folder, const fs::path& inner, OpenFor use) {
  const std::vector<std::string> components = components_of(folder, inner);
  const fs::path shown = joined(folder, components);
  const BelowStep last = walk_below(folder, components);
  if (last.error != 0) refuse_error(last.error, shown);
  constexpr int kCommon = O_NOFOLLOW | O_NONBLOCK | O_NOCTTY | O_CLOEXEC;
  const int flags = use == OpenFor::Reading ? O_RDONLY : O_WRONLY | O_APPEND | O_CREAT;
  FileDescriptor file(::openat(  // NOLINT(*-vararg)
      last.folder.number(),
      components.back().c_str(),
      flags | kCommon,
      0666));
  const int error = errno;
  struct ::stat state {};
  const bool known =
      file.is_open()
          ? ::fstat(file.number(), &state) == 0
          : ::fstatat(
                last.folder.number(), components.back().c_str(), &state, AT_SYMLINK_NOFOLLOW) == 0;
  if (known && S_ISLNK(state.st_mode)) refuse_link(last.folder.number(), components.back(), shown);
  if (known && !S_ISREG(state.st_mode))
    refuse_below(shown, fmt::format("is {}, not a file; replace it", kind_of_mode(state.st_mode)));
  if (!file.is_open() || !known) refuse_error(error, shown);
  if (use == OpenFor::Appending && state.st_nlink > 1)
    refuse_below(shown, "has another name (a hard link), under which it would change; remove it");
  return file;
}

fs::path path_below(const fs::path& folder, const fs::path& inner) {
  const std::vector<std::string> components = components_of(folder, inner);
  const fs::path shown = joined(folder, components);
  const BelowStep last = walk_below(folder, components);
  if (last.error == ENOENT || last.error == ENOTDIR) return shown;
  if (last.error != 0) refuse_error(last.error, shown);
  if (is_link(last.folder.number(), components.back(), shown))
    refuse_link(last.folder.number(), components.back(), shown);
  return shown;
}

std::string read_below(const fs::path& folder, const fs::path& inner, std::uint64_t max_bytes) {
  const FileDescriptor file = open_below(folder, inner);
  const fs::path shown = joined(folder, components_of(folder, inner));
  struct ::stat state {};
  if (::fstat(file.number(), &state) != 0) refuse_below(shown, "cannot be read; check the disk");
  const auto size = static_cast<std::uint64_t>(state.st_size);
  if (size > max_bytes) {
    refuse_below(
        shown,
        fmt::format("has {} bytes, more than the {} of the largest file of its kind; check that "
                    "it is the right file",
                    size,
                    max_bytes));
  }
  std::string text(static_cast<std::size_t>(size), '\0');
  std::size_t done = 0;
  while (done < text.size()) {
    const ::ssize_t got = ::read(file.number(), text.data() + done, text.size() - done);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) refuse_below(shown, "cannot be read; check the disk");
    if (got == 0) break;  // another process shortened the file
    done += static_cast<std::size_t>(got);
  }
  text.resize(done);
  return text;
}

std::string read_json_below(const std::filesystem::path& folder,
                            const std::filesystem::path& inner,
                            std::uint64_t max_bytes) {
  std::string text = read_below(folder, inner, max_bytes);
  check_json_nesting(text, folder / inner);
  return text;
}

}  // namespace frangia
