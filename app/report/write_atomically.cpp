#include <cstdio>
#include <filesystem>
#include <fstream>
#include <system_error>

#include <fmt/format.h>

#include <boresight/app/report/json_report.hpp>

namespace boresight::app {

void write_atomically(const std::string& path, const std::string& content) {
  const std::string temporary = path + ".part";
  std::ofstream file(temporary, std::ios::binary | std::ios::trunc);
  file << content;
  file.close();
  std::error_code failure;
  if (file) {
    std::filesystem::rename(temporary, path, failure);
    if (!failure) return;
  }
  std::error_code ignored;
  std::filesystem::remove(temporary, ignored);
  throw InvalidInput(fmt::format("{}: expected a place to write to, found none{}", path,
                                 failure ? " (" + failure.message() + ")" : ""));
}

}  // namespace boresight::app
