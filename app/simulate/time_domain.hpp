#pragma once

#include <optional>
#include <string>

#include <boresight/design/studies/time_domain_study.hpp>
#include <boresight/io/case/case_declaration.hpp>

namespace boresight::app {

/// A study in the time domain, and the parts of the case's text that its report needs.
struct TimeDomainSection : design::TimeDomainStudy {
  /// Basis of the valve's stroke if the case does not state it (demand_assumption).
  std::string stroke_assumption;
  /// loose_stribeck_text of the case.
  std::string friction_doubt;
};

std::optional<TimeDomainSection> section_of(const io::Case& antenna,
                                            std::optional<design::TimeDomainStudy> study);

/// In a sentence that the drive cannot slew as the case asks; empty if it can.
std::string slew_not_achievable(const TimeDomainSection& section);

/// A sentence if an assumed valve stroke decides the difference between nonlinear and linear
/// antenna: the rms in wind, or the slew rate. Empty if the stroke is stated or decides neither.
std::string assumed_stroke(const TimeDomainSection& section);

/// A sentence if freedom from limit cycles beyond the allowed amplitude is not shown
/// (design::is_limit_cycle_free); else empty.
std::string limit_cycle_remark(const TimeDomainSection& section);

/// What to do about a controller that is not free of limit cycles; of one that is, which others it
/// was preferred to and what its rms depends on, empty if neither. For the decision box, which
/// names the recommended controller itself.
std::string decide(const TimeDomainSection& section);

/// The section of the terminal's report.
std::string to_text(const TimeDomainSection& section);
/// What it means beside the linear figures, in a paragraph.
std::string conclude(const TimeDomainSection& section);

}  // namespace boresight::app
