#pragma once

#include <concepts>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include <boresight/io/description/visitor.hpp>

namespace boresight::app {

/// Writes what is described as JSON, keys in the order of the description.
class JsonWriter final : public io::Visitor {
 public:
  JsonWriter();
  bool by_example() const override { return false; }
  /// The object described since construction.
  nlohmann::ordered_json take();

 protected:
  void on_number(const io::Member& member, const std::optional<double>& value,
                 const io::KeyUnit& unit, const io::NumberForm& form) override;
  void on_count(const io::Member& member, const std::optional<std::uint64_t>& value,
                const io::CountForm& form) override;
  void on_flag(const io::Member& member, const std::optional<bool>& value, bool nullable) override;
  void on_text(const io::Member& member, const std::optional<std::string_view>& value,
               const io::TextForm& form, bool nullable) override;
  void on_object(const io::Member& member, bool present, bool nullable) override;
  void on_object_end() override;
  void on_list(const io::Member& member, const io::ListSize& size, bool present,
               bool nullable) override;
  void on_list_end() override;

 private:
  struct Open {
    std::string key;
    nlohmann::ordered_json value;
  };
  void put(std::string_view key, nlohmann::ordered_json value);
  void close();

  std::vector<Open> open_;
};

/// A described result as a JSON object.
template <typename Result>
nlohmann::ordered_json json_of(const Result& result) {
  JsonWriter writer;
  describe(writer, result);
  return writer.take();
}

/// What `describe_members(visitor)` describes as a JSON object.
template <std::invocable<io::Visitor&> Describe>
nlohmann::ordered_json json_by(Describe describe_members) {
  JsonWriter writer;
  describe_members(writer);
  return writer.take();
}

}  // namespace boresight::app
