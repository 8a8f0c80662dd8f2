// The CIE illuminant FL2, of a fluorescent tube.                                               [CIE 15:2004, table T.6]
#pragma once
#include <array>

#include "spectrum/observer.h"

namespace etendue {

// Relative power every 5 nm from 380 to 780 nm. Lines of mercury are spread over their interval.
inline constexpr std::array<double, kWavelengths> kIlluminantFl2{
    1.18,  1.48,  1.84,  2.15,  3.44,  15.69, 3.85,  3.74,  4.19,  4.62,  5.06,  34.98, 11.81, 6.27,
    6.63,  6.93,  7.19,  7.4,   7.54,  7.62,  7.65,  7.62,  7.62,  7.45,  7.28,  7.15,  7.05,  7.04,
    7.16,  7.47,  8.04,  8.88,  10.01, 24.88, 16.64, 14.59, 16.16, 17.56, 18.62, 21.47, 22.79, 19.29,
    18.66, 17.73, 16.54, 15.21, 13.8,  12.36, 10.95, 9.65,  8.4,   7.32,  6.31,  5.43,  4.68,  4.02,
    3.45,  2.96,  2.55,  2.19,  1.89,  1.64,  1.53,  1.27,  1.1,   0.99,  0.88,  0.76,  0.68,  0.61,
    0.56,  0.54,  0.51,  0.47,  0.47,  0.43,  0.46,  0.47,  0.4,   0.33,  0.27};

}  // namespace etendue
