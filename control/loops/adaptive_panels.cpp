#include <algorithm>
#include <cmath>

#include <boresight/control/loops/adaptive_panels.hpp>
#include <boresight/numerics/angles.hpp>

namespace boresight::control {

std::uint32_t AdaptivePanels::add(double from, double to) {
  panels_.push_back({from, to, 0});
  return static_cast<std::uint32_t>(panels_.size() - 1);
}

bool AdaptivePanels::drop_halves_if_too_many() {
  if (panels_.size() <= maximum) return false;
  panels_.resize(first_.size());
  for (FrequencyPanel& panel : panels_) panel.first_half = 0;
  return true;
}

std::vector<double> places_within(double lowest, double highest,
                                  std::initializer_list<double> frequencies) {
  std::vector<double> places;
  for (const double frequency : frequencies) {
    if (frequency >= lowest && frequency <= highest) {
      places.push_back(std::log(two_pi * frequency));
    }
  }
  return places;
}

std::vector<FrequencyPanel> panels_between(std::vector<double> places, double widest) {
  std::ranges::sort(places);
  std::vector<FrequencyPanel> panels;
  for (std::size_t e = 0; e + 1 < places.size(); ++e) {
    const double from = places[e], width = places[e + 1] - from;
    if (width < AdaptivePanels::narrowest) continue;
    const double parts = std::ceil(width / widest);
    for (double k = 0.0; k < parts; ++k) {
      panels.push_back({from + width * k / parts, from + width * (k + 1.0) / parts});
    }
  }
  return panels;
}

}  // namespace boresight::control
