#include <cerrno>
#include <filesystem>
#include <memory>
#include <string_view>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <boresight/io/files/input_files.hpp>
#include <boresight/io/records/record_file.hpp>
#include <boresight/io/records/record_mat.hpp>
#include <boresight/io/records/record_text.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::io {
namespace {

[[noreturn]] void refuse(const std::string& path, const std::string& found) {
  throw InvalidInput(fmt::format("{}: expected a readable recorder file, found {}", path, found));
}

/// A recorder's file, open for reading from its begin to its end. Read, not mapped: a file that
/// becomes shorter meanwhile ends in a message.
class RecordFile {
 public:
  explicit RecordFile(const std::string& path) : path_(path) {
    std::error_code error;
    if (std::filesystem::is_directory(path, error)) refuse(path, "a folder");
    size_ = std::filesystem::file_size(path, error);
    if (error) refuse(path, fmt::format("none ({})", error.message()));
    if (size_ == 0) refuse(path, "an empty one");
    file_ = open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (file_ < 0) refuse(path, fmt::format("none ({})", std::generic_category().message(errno)));
  }
  RecordFile(const RecordFile&) = delete;
  RecordFile& operator=(const RecordFile&) = delete;
  ~RecordFile() { close(file_); }

  /// Bytes of the file when it was opened.
  std::size_t size() const { return size_; }

  /// The next `count` bytes.
  void read_bytes(char* begin, std::size_t count) {
    while (count > 0) {
      const ssize_t got = read(file_, begin, count);
      if (got < 0 && errno == EINTR) continue;
      if (got < 0) {
        refuse(path_, fmt::format("none ({})", std::generic_category().message(errno)));
      }
      if (got == 0) refuse(path_, "one that became shorter while it was read");
      begin += got;
      count -= static_cast<std::size_t>(got);
    }
  }

 private:
  const std::string& path_;
  std::size_t size_ = 0;
  int file_ = -1;
};

/// Memory for a file, in large pages where the system has them: a large file in small ones takes a
/// quarter longer to read.
std::unique_ptr<char[]> large_block(std::size_t size) {
  constexpr std::size_t page = std::size_t{1} << 21U;
  auto block = std::make_unique_for_overwrite<char[]>(size);
  void* first = block.get();
  std::size_t left = size;
  if (std::align(page, page, first, left) != nullptr) madvise(first, left, MADV_HUGEPAGE);
  return block;
}

}  // namespace

RecordTable read_record(const std::string& path) {
  RecordFile file(path);
  const auto bytes = large_block(file.size());
  file.read_bytes(bytes.get(), file.size());
  const std::string_view content(bytes.get(), file.size());
  std::string digest = note_input(path, content);
  for (const auto& [magic, kind] :
       {std::pair{"\x1F\x8B", "a gzip file"}, std::pair{"PK\x03\x04", "a zip or spreadsheet file"},
        std::pair{"\xD0\xCF\x11\xE0", "a spreadsheet file"}}) {
    if (content.starts_with(magic)) {
      refuse(path, fmt::format("{} (unpack it, or save it as CSV)", kind));
    }
  }
  RecordTable table =
      is_mat(content) ? read_record_mat(content, path) : read_record_text(content, path);
  table.sha256 = std::move(digest);
  return table;
}

}  // namespace boresight::io
