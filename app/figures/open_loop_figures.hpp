#pragma once

#include <boresight/app/figures/drawn_controller.hpp>
#include <boresight/app/figures/figure.hpp>

namespace boresight::app {

/// Bode plot of the loop gain at the three breaks: gain crossovers, and at each break the smallest
/// gain and phase margins and the maximum sensitivity.
Figure open_loop_figure(const DrawnController& drawn, const ControllerResponses& on_grid);

/// Nyquist plot with the exclusion disks of the allowed Ms and the disk of the smallest disk
/// margin.
Figure nyquist_figure(const DrawnController& drawn, const ControllerResponses& on_grid);

/// Nichols chart, phases within [-360, 0] degrees, with the contours of the allowed Ms.
Figure nichols_figure(const DrawnController& drawn, const ControllerResponses& on_grid);

}  // namespace boresight::app
