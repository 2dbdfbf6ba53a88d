#pragma once

#include <boresight/design/studies/time_domain_study.hpp>
#include <boresight/io/description/visitor.hpp>

namespace boresight::io {

/// A tuned controller on the nonlinear antenna: in wind, at rest and at the tracking rate, in slow
/// reversals and in a slew, and the controllers that it was chosen from.
void describe(Visitor& v, const design::TimeDomainStudy& study);

/// The runs of one of many compared controllers: in wind, influences not separated, at rest and at
/// the tracking rate, and in slow reversals.
void describe(Visitor& v, const design::NonlinearVerification& run);

/// The rms over several records of wind, with its interval.
void describe(Visitor& v, const design::SimulatedRms& found);

/// Results of a simulation beyond linear rms.
void describe(Visitor& v, const design::NonlinearEffect& effect);

}  // namespace boresight::io
