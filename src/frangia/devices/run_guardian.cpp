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

#include "frangia/devices/deadline.h"
#include "frangia/devices/guardian.h"
#include "frangia/devices/internal/guardian_message.h"

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
