#pragma once

#include <string>

#include <boresight/io/units/quantity.hpp>

namespace boresight::io {

/// One change, as shown in a report.
struct ChangeRow {
  std::string key;
  std::string before;  // as the case has it
  std::string after;   // as the proposal has it: "12", "x 1.41"
  Basis basis = Basis::unstated;
  std::string source;
};

/// A quantity that changes as a consequence.
struct DerivedChange {
  std::string quantity;
  std::string unit;
  double before = 0.0, after = 0.0;  // in `unit`
  std::string follows_from;          // the equation or the rule
  std::string key;                   // of the case's own number, where it is one
};

}  // namespace boresight::io
