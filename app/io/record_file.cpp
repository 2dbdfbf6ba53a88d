#include <cerrno>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>
#include <zlib.h>

#include <boresight/app/io/record_file.hpp>
#include <boresight/app/io/record_mat.hpp>
#include <boresight/app/io/record_text.hpp>
#include <boresight/plant/error.hpp>

namespace boresight::app {
namespace {

[[noreturn]] void refuse(const std::string& path, const std::string& found) {
  throw InvalidInput(fmt::format("{}: expected a readable recorder file, found {}", path, found));
}

/// A file's bytes as the system has them in memory: a copy would take a third of the reading time.
class FileBytes {
 public:
  explicit FileBytes(const std::string& path) {
    std::error_code error;
    if (std::filesystem::is_directory(path, error)) refuse(path, "a folder");
    size_ = std::filesystem::file_size(path, error);
    if (error) refuse(path, fmt::format("none ({})", error.message()));
    if (size_ == 0) refuse(path, "an empty one");
    const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0) refuse(path, fmt::format("none ({})", std::generic_category().message(errno)));
    begin_ = mmap(nullptr, size_, PROT_READ, MAP_PRIVATE | MAP_POPULATE, file, 0);
    close(file);
    if (begin_ == MAP_FAILED) refuse(path, "one that cannot be read");
  }
  FileBytes(const FileBytes&) = delete;
  FileBytes& operator=(const FileBytes&) = delete;
  ~FileBytes() { munmap(begin_, size_); }

  std::string_view view() const { return {static_cast<const char*>(begin_), size_}; }

 private:
  void* begin_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace

RecordTable read_record(const std::string& path) {
  const FileBytes bytes(path);
  const std::string_view content = bytes.view();
  for (const auto& [magic, kind] :
       {std::pair{"\x1F\x8B", "a gzip file"}, std::pair{"PK\x03\x04", "a zip or spreadsheet file"},
        std::pair{"\xD0\xCF\x11\xE0", "a spreadsheet file"}}) {
    if (content.starts_with(magic)) {
      refuse(path, fmt::format("{} (unpack it, or save it as CSV)", kind));
    }
  }
  return is_mat(content) ? read_record_mat(content, path) : read_record_text(content, path);
}

std::uint32_t record_checksum(const std::string& path) {
  const FileBytes bytes(path);
  return static_cast<std::uint32_t>(
      crc32_z(0, reinterpret_cast<const Bytef*>(bytes.view().data()), bytes.view().size()));
}

}  // namespace boresight::app
