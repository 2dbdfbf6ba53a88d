#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <boresight/io/description/key_unit.hpp>

namespace boresight::io {

/// A described value's key, without its unit, and meaning; an element of a list has no key.
struct Member {
  std::string_view key = {};
  std::string_view meaning = {};
};

/// How a number stands in a table for people.
struct TableColumn {
  std::string_view heading = {};  // with its unit; empty: it is in none
  int decimals = 3;
  double multiplier = 1.0;  // of the number in the unit of its key
};

/// What a number can be in the unit of its key, and how it is shown.
struct NumberForm {
  double minimum = -std::numeric_limits<double>::infinity();
  double above = -std::numeric_limits<double>::infinity();  // excluded itself
  double maximum = std::numeric_limits<double>::infinity();
  /// Finite in every report. Otherwise null stands for infinity and for what is not a number.
  bool finite = false;
  TableColumn column = {};
};

struct CountForm {
  std::uint64_t minimum = 0;
  std::optional<std::uint64_t> maximum = std::nullopt;
  bool nullable = false;
  bool constant = false;  // the only count that it is
};

struct ListSize {
  std::size_t minimum = 0;
  std::optional<std::size_t> maximum = std::nullopt;
};

/// What a text can be, where that is known.
struct TextForm {
  /// Empty: any text.
  std::span<const std::string_view> words = {};
  /// Regular expression of the whole text; empty: none.
  std::string_view pattern = {};
  /// The only text that it is; empty: none.
  std::string_view constant = {};
};

/// Interface for reading a result: `describe(Visitor&, const T&)` names every member of a T once,
/// in order, with key, value in SI, unit and meaning. A writer of JSON, of the JSON's schema, and
/// the attributes of a Python class are visitors. A describe function is found next to the type or
/// in this namespace. It must accept a default-constructed T, whose values have no meaning and from
/// which visitors read the form (by_example).
class Visitor {
 public:
  Visitor() = default;
  Visitor(const Visitor&) = delete;
  Visitor& operator=(const Visitor&) = delete;
  virtual ~Visitor() = default;

  /// Whether the form is asked for, not the values: each list has one element constructed by
  /// default, and what is optional is there.
  virtual bool by_example() const = 0;

  /// Of the object described: its name, unique for its form, and what it is.
  virtual void defined_as(std::string_view name, std::string_view meaning);

  void number(std::string_view key, double value, const KeyUnit& unit, std::string_view meaning,
              const NumberForm& form = {});
  /// null where there is none.
  void number(std::string_view key, const std::optional<double>& value, const KeyUnit& unit,
              std::string_view meaning, NumberForm form = {});
  void count(std::string_view key, std::integral auto value, std::string_view meaning,
             const CountForm& form = {}) {
    on_count({key, meaning}, static_cast<std::uint64_t>(value), form);
  }
  template <std::integral Integer>
  void count(std::string_view key, const std::optional<Integer>& value, std::string_view meaning) {
    on_count({key, meaning},
             value ? std::optional(static_cast<std::uint64_t>(*value)) : std::nullopt,
             {.nullable = true});
  }
  void counts(std::string_view key, std::span<const std::uint64_t> values, std::string_view meaning,
              const CountForm& form = {});
  void constant(std::string_view key, std::uint64_t value, std::string_view meaning);
  void flag(std::string_view key, bool value, std::string_view meaning);
  void flag(std::string_view key, const std::optional<bool>& value, std::string_view meaning);
  void text(std::string_view key, std::string_view value, std::string_view meaning,
            const TextForm& form = {});
  /// null for an empty one.
  void text_or_null(std::string_view key, std::string_view value, std::string_view meaning);
  /// One of a few texts.
  void word(std::string_view key, std::string_view value,
            std::initializer_list<std::string_view> words, std::string_view meaning);
  void word(std::string_view key, std::string_view value, std::span<const std::string_view> words,
            std::string_view meaning);
  void constant(std::string_view key, std::string_view value, std::string_view meaning);
  void texts(std::string_view key, std::span<const std::string> values, std::string_view meaning,
             const ListSize& size = {});
  void numbers(std::string_view key, std::span<const double> values, const KeyUnit& unit,
               std::string_view meaning, const NumberForm& form = {}, const ListSize& size = {});
  /// null unless `present`.
  void numbers_if(std::string_view key, bool present, std::span<const double> values,
                  const KeyUnit& unit, std::string_view meaning, const NumberForm& form = {});
  /// A list of rows of numbers.
  void number_rows(std::string_view key, std::span<const std::vector<double>> rows,
                   const KeyUnit& unit, std::string_view meaning, const NumberForm& form = {});

  /// An object described by its own function.
  template <typename Object>
  void object(std::string_view key, const Object& value, std::string_view meaning) {
    on_object({key, meaning}, true, false);
    describe(*this, value);
    on_object_end();
  }
  /// null where there is none.
  template <typename Object>
  void object(std::string_view key, const std::optional<Object>& value, std::string_view meaning) {
    optional_group(key, value, meaning, [this](const Object& object) { describe(*this, object); });
  }
  /// An object whose members `describe_members()` describes.
  template <std::invocable Describe>
  void group(std::string_view key, std::string_view meaning, Describe describe_members) {
    on_object({key, meaning}, true, false);
    describe_members();
    on_object_end();
  }
  /// null unless `present`.
  template <std::invocable Describe>
  void group_if(std::string_view key, bool present, std::string_view meaning,
                Describe describe_members) {
    on_object({key, meaning}, present, true);
    if (present || by_example()) describe_members();
    on_object_end();
  }
  /// The same with `describe_members(value)`; null without a value.
  template <typename Value, std::invocable<const Value&> Describe>
  void optional_group(std::string_view key, const std::optional<Value>& value,
                      std::string_view meaning, Describe describe_members) {
    on_object({key, meaning}, value.has_value(), true);
    if (value) {
      describe_members(*value);
    } else if (by_example()) {
      describe_members(Value{});
    }
    on_object_end();
  }
  /// Members of this object that are there only if `present`.
  template <std::invocable Describe>
  void members_if(bool present, Describe describe_members) {
    on_optional();
    if (present || by_example()) describe_members();
    on_optional_end();
  }
  /// The same with `describe_members(value)`; not there without a value.
  template <typename Value, std::invocable<const Value&> Describe>
  void optional_members(const std::optional<Value>& value, Describe describe_members) {
    on_optional();
    if (value) {
      describe_members(*value);
    } else if (by_example()) {
      describe_members(Value{});
    }
    on_optional_end();
  }

  /// Finite numbers above 0 whose keys match a regular expression: `describe_them()` describes
  /// those there are, by example those that are known by name.
  template <std::invocable Describe>
  void numbers_by_name(std::string_view pattern, std::string_view meaning, Describe describe_them) {
    on_pattern(pattern, meaning);
    describe_them();
  }

  /// Objects described by their own function.
  template <typename Objects>
  void list(std::string_view key, const Objects& objects, std::string_view meaning,
            const ListSize& size = {}) {
    list(
        key, objects, meaning,
        [this](const typename Objects::value_type& object) { describe(*this, object); }, size);
  }
  /// Objects described by `describe_members(object)`.
  template <typename Objects, std::invocable<const typename Objects::value_type&> Describe>
  void list(std::string_view key, const Objects& objects, std::string_view meaning,
            Describe describe_members, const ListSize& size = {}) {
    on_list({key, meaning}, size, true, false);
    const auto one = [&](const typename Objects::value_type& object) {
      on_object({}, true, false);
      describe_members(object);
      on_object_end();
    };
    if (by_example()) {
      one(typename Objects::value_type{});
    } else {
      for (const auto& object : objects) one(object);
    }
    on_list_end();
  }

 protected:
  // What is described, in order; nothing is made of it here. Of no value: null, or of an object
  // or a list that is not `present`.
  virtual void on_number(const Member& member, const std::optional<double>& value,
                         const KeyUnit& unit, const NumberForm& form);
  virtual void on_count(const Member& member, const std::optional<std::uint64_t>& value,
                        const CountForm& form);
  virtual void on_flag(const Member& member, const std::optional<bool>& value, bool nullable);
  virtual void on_text(const Member& member, const std::optional<std::string_view>& value,
                       const TextForm& form, bool nullable);
  virtual void on_pattern(std::string_view pattern, std::string_view meaning);
  virtual void on_object(const Member& member, bool present, bool nullable);
  virtual void on_object_end();
  virtual void on_list(const Member& member, const ListSize& size, bool present, bool nullable);
  virtual void on_list_end();
  /// Members up to the end are there or not, together.
  virtual void on_optional();
  virtual void on_optional_end();

 private:
  void number_elements(std::span<const double> values, const KeyUnit& unit, const NumberForm& form);
};

}  // namespace boresight::io
