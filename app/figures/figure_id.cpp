#include <boresight/app/figures/figure_id.hpp>

namespace boresight::app {

std::string figure_id(std::string_view words) {
  std::string id;
  for (const char letter : words) {
    const bool upper = letter >= 'A' && letter <= 'Z';
    if (upper || (letter >= 'a' && letter <= 'z') || (letter >= '0' && letter <= '9')) {
      id += upper ? static_cast<char>(letter - 'A' + 'a') : letter;
    } else if (!id.empty() && id.back() != '-') {
      id += '-';
    }
  }
  while (!id.empty() && id.back() == '-') id.pop_back();
  return id;
}

}  // namespace boresight::app
