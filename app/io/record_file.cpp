#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <memory>
#include <string_view>
#include <system_error>

#include <fmt/format.h>
#include <zlib.h>

#include <boresight/app/io/record_file.hpp>
#include <boresight/app/io/record_mat.hpp>
#include <boresight/app/io/record_text.hpp>
#include <boresight/plant/error.hpp>

namespace boresight::app {
namespace {

struct Bytes {
  std::unique_ptr<char[]> data;
  std::size_t size = 0;
};

[[noreturn]] void refuse(const std::string& path, const std::string& found) {
  throw InvalidInput(fmt::format("{}: expected a readable recorder file, found {}", path, found));
}

// In one read, into memory that is not cleared first.
Bytes read_bytes(const std::string& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) refuse(path, "a folder");
  const auto size = std::filesystem::file_size(path, error);
  if (error) refuse(path, fmt::format("none ({})", error.message()));
  if (size == 0) refuse(path, "an empty one");
  struct Closing {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  const std::unique_ptr<std::FILE, Closing> file(std::fopen(path.c_str(), "rb"));
  if (!file) refuse(path, fmt::format("none ({})", std::generic_category().message(errno)));
  Bytes bytes{std::make_unique_for_overwrite<char[]>(size), size};
  if (std::fread(bytes.data.get(), 1, size, file.get()) != size) {
    refuse(path, "one that cannot be read to its end");
  }
  return bytes;
}

}  // namespace

RecordTable read_record(const std::string& path) {
  const Bytes bytes = read_bytes(path);
  const std::string_view content(bytes.data.get(), bytes.size);
  for (const auto& [magic, kind] :
       {std::pair{"\x1F\x8B", "a gzip file"}, std::pair{"PK\x03\x04", "a zip or spreadsheet file"},
        std::pair{"\xD0\xCF\x11\xE0", "a spreadsheet file"}}) {
    if (content.starts_with(magic)) {
      refuse(path, fmt::format("{} (unpack it, or save it as CSV)", kind));
    }
  }
  RecordTable table =
      is_mat(content) ? read_record_mat(content, path) : read_record_text(content, path);
  table.checksum = static_cast<std::uint32_t>(
      crc32_z(0, reinterpret_cast<const Bytef*>(content.data()), content.size()));
  return table;
}

}  // namespace boresight::app
