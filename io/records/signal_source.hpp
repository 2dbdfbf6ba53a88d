#pragma once

#include <string>

namespace boresight::io {

/// The column of a recorder file that a signal was read from.
struct SignalSource {
  std::string signal;  // "inlet pressure 1", "tachometer", "rate command"
  std::string column;
  std::string unit;      // as taken
  bool guessed = false;  // the column, by its name
  /// What was taken for granted beside, a sentence; empty if nothing.
  std::string remark;
};

}  // namespace boresight::io
