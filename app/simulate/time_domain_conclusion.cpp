#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <boresight/app/report/sky_units.hpp>
#include <boresight/app/simulate/time_domain.hpp>

namespace boresight::app {
namespace {

using design::RunStatus;

std::string conclude_wind(const TimeDomainSection& section) {
  const design::WindResult& wind = section.result.wind;
  if (wind.status != RunStatus::complete) {
    return fmt::format(
        "On the nonlinear antenna the {} law was not seen to hold in {:g} m/s of wind ({}): its "
        "linear figures stand alone.",
        section.law, section.wind_speed, design::to_string(wind.status));
  }
  std::string text = fmt::format(
      "On the nonlinear antenna the {} law points within {:.3f} mdeg in {:g} m/s, where the linear "
      "plant says {:.3f}",
      section.law, wind.beam_rms / millidegree, section.wind_speed,
      wind.predicted_rms / millidegree);
  if (wind.beam_rms <= wind.predicted_rms) return text + ".";
  const auto most =
      std::ranges::max_element(wind.influences, {}, [](const design::InfluenceResult& influence) {
        return std::isfinite(influence.difference) ? influence.difference : 0.0;
      });
  if (most != wind.influences.end() && most->difference > 0.0) {
    text += fmt::format("; {} alone is worth {:.3f}", design::to_string(most->influence),
                        most->difference / millidegree);
  }
  const double excess = 100.0 * (wind.beam_rms / wind.predicted_rms - 1.0);
  if (excess < 0.5) return text + ".";
  return text + fmt::format(
                    ". A budget that the linear figure meets with less than {:.0f} % to spare is "
                    "not met.",
                    excess);
}

// The largest beam amplitude of limit cycles (rad); 0 without any.
double hunting_of(const design::NonlinearVerification& result) {
  double largest = 0.0;
  for (const auto& hunting : result.hunting) {
    if (hunting.limit_cycle) largest = std::max(largest, hunting.beam_amplitude);
  }
  return largest;
}

// Why this law and not the one that the linear plant puts first.
std::string conclude_choice(const TimeDomainSection& section) {
  const auto linear = [](const TimeDomainSection::Candidate& candidate) {
    return candidate.result.wind.predicted_rms;
  };
  const auto first = std::ranges::min_element(section.candidates, {}, linear);
  if (first == section.candidates.end() || first->law == section.law) return "";
  const design::WindResult& wind = first->result.wind;
  std::string text =
      fmt::format("The linear plant puts {} first ({:.3f} mdeg); on the nonlinear antenna ",
                  first->law, wind.predicted_rms / millidegree);
  text += wind.status == RunStatus::complete
              ? fmt::format("it points within {:.3f}", wind.beam_rms / millidegree)
              : fmt::format("it does not hold ({})", design::to_string(wind.status));
  if (const double hunting = hunting_of(first->result); hunting > 0.0) {
    text += fmt::format(" and hunts by +-{:.2f}", hunting / millidegree);
  }
  return text + fmt::format(": {} is better. ", section.law);
}

}  // namespace

std::string conclude(const TimeDomainSection& section) {
  std::string text = conclude_choice(section) + conclude_wind(section);
  for (const auto& hunting : section.result.hunting) {
    if (hunting.status != RunStatus::complete || !hunting.limit_cycle) continue;
    text += fmt::format(" {} it hunts by +-{:.2f} mdeg.",
                        hunting.rate == 0.0 ? "At rest" : "At the tracking rate",
                        hunting.beam_amplitude / millidegree);
  }
  const auto& reversal = section.result.reversal;
  if (reversal && reversal->status == RunStatus::complete) {
    text += fmt::format(" Turning round at the tracking rate it errs by up to {:.1f} mdeg.",
                        reversal->beam_error / millidegree);
  }
  return text;
}

}  // namespace boresight::app
