#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

#include <boresight/io/files/input_files.hpp>
#include <boresight/io/units/unit_table.hpp>
#include <boresight/io/units/wording.hpp>

namespace boresight::io {
namespace {

constexpr std::uintmax_t largest_file = 256U << 20U;  // bytes

struct Line {
  std::string_view text;
  int number = 0;
};

[[noreturn]] void refuse_line(const std::string& path, int line, const std::string& message) {
  throw InvalidInput(fmt::format("{}:{}: {}", path, line, message));
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blank = " \t\r";
  const auto begin = text.find_first_not_of(blank);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(blank) - begin + 1);
}

std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> cells;
  for (;;) {
    const auto comma = line.find(',');
    cells.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return cells;
    line.remove_prefix(comma + 1);
  }
}

std::string content(const std::string& path) {
  std::error_code failure;
  const auto size = std::filesystem::file_size(path, failure);
  if (failure || !std::filesystem::is_regular_file(path, failure)) {
    throw InvalidInput(
        fmt::format("{}: expected a readable table file, found none{}", path,
                    failure ? fmt::format(" ({})", failure.message()) : std::string()));
  }
  if (size > largest_file) {
    throw InvalidInput(
        fmt::format("{}: expected a table file of at most 256 MB, found {} bytes", path, size));
  }
  std::ifstream file(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  if (!file) throw InvalidInput(fmt::format("{}: expected a readable table file", path));
  note_input(path, text);
  return text;
}

// Header and rows: what is neither blank nor a comment.
std::vector<Line> lines_of(std::string_view text) {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
  std::vector<Line> lines;
  for (int number = 1; !text.empty(); ++number) {
    const auto end = text.find('\n');
    const auto line = trimmed(text.substr(0, end));
    if (!line.empty() && line.front() != '#') lines.push_back({line, number});
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return lines;
}

bool stands_for(const UnitTableColumn& column, std::string_view name) {
  if (!column.name.ends_with('*')) return name == column.name;
  return name.starts_with(std::string_view(column.name).substr(0, column.name.size() - 1));
}

// SI per number in a column.
double factor_of(const std::string& path, int line, std::string_view name, std::string_view unit,
                 Kind kind) {
  const auto& known = describe(kind);
  const Unit own = parse_unit(known.si_unit);
  std::optional<Unit> found;
  try {
    found = parse_unit(unit);
  } catch (const UnitError& error) {
    refuse_line(path, line, fmt::format("column {}: {}", in_quotes(name), error.what()));
  }
  if (found->dimension != own.dimension) {
    refuse_line(path, line,
                fmt::format("column {}: expected {}, found the unit {}", in_quotes(name),
                            expectation(kind), in_quotes(unit)));
  }
  return found->factor / own.factor;
}

struct Header {
  std::vector<std::string> names;
  std::vector<double> factors;
};

Header header_of(const std::string& path, const Line& line,
                 const std::vector<UnitTableColumn>& columns) {
  Header header;
  std::vector<std::string_view> known;
  for (const auto& column : columns) known.push_back(column.name);
  for (const auto cell : cells_of(line.text)) {
    const auto bracket = cell.find('[');
    const auto name = trimmed(cell.substr(0, bracket));
    std::string_view unit = "1";
    if (bracket != std::string_view::npos) {
      unit = cell.substr(bracket + 1);
      if (!unit.ends_with(']')) {
        refuse_line(
            path, line.number,
            fmt::format("expected columns written 'name [unit]', found {}", in_quotes(cell)));
      }
      unit = trimmed(unit.substr(0, unit.size() - 1));
    }
    const auto column = std::ranges::find_if(
        columns, [&](const UnitTableColumn& c) { return stands_for(c, name); });
    if (column == columns.end()) {
      refuse_line(path, line.number,
                  fmt::format("expected columns out of {}, found {}", fmt::join(known, ", "),
                              in_quotes(name)));
    }
    if (std::ranges::find(header.names, name) != header.names.end()) {
      refuse_line(path, line.number,
                  fmt::format("expected each column once, found {} again", in_quotes(name)));
    }
    header.names.emplace_back(name);
    header.factors.push_back(factor_of(path, line.number, name, unit, column->kind));
  }
  for (const auto& column : columns) {
    const bool found = std::ranges::any_of(
        header.names, [&](const std::string& name) { return stands_for(column, name); });
    if (column.needed && !found) {
      refuse_line(path, line.number,
                  fmt::format("expected a column '{} [{}]', found none", column.name,
                              describe(column.kind).si_unit));
    }
  }
  return header;
}

}  // namespace

std::map<std::string, Eigen::VectorXd> read_unit_table(
    const std::string& path, const std::vector<UnitTableColumn>& columns) {
  const std::string text = content(path);
  const auto lines = lines_of(text);
  if (lines.size() < 2) {
    throw InvalidInput(
        fmt::format("{}: expected a header 'name [unit],...' and at least one row, found {} lines",
                    path, lines.size()));
  }
  const Header header = header_of(path, lines.front(), columns);
  const auto rows = static_cast<Eigen::Index>(lines.size()) - 1;
  std::vector<Eigen::VectorXd> values(header.names.size(), Eigen::VectorXd(rows));
  for (Eigen::Index row = 0; row < rows; ++row) {
    const Line& line = lines[static_cast<std::size_t>(row) + 1];
    const auto cells = cells_of(line.text);
    if (cells.size() != values.size()) {
      refuse_line(path, line.number,
                  fmt::format("expected {} numbers, found {}", values.size(), cells.size()));
    }
    for (std::size_t i = 0; i < cells.size(); ++i) {
      double number = 0.0;
      const char* end = cells[i].data() + cells[i].size();
      const auto read = std::from_chars(cells[i].data(), end, number);
      if (read.ec != std::errc() || read.ptr != end || !std::isfinite(number)) {
        refuse_line(path, line.number,
                    fmt::format("column '{}': expected a finite number, found {}", header.names[i],
                                in_quotes(cells[i])));
      }
      values[i][row] = number * header.factors[i];
    }
  }
  std::map<std::string, Eigen::VectorXd> table;
  for (std::size_t i = 0; i < values.size(); ++i) table[header.names[i]] = std::move(values[i]);
  return table;
}

std::string beside_case(const std::string& case_path, const std::string& name) {
  return (std::filesystem::path(case_path).parent_path() / name).string();
}

}  // namespace boresight::io
