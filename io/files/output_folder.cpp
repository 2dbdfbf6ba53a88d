#include <system_error>

#include <fmt/format.h>

#include <boresight/io/files/output_folder.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::io {

std::filesystem::path output_folder(const std::filesystem::path& folder, const std::string& what) {
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (!std::filesystem::is_directory(folder)) {
    throw InvalidInput(fmt::format("{}: expected a folder to write {} to, found none{}",
                                   folder.string(), what,
                                   failure ? " (" + failure.message() + ")" : ""));
  }
  return folder;
}

}  // namespace boresight::io
