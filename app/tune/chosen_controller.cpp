#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/tune/chosen_controller.hpp>
#include <boresight/app/tune/tune_section.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_tuning.hpp>
#include <boresight/io/case/present_gains.hpp>
#include <boresight/io/exchange/reported_controller.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::app {
namespace {

// A controller evaluated on samples may violate constraints.
constexpr auto usable = design::Fitness::unverified;

}  // namespace

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

std::optional<ChosenController> named_controller(const io::Case& antenna, const std::string& gains,
                                                 const std::string& structure) {
  if (gains == "tuned") return std::nullopt;
  if (gains == "case") return present_controller(antenna, structure);
  auto reported = io::controller_of_report(antenna, gains, structure);
  return ChosenController{
      std::move(reported.controller), std::move(reported.structure),
      reported.tuned_for.empty() ? gains : fmt::format("{}, tuned {}", gains, reported.tuned_for)};
}

ChosenController recommended_controller(const io::DesignedAntenna& designed,
                                        const design::TuneOptions& options) {
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
