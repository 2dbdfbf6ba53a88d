#include <cmath>
#include <stdexcept>
#include <utility>

#include <boresight/app/report/schema_writer.hpp>

namespace boresight::app {
namespace {

using Json = nlohmann::ordered_json;

Json described(std::string_view meaning) {
  Json schema = Json::object();
  if (!meaning.empty()) schema["description"] = meaning;
  return schema;
}

Json type_of(const char* type, bool nullable) {
  return nullable ? Json::array({type, "null"}) : Json(type);
}

// 3, not 3.0.
Json limit(double value) {
  const auto whole = static_cast<std::int64_t>(value);
  return static_cast<double>(whole) == value ? Json(whole) : Json(value);
}

}  // namespace

SchemaWriter::SchemaWriter() {
  open_.emplace_back();
  open_.back().value = Json::object();
  open_.back().required = Json::array();
}

Json SchemaWriter::take() {
  Json schema = object_schema(std::move(open_.front()));
  if (!definitions_.empty()) schema["$defs"] = std::move(definitions_);
  return schema;
}

void SchemaWriter::put(std::string_view key, Json schema) {
  Open& parent = open_.back();
  if (parent.is_list) {
    parent.value["items"] = std::move(schema);
    return;
  }
  const std::string name(key);
  if (parent.value.contains(name)) {
    throw std::logic_error("SchemaWriter: the key " + name + " is described twice");
  }
  parent.value[name] = std::move(schema);
  if (optional_ == parent.optional_outside) parent.required.push_back(name);
}

Json SchemaWriter::object_schema(Open object) {
  Json schema = described(object.meaning);
  schema["type"] = type_of("object", object.nullable);
  schema["additionalProperties"] = false;
  schema["required"] = std::move(object.required);
  schema["properties"] = std::move(object.value);
  if (!object.patterns.empty()) schema["patternProperties"] = std::move(object.patterns);
  return schema;
}

void SchemaWriter::defined_as(std::string_view name, std::string_view meaning) {
  open_.back().name = name;
  open_.back().definition = meaning;
}

void SchemaWriter::on_number(const io::Member& member, const std::optional<double>& /*value*/,
                             const io::KeyUnit& unit, const io::NumberForm& form) {
  Json schema = described(member.meaning);
  schema["type"] = type_of("number", !form.finite);
  if (std::isfinite(form.minimum)) schema["minimum"] = limit(form.minimum);
  if (std::isfinite(form.above)) schema["exclusiveMinimum"] = limit(form.above);
  if (std::isfinite(form.maximum)) schema["maximum"] = limit(form.maximum);
  put(io::key_with_unit(member.key, unit), std::move(schema));
}

void SchemaWriter::on_count(const io::Member& member, const std::optional<std::uint64_t>& value,
                            const io::CountForm& form) {
  Json schema = described(member.meaning);
  if (form.constant && value) {
    schema["const"] = *value;
  } else {
    schema["type"] = type_of("integer", form.nullable);
    schema["minimum"] = form.minimum;
    if (form.maximum) schema["maximum"] = *form.maximum;
  }
  put(member.key, std::move(schema));
}

void SchemaWriter::on_flag(const io::Member& member, const std::optional<bool>& /*value*/,
                           bool nullable) {
  Json schema = described(member.meaning);
  schema["type"] = type_of("boolean", nullable);
  put(member.key, std::move(schema));
}

void SchemaWriter::on_text(const io::Member& member,
                           const std::optional<std::string_view>& /*value*/,
                           const io::TextForm& form, bool nullable) {
  Json schema = described(member.meaning);
  if (!form.constant.empty()) {
    schema["const"] = form.constant;
  } else if (!form.words.empty()) {
    schema["enum"] = Json::array();
    for (const auto word : form.words) schema["enum"].push_back(word);
    if (nullable) schema["enum"].push_back(nullptr);
  } else {
    schema["type"] = type_of("string", nullable);
    if (!form.pattern.empty()) schema["pattern"] = form.pattern;
  }
  put(member.key, std::move(schema));
}

void SchemaWriter::on_pattern(std::string_view pattern, std::string_view meaning) {
  Json schema = described(meaning);
  schema["type"] = "number";
  schema["exclusiveMinimum"] = 0;
  open_.back().patterns[std::string(pattern)] = std::move(schema);
}

void SchemaWriter::on_object(const io::Member& member, bool /*present*/, bool nullable) {
  Open object;
  object.key = member.key;
  object.meaning = member.meaning;
  object.nullable = nullable;
  object.value = Json::object();
  object.required = Json::array();
  object.optional_outside = optional_;
  open_.push_back(std::move(object));
}

void SchemaWriter::on_object_end() {
  Open object = std::move(open_.back());
  open_.pop_back();
  const std::string key = object.key;
  if (object.name.empty()) {
    put(key, object_schema(std::move(object)));
    return;
  }
  Json reference = described(object.meaning);
  const Json target{{"$ref", "#/$defs/" + object.name}};
  if (object.nullable) {
    reference["anyOf"] = Json::array({target, {{"type", "null"}}});
  } else {
    reference.update(target);
  }
  const std::string name = object.name;
  object.nullable = false;
  object.meaning = object.definition;
  Json definition = object_schema(std::move(object));
  if (definitions_.contains(name) && definitions_[name] != definition) {
    throw std::logic_error("SchemaWriter: " + name + " is described in two ways");
  }
  definitions_[name] = std::move(definition);
  put(key, std::move(reference));
}

void SchemaWriter::on_list(const io::Member& member, const io::ListSize& size, bool /*present*/,
                           bool nullable) {
  Open list;
  list.key = member.key;
  list.is_list = true;
  list.value = described(member.meaning);
  list.value["type"] = type_of("array", nullable);
  if (size.minimum > 0) list.value["minItems"] = size.minimum;
  if (size.maximum) list.value["maxItems"] = *size.maximum;
  open_.push_back(std::move(list));
}

void SchemaWriter::on_list_end() {
  Open list = std::move(open_.back());
  open_.pop_back();
  put(list.key, std::move(list.value));
}

}  // namespace boresight::app
