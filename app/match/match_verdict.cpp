#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <boresight/app/match/match_verdict.hpp>
#include <boresight/app/report/influences.hpp>
#include <boresight/app/simulate/time_domain.hpp>
#include <boresight/design/decisions/recommend.hpp>

namespace boresight::app {

double span_of(const MatchSeries& series) {
  double least = HUGE_VAL, largest = 0.0;
  for (const auto& value : series.values) {
    if (!value.found) continue;
    least = std::min(least, value.beam_rms);
    largest = std::max(largest, value.beam_rms);
  }
  return largest > 0.0 ? largest / least - 1.0 : 0.0;
}

bool hardly_matters(const MatchSection& section) {
  bool any = false;
  for (const auto& series : section.series) {
    if (!weighed(section, series)) continue;
    any = true;
    const bool everywhere = std::ranges::all_of(series.values, &MatchValue::found);
    if (!everywhere || span_of(series) >= negligible_change) return false;
  }
  return any;
}

std::string what_matters_more(const MatchSection& section) {
  Influences influences;
  influences.add(structures_as_built(section).change, "the loop structure");
  for (const auto& variants : section.variants) {
    const MatchVariant& own = variants.variants.front();
    if (!own.best || !weighed(section, variants.structure)) continue;
    for (const auto& variant : variants.variants) {
      if (!variant.best) continue;
      influences.add(std::abs(variant.rms[*variant.best] / own.rms[*own.best] - 1.0),
                     fmt::format("'{}' with {}", variant.name, variants.structure));
    }
  }
  return influences.sentence();
}

std::size_t hunting_point(const MatchSection& section, const MatchSeries& series) {
  const std::size_t built = as_built(section);
  const std::size_t best = series.best.value_or(built);
  return series.values[best].time_domain ? best : built;
}

std::vector<design::HuntingResult> hunting_of(const MatchSection& section,
                                              const MatchSeries& series) {
  const auto& run = series.values[hunting_point(section, series)].time_domain;
  return run ? run->hunting : std::vector<design::HuntingResult>();
}

bool hunting_beyond(const MatchSection& section,
                    const std::vector<design::HuntingResult>& hunting) {
  return design::hunting_amplitude(hunting) > design::hunting_limit(section.tightest_budget);
}

bool hunts_at(const MatchSection& section, const MatchSeries& series, std::size_t point) {
  const auto& run = series.values[point].time_domain;
  return run && !design::holds_still(run->hunting, section.tightest_budget);
}

bool hunts(const MatchSection& section, const MatchSeries& series) {
  return hunts_at(section, series, hunting_point(section, series));
}

// The span of a structure has its best motors at one end, the comparison of structures those as
// built: what hunts at either has no such rms there.
bool weighed(const MatchSection& section, const MatchSeries& series) {
  return series.best && !hunts(section, series) && !hunts_at(section, series, as_built(section));
}

bool weighed(const MatchSection& section, std::string_view structure) {
  return std::ranges::any_of(section.series, [&](const MatchSeries& series) {
    return series.name == structure && weighed(section, series);
  });
}

const MatchSeries* recommended_structure(const MatchSection& section,
                                         const std::function<bool(const MatchSeries&)>& counts) {
  std::vector<const MatchSeries*> structures;
  std::vector<design::Assessment> candidates;
  for (const auto& series : section.series) {
    if (!series.best || !counts(series)) continue;
    design::Assessment candidate;
    candidate.structure = series.name;
    candidate.purpose = design::DesignPurpose::robust;
    candidate.parts = series.curve.structure.gains().size();
    candidate.stable = candidate.verified = true;
    candidate.nominal_constraints_met = candidate.member_constraints_met = true;
    candidate.linear_rms = series.values[*series.best].beam_rms;
    if (!hunting_of(section, series).empty()) {
      candidate.limit_cycles = design::limit_cycle_verdict(
          !hunts(section, series), design::hunting_seen(hunting_of(section, series)));
    }
    structures.push_back(&series);
    candidates.push_back(std::move(candidate));
  }
  const auto winner =
      design::recommend(candidates, {.accepted = design::Fitness::limit_cycle}).winner;
  return winner ? structures[*winner] : nullptr;
}

const MatchSeries* most_moved(const MatchSection& section) {
  const MatchSeries* most = nullptr;
  for (const auto& series : section.series) {
    if (!weighed(section, series)) continue;
    if (most == nullptr || span_of(series) > span_of(*most)) most = &series;
  }
  return most;
}

StructuresAsBuilt structures_as_built(const MatchSection& section) {
  const std::size_t built = as_built(section);
  const auto rms = [&](const MatchSeries& series) { return series.values[built].beam_rms; };
  StructuresAsBuilt result;
  for (const auto& series : section.series) {
    if (!series.values[built].found || !weighed(section, series)) continue;
    ++result.count;
    if (result.least == nullptr || rms(series) < rms(*result.least)) result.least = &series;
    if (result.largest == nullptr || rms(series) > rms(*result.largest)) result.largest = &series;
  }
  if (result.count > 0) result.change = rms(*result.largest) / rms(*result.least) - 1.0;
  return result;
}

bool one_friction(const MatchSection& section) {
  constexpr double same = 1e-9;
  return std::abs(section.tracking_friction - section.friction) <= same * section.friction;
}

std::size_t as_built(const MatchSection& section) {
  const auto point = std::ranges::find_if(section.points, [](const MatchPoint& one) {
    return one.label.find("as built") != std::string::npos;
  });
  return point == section.points.end() ? section.points.size() - 1
                                       : static_cast<std::size_t>(point - section.points.begin());
}

}  // namespace boresight::app
