#include <algorithm>
#include <cstddef>
#include <set>
#include <utility>

#include <fmt/format.h>

#include <boresight/app/document/document_html.hpp>
#include <boresight/io/units/printable.hpp>

namespace boresight::app {
namespace {

constexpr std::string_view blank = " \n";

std::string slug_of(std::string_view title) {
  std::string slug;
  for (const char c : title.substr(0, title.find_first_of(":,("))) {
    const bool capital = c >= 'A' && c <= 'Z';
    if ((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || capital) {
      slug += capital ? static_cast<char>(c - 'A' + 'a') : c;
    } else if (c != '\'' && !slug.empty() && slug.back() != '-') {
      slug += '-';
    }
  }
  if (slug.ends_with('-')) slug.pop_back();
  return slug.empty() ? "section" : slug;
}

std::string tagged(std::string_view tag, std::string_view attributes, std::string_view text) {
  return fmt::format("<{}{}>{}</{}>", tag, attributes, escaped_html(text), tag);
}

// One page as it grows.
class Elements {
 public:
  explicit Elements(const AdditionsOf& additions_of) : additions_of_(additions_of) {}

  void operator()(const Heading& heading) {
    close_section();
    html_ += fmt::format("<section id=\"{}\">\n{}\n", unused_id(slug_of(heading.title)),
                         tagged("h2", "", heading.title));
    in_section_ = true;
    if (!additions_of_) return;
    SectionAdditions additions = additions_of_(heading.title);
    html_ += additions.behind_heading;
    figures_ = std::move(additions.behind_first_table);
    figures_place_ = html_.size();
  }

  void operator()(const Subheading& subheading) {
    close_notes();
    html_ += tagged("h3", "", subheading.title) + '\n';
  }

  void operator()(const Paragraph& paragraph) {
    if (paragraph.text.find_first_not_of(blank) == std::string::npos) return;
    constexpr std::size_t usual = 2;
    note(tagged("p", paragraph.indent.size() > usual ? " class=\"nested\"" : "", paragraph.text));
  }

  void operator()(const Table& table) {
    if (table.rows.empty()) return;
    close_notes();
    const std::size_t header_rows = std::min(table.header_rows, table.rows.size());
    std::size_t columns = 0;
    for (const auto& row : table.rows) columns = std::max(columns, row.size());
    html_ += "<div class=\"table\"><table>\n";
    if (header_rows > 0) {
      html_ += "<thead>\n";
      for (std::size_t i = 0; i < header_rows; ++i) add_row(table, i, columns);
      html_ += "</thead>\n";
    }
    html_ += "<tbody>\n";
    for (std::size_t i = header_rows; i < table.rows.size(); ++i) add_row(table, i, columns);
    html_ += "</tbody>\n</table></div>\n";
    html_ += std::exchange(figures_, {});
  }

  // A page shows it in its own box.
  void operator()(const Lead& /*lead*/) {}

  void operator()(const Verbatim& verbatim) {
    const std::string_view text = verbatim.text;
    const std::size_t first = text.find_first_not_of(blank);
    if (first == std::string_view::npos) return;
    const std::size_t line_end = text.find_last_of('\n', first);
    const std::size_t begin = line_end == std::string_view::npos ? 0 : line_end + 1;
    note(tagged("pre", "", text.substr(begin, text.find_last_not_of(blank) + 1 - begin)));
  }

  std::string finish() {
    close_section();
    return std::move(html_);
  }

 private:
  void note(const std::string& element) {
    if (!in_notes_) html_ += "<div class=\"notes\">\n";
    in_notes_ = true;
    html_ += element + '\n';
  }

  void close_notes() {
    if (in_notes_) html_ += "</div>\n";
    in_notes_ = false;
  }

  void close_section() {
    close_notes();
    html_.insert(std::min(figures_place_, html_.size()), std::exchange(figures_, {}));
    if (in_section_) html_ += "</section>\n";
    in_section_ = false;
  }

  std::string unused_id(const std::string& slug) {
    std::string id = slug;
    for (int i = 2; !ids_.insert(id).second; ++i) id = fmt::format("{}-{}", slug, i);
    return id;
  }

  void add_row(const Table& table, std::size_t number, std::size_t columns) {
    const auto& row = table.rows[number];
    const bool header = number < table.header_rows;
    html_ += "<tr>";
    for (std::size_t i = 0; i < columns; ++i) {
      const std::string_view cell = i < row.size() ? std::string_view(row[i]) : std::string_view();
      const bool right = i >= table.alignment.size() || table.alignment[i] != 'l';
      const bool nested = cell.starts_with(' ') && !right;
      const bool names = !cell.empty() && (header || i == 0);
      std::string attributes;
      if (names) attributes += header ? " scope=\"col\"" : " scope=\"row\"";
      if (right || nested) attributes += right ? " class=\"right\"" : " class=\"nested\"";
      html_ += tagged(names ? "th" : "td", attributes, cell);
    }
    html_ += "</tr>\n";
  }

  const AdditionsOf& additions_of_;
  std::string html_;
  std::string figures_;  // of the section, until its first table
  std::size_t figures_place_ = 0;
  std::set<std::string> ids_;
  bool in_section_ = false;
  bool in_notes_ = false;
};

}  // namespace

std::string escaped_html(std::string_view text) {
  std::string html;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = io::printable_length(text, i);
    const char c = text[i];
    if (c == '&') {
      html += "&amp;";
    } else if (c == '<') {
      html += "&lt;";
    } else if (c == '>') {
      html += "&gt;";
    } else if (c == '"') {
      html += "&quot;";
    } else if (c == '\'') {
      html += "&#39;";
    } else if (length > 0 || c == '\n' || c == '\t') {
      html += text.substr(i, std::max<std::size_t>(length, 1));
    } else {
      html += "\xEF\xBF\xBD";
    }
    i += std::max<std::size_t>(length, 1);
  }
  return html;
}

std::string to_html(const Document& document, const AdditionsOf& additions_of) {
  Elements page(additions_of);
  for (const Block& block : document.blocks) std::visit(page, block.content);
  return page.finish();
}

}  // namespace boresight::app
