#pragma once

#include <string>

namespace spume::config {

/// A small case that is right; the tests change one thing of it.
inline const std::string sample_domain = R"([domain]
lower = [-0.004, -0.004, -0.004]
upper = [0.004, 0.004, 0.004]
cells = [32, 32, 32]
)";
inline const std::string sample_bubble = R"([[foam.bubble]]
shape = "sphere"
center = [0, 0, 0]
radius = 0.0015
)";
inline const std::string sample_case = sample_domain + sample_bubble;

}  // namespace spume::config
