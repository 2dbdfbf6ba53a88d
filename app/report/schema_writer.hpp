#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include <boresight/io/description/visitor.hpp>

namespace boresight::app {

/// Writes the JSON schema (draft 2020-12) of what is described: every key required unless it is
/// described as optional, no key allowed that is not described. Objects with a name of their own
/// stand once, in "$defs".
class SchemaWriter final : public io::Visitor {
 public:
  SchemaWriter();
  bool by_example() const override { return true; }
  void defined_as(std::string_view name, std::string_view meaning) override;
  /// The schema of the object described since construction, its "$defs" last.
  nlohmann::ordered_json take();

 protected:
  void on_number(const io::Member& member, const std::optional<double>& value,
                 const io::KeyUnit& unit, const io::NumberForm& form) override;
  void on_count(const io::Member& member, const std::optional<std::uint64_t>& value,
                const io::CountForm& form) override;
  void on_flag(const io::Member& member, const std::optional<bool>& value, bool nullable) override;
  void on_text(const io::Member& member, const std::optional<std::string_view>& value,
               const io::TextForm& form, bool nullable) override;
  void on_pattern(std::string_view pattern, std::string_view meaning) override;
  void on_object(const io::Member& member, bool present, bool nullable) override;
  void on_object_end() override;
  void on_list(const io::Member& member, const io::ListSize& size, bool present,
               bool nullable) override;
  void on_list_end() override;
  void on_optional() override { ++optional_; }
  void on_optional_end() override { --optional_; }

 private:
  struct Open {
    std::string key, meaning;
    bool nullable = false;
    bool is_list = false;
    std::string name, definition;  // of an object defined once, and what it is; empty: none
    nlohmann::ordered_json value;  // properties, or the schema of a list
    nlohmann::ordered_json required, patterns;
    int optional_outside = 0;
  };
  /// @throws std::logic_error for a key described twice.
  void put(std::string_view key, nlohmann::ordered_json schema);
  nlohmann::ordered_json object_schema(Open object);

  std::vector<Open> open_;
  nlohmann::ordered_json definitions_;
  int optional_ = 0;  // groups of optional members that are open
};

/// Description of the report as a whole in a schema.
struct SchemaHeading {
  std::string_view title, comment, description;
};

/// The schema of a described result. `conditions`: schemas that must hold too ("allOf"), for what
/// members say of one another; none without any.
template <typename Result>
nlohmann::ordered_json schema_of(const SchemaHeading& heading,
                                 const nlohmann::ordered_json& conditions = {}) {
  SchemaWriter writer;
  describe(writer, Result{});
  nlohmann::ordered_json schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                                {"title", heading.title},
                                {"$comment", heading.comment},
                                {"description", heading.description}};
  if (!conditions.empty()) schema["allOf"] = conditions;
  schema.update(writer.take());
  return schema;
}

}  // namespace boresight::app
