#pragma once

#include <span>
#include <vector>

namespace spume::transport {

/// Slopes at the knots of the cubic spline (twice continuously differentiable) through (s_k, f_k), s
/// increasing, at least four knots. Ends are "not-a-knot" (the first two and the last two pieces are one
/// cubic each), so the spline is of fourth order up to the ends. [de Boor, A Practical Guide to Splines, ch.
/// IV]
std::vector<double> spline_slopes(std::span<const double> s, std::span<const double> f);

/// The same on a ring: f.back() belongs to the point f.front(), s.back() − s.front() is the length of the
/// ring.
std::vector<double> periodic_spline_slopes(std::span<const double> s, std::span<const double> f);

/// Cubic on [0, length] with values f0, f1 and slopes d0, d1 at the ends, at the fraction t of the way.
double hermite(double t, double length, double f0, double f1, double d0, double d1);

}  // namespace spume::transport
