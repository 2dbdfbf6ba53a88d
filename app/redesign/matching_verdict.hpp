#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <boresight/app/report/report.hpp>

namespace boresight::app {

/// Conclusions of a redesign's matching study on a change of the motors' inertia.
class MatchingVerdict {
 public:
  /// The section must have two rows or more, and outlive this.
  explicit MatchingVerdict(const MatchingSection& section);

  /// Number of points whose controller violates a constraint or fails its verification; the rest of
  /// this verdict is meaningless unless it is 0.
  std::size_t unusable() const { return unusable_; }
  /// Row of the motors as built.
  std::size_t built() const { return built_; }
  /// The first and the last row, without that as built.
  std::vector<std::size_t> ends() const;
  /// Of those the one of less rms, by the first series.
  std::size_t better_end() const;
  /// Rms at a row over that as built, less 1.
  double change(const MatchingSeries& series, std::size_t row) const;
  /// Largest rms of a series over its least, less 1.
  static double span(const MatchingSeries& series);
  /// That of the series where it is largest.
  double largest_span() const;
  /// Whether no inertia of the study moves the rms of any series by what is worth a flywheel.
  bool flat() const;
  /// The series that differs from the first in friction alone; none if the study has one friction.
  const MatchingSeries* other_friction() const;
  /// Whether that friction decides if inertia matters: it moves the rms by more than 5 % with one
  /// friction and by less than negligible_change with the other, or the other way round.
  bool friction_decides() const;

 private:
  const MatchingSection& section_;
  std::size_t built_ = 0;
  std::size_t unusable_ = 0;
};

/// Which friction a series has: its name, or "friction slope 0.9 N.m.s/rad" where one slope is
/// both.
std::string friction_text(const MatchingSeries& series);

/// What moves the rms by more than negligible_change beside the motors' inertia, as
/// Influences::sentence; no choice with a missed_resonance.
std::string what_matters_more(const Report& report);

/// Appends what a matching study means.
void conclude_matching(const Report& report, const MatchingSection& section,
                       std::vector<std::string>& sentences);

/// In one sentence for the decision box; empty where nothing can be concluded.
std::string decide_matching(const Report& report, const MatchingSection& section);

}  // namespace boresight::app
