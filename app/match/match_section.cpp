#include <utility>

#include <boresight/app/match/match_section.hpp>
#include <boresight/io/case/case_drive.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_wind.hpp>

namespace boresight::app {

MatchSection section_of(const io::Case& antenna, design::MatchingStudy study) {
  return {std::move(study), antenna.wind->mast, std::nullopt,
          antenna.drive->viscous_friction.basis == io::Basis::measured};
}

std::string label_of(const MatchPoint& point) {
  if (!point.unit_ratio) return point.as_built ? "as built" : "";
  return point.as_built ? "ratio 1, as built" : "ratio 1";
}

std::string name_of(const MatchVariant& variant) {
  return variant.name.empty() ? "the case's plant" : variant.name;
}

std::string text_of(design::ClassicRule rule) {
  using design::ClassicRule;
  switch (rule) {
    case ClassicRule::one_to_one:
      break;
    case ClassicRule::equal_poles_damped_0_7:
      return "equal pole pairs, zeta = 1/2 sqrt(J_L/J_m) = 0.71";
    case ClassicRule::equal_poles_damped_1:
      return "equal pole pairs, zeta = 1/2 sqrt(J_L/J_m) = 1";
    case ClassicRule::no_flywheels:
      return "maximum acceleration at this gear ratio: no flywheels";
  }
  return "one to one: motor inertia equal to load inertia";
}

}  // namespace boresight::app
