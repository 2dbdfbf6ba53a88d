#pragma once

#include <string>

#include <boresight/io/units/units.hpp>

namespace boresight {

/// What a unit text was refused with, and where.
struct Refusal {
  std::string message;
  int column = 0;
};

template <typename Read>
Refusal refusal_of(Read read) {
  try {
    read();
  } catch (const io::UnitError& error) {
    return {error.what(), error.column};
  }
  return {"accepted", 0};
}

}  // namespace boresight
