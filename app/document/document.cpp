#include <iterator>
#include <utility>

#include <fmt/format.h>

#include <boresight/app/document/document.hpp>

namespace boresight::app {

Document& Document::operator+=(Document other) {
  blocks.insert(blocks.end(), std::make_move_iterator(other.blocks.begin()),
                std::make_move_iterator(other.blocks.end()));
  return *this;
}

Document& Document::operator+=(std::string_view verbatim) {
  if (verbatim.empty()) return *this;
  // Lines added one by one are one piece of text.
  auto* last = blocks.empty() || blocks.back().essential
                   ? nullptr
                   : std::get_if<Verbatim>(&blocks.back().content);
  if (last != nullptr) {
    last->text += verbatim;
  } else {
    blocks.push_back({Verbatim{std::string(verbatim)}});
  }
  return *this;
}

Document operator+(Document first, Document second) {
  first += std::move(second);
  return first;
}

Document operator+(Document first, std::string_view verbatim) {
  first += verbatim;
  return first;
}

Document operator+(std::string_view verbatim, Document second) {
  Document first;
  first += verbatim;
  first += std::move(second);
  return first;
}

Document heading(std::string_view title) {
  return {{{Heading{std::string(title)}}}};
}

Document subheading(std::string_view title, std::string_view indent) {
  return {{{Subheading{std::string(title), std::string(indent)}}}};
}

Document wrapped(std::string_view paragraph, std::string_view indent, std::string_view hanging) {
  return {{{Paragraph{std::string(paragraph), std::string(indent), std::string(hanging)}}}};
}

Document lead(const std::vector<std::string>& sentences) {
  if (sentences.empty()) return {};
  Lead all;
  for (const auto& sentence : sentences) all.paragraphs.push_back({sentence, "  ", "", ""});
  return {{{std::move(all)}}};
}

Document table(std::vector<std::vector<std::string>> rows, std::string_view alignment,
               std::size_t header_rows) {
  return {{{Table{std::move(rows), std::string(alignment), header_rows}}}};
}

Document verbatim(std::string_view text) {
  return {{{Verbatim{std::string(text)}}}};
}

Document essential(Document document) {
  for (auto& block : document.blocks) block.essential = true;
  return document;
}

Document shortened(Document document, std::size_t rows) {
  for (auto& block : document.blocks) {
    if (std::holds_alternative<Table>(block.content)) block.short_rows = rows;
  }
  return document;
}

namespace {

void append_shortened(Document& text, const Block& block) {
  text.blocks.push_back(block);
  auto* table = std::get_if<Table>(&text.blocks.back().content);
  if (table == nullptr || !block.short_rows) return;
  const std::size_t kept = table->header_rows + *block.short_rows;
  if (table->rows.size() <= kept + 1) return;  // the remark is as long as a row
  const std::size_t left_out = table->rows.size() - kept;
  table->rows.resize(kept);
  text.blocks.push_back({Verbatim{fmt::format("  and {} more\n", left_out)}, true});
}

}  // namespace

Document short_form(const Document& document) {
  Document text;
  const Block* heading = nullptr;
  bool in_section = false;
  for (const auto& block : document.blocks) {
    if (std::holds_alternative<Heading>(block.content)) {
      heading = &block;
      in_section = true;
      continue;
    }
    if (in_section && !block.essential) continue;
    if (heading != nullptr) text.blocks.push_back(*std::exchange(heading, nullptr));
    append_shortened(text, block);
  }
  return text;
}

Document report_title(std::string_view command, std::string_view title, std::string_view axis,
                      std::string_view case_path, std::optional<std::uint64_t> seed) {
  return verbatim(fmt::format("Boresight {} {}: {}{}\ncase {}{}\n", BORESIGHT_VERSION, command,
                              title, axis.empty() ? "" : fmt::format(" ({})", axis), case_path,
                              seed ? fmt::format(", seed {}", *seed) : ""));
}

}  // namespace boresight::app
