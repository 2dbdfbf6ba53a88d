#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include <boresight/io/records/record_header.hpp>
#include <boresight/io/records/recorded_unit.hpp>
#include <boresight/io/units/wording.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::io {
namespace {

constexpr std::size_t max_columns = 4096;
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

// "p1_in [psi]": the unit is in the brackets the text ends with. "Tach (raw)" has no unit.
RecordColumn named_column(std::string_view text) {
  constexpr std::array<std::pair<char, char>, 2> brackets{{{'[', ']'}, {'(', ')'}}};
  for (const auto& [open, close] : brackets) {
    const std::size_t begin = text.rfind(open);
    if (text.empty() || text.back() != close || begin == std::string_view::npos) continue;
    std::string unit(trimmed(text.substr(begin + 1, text.size() - begin - 2)));
    if (open == '(' && !recorded_unit(unit)) continue;
    return {std::string(trimmed(text.substr(0, begin))), std::move(unit), {}};
  }
  return {std::string(text), "", {}};
}

// A unit in a line of units: in brackets, or as it is.
std::string_view unit_of(std::string_view cell) {
  const bool brackets = cell.size() > 1 && ((cell.front() == '[' && cell.back() == ']') ||
                                            (cell.front() == '(' && cell.back() == ')'));
  return brackets ? trimmed(cell.substr(1, cell.size() - 2)) : cell;
}

// "s,psi,V", "[s],[psi],[]": cells in brackets, units, marks for none; and at least one unit. A
// bare "t" is a time, no tonne.
bool is_unit_line(const std::vector<Cell>& cells) {
  bool units = false;
  for (const Cell& cell : cells) {
    const std::string_view unit = unit_of(cell.text);
    const bool known =
        !unit.empty() && cell.text != "t" && recorded_unit(std::string(unit)).has_value();
    units = units || known;
    if (!known && unit.size() == cell.text.size() && !marks_no_number(cell.text)) return false;
  }
  return units;
}

// Of the lines above the numbers, the one with the names: the last that has as many cells as the
// numbers, or one more or less where a separator ends the lines; else whichever is the last. A
// comment only if no other will do: comments say something about the numbers.
std::size_t header_among(const std::vector<Line>& above, const std::vector<std::size_t>& widths,
                         std::size_t width) {
  for (const std::size_t tolerance : {std::size_t{0}, std::size_t{1}}) {
    for (const bool comment : {false, true}) {
      for (std::size_t i = above.size(); i-- > 0;) {
        const std::size_t off = widths[i] > width ? widths[i] - width : width - widths[i];
        if (above[i].comment == comment && off <= tolerance && widths[i] > 1) return i;
      }
    }
  }
  for (std::size_t i = above.size(); i-- > 0;) {
    if (!above[i].comment) return i;
  }
  return above.size();
}

// Where a line was a row of numbers but for some cells, for the message if there is no better one.
struct OddCell {
  std::size_t begin = 0;
  std::string text;
};

std::optional<OddCell> odd_cell_of(const std::vector<Cell>& cells, char separator) {
  std::optional<OddCell> odd;
  std::size_t numbers = 0;
  for (const Cell& cell : cells) {
    if (is_number(cell.text, separator)) {
      ++numbers;
    } else if (!odd && !marks_no_number(cell.text)) {
      odd = {cell.begin, std::string(cell.text)};
    }
  }
  return 2 * numbers >= cells.size() && numbers > 1 ? odd : std::nullopt;
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
  std::optional<OddCell> odd;
  bool found = false;
  while (position < std::min(content.size(), furthest_row)) {
    const std::size_t end = std::min(content.find_first_of("\r\n", position), content.size());
    std::string_view text = trimmed(content.substr(position, end - position));
    Line line{position, end, !text.empty() && (text.front() == '#' || text.front() == '%')};
    if (!text.empty() && !line.comment) {
      header.separator = separator_of(text);
      const auto cells = cells_of(content, position, end, header.separator);
      if (header.separator != '\0' && is_row(cells, header.separator)) {
        header.first_row = position;
        found = true;
        break;
      }
      if (header.separator != '\0' && !odd) odd = odd_cell_of(cells, header.separator);
    }
    if (line.comment) line.begin = content.find_first_not_of("#% \t", position);
    if (!text.empty() && line.begin < end) above.push_back(line);
    position = end;
    if (position < content.size() && content[position] == '\r') ++position;
    if (position < content.size() && content[position] == '\n') ++position;
  }
  if (!found && odd) {
    refuse_record(
        content, odd->begin, name,
        fmt::format("expected a number, found {} (columns of text, dates and times of day "
                    "are not read: leave them out)",
                    in_quotes(odd->text)));
  }
  if (!found) {
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
  std::vector<std::size_t> widths;
  for (const Line& line : above) widths.push_back(in_line(line).size());
  std::vector<Cell> units;
  if (above.size() > 1 && !above.back().comment && widths.back() > 1 &&
      widths[above.size() - 2] == widths.back() && is_unit_line(in_line(above.back())) &&
      !is_unit_line(in_line(above[above.size() - 2]))) {
    units = in_line(above.back());
    above.pop_back();
  }
  const std::size_t place = header_among(above, widths, width);
  if (place == above.size()) {
    refuse_record(content, header.first_row, name,
                  "expected a header such as 'time [s],tach [V]' above the numbers, found none");
  }
  const auto* const chosen = &above[place];
  const std::vector<Cell> names = in_line(*chosen);
  const bool numbers_among = std::any_of(names.begin(), names.end(), [&](const Cell& cell) {
    return is_number(cell.text, header.separator);
  });
  for (const Cell& cell : names) {
    if (numbers_among && !chosen->comment && !is_number(cell.text, header.separator) &&
        !marks_no_number(cell.text)) {
      refuse_record(content, cell.begin, name,
                    fmt::format("expected a number, found {}", in_quotes(cell.text)));
    }
  }
  if (names.size() < 2 || names.size() > max_columns) {
    refuse_record(content, chosen->begin, name,
                  fmt::format("expected a header of 2 to {} names separated as the numbers are, "
                              "found {}",
                              max_columns, names.size()));
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    header.columns.push_back(named_column(names[i].text));
    if (i >= units.size() || marks_no_number(units[i].text)) continue;
    std::string& unit = header.columns.back().unit;
    if (unit.empty()) unit = unit_of(units[i].text);
  }
  while (header.columns.size() > 1 && header.columns.back().name.empty()) {
    header.columns.pop_back();  // separators end each line
  }
  if (chosen->comment) header.remarks.emplace_back("the header was taken from a comment line");
  if (!units.empty()) {
    header.remarks.emplace_back("the line below the names was taken for their units");
  }
  const auto text_lines = [&](std::size_t begin, std::size_t end) {
    return std::count_if(above.begin() + static_cast<std::ptrdiff_t>(begin),
                         above.begin() + static_cast<std::ptrdiff_t>(end),
                         [](const Line& line) { return !line.comment; });
  };
  for (const auto& [count, where] : {std::pair{text_lines(0, place), "above the header"},
                                     {text_lines(place + 1, above.size()), "below the header"}}) {
    if (count == 0) continue;
    header.remarks.push_back(fmt::format("{} line{} {} {} skipped", count, count == 1 ? "" : "s",
                                         where, count == 1 ? "was" : "were"));
  }
  return header;
}

}  // namespace boresight::io
