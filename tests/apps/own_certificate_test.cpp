// The certificate that a machine makes for tablets; the program of OpenSSL reads it.
#include "own_certificate.h"

#include <ctime>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "frangia/core/durable_file.h"
#include "frangia/core/read_file.h"

#include "support/run_program.h"
#include "support/temporary_folder.h"

namespace frangia {
namespace {

using testing::run_shell;
constexpr std::time_t kDay_s = 24L * 60 * 60;

class OwnCertificateTest : public ::testing::Test {
 protected:
  [[nodiscard]] OwnCertificate made(std::time_t now = std::time(nullptr)) const {
    return own_certificate(file_, {"192.168.7.5", "10.0.0.9"}, now);
  }

  testing::TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.path() / "new" / "certificate.pem";
};

TEST_F(OwnCertificateTest, IsMadeOnceAndItsOwnerAloneReadsItsKey) {
  using std::filesystem::perms;
  const OwnCertificate first = made();
  EXPECT_EQ(std::filesystem::status(file_).permissions(), perms::owner_read | perms::owner_write);
  EXPECT_EQ(read_text_file(file_), first.pem);
  const OwnCertificate again = made();
  EXPECT_EQ(again.fingerprint, first.fingerprint);
  EXPECT_EQ(again.pem, first.pem);
}

TEST_F(OwnCertificateTest, IsKeptNowhereWithoutAPlace) {
  EXPECT_NE(own_certificate({}, {}).fingerprint, own_certificate({}, {}).fingerprint);
}

TEST_F(OwnCertificateTest, IsMadeAgainWhenItsKeyIsNoSecretOrItIsDamaged) {
  using std::filesystem::perms;
  const OwnCertificate first = made();
  std::filesystem::permissions(file_, perms::group_read, std::filesystem::perm_options::add);
  const OwnCertificate second = made();
  EXPECT_NE(second.fingerprint, first.fingerprint);
  EXPECT_EQ(std::filesystem::status(file_).permissions(), perms::owner_read | perms::owner_write);

  const auto key = [](const std::string& pem) { return pem.find("-----BEGIN PRIVATE KEY"); };
  ASSERT_NE(key(first.pem), std::string::npos);
  for (const std::string& damaged :
       {std::string(),
        second.pem.substr(0, key(second.pem)),
        second.pem.substr(0, key(second.pem)) + first.pem.substr(key(first.pem))}) {
    write_private_file(file_, damaged);
    const OwnCertificate third = made();
    EXPECT_NE(third.fingerprint, second.fingerprint);
    EXPECT_EQ(read_text_file(file_), third.pem);
  }
}

TEST_F(OwnCertificateTest, IsMadeAgainAMonthBeforeItIsOver) {
  const std::time_t now = std::time(nullptr);
  const OwnCertificate first = made(now);
  EXPECT_EQ(made(now + 769 * kDay_s).fingerprint, first.fingerprint);
  EXPECT_NE(made(now + 771 * kDay_s).fingerprint, first.fingerprint);
  EXPECT_NE(made(now).fingerprint, first.fingerprint);  // what is there is not valid yet
}

TEST_F(OwnCertificateTest, IsWhatOpensslReads) {
  if (run_shell("openssl version").exit_code != 0) GTEST_SKIP() << "openssl is not installed";
  const OwnCertificate certificate = made();
  const std::string file = file_.string();
  const auto shown =
      run_shell("openssl x509 -noout -in " + file +
                " -fingerprint -sha256 -ext subjectAltName,basicConstraints,extendedKeyUsage "
                "-checkend 69000000");
  EXPECT_EQ(shown.exit_code, 0) << shown.output;
  for (const std::string& words : {"sha256 Fingerprint=" + certificate.fingerprint,
                                   std::string("IP Address:192.168.7.5, IP Address:10.0.0.9"),
                                   std::string("DNS:localhost"),
                                   std::string("CA:FALSE"),
                                   std::string("TLS Web Server Authentication")})
    EXPECT_NE(shown.output.find(words), std::string::npos) << words << "\n" << shown.output;
  const auto verified = run_shell("openssl verify -x509_strict -purpose sslserver -CAfile " + file +
                                  " -verify_ip 10.0.0.9 " + file);
  EXPECT_EQ(verified.exit_code, 0) << verified.output;
}

}  // namespace
}  // namespace frangia
