#pragma once

#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <functional>
#include <mutex>
#include <string>
#include <utility>

#include <dlfcn.h>
#include <fcntl.h>
#include <limits.h>  // NOLINT(modernize-deprecated-headers): PATH_MAX is POSIX
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

#include "support/certain_disk.h"

// A program that includes this header defines functions which it and its libraries then call
// instead of those of the C library.

namespace frangia::testing {

/// A fault of the file system below one folder. Only what changes files counts: creating, writing,
/// syncing, renaming and removing them.
class FileFault {
 public:
  /// `at`: number of the operation, from 0, at which the fault begins. `what` is called then, on
  /// the thread of the operation; it returns an errno, or 0 to let the operation go on. With
  /// `lasting`, it is called for every later one as well.
  FileFault(std::string folder, std::size_t at, bool lasting, std::function<int()> what)
      : folder_(std::move(folder)), at_(at), lasting_(lasting), what_(std::move(what)) {
    const std::lock_guard lock(mutex());
    present() = this;
  }
  FileFault(const FileFault&) = delete;
  FileFault& operator=(const FileFault&) = delete;
  FileFault(FileFault&&) = delete;
  FileFault& operator=(FileFault&&) = delete;
  ~FileFault() {
    const std::lock_guard lock(mutex());
    present() = nullptr;
  }

  /// Operations so far.
  [[nodiscard]] std::size_t count() const { return count_; }

  /// Follows what a disk holds for certain below a folder; null ends that.
  static void follow(std::string folder, CertainDisk* disk) {
    const std::lock_guard lock(mutex());
    followed() = {std::move(folder), disk};
  }
  static void created(const char* path) { note(path, &CertainDisk::create); }
  static void synced(int file) {
    {
      const std::lock_guard lock(mutex());
      if (followed().second == nullptr || inside()) return;
    }
    note(path_of(file).c_str(), &CertainDisk::sync);
  }

  /// Whether an operation on a path fails; errno says why.
  static bool strikes(const char* path) {
    const std::lock_guard lock(mutex());
    FileFault* fault = present();
    if (fault == nullptr || path == nullptr || inside()) return false;
    if (std::strncmp(path, fault->folder_.c_str(), fault->folder_.size()) != 0) return false;
    const std::size_t number = fault->count_++;
    if (number < fault->at_ || (number > fault->at_ && !fault->lasting_)) return false;
    inside() = true;  // what it does to files is no operation
    const int error = fault->what_();
    inside() = false;
    errno = error;
    return error != 0;
  }
  static bool strikes(int file) {
    {
      const std::lock_guard lock(mutex());
      if (present() == nullptr || inside()) return false;
    }
    return strikes(path_of(file).c_str());
  }

 private:
  static std::string path_of(int file) {
    char link[64];
    char path[PATH_MAX];
    std::snprintf(link, sizeof link, "/proc/self/fd/%d", file);
    const ::ssize_t length = ::readlink(link, path, sizeof path);
    return length <= 0 ? std::string() : std::string(path, static_cast<std::size_t>(length));
  }
  static void note(const char* path, void (CertainDisk::*what)(const std::filesystem::path&)) {
    const std::lock_guard lock(mutex());
    const auto& [folder, disk] = followed();
    if (disk == nullptr || path == nullptr || inside()) return;
    if (std::strncmp(path, folder.c_str(), folder.size()) != 0) return;
    inside() = true;
    (disk->*what)(path);
    inside() = false;
  }
  static std::pair<std::string, CertainDisk*>& followed() {
    static std::pair<std::string, CertainDisk*> one;
    return one;
  }
  static std::recursive_mutex& mutex() {
    static std::recursive_mutex one;
    return one;
  }
  static FileFault*& present() {
    static FileFault* one = nullptr;
    return one;
  }
  static bool& inside() {
    thread_local bool now = false;
    return now;
  }

  std::string folder_;
  std::size_t at_;
  bool lasting_;
  std::function<int()> what_;
  std::atomic<std::size_t> count_ = 0;
};

template <typename Function>
Function* real(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));  // NOLINT(*-reinterpret-cast)
}

}  // namespace frangia::testing

// Weak, so that several sources of a program may hold them. The names for the compiler differ from
// those for the linker: the headers of the C library declare theirs with other exceptions and
// attributes.
extern "C" {
// NOLINTBEGIN(*-vararg, *-identifier-naming)
int faulty_open(const char* path, int flags, ...) __asm__("open") __attribute__((weak));
int faulty_open64(const char* path, int flags, ...) __asm__("open64") __attribute__((weak));
std::FILE* faulty_fopen64(const char* path, const char* mode) __asm__("fopen64")
    __attribute__((weak));
::ssize_t faulty_write(int file, const void* bytes, std::size_t size) __asm__("write")
    __attribute__((weak));
::ssize_t faulty_writev(int file, const ::iovec* parts, int count) __asm__("writev")
    __attribute__((weak));
int faulty_fsync(int file) __asm__("fsync") __attribute__((weak));
int faulty_rename(const char* from, const char* to) __asm__("rename") __attribute__((weak));
int faulty_mkdir(const char* path, ::mode_t mode) __asm__("mkdir") __attribute__((weak));
int faulty_remove(const char* path) __asm__("remove") __attribute__((weak));
int faulty_unlink(const char* path) __asm__("unlink") __attribute__((weak));

inline int open_unless_faulty(const char* name, const char* path, int flags, ::mode_t mode) {
  if ((flags & O_CREAT) != 0 && frangia::testing::FileFault::strikes(path)) return -1;
  const int file = frangia::testing::real<int(const char*, int, ...)>(name)(path, flags, mode);
  if (file >= 0 && (flags & O_EXCL) != 0) frangia::testing::FileFault::created(path);
  return file;
}
int faulty_open(const char* path, int flags, ...) {
  std::va_list list;
  va_start(list, flags);
  const ::mode_t mode = (flags & O_CREAT) != 0 ? va_arg(list, ::mode_t) : 0;
  va_end(list);
  return open_unless_faulty("open", path, flags, mode);
}
int faulty_open64(const char* path, int flags, ...) {
  std::va_list list;
  va_start(list, flags);
  const ::mode_t mode = (flags & O_CREAT) != 0 ? va_arg(list, ::mode_t) : 0;
  va_end(list);
  return open_unless_faulty("open64", path, flags, mode);
}
std::FILE* faulty_fopen64(const char* path, const char* mode) {
  const bool writes = std::strpbrk(mode, "wa+") != nullptr;
  if (writes && frangia::testing::FileFault::strikes(path)) return nullptr;
  static auto* const next = frangia::testing::real<std::FILE*(const char*, const char*)>("fopen64");
  return next(path, mode);
}
::ssize_t faulty_write(int file, const void* bytes, std::size_t size) {
  static auto* const next =
      frangia::testing::real<::ssize_t(int, const void*, std::size_t)>("write");
  return frangia::testing::FileFault::strikes(file) ? -1 : next(file, bytes, size);
}
::ssize_t faulty_writev(int file, const ::iovec* parts, int count) {
  static auto* const next = frangia::testing::real<::ssize_t(int, const ::iovec*, int)>("writev");
  return frangia::testing::FileFault::strikes(file) ? -1 : next(file, parts, count);
}
int faulty_fsync(int file) {
  static auto* const next = frangia::testing::real<int(int)>("fsync");
  if (frangia::testing::FileFault::strikes(file) || next(file) != 0) return -1;
  frangia::testing::FileFault::synced(file);
  return 0;
}
int faulty_rename(const char* from, const char* to) {
  static auto* const next = frangia::testing::real<int(const char*, const char*)>("rename");
  return frangia::testing::FileFault::strikes(to) ? -1 : next(from, to);
}
int faulty_mkdir(const char* path, ::mode_t mode) {
  static auto* const next = frangia::testing::real<int(const char*, ::mode_t)>("mkdir");
  if (frangia::testing::FileFault::strikes(path) || next(path, mode) != 0) return -1;
  frangia::testing::FileFault::created(path);
  return 0;
}
int faulty_remove(const char* path) {
  static auto* const next = frangia::testing::real<int(const char*)>("remove");
  return frangia::testing::FileFault::strikes(path) ? -1 : next(path);
}
int faulty_unlink(const char* path) {
  static auto* const next = frangia::testing::real<int(const char*)>("unlink");
  return frangia::testing::FileFault::strikes(path) ? -1 : next(path);
}
// NOLINTEND(*-vararg, *-identifier-naming)
}
