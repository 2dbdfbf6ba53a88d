#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <limits>

#include <fmt/format.h>

#include <boresight/io/records/record_header.hpp>
#include <boresight/io/records/record_text.hpp>
#include <boresight/io/units/wording.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::io {
namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
// More lines that end early than this, and than whole ones, are no accident.
constexpr std::size_t forgiven_short_rows = 100;
// As many bytes tell whether the decimal sign is a comma.
constexpr std::size_t sample_of_numbers = std::size_t{1} << 16U;

bool ends_line(char c) {
  return c == '\n' || c == '\r';
}

// Digits behind the decimal sign.
std::size_t decimals(std::string_view cell, bool decimal_comma) {
  const std::size_t sign = cell.find(decimal_comma ? ',' : '.');
  if (sign == std::string_view::npos) return 0;
  const std::size_t end = std::min(cell.find_first_not_of("0123456789", sign + 1), cell.size());
  return end - sign - 1;
}

class RowReader {
 public:
  RowReader(std::string_view content, const std::string& name, RecordHeader header)
      : content_(content),
        name_(name),
        separator_(header.separator),
        columns_(std::move(header.columns)),
        position_(header.first_row) {
    const std::string_view sample = content_.substr(position_, sample_of_numbers);
    decimal_comma_ = separator_ != ',' && sample.find(',') != std::string_view::npos &&
                     sample.find('.') == std::string_view::npos;
    const auto lines = std::count_if(sample.begin(), sample.end(), ends_line) + 1;
    // A line of n cells has at least 2 n - 1 characters, and its end.
    const std::size_t line_length =
        std::max(sample.size() / static_cast<std::size_t>(lines), 2 * columns_.size());
    const std::size_t rows = (content_.size() - position_) / line_length;
    grow(rows + rows / 16 + 16);
  }

  void read() {
    while (position_ < content_.size()) read_line();
    drop_unfinished_row();
    for (auto& column : columns_) column.values.resize(rows_);
  }

  std::vector<RecordColumn> columns() && { return std::move(columns_); }
  bool decimal_comma() const { return decimal_comma_; }
  const std::vector<std::string>& remarks() const { return remarks_; }

 private:
  void grow(std::size_t rows) {
    capacity_ = rows;
    ends_.clear();
    for (auto& column : columns_) {
      column.values.resize(rows);
      ends_.push_back(column.values.data());
    }
  }

  void read_line() {
    const char first = content_[position_];
    if (first == '#' || first == '%') {
      position_ = std::min(content_.find_first_of("\r\n", position_), content_.size());
    }
    if (position_ < content_.size() && !ends_line(content_[position_])) {
      const std::size_t blank =
          std::min(content_.find_first_not_of(" \t", position_), content_.size());
      if (blank == content_.size() || ends_line(content_[blank])) {
        position_ = blank;
      } else {
        read_row();
      }
    }
    if (position_ < content_.size() && content_[position_] == '\r') ++position_;
    if (position_ < content_.size() && content_[position_] == '\n') ++position_;
  }

  void read_row() {
    if (rows_ == capacity_) grow(capacity_ + capacity_ / 2);
    row_before_ = row_;
    row_ = position_;
    const char* const begin = content_.data();
    const char* const end = begin + content_.size();
    const char* at = begin + position_;
    std::size_t cells = 0;
    while (true) {
      const char* number = at;
      while (number != end && *number == ' ') ++number;
      double value = no_number;
      const auto [stop, error] = std::from_chars(number, end, value);
      const char* next = stop;
      while (next != end && *next == ' ') ++next;
      const bool whole = next == end || *next == separator_ || ends_line(*next);
      if (error != std::errc{} || !whole) {
        const auto cell = static_cast<std::size_t>(at - begin);
        const std::size_t stop_at = end_of_cell(content_, cell, separator_);
        value = odd_cell(cell, stop_at);
        next = begin + stop_at;
      }
      if (cells < ends_.size()) {
        ends_[cells][rows_] = std::isfinite(value) ? value : no_number;
      } else {
        refuse_surplus(at, next);
      }
      ++cells;
      at = next;
      if (at == end || *at != separator_) break;
      ++at;
    }
    position_ = static_cast<std::size_t>(at - begin);
    if (cells < ends_.size()) end_short_row(cells);
    ++rows_;
  }

  // What std::from_chars does not take as it stands: quotes, a decimal comma, a plus sign, marks.
  double odd_cell(std::size_t begin, std::size_t end) const {
    const std::string_view cell = unquoted_cell(content_.substr(begin, end - begin));
    const double value = cell_number(cell, decimal_comma_);
    if (std::isfinite(value)) return value;
    if (std::isinf(value)) {
      refuse_record(
          content_, begin, name_,
          fmt::format("expected a number that fits double precision, found {}", in_quotes(cell)));
    }
    if (marks_no_number(cell)) return no_number;
    refuse_record(content_, begin, name_,
                  fmt::format("expected a number, found {} (a missing one is left empty, or nan, "
                              "na, null or -; a comment begins with # or %)",
                              in_quotes(cell)));
  }

  void refuse_surplus(const char* begin, const char* end) const {
    if (begin == end || unquoted_cell({begin, static_cast<std::size_t>(end - begin)}).empty()) {
      return;  // a separator ends the line
    }
    refuse_record(content_, static_cast<std::size_t>(begin - content_.data()), name_,
                  fmt::format("expected the line to end after {} cells, as many as the header has, "
                              "found one more",
                              ends_.size()));
  }

  void end_short_row(std::size_t cells) {
    for (std::size_t i = cells; i < ends_.size(); ++i) ends_[i][rows_] = no_number;
    if (position_ == content_.size()) {  // the last line: drop_unfinished_row() sees to it
      unfinished_ = true;
      return;
    }
    if (short_rows_ == 0) {
      remarks_.push_back(fmt::format("the line of sample {} ends after {} of {} cells", rows_,
                                     cells, ends_.size()));
    }
    ++short_rows_;
    if (short_rows_ > forgiven_short_rows && 2 * short_rows_ > rows_) {
      refuse_record(content_, row_, name_,
                    fmt::format("expected {} cells in each line, as in the header, found fewer in "
                                "{} of {} lines",
                                ends_.size(), short_rows_, rows_ + 1));
    }
  }

  std::string_view last_cell(std::size_t row) const {
    std::size_t begin = row;
    while (true) {
      const std::size_t end = end_of_cell(content_, begin, separator_);
      if (end == content_.size() || ends_line(content_[end])) {
        return unquoted_cell(content_.substr(begin, end - begin));
      }
      begin = end + 1;
    }
  }

  // A recorder that was switched off leaves a part of a line, or of a number.
  void drop_unfinished_row() {
    if (short_rows_ > 1) {
      remarks_.back() += fmt::format(", and {} more lines end early", short_rows_ - 1);
    }
    const bool open =
        rows_ > 1 && !content_.empty() && !ends_line(content_.back()) &&
        std::min(content_.find_first_of("\r\n", row_), content_.size()) == content_.size();
    if (open && !unfinished_) {
      unfinished_ = decimals(last_cell(row_), decimal_comma_) <
                    decimals(last_cell(row_before_), decimal_comma_);
    }
    if (!unfinished_ || rows_ < 2) return;
    --rows_;
    remarks_.push_back(fmt::format("the last line, sample {}, is unfinished: left out", rows_));
  }

  std::string_view content_;
  const std::string& name_;
  char separator_;
  std::vector<RecordColumn> columns_;
  std::vector<double*> ends_;  // first value of each column
  std::size_t position_;
  bool decimal_comma_ = false;
  std::size_t rows_ = 0;
  std::size_t capacity_ = 0;
  std::size_t short_rows_ = 0;
  std::size_t row_ = 0;
  std::size_t row_before_ = 0;
  bool unfinished_ = false;
  std::vector<std::string> remarks_;
};

}  // namespace

RecordTable read_record_text(std::string_view content, const std::string& name) {
  RecordHeader header = read_record_header(content, name);
  RecordTable table;
  table.path = name;
  table.bytes = content.size();
  table.remarks = header.remarks;
  const char separator = header.separator;
  RowReader reader(content, name, std::move(header));
  reader.read();
  table.remarks.insert(table.remarks.end(), reader.remarks().begin(), reader.remarks().end());
  table.format = fmt::format("text separated by {}{}",
                             separator == '\t'  ? "tab"
                             : separator == ';' ? "semicolon"
                                                : "comma",
                             reader.decimal_comma() ? ", decimal comma" : "");
  table.columns = std::move(reader).columns();
  return table;
}

}  // namespace boresight::io
