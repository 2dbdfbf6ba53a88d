#include <algorithm>

#include <fmt/format.h>

#include <boresight/app/report/text_layout.hpp>

namespace boresight::app {
namespace {

// UTF-8 continuation bytes take no column.
std::size_t columns_of(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
  }));
}

}  // namespace

std::string heading(std::string_view title) {
  return fmt::format("\n{}\n{:-<{}}\n", title, "", columns_of(title));
}

std::string wrapped(std::string_view paragraph, std::string_view indent, std::string_view hanging) {
  constexpr std::size_t width = 108;
  std::string text;
  std::string line(indent);
  bool empty = true;
  while (!paragraph.empty()) {
    const std::size_t end = std::min(paragraph.find(' '), paragraph.size());
    const std::string_view word = paragraph.substr(0, end);
    paragraph.remove_prefix(std::min(end + 1, paragraph.size()));
    if (word.empty()) continue;
    if (!empty && columns_of(line) + 1 + columns_of(word) > width) {
      text += line + "\n";
      line = fmt::format("{}{}", indent, hanging);
      empty = true;
    }
    if (!empty) line += ' ';
    line += word;
    empty = false;
  }
  return empty ? text : text + line + "\n";
}

std::string table(const std::vector<std::vector<std::string>>& rows, std::string_view alignment) {
  std::vector<std::size_t> widths;
  for (const auto& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t i = 0; i < row.size(); ++i) {
      widths[i] = std::max(widths[i], columns_of(row[i]));
    }
  }
  std::string text;
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string pad(widths[i] - columns_of(row[i]), ' ');
      const bool left = i < alignment.size() && alignment[i] == 'l';
      line += left ? fmt::format("  {}{}", row[i], pad) : fmt::format("  {}{}", pad, row[i]);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

}  // namespace boresight::app
