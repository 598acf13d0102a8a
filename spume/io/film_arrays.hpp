#pragma once

#include <array>

#include "spume/io/column.hpp"

namespace spume::io::arrays {

inline constexpr Column half_thickness{
    "half_thickness_m",
    "point data: half-thickness of the film (η); the liquid on a film is twice this times its area"};
inline constexpr Column border_area{"border_area_m2", "point data: cross-section of the Plateau border (λ)"};
inline constexpr Column lamella{"lamella",
                                "cell data: number of the lamella, as in lamellae.csv at the same time"};
inline constexpr Column phase_a{
    "phase_a",
    "cell data: the phase that the triangle's normal (right-hand rule) points away from; 0 is the outside"};
inline constexpr Column phase_b{"phase_b", "cell data: the phase that the triangle's normal points into"};
inline constexpr Column border{"border",
                               "cell data: number of the Plateau border, as in borders.csv at the same time"};
inline constexpr Column time{"TimeValue", "field data: simulated time [s]"};

inline constexpr std::array all{half_thickness, border_area, lamella, phase_a, phase_b, border, time};

}  // namespace spume::io::arrays
