#include <cmath>
#include <utility>

#include <boresight/app/report/json_writer.hpp>

namespace boresight::app {

using Json = nlohmann::ordered_json;

JsonWriter::JsonWriter() {
  open_.push_back({{}, Json::object()});
}

Json JsonWriter::take() {
  return std::move(open_.front().value);
}

void JsonWriter::put(std::string_view key, Json value) {
  Json& parent = open_.back().value;
  if (parent.is_object()) {
    parent[std::string(key)] = std::move(value);
  } else if (parent.is_array()) {
    parent.push_back(std::move(value));
  }
}

void JsonWriter::close() {
  Open done = std::move(open_.back());
  open_.pop_back();
  put(done.key, std::move(done.value));
}

void JsonWriter::on_number(const io::Member& member, const std::optional<double>& value,
                           const io::KeyUnit& unit, const io::NumberForm& /*form*/) {
  const double written = value ? io::in_unit(*value, unit) : NAN;
  put(io::key_with_unit(member.key, unit), std::isfinite(written) ? Json(written) : Json(nullptr));
}

void JsonWriter::on_count(const io::Member& member, const std::optional<std::uint64_t>& value,
                          const io::CountForm& /*form*/) {
  put(member.key, value ? Json(*value) : Json(nullptr));
}

void JsonWriter::on_flag(const io::Member& member, const std::optional<bool>& value,
                         bool /*nullable*/) {
  put(member.key, value ? Json(*value) : Json(nullptr));
}

void JsonWriter::on_text(const io::Member& member, const std::optional<std::string_view>& value,
                         const io::TextForm& /*form*/, bool /*nullable*/) {
  put(member.key, value ? Json(*value) : Json(nullptr));
}

void JsonWriter::on_object(const io::Member& member, bool present, bool /*nullable*/) {
  open_.push_back({std::string(member.key), present ? Json::object() : Json(nullptr)});
}

void JsonWriter::on_object_end() {
  close();
}

void JsonWriter::on_list(const io::Member& member, const io::ListSize& /*size*/, bool present,
                         bool /*nullable*/) {
  open_.push_back({std::string(member.key), present ? Json::array() : Json(nullptr)});
}

void JsonWriter::on_list_end() {
  close();
}

}  // namespace boresight::app
