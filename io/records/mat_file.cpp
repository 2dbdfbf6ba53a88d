#include <algorithm>

#include <fmt/format.h>

#include <boresight/io/records/mat_file.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::io {
namespace {

constexpr std::size_t head_size = 128;

}  // namespace

void read_mat_file(std::string_view content, std::string_view name,
                   const std::function<void(MatArray&)>& take) {
  if (content.starts_with("MATLAB 7.3") || content.starts_with("\x89HDF")) {
    throw InvalidInput(fmt::format(
        "{}: expected a MAT file of version 5, found version 7.3 (save it with `save -v7`)", name));
  }
  if (content.size() < head_size) {
    throw InvalidInput(fmt::format("{}: expected a whole MAT file of version 5, found {} bytes",
                                   name, content.size()));
  }
  const std::string_view order = content.substr(126, 2);
  if (order != "IM" && order != "MI") {
    throw InvalidInput(fmt::format(
        "{}: expected a MAT file of version 5, found another version (save it with `save -v7`)",
        name));
  }
  const bool swapped = order == "MI";  // written on a machine of the other byte order
  MatCursor cursor(content.substr(head_size), swapped, name);
  while (!cursor.at_end()) {
    MatElement element = cursor.next();
    std::string unpacked;
    if (element.type == mat_compressed) {
      unpacked = inflate_mat(element, swapped, name);
      element = MatCursor(unpacked, swapped, name).next();
    }
    if (element.type != mat_matrix) continue;
    MatArray array = read_mat_array(element, swapped, name);
    take(array);
  }
}

void read_mat_fields(MatArray& structure,
                     const std::function<void(const std::string& field, MatArray&)>& take) {
  MatCursor& rest = structure.rest;
  const std::vector<std::int64_t> length = rest.integers(rest.next());
  const std::string_view names = rest.next().bytes;
  if (length.empty() || length[0] < 1 || length[0] > 1024) {
    rest.refuse("a structure whose field names have no length");
  }
  if (structure.elements != 1) return;
  const auto step = static_cast<std::size_t>(length[0]);
  for (std::size_t begin = 0; begin + step <= names.size(); begin += step) {
    const std::string_view padded = names.substr(begin, step);
    const MatElement element = rest.next();
    if (element.type != mat_matrix) continue;
    MatArray array = read_mat_array(element, rest.swapped(), rest.name());
    take(std::string(padded.substr(0, std::min(padded.find('\0'), step))), array);
  }
}

std::vector<double> mat_characters(MatArray& text) {
  MatElement element = text.rest.next();
  if (element.type == 16) element.type = 2;  // UTF-8
  if (element.type == 17) element.type = 4;  // UTF-16
  return text.rest.numbers(element);
}

}  // namespace boresight::io
