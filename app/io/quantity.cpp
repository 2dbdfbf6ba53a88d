#include <boresight/app/io/quantity.hpp>

namespace boresight::app {

std::string_view to_string(Basis basis) {
  switch (basis) {
    case Basis::measured:
      return "measured";
    case Basis::published:
      return "published";
    case Basis::inferred:
      return "inferred";
    case Basis::assumed:
      return "assumed";
    case Basis::unstated:
      break;
  }
  return "unstated";
}

}  // namespace boresight::app
