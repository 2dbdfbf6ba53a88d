#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <boresight/app/io/record_header.hpp>
#include <boresight/app/io/wording.hpp>
#include <boresight/plant/error.hpp>

namespace boresight::app {
namespace {

constexpr std::size_t most_columns = 4096;
// A header stands near the beginning; a file of prose is not read to its end for one.
constexpr std::size_t furthest_row = std::size_t{1} << 20U;

bool is_blank(char c) {
  return c == ' ' || c == '\t';
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

char separator_of(std::string_view line) {
  bool quoted_text = false;
  std::string found;
  for (const char c : line) {
    if (c == '"') quoted_text = !quoted_text;
    if (!quoted_text && (c == '\t' || c == ';' || c == ',')) found += c;
  }
  for (const char candidate : {'\t', ';', ','}) {
    if (found.find(candidate) != std::string::npos) return candidate;
  }
  return '\0';
}

struct Cell {
  std::string_view text;
  std::size_t begin = 0;
};

std::vector<Cell> cells_of(std::string_view content, std::size_t begin, std::size_t end,
                           char separator) {
  std::vector<Cell> cells;
  const std::string_view line = content.substr(0, end);
  while (true) {
    const std::size_t stop = end_of_cell(line, begin, separator);
    cells.push_back({unquoted_cell(line.substr(begin, stop - begin)), begin});
    if (stop >= end) return cells;
    begin = stop + 1;
  }
}

bool is_number(std::string_view cell, char separator) {
  return !std::isnan(cell_number(cell, separator != ','));
}

/// Two or more cells, each a number or a mark for none, and at least one number.
bool is_row(const std::vector<Cell>& cells, char separator) {
  const auto number = [&](const Cell& cell) { return is_number(cell.text, separator); };
  return cells.size() > 1 && std::any_of(cells.begin(), cells.end(), number) &&
         std::all_of(cells.begin(), cells.end(),
                     [&](const Cell& cell) { return number(cell) || marks_no_number(cell.text); });
}

struct Line {
  std::size_t begin = 0;
  std::size_t end = 0;
  bool comment = false;
};

// "p1_in [psi]": the unit is in the brackets the text ends with.
RecordColumn named_column(std::string_view text) {
  constexpr std::array<std::pair<char, char>, 2> brackets{{{'[', ']'}, {'(', ')'}}};
  for (const auto& [open, close] : brackets) {
    const std::size_t begin = text.rfind(open);
    if (text.empty() || text.back() != close || begin == std::string_view::npos) continue;
    const std::string_view unit = trimmed(text.substr(begin + 1, text.size() - begin - 2));
    return {std::string(trimmed(text.substr(0, begin))), std::string(unit), {}};
  }
  return {std::string(text), "", {}};
}

// Cells in brackets, or short ones without digits or blanks: "s", "[psi]", "deg/s".
bool is_unit_line(const std::vector<Cell>& cells) {
  return std::all_of(cells.begin(), cells.end(), [](const Cell& cell) {
    return !cell.text.empty() && ((cell.text.front() == '[' && cell.text.back() == ']') ||
                                  (cell.text.front() == '(' && cell.text.back() == ')'));
  });
}

}  // namespace

void refuse_record(std::string_view content, std::size_t byte, const std::string& name,
                   const std::string& message) {
  byte = std::min(byte, content.size());
  std::size_t line = 1;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < byte; ++i) {
    const bool first_of_two =
        content[i] == '\r' && i + 1 < content.size() && content[i + 1] == '\n';
    if ((content[i] != '\n' && content[i] != '\r') || first_of_two) continue;
    ++line;
    begin = i + 1;
  }
  throw InvalidInput(fmt::format("{}:{}:{}: {}", name, line,
                                 character_count(content.substr(begin, byte - begin)) + 1,
                                 message));
}

bool marks_no_number(std::string_view cell) {
  constexpr std::array<std::string_view, 16> marks{"",   "nan", "-nan", "inf",  "-inf", "+inf",
                                                   "na", "n/a", "#n/a", "null", "none", "-",
                                                   "--", "---", "?",    "*"};
  return std::any_of(marks.begin(), marks.end(), [cell](std::string_view mark) {
    return cell.size() == mark.size() &&
           std::equal(cell.begin(), cell.end(), mark.begin(), [](char c, char m) {
             return (c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c) == m;
           });
  });
}

std::string_view unquoted_cell(std::string_view cell) {
  cell = trimmed(cell);
  if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"') {
    cell = trimmed(cell.substr(1, cell.size() - 2));
  }
  return cell;
}

std::size_t end_of_cell(std::string_view content, std::size_t begin, char separator) {
  bool quoted_text = false;
  for (std::size_t i = begin; i < content.size(); ++i) {
    const char c = content[i];
    if (c == '\n' || c == '\r') return i;
    if (c == '"') quoted_text = !quoted_text;
    if (c == separator && !quoted_text) return i;
  }
  return content.size();
}

double cell_number(std::string_view cell, bool decimal_comma) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  std::array<char, 64> copy{};
  if (cell.size() > 1 && cell.front() == '+' && cell[1] != '-') cell.remove_prefix(1);
  if (cell.empty() || cell.size() > copy.size()) return none;
  const char last = cell.back();
  if ((last < '0' || last > '9') && last != '.' && last != ',') return none;  // nan, inf
  if (decimal_comma && std::count(cell.begin(), cell.end(), ',') == 1 &&
      cell.find('.') == std::string_view::npos) {
    std::replace_copy(cell.begin(), cell.end(), copy.begin(), ',', '.');
    cell = {copy.data(), cell.size()};
  }
  double value = 0.0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (end != cell.data() + cell.size() || error == std::errc::invalid_argument) return none;
  return error == std::errc{} ? value : std::numeric_limits<double>::infinity();
}

RecordHeader read_record_header(std::string_view content, const std::string& name) {
  RecordHeader header;
  std::size_t position = content.starts_with("\xEF\xBB\xBF") ? 3 : 0;
  if (content.substr(0, furthest_row).find('\0') != std::string_view::npos ||
      content.starts_with("\xFF\xFE") || content.starts_with("\xFE\xFF")) {
    refuse_record(content, 0, name,
                  "expected a text of ASCII or UTF-8 characters, or a MAT file of version 5, found "
                  "other bytes (save as CSV in UTF-8)");
  }
  std::vector<Line> above;
  while (position < std::min(content.size(), furthest_row)) {
    const std::size_t end = std::min(content.find_first_of("\r\n", position), content.size());
    std::string_view text = trimmed(content.substr(position, end - position));
    Line line{position, end, !text.empty() && (text.front() == '#' || text.front() == '%')};
    if (!text.empty() && !line.comment) {
      header.separator = separator_of(text);
      if (header.separator != '\0' &&
          is_row(cells_of(content, position, end, header.separator), header.separator)) {
        header.first_row = position;
        break;
      }
    }
    if (line.comment) line.begin = content.find_first_not_of("#% \t", position);
    if (!text.empty() && line.begin < end) above.push_back(line);
    position = end;
    if (position < content.size() && content[position] == '\r') ++position;
    if (position < content.size() && content[position] == '\n' && content[position - 1] != '\n') {
      ++position;
    } else if (position == end) {
      ++position;
    }
  }
  if (header.first_row == 0 &&
      (above.empty() || position >= furthest_row || position >= content.size())) {
    refuse_record(content, above.empty() ? 0 : above.back().end, name,
                  "expected a header and lines of numbers separated by comma, semicolon or tab, "
                  "found no line of two or more numbers");
  }
  const auto in_line = [&](const Line& line) {
    return cells_of(content, line.begin, line.end, header.separator);
  };
  const std::size_t row_end =
      std::min(content.find_first_of("\r\n", header.first_row), content.size());
  const std::size_t width = cells_of(content, header.first_row, row_end, header.separator).size();
  std::vector<Cell> units;
  if (above.size() > 1 && !above.back().comment && is_unit_line(in_line(above.back())) &&
      in_line(above[above.size() - 2]).size() == in_line(above.back()).size()) {
    units = in_line(above.back());
    above.pop_back();
  }
  // Comments between header and numbers say something about the numbers, unless there is no header.
  auto chosen =
      std::find_if(above.rbegin(), above.rend(), [](const Line& line) { return !line.comment; });
  if (chosen == above.rend()) {
    chosen = std::find_if(above.rbegin(), above.rend(),
                          [&](const Line& line) { return in_line(line).size() == width; });
  }
  if (chosen == above.rend()) {
    refuse_record(content, header.first_row, name,
                  "expected a header such as 'time [s],tach [V]' above the numbers, found none");
  }
  const std::vector<Cell> names = in_line(*chosen);
  const bool numbers_among = std::any_of(names.begin(), names.end(), [&](const Cell& cell) {
    return is_number(cell.text, header.separator);
  });
  for (const Cell& cell : names) {
    if (numbers_among && !chosen->comment && !is_number(cell.text, header.separator) &&
        !marks_no_number(cell.text)) {
      refuse_record(content, cell.begin, name,
                    fmt::format("expected a number, found {}", quoted(cell.text)));
    }
  }
  if (names.size() < 2 || names.size() > most_columns) {
    refuse_record(content, chosen->begin, name,
                  fmt::format("expected a header of 2 to {} names separated as the numbers are, "
                              "found {}",
                              most_columns, names.size()));
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    header.columns.push_back(named_column(names[i].text));
    if (units.empty()) continue;
    header.columns.back().unit = named_column(units[i].text).unit;
  }
  if (header.columns.back().name.empty()) header.columns.pop_back();  // a separator ends each line
  if (chosen->comment) header.remarks.emplace_back("the header was taken from a comment line");
  const auto skipped =
      std::count_if(chosen + 1, above.rend(), [](const Line& line) { return !line.comment; });
  if (skipped > 0) {
    header.remarks.push_back(fmt::format("{} lines above the header were skipped", skipped));
  }
  return header;
}

}  // namespace boresight::app
