#include <boresight/io/description/visitor.hpp>

namespace boresight::io {

void Visitor::defined_as(std::string_view /*name*/, std::string_view /*meaning*/) {}
void Visitor::on_number(const Member& /*member*/, const std::optional<double>& /*value*/,
                        const KeyUnit& /*unit*/, const NumberForm& /*form*/) {}
void Visitor::on_count(const Member& /*member*/, const std::optional<std::uint64_t>& /*value*/,
                       const CountForm& /*form*/) {}
void Visitor::on_flag(const Member& /*member*/, const std::optional<bool>& /*value*/,
                      bool /*nullable*/) {}
void Visitor::on_text(const Member& /*member*/, const std::optional<std::string_view>& /*value*/,
                      const TextForm& /*form*/, bool /*nullable*/) {}
void Visitor::on_pattern(std::string_view /*pattern*/, std::string_view /*meaning*/) {}
void Visitor::on_object(const Member& /*member*/, bool /*present*/, bool /*nullable*/) {}
void Visitor::on_object_end() {}
void Visitor::on_list(const Member& /*member*/, const ListSize& /*size*/, bool /*present*/,
                      bool /*nullable*/) {}
void Visitor::on_list_end() {}
void Visitor::on_optional() {}
void Visitor::on_optional_end() {}

void Visitor::number(std::string_view key, double value, const KeyUnit& unit,
                     std::string_view meaning, const NumberForm& form) {
  on_number({key, meaning}, value, unit, form);
}

void Visitor::number(std::string_view key, const std::optional<double>& value, const KeyUnit& unit,
                     std::string_view meaning, NumberForm form) {
  form.finite = false;
  on_number({key, meaning}, value, unit, form);
}

void Visitor::counts(std::string_view key, std::span<const std::uint64_t> values,
                     std::string_view meaning, const CountForm& form) {
  on_list({key, meaning}, {}, true, false);
  if (by_example()) {
    on_count({}, 0, form);
  } else {
    for (const auto value : values) on_count({}, value, form);
  }
  on_list_end();
}

void Visitor::constant(std::string_view key, std::uint64_t value, std::string_view meaning) {
  on_count({key, meaning}, value, {.constant = true});
}

void Visitor::flag(std::string_view key, bool value, std::string_view meaning) {
  on_flag({key, meaning}, value, false);
}

void Visitor::flag(std::string_view key, const std::optional<bool>& value,
                   std::string_view meaning) {
  on_flag({key, meaning}, value, true);
}

void Visitor::text(std::string_view key, std::string_view value, std::string_view meaning,
                   const TextForm& form) {
  on_text({key, meaning}, value, form, false);
}

void Visitor::text_or_null(std::string_view key, std::string_view value, std::string_view meaning) {
  on_text({key, meaning}, value.empty() ? std::nullopt : std::optional(value), {}, true);
}

void Visitor::word(std::string_view key, std::string_view value,
                   std::initializer_list<std::string_view> words, std::string_view meaning) {
  word(key, value, std::span(words.begin(), words.size()), meaning);
}

void Visitor::word(std::string_view key, std::string_view value,
                   std::span<const std::string_view> words, std::string_view meaning) {
  on_text({key, meaning}, value, {.words = words}, false);
}

void Visitor::constant(std::string_view key, std::string_view value, std::string_view meaning) {
  on_text({key, meaning}, value, {.constant = value}, false);
}

void Visitor::texts(std::string_view key, std::span<const std::string> values,
                    std::string_view meaning, const ListSize& size) {
  on_list({key, meaning}, size, true, false);
  if (by_example()) {
    on_text({}, {}, {}, false);
  } else {
    for (const auto& value : values) on_text({}, value, {}, false);
  }
  on_list_end();
}

void Visitor::numbers(std::string_view key, std::span<const double> values, const KeyUnit& unit,
                      std::string_view meaning, const NumberForm& form, const ListSize& size) {
  on_list({key_with_unit(key, unit), meaning}, size, true, false);
  number_elements(values, unit, form);
  on_list_end();
}

void Visitor::numbers_if(std::string_view key, bool present, std::span<const double> values,
                         const KeyUnit& unit, std::string_view meaning, const NumberForm& form) {
  on_list({key_with_unit(key, unit), meaning}, {}, present, true);
  if (present || by_example()) number_elements(values, unit, form);
  on_list_end();
}

void Visitor::number_elements(std::span<const double> values, const KeyUnit& unit,
                              const NumberForm& form) {
  // Elements have no key that could name their unit.
  const KeyUnit unnamed = without_suffix(unit);
  if (by_example()) {
    on_number({}, 0.0, unnamed, form);
  } else {
    for (const double value : values) on_number({}, value, unnamed, form);
  }
}

void Visitor::number_rows(std::string_view key, std::span<const std::vector<double>> rows,
                          const KeyUnit& unit, std::string_view meaning, const NumberForm& form) {
  const KeyUnit unnamed = without_suffix(unit);
  on_list({key_with_unit(key, unit), meaning}, {}, true, false);
  if (by_example()) {
    numbers({}, {}, unnamed, {}, form);
  } else {
    for (const auto& row : rows) numbers({}, row, unnamed, {}, form);
  }
  on_list_end();
}

}  // namespace boresight::io
