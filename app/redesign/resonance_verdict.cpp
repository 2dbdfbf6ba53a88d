#include <fmt/format.h>

#include <boresight/app/redesign/oil_remark.hpp>
#include <boresight/app/redesign/resonance_verdict.hpp>

namespace boresight::app {
namespace {

constexpr double gigapascal = 1e9;  // Pa

}  // namespace

std::string which_was_measured(const io::ResonanceVerdict& verdict) {
  const std::string remark = verdict.of_oil ? "" : oil_remark(verdict.mode, verdict.oil_mode);
  return remark.empty()
             ? ""
             : remark + " Check which of them was measured and state it in resonance.mode.";
}

// Beyond so many the first order of the uncertainty says no more than that.
constexpr double most_by_first_order = 5.0;

std::string resonance_sentence(const io::ResonanceVerdict& verdict) {
  const double own = verdict.stated_bulk_modulus / gigapascal;
  const std::string modulus =
      verdict.bulk_modulus
          ? fmt::format("{} the bulk modulus from {:.3g} to {:.3g} GPa would reconcile the two",
                        *verdict.bulk_modulus / gigapascal > own ? "raising" : "lowering", own,
                        *verdict.bulk_modulus / gigapascal)
          : fmt::format(
                "no bulk modulus within a factor of 30 of the case's {:.3g} GPa reconciles the two",
                own);
  return fmt::format(
      "The measured hydraulic frequency, {:.3g} Hz, {} the {:.3g} Hz of the case's flexible "
      "antenna{} ({} standard uncertainties apart): {}.{}",
      verdict.measured, verdict.contradicts() ? "contradicts" : "does not contradict",
      verdict.expected, verdict.of_oil ? ", in its dominant hydraulic mode" : "",
      verdict.deviation() > most_by_first_order ? fmt::format("more than {:g}", most_by_first_order)
                                                : fmt::format("{:.3g}", verdict.deviation()),
      modulus, which_was_measured(verdict));
}

std::string resonance_warning(const std::optional<io::ResonanceVerdict>& verdict) {
  if (!verdict || !verdict->contradicts()) return "";
  std::string text = resonance_sentence(*verdict);
  if (!verdict->bulk_modulus) return text;
  const double wanted = *verdict->bulk_modulus / verdict->stated_bulk_modulus;
  constexpr double same = 0.01;
  if (wanted >= verdict->min_oil * (1.0 - same) && wanted <= verdict->max_oil * (1.0 + same)) {
    return text;
  }
  return text + fmt::format(
                    " The uncertainty set has {:.3g} to {:.3g} times the case's oil stiffness, and "
                    "that would be {:.3g} times: no member represents the measured antenna.",
                    verdict->min_oil, verdict->max_oil, wanted);
}

std::string unread_resonance(const std::optional<io::ResonanceVerdict>& verdict) {
  if (!verdict || verdict->rigid) return "";
  return fmt::format(
      "The measured {:.3g} Hz give no inertia: they are not the rigid-body resonance of the whole "
      "antenna on the oil spring.",
      verdict->measured);
}

std::string rigid_resonance_remark(const std::optional<io::ResonanceVerdict>& verdict,
                                   const identification::InertiaMethod& minimum,
                                   const identification::InertiaMethod& maximum) {
  constexpr auto resonance = identification::MethodKind::resonance;
  const bool of_rigid = minimum.kind == resonance || maximum.kind == resonance;
  if (!of_rigid || !verdict || verdict->contradicts()) return "";
  return "; the resonance method assumes a rigid antenna, and the flexible one does not contradict "
         "the masses";
}

}  // namespace boresight::app
