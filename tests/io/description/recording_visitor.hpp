#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include <boresight/io/description/visitor.hpp>

namespace boresight::io {

/// Keeps what is described by its place: "outer.inner_mdeg", "list[0].inner".
class RecordingVisitor final : public Visitor {
 public:
  explicit RecordingVisitor(bool by_example = false) : by_example_(by_example) {}
  bool by_example() const override { return by_example_; }

  std::map<std::string, std::optional<double>> numbers_found;
  std::map<std::string, std::optional<std::string>> texts_found;
  std::vector<std::string> places;  // of all values, in order

 protected:
  void on_number(const Member& member, const std::optional<double>& value, const KeyUnit& unit,
                 const NumberForm& /*form*/) override {
    numbers_found[place(key_with_unit(member.key, unit))] =
        value ? std::optional(in_unit(*value, unit)) : std::nullopt;
  }
  void on_count(const Member& member, const std::optional<std::uint64_t>& value,
                const CountForm& /*form*/) override {
    numbers_found[place(member.key)] =
        value ? std::optional(static_cast<double>(*value)) : std::nullopt;
  }
  void on_flag(const Member& member, const std::optional<bool>& value, bool /*nullable*/) override {
    numbers_found[place(member.key)] = value ? std::optional(*value ? 1.0 : 0.0) : std::nullopt;
  }
  void on_text(const Member& member, const std::optional<std::string_view>& value,
               const TextForm& /*form*/, bool /*nullable*/) override {
    texts_found[place(member.key)] = value ? std::optional(std::string(*value)) : std::nullopt;
  }
  void on_object(const Member& member, bool present, bool /*nullable*/) override {
    if (!present && !by_example_) place(member.key);
    open(member.key, false);
  }
  void on_object_end() override { open_.pop_back(); }
  void on_list(const Member& member, const ListSize& /*size*/, bool /*present*/,
               bool /*nullable*/) override {
    open(member.key, true);
  }
  void on_list_end() override { open_.pop_back(); }

 private:
  struct Open {
    std::string place;
    bool is_list = false;
    int elements = 0;
  };
  std::string name(std::string_view key) {
    if (open_.empty()) return std::string(key);
    Open& parent = open_.back();
    if (parent.is_list) return parent.place + "[" + std::to_string(parent.elements++) + "]";
    return parent.place + "." + std::string(key);
  }
  std::string place(std::string_view key) { return places.emplace_back(name(key)); }
  void open(std::string_view key, bool is_list) { open_.push_back({name(key), is_list}); }

  bool by_example_;
  std::vector<Open> open_;
};

}  // namespace boresight::io
