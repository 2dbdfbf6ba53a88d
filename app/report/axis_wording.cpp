#include <fmt/format.h>

#include <boresight/app/report/axis_wording.hpp>
#include <boresight/numerics/angles.hpp>

namespace boresight::app {

std::string words_of(const io::PointingAxis& axis) {
  std::string text = axis.name + " axis";
  if (axis.name == "azimuth") {
    text += ", cross-elevation error at " +
            (axis.elevation ? fmt::format("{:.4g} deg elevation", *axis.elevation / degree)
                            : std::string("the horizon"));
  } else if (axis.name == "X") {
    text += fmt::format(" of an X-Y mount at Y = {:.4g} deg, boresight error = axis error x cos(Y)",
                        axis.y_angle.value_or(0.0) / degree);
  } else if (axis.name == "Y") {
    text += " of an X-Y mount";
  }
  return text;
}

std::string words_beside(std::string_view title, const io::PointingAxis& axis) {
  std::string words = words_of(axis);
  const std::string name = axis.name + " axis";
  if (title.find(name) == std::string_view::npos) return words;
  constexpr std::string_view comma = ", ";
  if (words == name) return {};
  return words.starts_with(name + std::string(comma)) ? words.substr(name.size() + comma.size())
                                                      : words;
}

}  // namespace boresight::app
