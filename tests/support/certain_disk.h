#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <mutex>
#include <string>
#include <utility>

#include <sys/stat.h>

namespace frangia::testing {

/// What a disk holds for certain after a power cut, as POSIX defines it: of a file the bytes at its
/// last fsync, of a folder the names at its last fsync.
class CertainDisk {
 public:
  /// All that is below a folder is certain from now on, but for a folder in it that is left out.
  CertainDisk(std::filesystem::path root, std::string without)
      : root_(std::move(root)), without_(std::move(without)) {
    for (const auto& top : std::filesystem::directory_iterator(root_)) {
      if (top.path().filename() == without_) continue;
      sync(top.path());
      if (!top.is_directory()) continue;
      for (const auto& entry : std::filesystem::recursive_directory_iterator(top.path()))
        sync(entry.path());
    }
    sync(root_);
  }

  /// A file or folder was synced.
  void sync(const std::filesystem::path& path) {
    const std::lock_guard lock(mutex_);
    if (!std::filesystem::is_directory(path)) {
      std::ifstream stream(path, std::ios::binary);
      bytes_[node_of(path)] = {std::istreambuf_iterator<char>(stream), {}};
      return;
    }
    names_[node_of(path)] = names_in(path);
  }
  /// A new file or folder may have the number of one that was removed here, and that the disk holds
  /// as long as a name of it is certain.
  void create(const std::filesystem::path& path) {
    const std::lock_guard lock(mutex_);
    ++lives_[number_of(path)];
  }
  /// Writes what is certain. With `all_names`, changes of names have arrived as well, as they may.
  void write_to(const std::filesystem::path& folder, bool all_names) {
    const std::lock_guard lock(mutex_);
    std::filesystem::remove_all(folder);
    write(node_of(root_), root_, folder, all_names);
  }

 private:
  /// A file or folder: its number, and how many had that before.
  using Node = std::pair<::ino_t, int>;
  struct Name {
    Node node;
    bool folder = false;
  };
  using Names = std::map<std::string, Name>;

  static ::ino_t number_of(const std::filesystem::path& path) {
    struct ::stat state {};
    return ::lstat(path.c_str(), &state) == 0 ? state.st_ino : 0;
  }
  [[nodiscard]] Node node_of(const std::filesystem::path& path) const {
    const ::ino_t number = number_of(path);
    const auto known = lives_.find(number);
    return {number, known == lives_.end() ? 0 : known->second};
  }
  [[nodiscard]] Names names_in(const std::filesystem::path& folder) const {
    Names names;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
      names[entry.path().filename().string()] = {node_of(entry.path()), entry.is_directory()};
    return names;
  }
  void write(const Node& node,
             const std::filesystem::path& present,
             const std::filesystem::path& target,
             bool all_names) const {
    std::filesystem::create_directories(target);
    Names names;
    if (all_names && std::filesystem::is_directory(present)) {
      names = names_in(present);
    } else if (const auto known = names_.find(node); known != names_.end()) {
      names = known->second;
    }
    for (const auto& [name, one] : names) {
      if (name == without_) continue;
      if (one.folder) {
        write(one.node, present / name, target / name, all_names);
        continue;
      }
      std::ofstream stream(target / name, std::ios::binary);
      if (const auto known = bytes_.find(one.node); known != bytes_.end()) stream << known->second;
    }
  }

  std::filesystem::path root_;
  std::string without_;
  std::mutex mutex_;
  std::map<::ino_t, int> lives_;
  std::map<Node, std::string> bytes_;
  std::map<Node, Names> names_;
};

}  // namespace frangia::testing
