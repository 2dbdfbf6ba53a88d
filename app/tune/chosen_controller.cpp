#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/tune/chosen_controller.hpp>
#include <boresight/app/tune/structure_option.hpp>
#include <boresight/app/tune/tune_section.hpp>
#include <boresight/control/controllers/sample_time.hpp>
#include <boresight/design/verification/stable_gain.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_tuning.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/io/case/mission_of.hpp>
#include <boresight/io/case/present_gains.hpp>
#include <boresight/io/exchange/gains_file.hpp>
#include <boresight/io/exchange/sampled_controller_file.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::app {
namespace {

// A controller evaluated on samples may violate constraints.
constexpr auto usable = design::Fitness::unverified;

ChosenController state_space_of(const io::Case& antenna, const ControllerOptions& options) {
  const std::string& path = options.controller_path;
  const design::Mission mission = io::mission_of(antenna);
  const design::TrackingProblem problem = design::tracking_problem(mission);
  auto [controller, remarks] = io::read_sampled_controller(
      path, io::gear_ratio(antenna), control::sample_time_of(problem.delay), options.names);
  const auto factor = design::largest_stable_factor(problem, controller);
  if (factor != 1.0) {
    throw InfeasibleRequirement(
        fmt::format("{}: the loop of this controller is unstable on the nominal antenna; {}", path,
                    factor ? fmt::format("it is stable with its output times {:.3g}", *factor)
                           : "no smaller output of it, down to a thousandth, makes it stable"));
  }
  std::string source = path;
  for (const auto& remark : remarks) source += "; " + remark;
  return {controller, controller.structure.name(), std::move(source)};
}

}  // namespace

void ControllerOptions::validate() const {
  if (!controller_path.empty()) {
    if (gains == "tuned" && structure.empty()) return;
    throw InvalidInput("expected either --controller or --gains and --structure, found both");
  }
  const auto refuse = [](bool given, const char* option) {
    if (!given) return;
    throw InvalidInput(fmt::format("{}: expected --controller FILE as well, found none", option));
  };
  refuse(!names.part.empty(), "--part");
  refuse(!names.inputs.empty(), "--inputs");
  refuse(!names.outputs.empty(), "--outputs");
}

ChosenController present_controller(const io::Case& antenna, const std::string& structure) {
  for (const auto& [name, controller] : present_controllers(antenna)) {
    if (structure.empty() || controller.structure == io::loop_structure(antenna, structure)) {
      return {controller, structure.empty() ? controller.structure.name() : structure,
              "the antenna's present gains, from the case"};
    }
  }
  throw InvalidInput(
      fmt::format("--gains case: expected [gains] in the case{}, found none",
                  structure.empty() ? "" : fmt::format(" of the structure {}", structure)));
}

std::optional<ChosenController> named_controller(const io::Case& antenna,
                                                 const ControllerOptions& options) {
  options.validate();
  if (!options.controller_path.empty()) return state_space_of(antenna, options);
  if (options.recommended()) return std::nullopt;
  if (options.gains == "case") return present_controller(antenna, options.structure);
  auto file = io::read_gains_file(options.gains, antenna, options.structure);
  return ChosenController{std::move(file.controller), std::move(file.structure),
                          file.tuned_for.empty()
                              ? options.gains
                              : fmt::format("{}, tuned {}", options.gains, file.tuned_for)};
}

ChosenController recommended_controller(const io::DesignedAntenna& designed,
                                        const std::string& structure, design::TuneOptions options) {
  if (!structure.empty()) options.structures = structure_option(designed.antenna, {structure});
  const auto study = study_controllers(designed.mission, designed.ensemble, options);
  if (options.interrupted && options.interrupted()) {
    throw Interrupted("interrupted while tuning the controller");
  }
  const TunedController* best = recommended_or(study, usable);
  if (best == nullptr) {
    throw InfeasibleRequirement(
        fmt::format("{}: no controller of {} keeps the antenna stable; name other structures with "
                    "--structure or gains with --gains",
                    designed.antenna.path, fmt::join(study.tuned.structures, ", ")));
  }
  return {best->design.tuning.controller, best->structure,
          best->tuned_for == TunedFor::nominal
              ? fmt::format("tuned now at {:g} m/s for the nominal plant: no robust controller "
                            "meets the constraints on all {} plants",
                            best->wind_speed, designed.ensemble.members.size())
              : fmt::format("tuned now at {:g} m/s, robust over {} plants{}", best->wind_speed,
                            designed.ensemble.members.size(),
                            best->constraints_met ? "" : "; VIOLATES constraints on some of them")};
}

}  // namespace boresight::app
