#include <array>
#include <memory>

#include <openssl/evp.h>

#include "dashpot/base/file.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

/// A checksum that is being taken. OpenSSL's, which uses the processor's instructions for it.
class Checksum {
 public:
  Checksum() : context_(EVP_MD_CTX_new(), EVP_MD_CTX_free) {
    static const EVP_MD* const kSha256 = EVP_MD_fetch(nullptr, "SHA256", nullptr);
    require(kSha256 && context_ && EVP_DigestInit_ex(context_.get(), kSha256, nullptr) == 1);
  }

  void add(std::string_view bytes) {
    require(EVP_DigestUpdate(context_.get(), bytes.data(), bytes.size()) == 1);
  }

  std::string hexadecimal() {
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest;
    unsigned size = 0;
    require(EVP_DigestFinal_ex(context_.get(), digest.data(), &size) == 1);
    std::string text;
    for (unsigned k = 0; k < size; ++k) {
      constexpr std::string_view kDigits = "0123456789abcdef";
      text += kDigits[digest[k] >> 4];
      text += kDigits[digest[k] & 15];
    }
    return text;
  }

 private:
  static void require(bool is_done) {
    if (!is_done) throw Error("SHA-256", "OpenSSL, as it is set up here, does not take it");
  }

  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context_;
};

}  // namespace

std::string sha256(std::string_view bytes) {
  Checksum checksum;
  checksum.add(bytes);
  return checksum.hexadecimal();
}

std::string sha256_of_file(const std::filesystem::path& path) {
  Checksum checksum;
  visit_bytes(path, [&](std::string_view block) { checksum.add(block); });
  return checksum.hexadecimal();
}

}  // namespace dashpot
