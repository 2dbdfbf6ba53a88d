#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include <boresight/design/audit/physical_check.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::design {

void PhysicalCheck::add(std::string name, double value, std::string unit, double lower,
                        double upper) {
  if (value < lower || value > upper) holds = false;
  numbers.push_back({std::move(name), value, std::move(unit), lower, upper});
}

const CheckedNumber& PhysicalCheck::number(std::string_view name) const {
  const auto found = std::ranges::find(numbers, name, &CheckedNumber::name);
  if (found == numbers.end()) {
    throw InvalidInput(fmt::format("check {}: expected a number '{}', found none", id, name));
  }
  return *found;
}

}  // namespace boresight::design
