#pragma once

namespace boresight::numerics {

/// What a sum of squares of `freedom` independent standard normal numbers exceeds once in a
/// thousand times: beyond it what was squared is no chance. By the cube root's normality, to 3 %
/// (E. B. Wilson and M. M. Hilferty, Proc. Natl. Acad. Sci. 17(12), 1931).
/// @throws InvalidInput for a freedom below 1.
double chi_squared_999(int freedom);

}  // namespace boresight::numerics
