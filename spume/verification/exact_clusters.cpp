#include "spume/verification/exact_clusters.hpp"

#include <cmath>
#include <numbers>

#include "spume/base/contract.hpp"

namespace spume::verification {

namespace {

using std::numbers::pi;

const double circle = std::sqrt(0.75);         // radius of the circle where two unit spheres 1 apart meet
const double turn = pi - std::acos(-1.0 / 3);  // exterior angle of an outer film at an outer junction

/// An outer film bounded by arcs of total length `arc` with `n_corners` corners: Gauss and Bonnet. The arcs
/// bend away from it with the geodesic curvature cot 60° of those circles on the unit sphere.
double outer_film(int n_corners, double arc) {
  return 2 * pi - n_corners * turn + arc / std::sqrt(3.0);
}

/// Segment of that circle over an arc of the given angle.
double segment(double angle) {
  return 0.5 * circle * circle * (angle - std::sin(angle));
}

EqualCluster triple() {
  const double to_axis = 1 / (2 * std::sqrt(3.0));  // from the middle of two centres to the axis
  const double half = std::sqrt(circle * circle - to_axis * to_axis);
  const double angle = 2 * pi - 2 * std::atan2(half, to_axis);
  EqualCluster c{.n = 3,
                 .area = 0,
                 .volume = 0,
                 .inner_border = 2 * half,
                 .outer_border = circle * angle,
                 .n_inner_borders = 1,
                 .n_outer_borders = 3,
                 .n_lamellae = 6,
                 .n_junctions = 2,
                 .outer_junction = half};
  c.area = 3 * outer_film(2, 2 * c.outer_border) + 3 * segment(angle);
  return c;
}

EqualCluster tetrahedral() {
  const double to_film = 1 / (2 * std::sqrt(2.0));  // from the middle to the middle of two centres
  // The outer junction lies at distance d on a line that makes half the tetrahedral angle with that
  // direction.
  const double cosine = std::sqrt(1.0 / 3), sine = std::sqrt(2.0 / 3);
  const double d = to_film * cosine + std::sqrt(to_film * to_film * (cosine * cosine - 1) + circle * circle);
  const double angle = 2 * std::atan2(d * sine, d * cosine - to_film);
  EqualCluster c{.n = 4,
                 .area = 0,
                 .volume = 0,
                 .inner_border = d,
                 .outer_border = circle * angle,
                 .n_inner_borders = 4,
                 .n_outer_borders = 6,
                 .n_lamellae = 10,
                 .n_junctions = 5,
                 .outer_junction = d};
  c.area = 4 * outer_film(3, 3 * c.outer_border) + 6 * (segment(angle) + d * sine * d * cosine);
  return c;
}

/// Volume of a spherical cap of height h.
double cap(double radius, double height) {
  return pi * height * height * (3 * radius - height) / 3;
}

}  // namespace

double EqualCluster::radius_for(double bubble_volume) const {
  return std::cbrt(bubble_volume / volume);
}

EqualCluster equal_cluster(int n) {
  expects(1 <= n && n <= 4, "clusters of one to four equal bubbles");
  EqualCluster c{.n = 1,
                 .area = 4 * pi,
                 .volume = 0,
                 .inner_border = 0,
                 .outer_border = 0,
                 .n_inner_borders = 0,
                 .n_outer_borders = 0,
                 .n_lamellae = 1,
                 .n_junctions = 0,
                 .outer_junction = 0};
  if (n == 2)
    c = {.n = 2,
         .area = 2 * outer_film(0, 2 * pi * circle) + pi * circle * circle,
         .volume = 0,
         .inner_border = 0,
         .outer_border = 2 * pi * circle,
         .n_inner_borders = 0,
         .n_outer_borders = 1,
         .n_lamellae = 3,
         .n_junctions = 0,
         .outer_junction = 0};
  if (n == 3) c = triple();
  if (n == 4) c = tetrahedral();
  c.volume = c.area / (3 * n);  // Σ p V = (2/3) T A with p = 2T
  return c;
}

std::vector<Vec3> equal_cluster_centres(int n) {
  expects(1 <= n && n <= 4, "clusters of one to four equal bubbles");
  if (n == 1) return {{0, 0, 0}};
  if (n == 2) return {{-0.5, 0, 0}, {0.5, 0, 0}};
  if (n == 3) {
    const double r = 1 / std::sqrt(3.0);
    return {{r, 0, 0}, {-r / 2, 0.5, 0}, {-r / 2, -0.5, 0}};
  }
  const double s = 1 / (2 * std::sqrt(2.0));
  return {{s, s, s}, {s, -s, -s}, {-s, s, -s}, {-s, -s, s}};
}

DoubleBubble double_bubble_of_radii(double radius_1, double radius_2) {
  expects(0 < radius_1 && radius_1 <= radius_2, "a double bubble with radii 0 < r1 <= r2");
  const double r1 = radius_1, r2 = radius_2;
  DoubleBubble b{};
  b.radius_1 = r1;
  b.radius_2 = r2;
  b.septum_curvature = 1 / r1 - 1 / r2;
  b.distance = std::sqrt(r1 * r1 + r2 * r2 - r1 * r2);
  const double ring = std::sqrt(0.75) * r1 * r2 / b.distance;
  b.border_length = 2 * pi * ring;
  // Heights of the outer caps above the plane of the border; the centre of the smaller may lie beyond it.
  const double height_1 = r1 + (2 * r1 * r1 - r1 * r2) / (2 * b.distance);
  const double height_2 = r2 + (2 * r2 * r2 - r1 * r2) / (2 * b.distance);
  // Height of the septum, ring² κ/(1 + sqrt(1 − ring² κ²)): finite where it is flat.
  const double k = b.septum_curvature;
  const double height_3 = ring * ring * k / (1 + std::sqrt(1 - ring * ring * k * k));
  const double bulge = pi * height_3 * (3 * ring * ring + height_3 * height_3) / 6;
  b.volume_1 = cap(r1, height_1) + bulge;
  b.volume_2 = cap(r2, height_2) - bulge;
  b.area = 2 * pi * r1 * height_1 + 2 * pi * r2 * height_2 + pi * (ring * ring + height_3 * height_3);
  return b;
}

DoubleBubble double_bubble_of_volumes(double volume_1, double volume_2) {
  expects(0 < volume_1 && volume_1 <= volume_2, "a double bubble with volumes 0 < V1 <= V2");
  const auto share = [](double ratio) {
    const DoubleBubble b = double_bubble_of_radii(ratio, 1);
    return b.volume_1 / b.volume_2;
  };
  double low = 1e-6, high = 1;
  for (int n = 0; n < 100; ++n) {
    const double middle = 0.5 * (low + high);
    (share(middle) < volume_1 / volume_2 ? low : high) = middle;
  }
  const double ratio = 0.5 * (low + high);
  const double scale = std::cbrt(volume_2 / double_bubble_of_radii(ratio, 1).volume_2);
  return double_bubble_of_radii(ratio * scale, scale);
}

}  // namespace spume::verification
