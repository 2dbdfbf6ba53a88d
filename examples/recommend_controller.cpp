// recommend_controller CASE.toml [PROPOSAL.toml]: the controller that every command recommends, its
// rivals, what flywheels change, and whether a proposal of hardware is worth its cost.
#include <iostream>
#include <stdexcept>

#include <boresight/design/studies/controller_study.hpp>
#include <boresight/design/studies/matching_verdict.hpp>
#include <boresight/io/campaign/designed_antenna.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/present_gains.hpp>
#include <boresight/io/proposals/compared_antennas.hpp>
#include <boresight/numerics/angles.hpp>

using namespace boresight;

void print_controllers(const io::Case& stated, const design::ControllerStudy& study) {
  const design::TunedController* best = design::recommended_or(study, design::Fitness::unstable);
  for (const auto& row : study.tuned.controllers) {
    std::cout << (&row == best ? "recommended " : "") << design::description_of(row) << ": "
              << row.boresight_rms / millidegree << " mdeg linear, constraints "
              << (row.constraints_met ? "met" : "missed");
    if (row.in_time) {
      std::cout << ", " << row.in_time->rms() / millidegree << " simulated, limit cycle "
                << row.in_time->limit_cycles / millidegree << (row.left_out() ? ", excluded" : "");
    }
    std::cout << '\n';
  }
  if (best == nullptr) return;
  const auto& controller = best->design.tuning.controller;
  const auto gains = io::GainUnits(stated).texts(controller);
  // A state space has none: `boresight tune --mat` writes its matrices.
  for (std::size_t i = 0; i < gains.size(); ++i) {
    std::cout << controller.structure.gains()[i].symbol << ": " << gains[i] << '\n';
  }
}

int main(int count, char** arguments) try {
  if (count < 2) throw std::invalid_argument("usage: recommend_controller CASE [PROPOSAL]");
  const io::Case stated = io::read_case(arguments[1]);
  const auto antenna = io::designed_antenna(stated, 1, 1, {});  // seed, threads
  std::cout << "reflected inertia: " << reflected_inertia(linear_plant(antenna.mission.antenna))
            << " kg.m2 " << (antenna.from_records ? "by the records" : "as stated") << '\n';
  print_controllers(stated, design::study_controllers(antenna.mission, antenna.ensemble, {}));
  design::MatchOptions matching;
  matching.points = 4;
  for (const auto& series : study_matching(antenna.mission, antenna.ensemble, matching).series) {
    std::cout << series.name << " over the flywheels: the largest rms is "
              << 100.0 * design::span_of(series) << " % above the least\n";
  }
  if (count < 3) return 0;
  const auto asked = io::compared_antennas(antenna.antenna, {io::read_proposal(arguments[2])});
  const auto study = design::study_proposals(asked.antennas, {antenna.distribution}, {});
  const auto& decision = study.decision.value();
  std::cout << "worth its cost: "
            << study.candidates[decision.candidates[decision.worth].candidate].name
            << "; as it is better with probability "
            << decision.statistics.pairs.front().better.value << '\n';
} catch (const std::exception& error) {
  std::cerr << "recommend_controller: " << error.what() << '\n';
  return 2;
}
