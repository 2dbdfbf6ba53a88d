#pragma once

#include <optional>
#include <string>

#include <boresight/identification/campaign/inertia_methods.hpp>
#include <boresight/io/audit/resonance_verdict.hpp>

namespace boresight::app {

/// The oil_remark of the expected mode, and the advice to verify which mode was measured; empty
/// without a remark or if the case states the mode.
std::string which_was_measured(const io::ResonanceVerdict& verdict);

/// Both frequencies, how far they are apart, and the bulk modulus that would make the measured one;
/// then which_was_measured.
std::string resonance_sentence(const io::ResonanceVerdict& verdict);

/// The same where the two contradict each other. States also if no plant of the uncertainty set has
/// that oil stiffness. Else empty.
std::string resonance_warning(const std::optional<io::ResonanceVerdict>& verdict);

/// Reason why the methods have no inertia by the resonance, if the resonance is not rigid; else
/// empty.
std::string unread_resonance(const std::optional<io::ResonanceVerdict>& verdict);

/// Ends a sentence on the range of inertia by methods, of which these give least and most: that the
/// resonance's figure is of a rigid antenna, where it is one of them and the measured frequency
/// does not contradict the flexible antenna. Else empty.
std::string rigid_resonance_remark(const std::optional<io::ResonanceVerdict>& verdict,
                                   const identification::InertiaMethod& minimum,
                                   const identification::InertiaMethod& maximum);

}  // namespace boresight::app
