#include <algorithm>

#include <fmt/format.h>

#include <boresight/app/document/document_text.hpp>

namespace boresight::app {
namespace {

// UTF-8 continuation bytes take no column.
std::size_t columns_of(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
  }));
}

void append(std::string& text, const Heading& heading) {
  text += fmt::format("\n{}\n{:-<{}}\n", heading.title, "", columns_of(heading.title));
}

void append(std::string& text, const Paragraph& block) {
  constexpr std::size_t width = 108;
  std::string_view paragraph = block.text;
  std::string line = block.indent;
  if (!block.label.empty()) line += fmt::format("{:<{}}", block.label, block.hanging.size());
  bool empty = true;
  while (!paragraph.empty()) {
    const std::size_t end = std::min(paragraph.find(' '), paragraph.size());
    const std::string_view word = paragraph.substr(0, end);
    paragraph.remove_prefix(std::min(end + 1, paragraph.size()));
    if (word.empty()) continue;
    if (!empty && columns_of(line) + 1 + columns_of(word) > width) {
      text += line;
      text += '\n';
      line = block.indent + block.hanging;
      empty = true;
    }
    if (!empty) line += ' ';
    line += word;
    empty = false;
  }
  if (!empty) text += line + "\n";
}

void append(std::string& text, const Subheading& subheading) {
  text += '\n';
  append(text, Paragraph{subheading.title, subheading.indent, {}, {}});
}

void append(std::string& text, const Table& table) {
  std::vector<std::size_t> widths;
  for (const auto& row : table.rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t i = 0; i < row.size(); ++i) {
      widths[i] = std::max(widths[i], columns_of(row[i]));
    }
  }
  for (const auto& row : table.rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string pad(widths[i] - columns_of(row[i]), ' ');
      const bool left = i < table.alignment.size() && table.alignment[i] == 'l';
      line += left ? fmt::format("  {}{}", row[i], pad) : fmt::format("  {}{}", pad, row[i]);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    line += '\n';
    text += line;
  }
}

void append(std::string& text, const Lead& lead) {
  text += '\n';
  for (const auto& paragraph : lead.paragraphs) append(text, paragraph);
}

void append(std::string& text, const Verbatim& verbatim) {
  text += verbatim.text;
}

}  // namespace

std::string to_text(const Document& document) {
  std::string text;
  for (const Block& block : document.blocks) {
    std::visit([&](const auto& one) { append(text, one); }, block.content);
  }
  return text;
}

}  // namespace boresight::app
