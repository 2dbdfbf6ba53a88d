#include <fmt/format.h>

#include <boresight/app/report/present_gains.hpp>

namespace boresight::app {

std::string unstable_present_gains(const std::string& structure) {
  return fmt::format(
      "WARNING: the present gains of {} are unstable on the plant of this report. If the antenna "
      "runs on them, the plant or the meaning of a gain is wrong: check leakage, inertia, oil "
      "stiffness and how each gain is defined before believing any rms here.",
      structure);
}

std::string present_label(const std::string& structure, bool retuned) {
  return retuned ? structure + " tuned for this plant" : "present gains: " + structure;
}

}  // namespace boresight::app
