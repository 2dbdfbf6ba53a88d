#include <array>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <mutex>
#include <set>
#include <span>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <nettle/base64.h>
#include <nettle/sha2.h>

#include <boresight/io/files/input_files.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::io {
namespace {

using Digest = std::array<std::uint8_t, SHA256_DIGEST_SIZE>;

Digest sha256(std::string_view bytes) {
  sha256_ctx context{};
  sha256_init(&context);
  sha256_update(&context, bytes.size(), reinterpret_cast<const std::uint8_t*>(bytes.data()));
  Digest digest{};
  sha256_digest(&context, digest.size(), digest.data());
  return digest;
}

std::string hexadecimal(std::span<const std::uint8_t> bytes) {
  std::string text;
  for (const auto byte : bytes) fmt::format_to(std::back_inserter(text), "{:02x}", byte);
  return text;
}

// What this process read: readers stand deep in the libraries of formats, on threads of their own.
struct Log {
  std::mutex mutex;
  std::map<std::pair<std::string, std::string>, std::uint64_t> sizes;  // by path and digest
  std::set<std::string> warnings;
};

Log& log() {
  static Log log;
  return log;
}

}  // namespace

std::string sha256_hex(std::string_view bytes) {
  return hexadecimal(sha256(bytes));
}

std::string sha256_base64(std::string_view bytes) {
  const Digest digest = sha256(bytes);
  std::string text(BASE64_ENCODE_RAW_LENGTH(digest.size()), '\0');
  base64_encode_raw(text.data(), digest.size(), digest.data());
  return text;
}

std::string read_input(const std::string& path, std::uint64_t max_bytes) {
  std::error_code unknown;
  if (std::filesystem::is_directory(path, unknown)) {
    throw InvalidInput(fmt::format("{}: expected a readable file, found a folder", path));
  }
  const std::uintmax_t size = std::filesystem::file_size(path, unknown);
  if (!unknown && size > max_bytes) {
    throw InvalidInput(
        fmt::format("{}: expected at most {} bytes, found {}", path, max_bytes, size));
  }
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  if (!file) {
    throw InvalidInput(fmt::format("{}: expected a readable file, found none ({})", path,
                                   std::generic_category().message(errno)));
  }
  note_input(path, text);
  return text;
}

std::string note_input(const std::string& path, std::string_view content) {
  std::string digest = sha256_hex(content);
  const std::lock_guard lock(log().mutex);
  log().sizes.try_emplace({path, digest}, content.size());
  return digest;
}

std::vector<InputFile> inputs_read() {
  const std::lock_guard lock(log().mutex);
  std::vector<InputFile> files;
  for (const auto& [key, bytes] : log().sizes) files.push_back({key.first, bytes, key.second});
  return files;
}

void note_warning(const std::string& sentence) {
  const std::lock_guard lock(log().mutex);
  log().warnings.insert(sentence);
}

std::vector<std::string> warnings_noted() {
  const std::lock_guard lock(log().mutex);
  return {log().warnings.begin(), log().warnings.end()};
}

}  // namespace boresight::io
