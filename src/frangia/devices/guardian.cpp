#include "frangia/devices/guardian.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <system_error>
#include <thread>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "frangia/devices/deadline.h"
#include "frangia/devices/internal/guardian_message.h"

namespace frangia {
namespace {

/// For the program to be loaded, also from a slow disk.
constexpr double kStart_s = 10.0;
/// For an idle process to end.
constexpr double kEnd_s = 1.0;

[[noreturn]] void fail_guardian(const std::string& what) {
  throw Error(
      ErrorKind::Device,
      fmt::format("the guardian process, which switches light off when the program dies, {}",
                  what));
}

/// Attributes and file actions of a process that holds nothing of this one but its socket.
class GuardianSpawn {
 public:
  explicit GuardianSpawn(int socket) {
    posix_spawnattr_init(&attributes_);
    sigset_t all;
    sigfillset(&all);
    posix_spawnattr_setsigmask(&attributes_, &all);
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSID | POSIX_SPAWN_SETSIGMASK);
    posix_spawn_file_actions_init(&actions_);
    posix_spawn_file_actions_adddup2(&actions_, socket, kGuardianSocket);
    // A reader of this program's output must see its end when this program ends.
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
      posix_spawn_file_actions_addopen(&actions_, stream, "/dev/null", O_RDWR, 0);
    posix_spawn_file_actions_addclosefrom_np(&actions_, kGuardianSocket + 1);
    posix_spawn_file_actions_addchdir_np(&actions_, "/");
  }
  GuardianSpawn(const GuardianSpawn&) = delete;
  GuardianSpawn& operator=(const GuardianSpawn&) = delete;
  GuardianSpawn(GuardianSpawn&&) = delete;
  GuardianSpawn& operator=(GuardianSpawn&&) = delete;
  ~GuardianSpawn() {
    posix_spawn_file_actions_destroy(&actions_);
    posix_spawnattr_destroy(&attributes_);
  }
  [[nodiscard]] pid_t start(GuardianProgram program) const {
    std::vector<char*> arguments;
    for (std::string& argument : program.arguments)
      arguments.push_back(argument.data());
    arguments.push_back(nullptr);
    pid_t process = -1;
    const int error = ::posix_spawn(
        &process, program.path.c_str(), &actions_, &attributes_, arguments.data(), environ);
    if (error != 0) {
      fail_guardian(fmt::format("cannot be started from {} ({})",
                                program.path.string(),
                                std::generic_category().message(error)));
    }
    return process;
  }

 private:
  posix_spawnattr_t attributes_{};
  posix_spawn_file_actions_t actions_{};
};

/// Sends one packet, with a file if `file` is not -1.
bool send_packet(int socket, const std::string& packet, int file = -1) {
  iovec data{const_cast<char*>(packet.data()), packet.size()};
  msghdr message{};
  message.msg_iov = &data;
  message.msg_iovlen = 1;
  alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(int))> control{};
  if (file >= 0) {
    message.msg_control = control.data();
    message.msg_controllen = control.size();
    cmsghdr* header = CMSG_FIRSTHDR(&message);
    header->cmsg_level = SOL_SOCKET;
    header->cmsg_type = SCM_RIGHTS;
    header->cmsg_len = CMSG_LEN(sizeof(int));
    std::memcpy(CMSG_DATA(header), &file, sizeof(int));
  }
  return ::sendmsg(socket, &message, MSG_NOSIGNAL) == static_cast<ssize_t>(packet.size());
}

std::string packet_of(const GuardianMessage& message, const SafeOff& how = {}) {
  std::string packet(sizeof(message), '\0');
  std::memcpy(packet.data(), &message, sizeof(message));
  return packet + how.end_command + how.off;
}

/// Waits until the process reports that it runs.
bool wait_for_byte(int socket) {
  const Deadline deadline = Deadline::in(kStart_s);
  while (!deadline.passed()) {
    pollfd waiting{socket, POLLIN, 0};
    constexpr int kPiece_ms = 100;
    if (::poll(&waiting, 1, kPiece_ms) <= 0) continue;
    char byte = 0;
    return ::recv(socket, &byte, 1, 0) == 1;
  }
  return false;
}

}  // namespace

Guardian::Watch::Watch(Watch&& other) noexcept
    : guardian_(std::exchange(other.guardian_, nullptr)), file_(other.file_) {}

Guardian::Watch& Guardian::Watch::operator=(Watch&& other) noexcept {
  if (this != &other) {
    if (guardian_ != nullptr) guardian_->release(file_);
    guardian_ = std::exchange(other.guardian_, nullptr);
    file_ = other.file_;
  }
  return *this;
}

Guardian::Watch::~Watch() {
  if (guardian_ != nullptr) guardian_->release(file_);
}

Guardian::~Guardian() {
  if (socket_ < 0) return;
  static_cast<void>(send_packet(socket_, packet_of({GuardianMessageKind::Farewell})));
  ::close(socket_);
  const Deadline deadline = Deadline::in(kEnd_s);
  while (::waitpid(process_, nullptr, WNOHANG) == 0 && !deadline.passed())
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

Guardian::Watch Guardian::watch(const SafeOff& how) {
  const GuardianMessage message{GuardianMessageKind::Watch,
                                how.file,
                                how.pause_s,
                                static_cast<std::uint32_t>(how.end_command.size()),
                                static_cast<std::uint32_t>(how.off.size())};
  const std::string packet = packet_of(message, how);
  if (how.file < 0 || packet.size() > kMaxGuardianMessage) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: the commands that switch it off are longer than {} bytes, or it "
                            "has no open line",
                            how.line,
                            kMaxGuardianMessage));
  }
  const std::scoped_lock lock(mutex_);
  if (socket_ < 0) start();
  if (!send_packet(socket_, packet, how.file)) fail_guardian("has ended; start the program again");
  ++watches_[how.file];
  return {this, how.file};
}

void Guardian::start() {
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) != 0)
    fail_guardian(fmt::format("has no socket ({})", std::generic_category().message(errno)));
  // Above the descriptors that the process gets, so that none of them is replaced.
  constexpr int kAbove = 10;
  const int other = ::fcntl(ends[1], F_DUPFD_CLOEXEC, kAbove);
  ::close(ends[1]);
  try {
    process_ = GuardianSpawn(other).start(program_);
  } catch (const Error&) {
    ::close(other);
    ::close(ends[0]);
    throw;
  }
  ::close(other);
  if (!wait_for_byte(ends[0])) {
    ::close(ends[0]);
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
    fail_guardian(fmt::format("does not start; check {}", program_.path.string()));
  }
  socket_ = ends[0];
}

void Guardian::release(int file) noexcept {
  const std::scoped_lock lock(mutex_);
  const auto found = watches_.find(file);
  if (found == watches_.end() || --found->second > 0) return;
  watches_.erase(found);
  GuardianMessage message{GuardianMessageKind::Release, file};
  try {
    static_cast<void>(send_packet(socket_, packet_of(message)));
  } catch (const std::bad_alloc&) {  // NOLINT(bugprone-empty-catch) it is released at the end
  }
}

}  // namespace frangia

// The guardian process. It writes no files and needs little memory, since the machine may be out of
// disk space or memory when the program that started it dies.
#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <exception>
#include <map>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <termios.h>
#include <unistd.h>

namespace frangia {
namespace {

constexpr double kSend_s = 1.0;  ///< for a device that takes no bytes
/// Until the device has processed the commands. The line must stay open: a network stack that
/// closes a connection with unread input drops what it has not yet sent.
constexpr double kProcess_s = 0.3;

struct HeldLine {
  int file = -1;
  double pause_s = 0.0;
  std::string end_command;
  std::string off;
};

int milliseconds_until(const Deadline& deadline) {
  const std::chrono::duration<double, std::milli> left = deadline.time - Deadline::Clock::now();
  return std::max(0, static_cast<int>(left.count()));
}

/// Reads and discards what the device sends, so that it does not wait for a reader.
void discard_for(int file, double seconds) {
  const Deadline deadline = Deadline::in(seconds);
  while (!deadline.passed()) {
    pollfd waiting{file, POLLIN, 0};
    if (::poll(&waiting, 1, milliseconds_until(deadline)) <= 0) continue;
    std::array<char, 1024> bytes{};
    const bool readable = (waiting.revents & POLLIN) != 0;
    if (!readable || ::read(file, bytes.data(), bytes.size()) <= 0) return;  // unplugged
  }
}

void send_bytes(int file, const std::string& bytes) {
  const Deadline deadline = Deadline::in(kSend_s);
  std::size_t sent = 0;
  while (sent < bytes.size() && !deadline.passed()) {
    const ssize_t count = ::write(file, bytes.data() + sent, bytes.size() - sent);
    if (count > 0) {
      sent += static_cast<std::size_t>(count);
      continue;
    }
    if (count < 0 && errno != EAGAIN && errno != EINTR) return;  // unplugged
    constexpr int kPiece_ms = 20;
    pollfd waiting{file, POLLOUT, 0};
    // The device takes nothing. Commands that wait for it are obsolete.
    if (::poll(&waiting, 1, kPiece_ms) == 0 && sent == 0 && ::isatty(file) != 0)
      ::tcflush(file, TCOFLUSH);
  }
}

void switch_off(const HeldLine& line) {
  // The program is dead: it no longer minds a file that does not block.
  ::fcntl(line.file, F_SETFL, ::fcntl(line.file, F_GETFL) | O_NONBLOCK);
  send_bytes(line.file, line.end_command);
  discard_for(line.file, line.pause_s);
  send_bytes(line.file, line.off);
  discard_for(line.file, kProcess_s);
  ::close(line.file);
}

void switch_all_off(const std::map<int, HeldLine>& lines) {
  std::vector<std::thread> threads;
  for (const auto& entry : lines) {
    const HeldLine& line = entry.second;
    try {
      threads.emplace_back([&line] { switch_off(line); });
    } catch (const std::exception&) {  // no further thread can be started
      switch_off(line);
    }
  }
  for (std::thread& thread : threads)
    thread.join();
}

/// The file that came with a message; -1 without one.
int file_in(msghdr& message) {
  const cmsghdr* header = CMSG_FIRSTHDR(&message);
  if (header == nullptr || header->cmsg_type != SCM_RIGHTS) return -1;
  int file = -1;
  std::memcpy(&file, CMSG_DATA(header), sizeof(file));
  return file;
}

/// Receives one message and updates the lines. False at the end of the connection.
bool receive_message(int socket, std::map<int, HeldLine>& lines, bool& farewell) {
  std::array<char, kMaxGuardianMessage> bytes{};
  alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(int))> control{};
  iovec data{bytes.data(), bytes.size()};
  msghdr packet{};
  packet.msg_iov = &data;
  packet.msg_iovlen = 1;
  packet.msg_control = control.data();
  packet.msg_controllen = control.size();
  const ssize_t count = ::recvmsg(socket, &packet, MSG_CMSG_CLOEXEC);
  if (count < 0 && errno == EINTR) return true;
  if (count < static_cast<ssize_t>(sizeof(GuardianMessage))) return false;
  GuardianMessage message;
  std::memcpy(&message, bytes.data(), sizeof(message));
  const int file = file_in(packet);
  const auto held = lines.find(message.key);
  if (held != lines.end()) {
    ::close(held->second.file);
    lines.erase(held);
  }
  if (message.kind == GuardianMessageKind::Farewell) farewell = true;
  const std::size_t size = sizeof(message) + message.end_size + message.off_size;
  if (message.kind == GuardianMessageKind::Watch && file >= 0 &&
      size == static_cast<std::size_t>(count)) {
    const char* text = bytes.data() + sizeof(message);
    lines[message.key] = {file,
                          message.pause_s,
                          std::string(text, message.end_size),
                          std::string(text + message.end_size, message.off_size)};
  }
  return !farewell;
}

}  // namespace

int run_guardian(int socket) {
  int type = 0;
  socklen_t size = sizeof(type);
  constexpr int kNotAGuardian = 2;
  if (::getsockopt(socket, SOL_SOCKET, SO_TYPE, &type, &size) != 0 || type != SOCK_SEQPACKET)
    return kNotAGuardian;
  const char ready = 1;
  if (::send(socket, &ready, 1, MSG_NOSIGNAL) != 1) return 0;
  std::map<int, HeldLine> lines;
  bool farewell = false;
  while (receive_message(socket, lines, farewell)) {
  }
  if (!farewell) switch_all_off(lines);
  return 0;
}

}  // namespace frangia
