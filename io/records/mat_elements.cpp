#include <algorithm>
#include <array>
#include <cstring>
#include <limits>

#include <fmt/format.h>
#include <zlib.h>

#include <boresight/io/records/mat_elements.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::io {
namespace {

constexpr std::size_t largest_deflate_ratio = 1032;

template <typename Number>
Number read_number(const char* at, bool swapped) {
  std::array<char, sizeof(Number)> bytes{};
  std::memcpy(bytes.data(), at, sizeof(Number));
  if (swapped) std::reverse(bytes.begin(), bytes.end());
  Number number{};
  std::memcpy(&number, bytes.data(), sizeof(Number));
  return number;
}

template <typename Number>
std::vector<double> read_numbers(std::string_view bytes, bool swapped) {
  std::vector<double> numbers(bytes.size() / sizeof(Number));
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    numbers[i] =
        static_cast<double>(read_number<Number>(bytes.data() + i * sizeof(Number), swapped));
  }
  return numbers;
}

[[noreturn]] void refuse_damaged(std::string_view name, std::string_view what) {
  throw InvalidInput(
      fmt::format("{}: expected a whole MAT file of version 5, found {}", name, what));
}

}  // namespace

void MatCursor::refuse(const std::string& what) const {
  refuse_damaged(name_, what);
}

std::uint32_t MatCursor::word(std::size_t at) const {
  return read_number<std::uint32_t>(bytes_.data() + at, swapped_);
}

MatElement MatCursor::next() {
  constexpr std::size_t tag = 8;
  if (bytes_.size() - position_ < tag) refuse("its end within the head of an element");
  const std::uint32_t first = word(position_);
  if ((first >> 16U) != 0) {  // a short element has its bytes within the tag
    const std::size_t size = first >> 16U;
    if (size > 4) refuse(fmt::format("a short element of {} bytes", size));
    const MatElement element{first & 0xFFFFU, bytes_.substr(position_ + 4, size)};
    position_ += tag;
    return element;
  }
  const std::size_t size = word(position_ + 4);
  if (size > bytes_.size() - position_ - tag) {
    refuse(fmt::format("an element of {} bytes where {} are left", size,
                       bytes_.size() - position_ - tag));
  }
  const MatElement element{first, bytes_.substr(position_ + tag, size)};
  // Elements begin at multiples of eight bytes, but for compressed ones.
  const std::size_t padded = first == mat_compressed ? size : (size + 7) / 8 * 8;
  position_ = std::min(bytes_.size(), position_ + tag + padded);
  return element;
}

std::vector<double> MatCursor::numbers(const MatElement& element) const {
  switch (element.type) {
    case 1:
      return read_numbers<std::int8_t>(element.bytes, swapped_);
    case 2:
      return read_numbers<std::uint8_t>(element.bytes, swapped_);
    case 3:
      return read_numbers<std::int16_t>(element.bytes, swapped_);
    case 4:
      return read_numbers<std::uint16_t>(element.bytes, swapped_);
    case 5:
      return read_numbers<std::int32_t>(element.bytes, swapped_);
    case 6:
      return read_numbers<std::uint32_t>(element.bytes, swapped_);
    case 7:
      return read_numbers<float>(element.bytes, swapped_);
    case 9:
      return read_numbers<double>(element.bytes, swapped_);
    case 12:
      return read_numbers<std::int64_t>(element.bytes, swapped_);
    case 13:
      return read_numbers<std::uint64_t>(element.bytes, swapped_);
    default:
      refuse(fmt::format("an element of type {} where numbers belong", element.type));
  }
}

std::vector<std::int64_t> MatCursor::integers(const MatElement& element) const {
  if (element.type != 5 && element.type != 6) {
    refuse(fmt::format("an element of type {} where integers belong", element.type));
  }
  std::vector<std::int64_t> result(element.bytes.size() / 4);
  for (std::size_t i = 0; i < result.size(); ++i) {
    result[i] = read_number<std::int32_t>(element.bytes.data() + 4 * i, swapped_);
  }
  return result;
}

MatArray read_mat_array(const MatElement& matrix, bool swapped, std::string_view name) {
  MatCursor cursor(matrix.bytes, swapped, name);
  MatArray array{MatArray::Class::other, false, {}, {}, 0, cursor};
  if (matrix.bytes.empty()) {  // an empty field of a structure
    array.dimensions = {0, 0};
    return array;
  }
  const std::vector<std::int64_t> flags = cursor.integers(cursor.next());
  if (flags.empty()) cursor.refuse("an array without flags");
  const std::int64_t code = flags[0] & 0xFF;
  if (code == 2) array.kind = MatArray::Class::structure;
  if (code == 4) array.kind = MatArray::Class::text;
  if (code >= 6 && code <= 15) array.kind = MatArray::Class::number;
  array.complex = (flags[0] & 0x0800) != 0;
  if (array.kind == MatArray::Class::other) {  // cells, objects, sparse: their heads differ
    if (code == 17 || code == 16) return array;
  }
  array.dimensions = cursor.integers(cursor.next());
  if (array.dimensions.size() < 2) cursor.refuse("an array of fewer than two dimensions");
  array.elements = 1;
  for (const std::int64_t dimension : array.dimensions) {
    if (dimension < 0) cursor.refuse("an array of negative size");
    const auto size = static_cast<std::uint64_t>(dimension);
    if (size != 0 && array.elements > std::numeric_limits<std::uint32_t>::max() / size) {
      cursor.refuse("an array larger than the format allows");
    }
    array.elements *= size;
  }
  array.name = std::string(cursor.next().bytes);
  array.rest = cursor;
  return array;
}

std::string inflate_mat(const MatElement& compressed, bool swapped, std::string_view name) {
  struct Stream {
    z_stream stream{};
    Stream() = default;
    Stream(const Stream&) = delete;
    Stream& operator=(const Stream&) = delete;
    ~Stream() { inflateEnd(&stream); }
  } holder;
  z_stream& stream = holder.stream;
  if (inflateInit(&stream) != Z_OK) refuse_damaged(name, "too little memory to unpack an element");
  std::string input(compressed.bytes);
  stream.next_in = reinterpret_cast<Bytef*>(input.data());
  stream.avail_in = static_cast<uInt>(input.size());
  std::string bytes(8, '\0');
  stream.next_out = reinterpret_cast<Bytef*>(bytes.data());
  stream.avail_out = 8;
  int state = inflate(&stream, Z_SYNC_FLUSH);
  if ((state != Z_OK && state != Z_STREAM_END) || stream.avail_out != 0) {
    refuse_damaged(name, "a compressed element that does not unpack");
  }
  const std::size_t size = read_number<std::uint32_t>(bytes.data() + 4, swapped);
  if (read_number<std::uint32_t>(bytes.data(), swapped) != mat_matrix ||
      size > largest_deflate_ratio * input.size()) {
    refuse_damaged(name, "a compressed element that holds no array");
  }
  bytes.resize(8 + size);
  stream.next_out = reinterpret_cast<Bytef*>(bytes.data() + 8);
  stream.avail_out = static_cast<uInt>(size);
  if (size > 0) state = inflate(&stream, Z_FINISH);
  if (stream.avail_out != 0 || state == Z_DATA_ERROR) {
    refuse_damaged(name, "a compressed element that does not unpack");
  }
  return bytes;
}

}  // namespace boresight::io
