#include "indistinguishable_faults.hpp"

#include <algorithm>
#include <array>

namespace boresight::faults {
namespace {

struct Proof {
  const char* fault;
  const char* text;
};

// The oil's stiffness K = e_t e_v d^2 Bf (1/V1 + 1/V2) has the same factor as the torque.
constexpr const char* torque_efficiency =
    "J dw/dt + F(w) + T_off = e_t d sum(p_in - p_out) and K are linear in the torque efficiency "
    "e_t: with c times e_t, c times J, F, T_off and K fit the same rates and pressures equally "
    "well. Only the drawings' inertia is independent of e_t, stated to some 2 %";

constexpr std::array<Proof, 1> proofs{{{"torque efficiency 3 % low", torque_efficiency}}};

}  // namespace

void add_proofs(std::vector<RecorderFault>& faults) {
  for (RecorderFault& fault : faults) {
    const auto* const found =
        std::ranges::find_if(proofs, [&](const Proof& proof) { return fault.name == proof.fault; });
    if (found != proofs.end()) fault.indistinguishable = found->text;
  }
}

}  // namespace boresight::faults
