#include <boresight/io/units/printable.hpp>

namespace boresight::io {
namespace {

unsigned char byte_at(std::string_view text, std::size_t i) {
  return static_cast<unsigned char>(text[i]);
}

bool continues_character(unsigned char byte) {
  return (byte & 0xC0U) == 0x80U;
}

}  // namespace

std::size_t printable_length(std::string_view text, std::size_t place) {
  const unsigned char lead = byte_at(text, place);
  if (lead < 0x80U) {
    return lead >= 0x20U && lead != 0x7FU ? 1 : 0;
  }
  const std::size_t length = lead >= 0xF0U ? 4 : lead >= 0xE0U ? 3 : 2;
  if (lead < 0xC2U || lead > 0xF4U || place + length > text.size()) {
    return 0;
  }
  for (std::size_t k = 1; k < length; ++k) {
    if (!continues_character(byte_at(text, place + k))) {
      return 0;
    }
  }
  const unsigned char second = byte_at(text, place + 1);
  const bool control = lead == 0xC2U && second < 0xA0U;
  const bool overlong = (lead == 0xE0U && second < 0xA0U) || (lead == 0xF0U && second < 0x90U);
  const bool outside = (lead == 0xEDU && second >= 0xA0U) || (lead == 0xF4U && second >= 0x90U);
  return control || overlong || outside ? 0 : length;
}

}  // namespace boresight::io
