#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace boresight::app {

/// Opens a section, which lasts to the next heading.
struct Heading {
  std::string title;
};

/// Names what follows within a section; on a terminal behind `indent`, a blank line before it.
struct Subheading {
  std::string title;
  std::string indent;
};

/// Running text, broken at blanks; on a terminal each line behind `indent`, all but the first
/// behind `hanging` too, in whose columns the first has the `label`.
struct Paragraph {
  std::string text;
  std::string indent;
  std::string hanging;
  std::string label = {};
};

/// Rows of cells, of which the first `header_rows` name the columns. A row may have fewer cells
/// than others. A column is to the left ('l') or right ('r') by its letter in `alignment`; columns
/// beyond it are to the right.
struct Table {
  std::vector<std::vector<std::string>> rows;
  std::string alignment;
  std::size_t header_rows = 1;
};

/// Text whose line breaks and blanks stay as they are.
struct Verbatim {
  std::string text;
};

/// The decision, which a terminal shows between title and sections, a page in its own box: not
/// where it stands here.
struct Lead {
  std::vector<Paragraph> paragraphs;
};

using Content = std::variant<Heading, Subheading, Paragraph, Table, Verbatim, Lead>;

struct Block {
  Content content;
  /// The short form of the document keeps it.
  bool essential = false;
};

/// What a report says, apart from how it is shown: to_text (document_text.hpp) is for a terminal,
/// to_html (document_html.hpp) for a page. Strings added to it are verbatim.
struct Document {
  std::vector<Block> blocks;

  Document& operator+=(Document other);
  Document& operator+=(std::string_view verbatim);
};

Document operator+(Document first, Document second);
Document operator+(Document first, std::string_view verbatim);
Document operator+(std::string_view verbatim, Document second);

// Documents of one block.
Document heading(std::string_view title);
Document subheading(std::string_view title, std::string_view indent = "  ");
Document wrapped(std::string_view paragraph, std::string_view indent,
                 std::string_view hanging = {});
/// The decision in sentences; nothing without any.
Document lead(const std::vector<std::string>& sentences);
Document table(std::vector<std::vector<std::string>> rows, std::string_view alignment = "l",
               std::size_t header_rows = 1);
Document verbatim(std::string_view text);
/// The same blocks, which the short form keeps.
Document essential(Document document);
/// The short form: what stands before the first section, and of each section that has essential
/// blocks its heading and those.
Document short_form(const Document& document);
/// The two lines that every report begins with; `seed` where the work draws numbers.
Document report_title(std::string_view command, std::string_view title, std::string_view axis,
                      std::string_view case_path, std::optional<std::uint64_t> seed);

}  // namespace boresight::app
