#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <set>
#include <utility>

#include <fmt/format.h>

#include <boresight/io/case/field.hpp>
#include <boresight/io/case/table_reader.hpp>
#include <boresight/io/case/toml_tree.hpp>
#include <boresight/io/files/input_files.hpp>
#include <boresight/io/units/wording.hpp>

namespace boresight::io {
namespace {

/// A parsed file; the tables read from it share it.
struct TomlText {
  std::string name;
  TomlNode root;
  /// Of all tables: the reader's record, not the file's content.
  mutable std::vector<Quantity> quantities;
};

bool is_bare_key(std::string_view key) {
  return !key.empty() && std::all_of(key.begin(), key.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-';
  });
}

Basis basis_named(std::string_view name) {
  constexpr std::array stated{Basis::measured, Basis::published, Basis::inferred, Basis::assumed};
  return *std::find_if(stated.begin(), stated.end(),
                       [name](Basis basis) { return to_string(basis) == name; });
}

}  // namespace

struct TableReader::Content {
  std::shared_ptr<const TomlText> document;
  const TomlNode& table;
  std::string path;
  std::set<std::string, std::less<>> asked;

  Field field(const TomlNode& node, std::string_view key) const {
    return {node, path_of(key), document->name};
  }

  std::string path_of(std::string_view key) const {
    const std::string step = is_bare_key(key) ? std::string(key) : in_quotes(key);
    return path.empty() ? step : fmt::format("{}.{}", path, step);
  }

  Location location() const { return {document->name, table.line, table.column}; }

  /// The field of a key, which from now on counts as read; none if the table lacks it.
  std::optional<Field> ask(std::string_view key) {
    asked.emplace(key);
    const TomlNode* node = table.find(key);
    return node != nullptr ? std::optional(field(*node, key)) : std::nullopt;
  }

  Field require(std::string_view key, std::string_view expected) {
    const std::optional<Field> found = ask(key);
    if (found) {
      return *found;
    }
    std::vector<std::string_view> unread;
    for (const TomlEntry& entry : table.entries) {
      if (!asked.contains(entry.key)) {
        unread.push_back(entry.key);
      }
    }
    // The reading ends here, before finish() could name the misspelt key.
    const std::string_view misspelt = nearest_name(key, unread);
    Location place = location();
    if (path.empty()) {
      // The file itself has no header to point at.
      for (const TomlEntry& entry : table.entries) {
        if (!misspelt.empty() && entry.key == misspelt) {
          place = {document->name, entry.line, entry.column};
        }
      }
    }
    refuse_at(place, path_of(key),
              fmt::format(
                  "expected {}, found nothing: key is missing{}", expected,
                  misspelt.empty() ? "" : fmt::format(" (is {} misspelt?)", in_quotes(misspelt))));
  }

  TableReader nested(const TomlNode& inner, const std::string& inner_path) const {
    return TableReader(std::make_unique<Content>(Content{document, inner, inner_path, {}}));
  }

  TableReader nested_table(const Field& found) const {
    if (found.node.type != TomlType::table) {
      refuse_field(found, "a table", fmt::format(" (write [{}] once)", found.path));
    }
    return nested(found.node, found.path);
  }

  Quantity record(Quantity quantity) const {
    document->quantities.push_back(quantity);
    return quantity;
  }

  Quantity quantity(const Field& found, Kind kind, const Range& range) const {
    if (found.node.type == TomlType::table) {
      return quantity_table(found, kind, range);
    }
    const PrintedNumber number = read_printed(found, kind);
    check_range(found, number, kind, range);
    Quantity result;
    result.value = number.value;
    result.half_unit = number.half_unit;
    // A rounding error is spread evenly over one unit of the last digit.
    result.standard_uncertainty = number.half_unit / std::numbers::sqrt3;
    result.text = number.text;
    result.kind = kind;
    result.key = found.path;
    result.location = found.location();
    return result;
  }

  Quantity quantity_table(const Field& found, Kind kind, const Range& range) const {
    TableReader reader = nested(found.node, found.path);
    Content& details = *reader.content_;
    const Field value = details.require("value", expectation(kind));
    if (value.node.type == TomlType::table) {
      refuse_field(value, expectation(kind));
    }
    Quantity result = quantity(value, kind, range);
    result.key = found.path;
    if (const std::optional<Field> uncertainty = details.ask("uncertainty")) {
      result.standard_uncertainty = read_uncertainty(*uncertainty, result);
      result.uncertainty_given = true;
    }
    if (const std::optional<Field> also = details.ask("also")) {
      result.also = read_printed_list(*also, kind);
    }
    if (const std::optional<Field> basis = details.ask("basis")) {
      result.basis =
          basis_named(read_choice(*basis, {"measured", "published", "inferred", "assumed"}));
    }
    result.source = reader.optional_text("source").value_or("");
    result.uncertainty_source = reader.optional_text("uncertainty_source").value_or("");
    reader.finish();
    return result;
  }
};

TableReader::TableReader(std::unique_ptr<Content> content) : content_(std::move(content)) {}
TableReader::TableReader(TableReader&&) noexcept = default;
TableReader& TableReader::operator=(TableReader&&) noexcept = default;
TableReader::~TableReader() = default;

TableReader TableReader::open(const std::string& path) {
  return parse(read_input(path), path);
}

TableReader TableReader::parse(std::string_view text, const std::string& name) {
  const auto document =
      std::make_shared<const TomlText>(TomlText{name, parse_toml(text, name), {}});
  return TableReader(std::make_unique<Content>(Content{document, document->root, "", {}}));
}

bool TableReader::has(std::string_view key) const {
  return content_->table.find(key) != nullptr;
}

Location TableReader::location(std::string_view key) const {
  const TomlNode* node = key.empty() ? nullptr : content_->table.find(key);
  return node != nullptr ? content_->field(*node, key).location() : content_->location();
}

std::string TableReader::path(std::string_view key) const {
  return key.empty() ? content_->path : content_->path_of(key);
}

Quantity TableReader::quantity(std::string_view key, Kind kind, Range range) {
  return content_->record(
      content_->quantity(content_->require(key, expectation(kind)), kind, range));
}

std::optional<Quantity> TableReader::optional_quantity(std::string_view key, Kind kind,
                                                       Range range) {
  const std::optional<Field> found = content_->ask(key);
  return found ? std::optional(content_->record(content_->quantity(*found, kind, range)))
               : std::nullopt;
}

Quantity TableReader::quantity_or(std::string_view key, Kind kind, Range range, double value,
                                  std::string source) {
  auto stated = optional_quantity(key, kind, range);
  return stated ? std::move(*stated) : assume(key, kind, value, std::move(source));
}

Quantity TableReader::assume(std::string_view key, Kind kind, double value, std::string source) {
  Quantity quantity;
  quantity.value = value;
  quantity.text = fmt::format("{:.4g}", value);
  if (kind != Kind::number) quantity.text += fmt::format(" {}", describe(kind).si_unit);
  quantity.kind = kind;
  quantity.basis = Basis::assumed;
  quantity.source = std::move(source);
  quantity.key = path(key);
  quantity.location = location();
  return content_->record(std::move(quantity));
}

const std::vector<Quantity>& TableReader::quantities_read() const {
  return content_->document->quantities;
}

std::string TableReader::text(std::string_view key) {
  return read_text(content_->require(key, "a text"));
}

std::optional<std::string> TableReader::optional_text(std::string_view key) {
  const std::optional<Field> found = content_->ask(key);
  return found ? std::optional(read_text(*found)) : std::nullopt;
}

std::string TableReader::choice(std::string_view key, const std::vector<std::string>& choices) {
  const std::vector<std::string_view> names(choices.begin(), choices.end());
  return read_choice(content_->require(key, "one of " + quoted_list(names)), choices);
}

long TableReader::integer(std::string_view key, long minimum, long maximum) {
  return read_integer(content_->require(key, "an integer"), minimum, maximum);
}

std::optional<long> TableReader::optional_integer(std::string_view key, long minimum,
                                                  long maximum) {
  const std::optional<Field> found = content_->ask(key);
  return found ? std::optional(read_integer(*found, minimum, maximum)) : std::nullopt;
}

bool TableReader::boolean(std::string_view key) {
  return read_boolean(content_->require(key, "true or false"));
}

std::optional<bool> TableReader::optional_boolean(std::string_view key) {
  const std::optional<Field> found = content_->ask(key);
  return found ? std::optional(read_boolean(*found)) : std::nullopt;
}

std::vector<std::string> TableReader::texts(std::string_view key) {
  return read_texts(content_->require(key, "a list of texts"));
}

TableReader TableReader::table(std::string_view key) {
  return content_->nested_table(content_->require(key, "a table"));
}

std::optional<TableReader> TableReader::optional_table(std::string_view key) {
  const std::optional<Field> found = content_->ask(key);
  return found ? std::optional(content_->nested_table(*found)) : std::nullopt;
}

std::vector<TableReader> TableReader::tables(std::string_view key, bool required) {
  const std::string expected = fmt::format("a list of tables [[{}]]", path(key));
  const std::optional<Field> found =
      required ? content_->require(key, expected) : content_->ask(key);
  std::vector<TableReader> readers;
  if (!found) {
    return readers;
  }
  const std::vector<TomlNode>& elements = found->node.elements;
  if (found->node.type != TomlType::list || (required && elements.empty())) {
    refuse_field(*found, expected);
  }
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const Field element{elements[i], fmt::format("{}[{}]", found->path, i), found->file};
    if (element.node.type != TomlType::table) {
      refuse_field(element, "a table");
    }
    readers.push_back(content_->nested(element.node, element.path));
  }
  return readers;
}

void TableReader::finish() const {
  const auto& [document, table, table_path, asked] = *content_;
  std::vector<std::string_view> absent;
  for (const std::string& key : asked) {
    if (table.find(key) == nullptr) {
      absent.push_back(key);
    }
  }
  for (const TomlEntry& entry : table.entries) {
    if (!asked.contains(entry.key)) {
      const std::vector<std::string_view> known(asked.begin(), asked.end());
      refuse_at({document->name, entry.line, entry.column}, content_->path_of(entry.key),
                fmt::format("expected {}, found an unknown key{}",
                            known.empty() ? "no key here" : "one of the keys " + quoted_list(known),
                            did_you_mean(entry.key, absent)));
    }
  }
}

void TableReader::refuse(std::string_view key, const std::string& message) const {
  refuse_at(location(key), path(key), message);
}

}  // namespace boresight::io
