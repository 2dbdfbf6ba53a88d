// Of a case file, and of its records where it has some: the controller that every command of the
// program recommends, what it was weighed against, and what fewer or more flywheels would do.
//   recommend_controller CASE.toml
#include <cstdio>
#include <exception>
#include <stdexcept>

#include <boresight/design/studies/controller_study.hpp>
#include <boresight/design/studies/matching_verdict.hpp>
#include <boresight/io/campaign/designed_antenna.hpp>
#include <boresight/io/case/present_gains.hpp>
#include <boresight/numerics/angles.hpp>

namespace design = boresight::design;
namespace io = boresight::io;

void print_controllers(const io::Case& stated, const design::ControllerStudy& study) {
  const design::TunedLaw* best = design::recommended_or(study, design::Fitness::unstable);
  for (const auto& row : study.tuned.laws) {
    std::printf("%s%s: %.4f mdeg linear, constraints %s", &row == best ? "recommended " : "",
                design::description_of(row).c_str(), row.beam_rms / boresight::millidegree,
                row.goals_met ? "met" : "missed");
    if (row.in_time) {
      std::printf(", %.4f simulated, limit cycle %.4f%s",
                  row.in_time->beam_rms / boresight::millidegree,
                  row.in_time->hunting / boresight::millidegree,
                  row.left_out() ? ", beyond the budget" : "");
    }
    std::puts("");
  }
  if (best == nullptr) return;
  const auto& law = best->design.tuning.law;
  const auto gains = io::GainUnits(stated).texts(law);
  for (std::size_t i = 0; i < gains.size(); ++i) {
    std::printf("%s: %s\n", law.structure.gains()[i].symbol.c_str(), gains[i].c_str());
  }
}

int main(int count, char** arguments) try {
  if (count != 2) throw std::invalid_argument("usage: recommend_controller CASE.toml");
  const io::Case stated = io::read_case(arguments[1]);
  const io::DesignedAntenna antenna = io::designed_antenna(stated, 1, 2, {});
  std::printf("reflected inertia: %.4f kg.m2 %s\n",
              boresight::plant::reflected_inertia(linear_plant(antenna.mission.antenna)),
              antenna.from_records ? "by the records" : "as stated");
  design::TuneOptions tuning;
  tuning.threads = 2;
  print_controllers(stated, study_controllers(antenna.mission, antenna.ensemble, tuning));

  design::MatchOptions matching;
  matching.points = 4;
  matching.variants = false;
  matching.threads = 2;
  for (const auto& series : study_matching(antenna.mission, antenna.ensemble, matching).series) {
    std::printf("%s over the flywheels: the largest rms is %.1f %% above the least\n",
                series.name.c_str(), 100.0 * design::span_of(series));
  }
} catch (const std::exception& error) {
  std::fprintf(stderr, "recommend_controller: %s\n", error.what());
  return 2;
}
