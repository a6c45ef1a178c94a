#include "frangia/service/access_guard.h"

#include <algorithm>
#include <array>
#include <iterator>

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <sodium.h>

#include "frangia/core/error.h"

namespace frangia {

std::string hash_password(std::string_view password) {
  require(
      password.size() >= PasswordGuard::kLeastBytes && password.size() <= PasswordGuard::kMostBytes,
      fmt::format("a password has {} to {} bytes; choose another one",
                  PasswordGuard::kLeastBytes,
                  PasswordGuard::kMostBytes)
          .c_str());
  std::array<char, crypto_pwhash_STRBYTES> text{};
  if (sodium_init() < 0 || crypto_pwhash_str(text.data(),
                                             password.data(),
                                             password.size(),
                                             crypto_pwhash_OPSLIMIT_INTERACTIVE,
                                             crypto_pwhash_MEMLIMIT_INTERACTIVE) != 0)
    throw Error(ErrorKind::Device, "the password cannot be hashed: memory is short");
  return text.data();
}

bool PasswordGuard::admits(std::string_view password,
                           const std::string& address,
                           Clock::time_point now) {
  const std::lock_guard lock(mutex_);
  std::erase_if(tries_, [&](const auto& one) { return now - one.second.last > kMemory; });
  const auto known = tries_.find(address);
  if (known != tries_.end() && now < known->second.paused_until) {
    const auto left = std::chrono::ceil<std::chrono::seconds>(known->second.paused_until - now);
    throw TooManyTries(
        ErrorKind::Input,
        fmt::format("too many wrong passwords from {}; try again in {} s", address, left.count()));
  }
  const bool right = !hash_.empty() && password.size() <= kMostBytes && sodium_init() >= 0 &&
                     crypto_pwhash_str_verify(hash_.c_str(), password.data(), password.size()) == 0;
  if (right) {
    tries_.erase(address);
    return true;
  }
  if (known == tries_.end() && tries_.size() >= kMostAddresses) {
    tries_.erase(std::min_element(tries_.begin(), tries_.end(), [](const auto& a, const auto& b) {
      return a.second.last < b.second.last;
    }));
  }
  Tries& tries = tries_[address];
  tries.last = now;
  if (++tries.wrong < kFreeTries) return false;
  const int doublings = std::min(tries.wrong - kFreeTries, 10);
  tries.paused_until =
      now + std::min<std::chrono::seconds>(kLongestPause, kFirstPause * (1 << doublings));
  return false;
}

namespace {

/// An address without the port that some proxies write behind it: 1.2.3.4:5678, [2001:db8::1]:5678.
std::string without_port(const std::string& address) {
  if (address.starts_with('[')) return address.substr(1, address.find(']') - 1);
  const std::size_t colon = address.find(':');
  const bool has_port = colon != std::string::npos && address.rfind(':') == colon;
  return has_port ? address.substr(0, colon) : address;
}

/// An address in its usual form: an IPv4 address also where it is mapped into IPv6, the network of
/// an IPv6 address. This machine is one client, by whichever of its 16 million addresses
/// (127.0.0.0/8) it asks.
std::string plain_address(const std::string& address) {
  std::string plain = address.substr(0, INET6_ADDRSTRLEN);
  ::in6_addr number{};
  if (::inet_pton(AF_INET6, address.c_str(), &number) == 1) {
    std::array<char, INET6_ADDRSTRLEN> text{};
    constexpr std::size_t kNetworkBytes = 8;
    if (IN6_IS_ADDR_LOOPBACK(&number)) return "127.0.0.1";
    if (IN6_IS_ADDR_V4MAPPED(&number)) {
      ::inet_ntop(AF_INET, &number.s6_addr[12], text.data(), text.size());
      plain = text.data();
    } else {
      std::fill(std::begin(number.s6_addr) + kNetworkBytes, std::end(number.s6_addr), 0);
      ::inet_ntop(AF_INET6, &number, text.data(), text.size());
      return fmt::format("{}/64", text.data());
    }
  }
  ::in_addr short_number{};
  const bool is_here = ::inet_pton(AF_INET, plain.c_str(), &short_number) == 1 &&
                       (ntohl(short_number.s_addr) >> 24U) == IN_LOOPBACKNET;
  return is_here ? "127.0.0.1" : plain;
}

}  // namespace

std::string client_address(const std::string& peer,
                           const std::string& forwarded_for,
                           bool behind_proxy) {
  const std::string from = plain_address(peer);
  if (!behind_proxy || from != "127.0.0.1" || forwarded_for.empty()) return from;
  std::string address = forwarded_for.substr(forwarded_for.rfind(',') + 1);
  std::erase_if(address, [](char c) { return c == ' ' || c == '\t'; });
  return plain_address(without_port(address));
}

}  // namespace frangia
