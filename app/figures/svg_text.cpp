#include <array>
#include <cstdint>

#include <boresight/app/figures/svg_text.hpp>

namespace boresight::app {
namespace {

// Advance widths of DejaVu Sans, hundredths of the size, from blank to tilde.
constexpr std::array<std::uint8_t, 95> ascii_width{
    32, 40, 46, 84, 64, 95, 78, 27, 39,  39, 50, 84, 32, 36, 32, 34, 64, 64, 64, 64, 64, 64, 64, 64,
    64, 64, 34, 34, 84, 84, 84, 53, 100, 68, 69, 70, 77, 63, 58, 77, 75, 29, 29, 66, 56, 86, 75, 79,
    60, 79, 69, 63, 61, 73, 68, 99, 69,  61, 69, 39, 34, 39, 84, 50, 50, 61, 63, 55, 63, 62, 35, 63,
    63, 28, 28, 58, 28, 97, 63, 61, 63,  63, 41, 52, 39, 63, 59, 82, 59, 59, 52, 64, 34, 64, 84};
constexpr double other_width = 0.7;

}  // namespace

double text_width(std::string_view text, double size) {
  double width = 0.0;
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (code >= 0x20U && code < 0x7fU) {
      width += 0.01 * ascii_width.at(code - 0x20U);
    } else if ((code & 0xC0U) != 0x80U) {  // UTF-8 continuation bytes take no room
      width += other_width;
    }
  }
  return width * size;
}

std::vector<std::string> text_lines(std::string_view text, double width, double size) {
  std::vector<std::string> lines;
  std::string line;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    const std::string_view word = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (word.empty()) continue;
    std::string longer = line;
    if (!longer.empty()) longer += ' ';
    longer += word;
    if (!line.empty() && text_width(longer, size) > width) {
      lines.push_back(line);
      line = word;
    } else {
      line = std::move(longer);
    }
  }
  if (!line.empty()) lines.push_back(line);
  return lines;
}

}  // namespace boresight::app
