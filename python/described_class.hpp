#pragma once

#include <map>
#include <optional>
#include <string>

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <boresight/io/description/visitor.hpp>

namespace boresight::python {

namespace py = pybind11;

/// The numbers of a described result by their keys without unit, in SI; by example what they mean.
class DescribedNumbers final : public io::Visitor {
 public:
  explicit DescribedNumbers(bool by_example) : by_example_(by_example) {}
  bool by_example() const override { return by_example_; }

  std::map<std::string, std::optional<double>> values;
  std::map<std::string, std::string> meanings;

 protected:
  void on_number(const io::Member& member, const std::optional<double>& value,
                 const io::KeyUnit& /*unit*/, const io::NumberForm& /*form*/) override {
    values.emplace(member.key, value);
    meanings.emplace(member.key, member.meaning);
  }

 private:
  bool by_example_;
};

/// Gives a class every number of its description as an attribute, named by the key without unit
/// or, where `names` has the key, by that: a float in SI or, where there is none, None.
template <typename Result>
void add_described_numbers(py::class_<Result>& type,
                           const std::map<std::string, std::string>& names) {
  DescribedNumbers example(true);
  describe(example, Result{});
  for (const auto& [key, meaning] : example.meanings) {
    const auto named = names.find(key);
    const std::string name = named == names.end() ? key : named->second;
    type.def_property_readonly(
        name.c_str(),
        [key = key](const Result& result) {
          DescribedNumbers numbers(false);
          describe(numbers, result);
          return numbers.values.at(key);
        },
        meaning.c_str());
  }
}

}  // namespace boresight::python
