#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <boresight/app/report/sky_units.hpp>
#include <boresight/app/tune/laws_in_time.hpp>
#include <boresight/app/tune/tune_study.hpp>
#include <boresight/design/problem/pointing_budget.hpp>
#include <boresight/io/case/mission_of.hpp>
#include <boresight/numerics/parallel_loop.hpp>

namespace boresight::app {
namespace {

LawInTime judged(const design::NonlinearVerification& result, double error) {
  return {.still = design::holds_still(result.hunting, error),
          .hunting = design::hunting_amplitude(result.hunting),
          .beam_rms = result.wind.beam_rms,
          .hunting_seen = design::hunting_seen(result.hunting)};
}

bool needed(const TuneSection& section, double speed) {
  return std::ranges::any_of(section.budgets, [&](const design::PointingBudget& budget) {
    return budget.wind_speed == speed;
  });
}

}  // namespace

std::string description_of(const TunedLaw& row) {
  return fmt::format("{}, {}", row.structure, to_string(row.tuned_for));
}

const design::NonlinearVerification* run_of(const TimeDomainSection& section, const TunedLaw& row) {
  if (section.wind_speed != row.wind_speed) return nullptr;
  const std::string law = description_of(row);
  if (section.law == law) return &section.result;
  const auto one = std::ranges::find(section.candidates, law, &TimeDomainSection::Candidate::law);
  return one == section.candidates.end() ? nullptr : &one->result;
}

void judge_in_time(const io::Case& antenna, const std::optional<TimeDomainSection>& compared,
                   TunedFor purpose, std::uint64_t seed, unsigned threads,
                   const std::function<bool()>& interrupted, TuneSection& section) {
  if (!compared) return;
  const double error = tightest_budget(antenna);
  std::vector<TunedLaw*> to_run;
  for (auto& row : section.laws) {
    if (row.tuned_for != purpose || !row.usable()) continue;
    if (const auto* result = run_of(*compared, row)) {
      row.in_time = judged(*result, error);
    } else if (needed(section, row.wind_speed)) {
      to_run.push_back(&row);
    }
  }
  const auto options = comparison_options(antenna, seed);
  numerics::for_each_index(to_run.size(), threads, [&](std::size_t i) {
    if (interrupted && interrupted()) return;
    TunedLaw& row = *to_run[i];
    auto problem = make_problem(antenna);
    problem.wind.mean_speed = row.wind_speed;
    const auto result = run_in_time_domain(antenna, problem, row.design.tuning.law, options);
    if (result) row.in_time = judged(*result, error);
  });
  section.shortfalls = find_shortfalls(section);
}

std::string held_against(const TunedLaw& row) {
  if (!row.left_out() || !row.in_time) return "";
  const LawInTime& run = *row.in_time;
  if (!run.still) {
    return run.hunting > 0.0 ? fmt::format("hunts by +-{:.2f} mdeg", run.hunting / millidegree)
                             : "does not hold still";
  }
  return "does not hold in wind";
}

}  // namespace boresight::app
