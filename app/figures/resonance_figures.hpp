#pragma once

#include <vector>

#include <boresight/app/figures/figure.hpp>
#include <boresight/io/campaign/campaign_section.hpp>

namespace boresight::app {

/// Ringing of the oil lines after the strongest event of each slosh test: pressures with the damped
/// cosines fitted, and their spectra with the lines' frequencies.
std::vector<Figure> ringing_figures(const io::CampaignSection& section);

/// Torque spectra of ramps with their peaks, each with the harmonic of the excitation that it lies
/// on; the first ring after a valve step with its fit; torque over rate with the impedance fitted.
std::vector<Figure> resonance_figures(const io::CampaignSection& section);

}  // namespace boresight::app
