#include <cstdio>
#include <filesystem>
#include <fstream>
#include <system_error>

#include <fmt/format.h>

#include <boresight/io/files/write_atomically.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::io {

namespace {

std::string temporary_of(const std::string& path) {
  return path + ".part";
}

[[noreturn]] void refuse(const std::string& path, const std::error_code& failure) {
  std::error_code ignored;
  std::filesystem::remove(temporary_of(path), ignored);
  throw InvalidInput(fmt::format("{}: expected a place to write to, found none{}", path,
                                 failure ? " (" + failure.message() + ")" : ""));
}

}  // namespace

void require_writable(const std::string& path) {
  std::error_code failure;
  if (std::filesystem::is_directory(path, failure)) {
    refuse(path, std::make_error_code(std::errc::is_a_directory));
  }
  if (!std::ofstream(temporary_of(path), std::ios::binary | std::ios::trunc)) {
    refuse(path, std::make_error_code(std::errc::no_such_file_or_directory));
  }
  std::filesystem::remove(temporary_of(path), failure);
}

void write_atomically(const std::string& path, const std::string& content) {
  std::ofstream file(temporary_of(path), std::ios::binary | std::ios::trunc);
  file << content;
  file.close();
  if (!file) refuse(path, {});
  std::error_code failure;
  std::filesystem::rename(temporary_of(path), path, failure);
  if (failure) refuse(path, failure);
}

}  // namespace boresight::io
