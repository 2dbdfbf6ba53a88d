#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include <fmt/format.h>

#include <boresight/io/records/mat_file.hpp>
#include <boresight/io/records/record_mat.hpp>
#include <boresight/io/units/wording.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::io {
namespace {

constexpr std::size_t max_columns = 4096;
constexpr int deepest = 8;

class Collector {
 public:
  explicit Collector(const std::string& name) : name_(name) {}

  void take(MatArray& array, const std::string& name, int depth) {
    if (array.kind == MatArray::Class::number && array.elements > 1) {
      take_numbers(array, name);
    } else if (array.kind == MatArray::Class::text) {
      texts_[name] = text_of(array);
    } else if (array.kind == MatArray::Class::structure && depth < deepest) {
      take_structure(array, name, depth);
    } else {
      left_out_.push_back(name);
    }
  }

  RecordTable table() && {
    RecordTable table;
    for (auto& column : columns_) {
      for (const auto* suffix : {"_unit", "_units"}) {
        const auto text = texts_.find(column.name + suffix);
        if (text != texts_.end() && column.unit.empty()) column.unit = text->second;
      }
    }
    table.columns = std::move(columns_);
    if (!left_out_.empty()) {
      std::string names;
      for (std::size_t i = 0; i < std::min<std::size_t>(left_out_.size(), 8); ++i) {
        names += (i == 0 ? "" : ", ") + in_quotes(left_out_[i]);
      }
      if (left_out_.size() > 8) names += fmt::format(" and {} more", left_out_.size() - 8);
      table.remarks.push_back(fmt::format("no vectors of numbers, left out: {}", names));
    }
    return table;
  }

 private:
  void add(std::string name, std::vector<double> values) {
    if (columns_.size() == max_columns) {
      throw InvalidInput(
          fmt::format("{}: expected at most {} vectors, found more", name_, max_columns));
    }
    columns_.push_back({std::move(name), "", std::move(values)});
  }

  void take_numbers(MatArray& array, const std::string& name) {
    if (array.complex || array.dimensions.size() != 2) {
      left_out_.push_back(name);
      return;
    }
    std::vector<double> values = array.rest.numbers(array.rest.next());
    if (values.size() != array.elements) {
      array.rest.refuse(fmt::format("{} numbers in {} that should have {}", values.size(),
                                    in_quotes(name), array.elements));
    }
    const auto rows = static_cast<std::size_t>(array.dimensions[0]);
    const auto width = static_cast<std::size_t>(array.dimensions[1]);
    if (rows == 1 || width == 1) {
      add(name, std::move(values));
    } else {
      for (std::size_t i = 0; i < width; ++i) {
        const auto begin = values.begin() + static_cast<std::ptrdiff_t>(i * rows);
        add(fmt::format("{}(:,{})", name, i + 1),
            {begin, begin + static_cast<std::ptrdiff_t>(rows)});
      }
    }
  }

  std::string text_of(MatArray& array) const {
    if (array.elements == 0 || array.elements > 1000) return {};
    std::string text;
    for (const double code : mat_characters(array)) {
      text +=
          code >= 32.0 && code < 256.0 ? static_cast<char>(static_cast<unsigned char>(code)) : '?';
    }
    return text;
  }

  void take_structure(MatArray& array, const std::string& name, int depth) {
    if (array.elements != 1) left_out_.push_back(name);
    const std::size_t first = columns_.size();
    std::string unit;
    read_mat_fields(array, [&](const std::string& field, MatArray& inner) {
      take(inner, field, depth + 1);
      const auto text = texts_.find(field);
      if ((field == "unit" || field == "units") && text != texts_.end()) {
        unit = text->second;
        texts_.erase(text);
      }
    });
    // { data, unit } is one signal, named by its structure.
    constexpr std::array<std::string_view, 3> contents{"data", "values", "signal"};
    if (columns_.size() == first + 1 &&
        std::find(contents.begin(), contents.end(), columns_[first].name) != contents.end()) {
      columns_[first].name = name;
      columns_[first].unit = unit;
    }
  }

  const std::string& name_;
  std::vector<RecordColumn> columns_;
  std::map<std::string, std::string> texts_;
  std::vector<std::string> left_out_;
};

}  // namespace

bool is_mat(std::string_view content) {
  if (content.starts_with("MATLAB 5.0 MAT-file") || content.starts_with("MATLAB 7.3 MAT-file") ||
      content.starts_with("\x89HDF")) {
    return true;
  }
  // The text at its head is free: version 1.0 and the mark of the byte order follow it.
  const std::string_view mark = content.substr(std::min<std::size_t>(content.size(), 124), 4);
  return mark == std::string_view("\x00\x01IM", 4) || mark == std::string_view("\x01\x00MI", 4);
}

RecordTable read_record_mat(std::string_view content, const std::string& name) {
  Collector collector(name);
  read_mat_file(content, name, [&](MatArray& array) { collector.take(array, array.name, 0); });
  RecordTable table = std::move(collector).table();
  table.path = name;
  table.bytes = content.size();
  table.format = "MAT 5";
  if (table.columns.empty()) {
    throw InvalidInput(fmt::format("{}: expected vectors of numbers, found none", name));
  }
  return table;
}

}  // namespace boresight::io
