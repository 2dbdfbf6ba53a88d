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

/// Rows of cells, of which the first `header_rows` name the columns. Rows may have different
/// numbers of cells. A letter of `alignment` aligns its column left ('l') or right ('r'); further
/// columns are aligned right.
struct Table {
  std::vector<std::vector<std::string>> rows;
  std::string alignment;
  std::size_t header_rows = 1;
};

/// Text whose line breaks and blanks stay as they are.
struct Verbatim {
  std::string text;
};

/// The decision. A terminal shows it between title and sections, a page in its own box, regardless
/// of its position here.
struct Lead {
  std::vector<Paragraph> paragraphs;
};

using Content = std::variant<Heading, Subheading, Paragraph, Table, Verbatim, Lead>;

struct Block {
  Content content;
  /// The short form of the document keeps it.
  bool essential = false;
  /// Most rows below the header of a table in the short form; none: all.
  std::optional<std::size_t> short_rows = std::nullopt;
};

/// The content of a report, independent of its presentation: to_text (document_text.hpp) for a
/// terminal, to_html (document_html.hpp) for a page. Strings added to it are verbatim.
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
/// The same, with at most `rows` of each table below its header in the short form.
Document shortened(Document document, std::size_t rows);
/// The short form: everything before the first section, and of each section with essential blocks
/// its heading and those blocks. Behind a shortened table stands how many rows it lacks.
Document short_form(const Document& document);
/// The two lines at the start of every report; `axis` stands in brackets behind the title unless it
/// is empty; `seed` for work that uses random numbers.
Document report_title(std::string_view command, std::string_view title, std::string_view axis,
                      std::string_view case_path, std::optional<std::uint64_t> seed);

}  // namespace boresight::app
