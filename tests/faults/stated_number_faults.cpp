#include "stated_number_faults.hpp"

#include <algorithm>
#include <array>

namespace boresight::faults {
namespace {

struct Statement {
  const char* fault;
  const char* number;  // of the fit
  double error;        // stated over true, less 1
  const char* why_hidden;
};

// The oil's stiffness is K = e_t e_v d^2 Bf (1/V1 + 1/V2), of efficiencies e_t and e_v,
// displacement d and volumes V1 and V2.
constexpr const char* torque_scale =
    "J dw/dt + F(w) + T_off = e_t d sum(p_in - p_out) and K are linear in the torque efficiency "
    "e_t: with c times e_t, c times J, F, T_off and K fit the same rates and pressures, and only "
    "stated inertias and stiffness are against it";
constexpr const char* displacement =
    "with c times the displacement, c times J, F and T_off and c^2 times K fit the same rates and "
    "pressures, and only stated inertias and stiffness are against it";
constexpr const char* rate_scale =
    "with c times the rate in all channels that show it, J, the slope of F and K over c fit the "
    "same torque, and only stated inertias and stiffness are against it";

constexpr std::array<Statement, 4> statements{
    {{"torque efficiency 3 % low", "torque per pressure", -0.03, torque_scale},
     {"displacement 5 % high", "displacement", 0.05, displacement},
     {"no encoder recorded, tachometer x 1.05", "tachometer scale", -0.05 / 1.05, rate_scale},
     {"tachometer and encoder x 1.05", "tachometer scale", -0.05 / 1.05, rate_scale}}};

}  // namespace

void add_stated_numbers(std::vector<RecorderFault>& faults) {
  for (RecorderFault& fault : faults) {
    const auto* const found = std::ranges::find_if(
        statements, [&](const Statement& one) { return fault.name == one.fault; });
    if (found == statements.end()) continue;
    fault.stated_number = found->number;
    fault.stated_error = found->error;
    fault.why_hidden = found->why_hidden;
  }
}

}  // namespace boresight::faults
