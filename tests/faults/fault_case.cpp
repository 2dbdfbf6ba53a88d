#include "fault_case.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "../coverage/simulated_campaign.hpp"
#include <boresight/identification/grey_box/grey_box.hpp>
#include <boresight/identification/lines/slosh.hpp>
#include <boresight/identification/records/channel_consistency.hpp>
#include <boresight/io/campaign/campaign_section.hpp>
#include <boresight/io/campaign/channel_findings.hpp>
#include <boresight/io/campaign/loaded_campaign.hpp>
#include <boresight/io/campaign/recommended_values.hpp>
#include <boresight/io/case/case_campaign.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::faults {
namespace {

using identification::RawChannel;
using identification::RawRecord;

constexpr double allowed_error = 0.02;
constexpr std::size_t findings_shown = 3;

io::LoadedRecord loaded_record(RawRecord raw) {
  io::LoadedRecord work;
  work.notes.name = raw.name;
  work.notes.path = raw.name + ".csv";
  work.notes.rows = static_cast<std::size_t>(raw.time.size());
  const auto add = [&](const std::string& signal, const RawChannel& channel) {
    work.notes.sources.push_back({signal, channel.name, "", false, ""});
  };
  for (std::size_t motor = 0; motor < raw.inlet.size(); ++motor) {
    add(fmt::format("inlet pressure {}", motor + 1), raw.inlet[motor]);
    add(fmt::format("outlet pressure {}", motor + 1), raw.outlet[motor]);
  }
  add("tachometer", raw.tachometer);
  if (raw.rate_command) add("rate command", *raw.rate_command);
  if (raw.valve_command) add("valve command", *raw.valve_command);
  if (raw.encoder) add("encoder", *raw.encoder);
  work.clean = identification::clean_record(raw);
  work.raw = std::move(raw);
  return work;
}

// Of the case what reading records needs of it.
io::Case case_of(const RecordedCampaign& campaign) {
  io::Case antenna;
  antenna.path = "campaign";
  for (const RawRecord& raw : campaign.records) {
    io::RecordEntry entry;
    entry.name = raw.name;
    entry.test = io::to_string(raw.test);
    entry.rate_loop = raw.rate_loop_closed ? "closed" : "open";
    antenna.campaign->records.push_back(std::move(entry));
  }
  return antenna;
}

template <typename Function>
void attempt(const std::string& method, io::CampaignSection& section, const Function& function) {
  try {
    function();
  } catch (const InvalidInput& failure) {
    section.failures.push_back({method, failure.what()});
  } catch (const NumericalFailure& failure) {
    section.failures.push_back({method, failure.what()});
  }
}

// As io::identify_campaign, of which recommendation and findings need no more.
io::CampaignSection identify(RecordedCampaign recorded, const FaultSetting& setting) {
  const io::Case antenna = case_of(recorded);
  io::LoadedCampaign loaded;
  loaded.knowledge = recorded.knowledge;
  loaded.instruments = recorded.instruments;
  for (RawRecord& raw : recorded.records) loaded.records.push_back(loaded_record(std::move(raw)));
  io::settle_conflicts(antenna, loaded.records);
  io::CampaignSection section;
  std::vector<identification::EvaluatedRecord> evaluated;
  for (const io::LoadedRecord& one : loaded.records) evaluated.push_back({&one.raw, &one.clean});
  section.channels =
      identification::channel_consistency(evaluated, loaded.knowledge, loaded.instruments);
  const auto campaign = io::make_campaign(antenna, std::move(loaded), section.notes);
  section.knowledge = campaign.knowledge;
  section.instruments = campaign.instruments;
  if (io::channels_contradict(section)) return section;
  std::optional<numerics::Interval> heard;
  for (const auto& record : campaign.records) {
    if (record.test != identification::TestKind::slosh) continue;
    attempt("slosh", section, [&] {
      heard = identification::identify_slosh(record, campaign.knowledge).bulk_modulus;
    });
  }
  section.bulk_modulus_guessed = !heard;
  section.bulk_modulus = heard ? *heard : numerics::normal_interval(1.3e9, 0.15 * 1.3e9);
  attempt("grey box", section, [&] {
    identification::GreyBoxOptions options;
    options.further_starts = setting.further_starts;
    options.random_samples = setting.random_samples;
    options.threads = 1;
    options.bulk_modulus_guessed = section.bulk_modulus_guessed;
    section.grey_box = identification::fit_grey_box(campaign, section.bulk_modulus, options);
  });
  return section;
}

bool names_any(const io::ChannelSuspicion& finding, const std::vector<std::string>& names) {
  const auto begins = [&](const std::string& text) {
    return std::ranges::any_of(names, [&](const auto& name) { return text.starts_with(name); });
  };
  // A record by itself, not one of all.
  return std::ranges::any_of(finding.channels, begins) ||
         std::ranges::any_of(finding.stated_numbers, begins) ||
         (finding.records.size() == 1 && begins(finding.records.front()));
}

std::string subject(const io::ChannelSuspicion& finding) {
  return fmt::format("{}: {} in {}", finding.finding, fmt::join(finding.channels, " "),
                     fmt::join(finding.records, ", "));
}

std::string in_words(const io::ChannelSuspicion& finding) {
  return fmt::format("{}: {} in {} ({})", finding.finding, fmt::join(finding.channels, " "),
                     finding.records.size() > 2
                         ? fmt::format("{} records", finding.records.size())
                         : fmt::format("{}", fmt::join(finding.records, ", ")),
                     finding.explanation);
}

bool covers(const numerics::Interval& interval, double truth) {
  return interval.lower <= truth && truth <= interval.upper;
}

// Whether the records cannot show the fault's error, and the fit says what follows without the
// stated number.
bool is_undetectable(const FaultCase& one, double stated_error) {
  return one.check && std::abs(stated_error) < one.check->visible_error && one.without_holds;
}

Outcome outcome_of(const FaultCase& one, double stated_error, double truth) {
  if (!one.rejection.empty()) {
    if (one.named) return Outcome::flagged;
    return one.findings.empty() ? Outcome::refused : Outcome::other_flagged;
  }
  const bool covered = covers(*one.inertia, truth);
  if (std::abs(one.error) <= allowed_error) return covered ? Outcome::right : Outcome::uncovered;
  if (one.named) return Outcome::warned;
  if (covered) return Outcome::held;
  return is_undetectable(one, stated_error) ? Outcome::undetectable : Outcome::silently_wrong;
}

// The same for a fault wherever it stands in the list.
std::uint64_t number_of(std::string_view text) {
  std::uint64_t number = 14695981039346656037U;
  for (const char c : text) number = (number ^ static_cast<unsigned char>(c)) * 1099511628211U;
  return number;
}

}  // namespace

std::string_view to_string(Outcome outcome) {
  switch (outcome) {
    case Outcome::right:
      return "right";
    case Outcome::uncovered:
      return "not covered";
    case Outcome::flagged:
      return "flagged";
    case Outcome::refused:
      return "refused";
    case Outcome::other_flagged:
      return "other flagged";
    case Outcome::warned:
      return "warned";
    case Outcome::held:
      return "wide";
    case Outcome::undetectable:
      return "undetectable";
    case Outcome::silently_wrong:
      break;
  }
  return "silently wrong";
}

Recorded recorded_campaign(std::uint64_t seed, std::uint64_t number, const FaultSetting& setting) {
  const auto drive = coverage::random_drive(seed, number);
  auto simulated =
      coverage::simulate_campaign(drive, seed + (number << 20U), {{0.05, 0.2, 0.8}, 5.0, 40.0});
  Recorded recorded;
  recorded.number = number;
  recorded.inertia = drive.inertia;
  recorded.campaign = {std::move(simulated.raw), drive.knowledge, drive.instruments};
  for (RawRecord& record : recorded.campaign.records) {
    for (std::size_t motor = 0; motor < record.inlet.size(); ++motor) {
      // As a case with the transducers' range has them.
      record.inlet[motor].upper_limit = drive.inlet[motor].highest;
      record.outlet[motor].upper_limit = drive.outlet[motor].highest;
      record.inlet[motor].lower_limit = drive.inlet[motor].lowest;
      record.outlet[motor].lower_limit = drive.outlet[motor].lowest;
    }
  }
  for (const auto& finding : io::suspicions(identify(recorded.campaign, setting))) {
    recorded.findings.push_back(subject(finding));
  }
  return recorded;
}

FaultCase fault_case(const RecorderFault& fault, const Recorded& recorded, std::uint64_t seed,
                     const FaultSetting& setting) {
  FaultCase result;
  result.kind = fault.kind;
  result.fault = fault.name;
  result.campaign = recorded.number;
  RecordedCampaign campaign = recorded.campaign;
  reference::RandomNumbers random(number_of(fault.name) ^ (seed + (recorded.number << 20U)));
  fault.apply(campaign, random);
  try {
    const auto section = identify(std::move(campaign), setting);
    result.rejection = io::to_string(io::rejection(section));
    for (const auto& failure : section.failures) {
      if (failure.method == "grey box") result.rejection += ": " + failure.reason;
    }
    if (section.grey_box) {
      result.inertia = section.grey_box->quantity("inertia").posterior;
      result.error = result.inertia->value / recorded.inertia - 1.0;
      const auto& checks = section.grey_box->stated_numbers;
      const auto number =
          std::ranges::find(checks, fault.stated_number, &identification::StatedNumberCheck::name);
      if (number != checks.end()) {
        result.check = *number;
        result.without_holds = covers(number->inertia, recorded.inertia);
      }
      const auto departing = identification::departing_numbers(checks, 0.0);
      result.departure = departing.empty() ? 0.0 : departing.front().departure;
      const auto& conflict = section.grey_box->conflict;
      result.conflict = conflict.limit > 0.0 ? conflict.sum / conflict.limit : 0.0;
    }
    auto findings = io::suspicions(section);
    findings.resize(std::min(findings.size(), findings_shown));
    for (const auto& finding : findings) {
      const bool new_one = std::ranges::count(recorded.findings, subject(finding)) == 0;
      result.named = result.named || (new_one && names_any(finding, fault.names));
      result.findings.push_back(in_words(finding));
    }
  } catch (const InvalidInput& refusal) {
    result.rejection = refusal.what();
    result.named = std::ranges::any_of(fault.names, [&](const std::string& name) {
      return result.rejection.find(name) != std::string::npos;
    });
  } catch (const NumericalFailure& failure) {
    result.rejection = failure.what();
  }
  result.outcome = outcome_of(result, fault.stated_error, recorded.inertia);
  return result;
}

}  // namespace boresight::faults
