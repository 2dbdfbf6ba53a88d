#pragma once

#include <functional>
#include <optional>
#include <string>

#include <boresight/app/tune/tune_study.hpp>
#include <boresight/control/controllers/control_law.hpp>
#include <boresight/io/case/case_file.hpp>

namespace boresight::app {

/// A law and where its gains come from, in words.
struct HeldLaw {
  control::ControlLaw law;
  std::string structure;  // as the user names it
  std::string source;
};

/// A structure by the name that a HeldLaw or a report has for it: in full ("PI with lag"), short
/// ("PI"), one of the case's own, or that of its present gains. @throws InvalidInput as
/// loop_structure.
control::LoopStructure structure_named(const io::Case& antenna, const std::string& name);

/// The law that the antenna runs on now: of [gains], or of the [[loop]] named `structure`.
/// @throws InvalidInput if the case has none.
HeldLaw present_law(const io::Case& antenna, const std::string& structure);

/// The law of a report that `boresight tune` or `redesign` wrote as JSON, of `structure` unless
/// that is empty: of tune's io::recommended_row, whether it meets its goals or not.
/// @throws InvalidInput naming the file if there is none.
HeldLaw law_of_report(const io::Case& antenna, const std::string& path,
                      const std::string& structure);

/// What the options --gains and --structure name: with "case" present_law, with a path
/// law_of_report; nothing with "tuned". @throws InvalidInput as they do
std::optional<HeldLaw> named_law(const io::Case& antenna, const std::string& gains,
                                 const std::string& structure);

/// What design::recommend chooses of the nominal and robust designs of a structure, tuned now; one
/// that misses its goals where none meets them.
/// @throws InfeasibleRequirement if no stable law is found; Interrupted.
HeldLaw tuned_law(const io::Case& antenna, const PlantEnsemble& ensemble,
                  const std::string& structure, std::uint64_t seed, unsigned threads,
                  const std::function<bool()>& interrupted);

}  // namespace boresight::app
