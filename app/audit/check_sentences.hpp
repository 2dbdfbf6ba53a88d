#pragma once

#include <span>
#include <string>
#include <string_view>

#include <boresight/io/audit/physical_checks.hpp>

namespace boresight::app {

/// The input of a sentence: the check, its case, and the data common to all checks.
struct FailedCheck {
  const design::PhysicalCheck& check;
  const io::Case& antenna;
  const io::PhysicalChecks& physics;

  /// Of the check's number of that name.
  double operator[](std::string_view name) const { return check.number(name).value; }
};

/// How reports name a check of io::check_physics, and its sentence with the numbers in it.
struct CheckWording {
  std::string_view id;
  std::string_view name;
  std::string (*sentence)(const FailedCheck& failed);
};

/// Of friction, valve, supply and the tests of them.
std::span<const CheckWording> drive_wordings();
/// Of inertias, resonance, structure and what else is the antenna's.
std::span<const CheckWording> antenna_wordings();

}  // namespace boresight::app
