#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace boresight::io {

/// A file that this run read, as it was then.
struct InputFile {
  std::string path;  // as it was asked for
  std::uint64_t bytes = 0;
  std::string sha256;  // 64 hexadecimal digits
};

/// SHA-256 (FIPS 180-4) in hexadecimal digits, and in base 64 as browsers take it.
std::string sha256_hex(std::string_view bytes);
std::string sha256_base64(std::string_view bytes);

/// The content of an input file, which note_input registers.
/// @throws InvalidInput naming the file, for a folder, for one that cannot be read and for one of
/// more than `max_bytes`.
std::string read_input(const std::string& path,
                       std::uint64_t max_bytes = std::numeric_limits<std::uint64_t>::max());

/// Registers an input file, from any thread, so that a report can list all inputs. Returns the
/// content's SHA-256 in hexadecimal digits.
std::string note_input(const std::string& path, std::string_view content);

/// All noted so far, by path; a file read twice is there once, one that changed meanwhile twice.
std::vector<InputFile> inputs_read();

/// Registers a sentence on an input for the user, from any thread: what a reader accepts now and
/// will not in the next version.
void note_warning(const std::string& sentence);

/// All noted so far, each once, in alphabetical order.
std::vector<std::string> warnings_noted();

}  // namespace boresight::io
