#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include <fmt/format.h>

#include <boresight/app/io/mat_elements.hpp>
#include <boresight/app/io/record_mat.hpp>
#include <boresight/app/io/wording.hpp>
#include <boresight/plant/error.hpp>

namespace boresight::app {
namespace {

constexpr std::size_t head_size = 128;
constexpr std::size_t most_columns = 4096;
constexpr int deepest = 8;

class Collector {
 public:
  Collector(bool swapped, const std::string& name) : swapped_(swapped), name_(name) {}

  void take(const MatElement& element, const std::string& field, int depth) {
    if (element.type != mat_matrix) return;
    MatArray array = read_mat_array(element, swapped_, name_);
    const std::string name = field.empty() ? array.name : field;
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
        names += (i == 0 ? "" : ", ") + quoted(left_out_[i]);
      }
      if (left_out_.size() > 8) names += fmt::format(" and {} more", left_out_.size() - 8);
      table.remarks.push_back(fmt::format("no vectors of numbers, left out: {}", names));
    }
    return table;
  }

 private:
  void add(std::string name, std::vector<double> values) {
    if (columns_.size() == most_columns) {
      throw InvalidInput(
          fmt::format("{}: expected at most {} vectors, found more", name_, most_columns));
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
                                    quoted(name), array.elements));
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
    MatElement element = array.rest.next();
    if (element.type == 16) element.type = 2;  // UTF-8
    if (element.type == 17) element.type = 4;  // UTF-16
    std::string text;
    for (const double code : array.rest.numbers(element)) {
      text +=
          code >= 32.0 && code < 256.0 ? static_cast<char>(static_cast<unsigned char>(code)) : '?';
    }
    return text;
  }

  void take_structure(MatArray& array, const std::string& name, int depth) {
    const std::vector<std::int64_t> length = array.rest.integers(array.rest.next());
    const std::string_view names = array.rest.next().bytes;
    if (length.empty() || length[0] < 1 || length[0] > 1024) {
      array.rest.refuse("a structure whose field names have no length");
    }
    if (array.elements != 1) {
      left_out_.push_back(name);
      return;
    }
    const auto step = static_cast<std::size_t>(length[0]);
    const std::size_t first = columns_.size();
    std::string unit;
    for (std::size_t begin = 0; begin + step <= names.size(); begin += step) {
      const std::string_view padded = names.substr(begin, step);
      const std::string field(padded.substr(0, std::min(padded.find('\0'), step)));
      const MatElement element = array.rest.next();
      const bool is_unit = field == "unit" || field == "units";
      take(element, field, depth + 1);
      const auto text = texts_.find(field);
      if (is_unit && text != texts_.end()) {
        unit = text->second;
        texts_.erase(text);
      }
    }
    // { data, unit } is one signal, named by its structure.
    constexpr std::array<std::string_view, 3> contents{"data", "values", "signal"};
    if (columns_.size() == first + 1 &&
        std::find(contents.begin(), contents.end(), columns_[first].name) != contents.end()) {
      columns_[first].name = name;
      columns_[first].unit = unit;
    }
  }

  bool swapped_;
  const std::string& name_;
  std::vector<RecordColumn> columns_;
  std::map<std::string, std::string> texts_;
  std::vector<std::string> left_out_;
};

}  // namespace

bool is_mat(std::string_view content) {
  return content.starts_with("MATLAB ") || content.starts_with("\x89HDF") ||
         (content.size() >= head_size &&
          (content.substr(126, 2) == "IM" || content.substr(126, 2) == "MI"));
}

RecordTable read_record_mat(std::string_view content, const std::string& name) {
  if (content.starts_with("MATLAB 7.3") || content.starts_with("\x89HDF")) {
    throw InvalidInput(fmt::format(
        "{}: expected a MAT file of version 5, found version 7.3 (save it with `save -v7`)", name));
  }
  if (content.size() < head_size) {
    throw InvalidInput(fmt::format("{}: expected a whole MAT file of version 5, found {} bytes",
                                   name, content.size()));
  }
  const std::string_view order = content.substr(126, 2);
  if (order != "IM" && order != "MI") {
    throw InvalidInput(fmt::format(
        "{}: expected a MAT file of version 5, found another (save it with `save -v7`)", name));
  }
  const bool swapped = order == "MI";  // written on a machine of the other byte order
  MatCursor cursor(content.substr(head_size), swapped, name);
  Collector collector(swapped, name);
  while (!cursor.at_end()) {
    const MatElement element = cursor.next();
    if (element.type != mat_compressed) {
      collector.take(element, "", 0);
      continue;
    }
    const std::string bytes = inflate_mat(element, swapped, name);
    MatCursor inner(bytes, swapped, name);
    collector.take(inner.next(), "", 0);
  }
  RecordTable table = std::move(collector).table();
  table.path = name;
  table.bytes = content.size();
  table.format = "MAT 5";
  if (table.columns.empty()) {
    throw InvalidInput(fmt::format("{}: expected vectors of numbers, found none", name));
  }
  return table;
}

}  // namespace boresight::app
