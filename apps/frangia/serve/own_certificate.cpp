#include "own_certificate.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <openssl/bio.h>
#include <openssl/err.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/rand.h>
#include <openssl/x509.h>
#include <openssl/x509v3.h>
#include <unistd.h>

#include "frangia/core/durable_file.h"
#include "frangia/core/error.h"
#include "frangia/core/read_file.h"

namespace frangia {
namespace {

constexpr long kDay_s = 24L * 60 * 60;
/// Apple's devices take no certificate for longer than 825 days.
constexpr long kValid_s = 800 * kDay_s;
/// Clocks of tablets may be late.
constexpr long kBefore_s = kDay_s;
/// A certificate that is over so soon is replaced.
constexpr long kLeast_s = 30 * kDay_s;

template <auto release>
struct Release {
  template <class T>
  void operator()(T* held) const {
    release(held);
  }
};
template <class T, auto release>
using Held = std::unique_ptr<T, Release<release>>;
using HeldBio = Held<BIO, BIO_free_all>;
using HeldKey = Held<EVP_PKEY, EVP_PKEY_free>;
using HeldCertificate = Held<X509, X509_free>;
using HeldExtension = Held<X509_EXTENSION, X509_EXTENSION_free>;

/// Throws where a function of OpenSSL has not done what it should.
void check(bool done) {
  if (done) return;
  ERR_clear_error();
  throw Error(ErrorKind::Device,
              "no certificate can be made for this machine; connect without encryption");
}

/// The name of this machine in certificates; empty where it has none that is a name of DNS.
std::string host_name() {
  std::array<char, 256> name{};
  if (::gethostname(name.data(), name.size() - 1) != 0) return {};
  const std::string text(name.data());
  const bool plain = std::all_of(text.begin(), text.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
           c == '.';
  });
  return plain ? text : std::string();
}

void add_extension(X509* certificate, int kind, const std::string& value) {
  X509V3_CTX context{};
  X509V3_set_ctx(&context, certificate, certificate, nullptr, nullptr, 0);
  const HeldExtension extension(X509V3_EXT_conf_nid(nullptr, &context, kind, value.c_str()));
  check(extension && X509_add_ext(certificate, extension.get(), -1) == 1);
}

std::string text_in(BIO* memory) {
  std::string text;
  std::array<char, 1024> block{};
  for (int count = 0; (count = BIO_read(memory, block.data(), static_cast<int>(block.size()))) > 0;)
    text.append(block.data(), static_cast<std::size_t>(count));
  return text;
}

std::string fingerprint_of(const X509* certificate) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned length = 0;
  check(X509_digest(certificate, EVP_sha256(), digest.data(), &length) == 1);
  return fmt::format("{:02X}", fmt::join(digest.begin(), digest.begin() + length, ":"));
}

/// The certificate and the key in a text, unless they are damaged or not valid any more.
std::optional<OwnCertificate> certificate_in(const std::string& pem, std::time_t now) {
  const HeldBio memory(BIO_new_mem_buf(pem.data(), static_cast<int>(pem.size())));
  check(memory != nullptr);
  // Without this function OpenSSL would ask at the terminal for the password of a key.
  const auto no_password = [](char*, int, int, void*) { return -1; };
  const HeldCertificate certificate(PEM_read_bio_X509(memory.get(), nullptr, no_password, nullptr));
  const HeldKey key(
      certificate ? PEM_read_bio_PrivateKey(memory.get(), nullptr, no_password, nullptr) : nullptr);
  ERR_clear_error();
  if (!certificate || !key) return std::nullopt;
  const bool fits = X509_check_private_key(certificate.get(), key.get()) == 1;
  ERR_clear_error();
  std::time_t soon = now + kLeast_s;
  if (!fits || X509_cmp_time(X509_get0_notBefore(certificate.get()), &now) >= 0 ||
      X509_cmp_time(X509_get0_notAfter(certificate.get()), &soon) <= 0)
    return std::nullopt;
  return OwnCertificate{pem, fingerprint_of(certificate.get())};
}

OwnCertificate make(const std::vector<std::string>& addresses, std::time_t now) {
  const HeldKey key(EVP_PKEY_Q_keygen(nullptr, nullptr, "EC", "P-256"));
  const HeldCertificate held(X509_new());
  check(key && held);
  X509* certificate = held.get();
  std::uint64_t serial = 0;
  std::array<unsigned char, sizeof serial> random{};
  check(RAND_bytes(random.data(), static_cast<int>(random.size())) == 1);
  for (const unsigned char byte : random)
    serial = (serial << 8U) | byte;
  check(X509_set_version(certificate, 2) == 1 &&  // the third
        ASN1_INTEGER_set_uint64(X509_get_serialNumber(certificate), serial) == 1 &&
        X509_time_adj(X509_getm_notBefore(certificate), -kBefore_s, &now) != nullptr &&
        X509_time_adj(X509_getm_notAfter(certificate), kValid_s, &now) != nullptr &&
        X509_set_pubkey(certificate, key.get()) == 1);
  const std::string common = "Frangia";
  X509_NAME* name = X509_get_subject_name(certificate);
  check(X509_NAME_add_entry_by_NID(name,
                                   NID_commonName,
                                   MBSTRING_UTF8,
                                   reinterpret_cast<const unsigned char*>(common.data()),  // NOLINT
                                   static_cast<int>(common.size()),
                                   -1,
                                   0) == 1 &&
        X509_set_issuer_name(certificate, name) == 1);
  std::string names = "DNS:localhost";
  if (const std::string host = host_name(); !host.empty() && host != "localhost")
    names += fmt::format(",DNS:{0},DNS:{0}.local", host);
  for (const std::string& address : addresses)
    names += fmt::format(",IP:{}", address);
  add_extension(certificate, NID_subject_alt_name, names);
  add_extension(
      certificate, NID_basic_constraints, "critical,CA:FALSE");  // it vouches for no other
  add_extension(certificate, NID_key_usage, "critical,digitalSignature");
  add_extension(certificate, NID_ext_key_usage, "serverAuth");
  check(X509_sign(certificate, key.get(), EVP_sha256()) > 0);
  const HeldBio memory(BIO_new(BIO_s_mem()));
  check(memory && PEM_write_bio_X509(memory.get(), certificate) == 1 &&
        PEM_write_bio_PrivateKey(memory.get(), key.get(), nullptr, nullptr, 0, nullptr, nullptr) ==
            1);
  return {text_in(memory.get()), fingerprint_of(certificate)};
}

/// Whether its owner alone may read a file.
bool is_private(const std::filesystem::path& file) {
  using std::filesystem::perms;
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  return !error && std::filesystem::is_regular_file(status) &&
         (status.permissions() & (perms::group_all | perms::others_all)) == perms::none;
}

}  // namespace

OwnCertificate own_certificate(const std::filesystem::path& file,
                               const std::vector<std::string>& addresses,
                               std::time_t now) {
  if (!file.empty() && is_private(file))
    if (auto kept = certificate_in(read_text_file(file), now)) return *kept;
  OwnCertificate made = make(addresses, now);
  if (!file.empty()) {
    make_folder(folder_of(file));
    write_private_file(file, made.pem, Durability::Synced);
  }
  return made;
}

}  // namespace frangia
