#include "spume/simulation/lattice.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "spume/base/random.hpp"

namespace spume::simulation {

namespace {

using Structure = LatticeShape::Structure;

constexpr std::array<Vec3, 2> body_centred{{{0.25, 0.25, 0.25}, {0.75, 0.75, 0.75}}};
constexpr std::array<Vec3, 8> a15{{{0, 0, 0},
                                   {0.5, 0.5, 0.5},
                                   {0.25, 0.5, 0},
                                   {0.75, 0.5, 0},
                                   {0, 0.25, 0.5},
                                   {0, 0.75, 0.5},
                                   {0.5, 0, 0.25},
                                   {0.5, 0, 0.75}}};

std::span<const Vec3> sites_of(Structure structure) {
  if (structure == Structure::Kelvin) return body_centred;
  return a15;
}

/// The power diagram of the bubbles, sampled at about 400 points a bubble.
class SampledDiagram {
 public:
  explicit SampledDiagram(const grid::Box& box, double spacing) : domain_(box.domain()) {
    constexpr double samples_per_bubble = 400, reach_in_spacings = 2.2;
    const double wanted = spacing / std::cbrt(samples_per_bubble);
    for (int d = 0; d < 3; ++d) {
      n_[d] = static_cast<int>(std::ceil(box.size()[d] / wanted));
      step_[d] = box.size()[d] / n_[d];
      reach_[d] = std::min(n_[d] / 2, static_cast<int>(std::ceil(reach_in_spacings * spacing / step_[d])));
    }
    best_.resize(static_cast<std::size_t>(n_.i) * n_.j * n_.k);
    owner_.resize(best_.size());
  }

  /// Volume of every cell [m³], and the way from its bubble's centre to its centroid [m].
  void measure(const std::vector<LatticeBubble>& bubbles, std::vector<double>& volume,
               std::vector<Vec3>& to_centroid) {
    std::fill(best_.begin(), best_.end(), -std::numeric_limits<double>::infinity());
    std::fill(owner_.begin(), owner_.end(), -1);
    for (std::size_t b = 0; b < bubbles.size(); ++b) claim(bubbles[b], static_cast<int>(b));
    volume.assign(bubbles.size(), 0.0);
    to_centroid.assign(bubbles.size(), {});
    const double sample_volume = step_.x * step_.y * step_.z;
    std::size_t n = 0;
    for (int k = 0; k < n_.k; ++k)
      for (int j = 0; j < n_.j; ++j)
        for (int i = 0; i < n_.i; ++i, ++n) {
          if (owner_[n] < 0) continue;
          volume[owner_[n]] += sample_volume;
          to_centroid[owner_[n]] +=
              sample_volume * domain_.step(bubbles[owner_[n]].center, sample({i, j, k}));
        }
    for (std::size_t b = 0; b < bubbles.size(); ++b)
      if (volume[b] > 0) to_centroid[b] = to_centroid[b] / volume[b];
  }

 private:
  Vec3 sample(const Index3& c) const {
    return domain_.lower + Vec3{(c.i + 0.5) * step_.x, (c.j + 0.5) * step_.y, (c.k + 0.5) * step_.z};
  }
  void claim(const LatticeBubble& bubble, int number) {
    Index3 middle;
    for (int d = 0; d < 3; ++d)
      middle[d] = static_cast<int>(std::floor((bubble.center[d] - domain_.lower[d]) / step_[d]));
    const auto wrap = [](int c, int n) { return ((c % n) + n) % n; };
    for (int k = -reach_.k; k <= reach_.k; ++k)
      for (int j = -reach_.j; j <= reach_.j; ++j)
        for (int i = -reach_.i; i <= reach_.i; ++i) {
          const Index3 c{wrap(middle.i + i, n_.i), wrap(middle.j + j, n_.j), wrap(middle.k + k, n_.k)};
          const std::size_t n = (static_cast<std::size_t>(c.k) * n_.j + c.j) * n_.i + c.i;
          const double value = bubble.weight - norm_squared(domain_.step(bubble.center, sample(c)));
          if (value <= best_[n]) continue;
          best_[n] = value;
          owner_[n] = number;
        }
  }

  Domain domain_;
  Index3 n_, reach_;
  Vec3 step_;
  std::vector<double> best_;
  std::vector<int> owner_;
};

/// Random places, none within a distance of another that shrinks until all find room.
void scatter(std::vector<LatticeBubble>& bubbles, const Domain& domain, double spacing, Random& random) {
  constexpr int tries = 1000;
  double apart = 0.8 * spacing;
  for (std::size_t b = 0; b < bubbles.size(); ++b)
    for (int n = 1;; ++n) {
      for (int d = 0; d < 3; ++d) bubbles[b].center[d] = domain.lower[d] + domain.size[d] * random.uniform();
      if (n % tries == 0) apart *= 0.95;
      if (std::none_of(bubbles.begin(), bubbles.begin() + b, [&](const LatticeBubble& other) {
            return norm(domain.step(other.center, bubbles[b].center)) < apart;
          }))
        break;
    }
}

/// Moves centres to centroids and gives the cells their volumes.
void spread_out(std::vector<LatticeBubble>& bubbles, const grid::Box& box, double spacing) {
  constexpr int sweeps_that_move = 10, most_sweeps = 200;
  constexpr double enough = 0.02, pace = 0.25;
  SampledDiagram diagram(box, spacing);
  std::vector<double> volume;
  std::vector<Vec3> to_centroid;
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    diagram.measure(bubbles, volume, to_centroid);
    double largest_error = 0;  // of a volume over the mean one
    for (std::size_t b = 0; b < bubbles.size(); ++b)
      largest_error =
          std::max(largest_error, std::abs(volume[b] - bubbles[b].volume) / (spacing * spacing * spacing));
    if (sweep >= sweeps_that_move && largest_error < enough) return;
    for (std::size_t b = 0; b < bubbles.size(); ++b) {
      if (sweep < sweeps_that_move) bubbles[b].center += to_centroid[b];
      // A weight moves the faces of its cell by half of it over the spacing, and a cell has some 5 V^(2/3) of
      // them, which neighbours move too.
      bubbles[b].weight += pace * (bubbles[b].volume - volume[b]) / spacing;
    }
  }
}

std::vector<LatticeBubble> make_random(const LatticeShape& lattice, const grid::Box& box) {
  Random random(lattice.seed);
  std::vector<LatticeBubble> bubbles(lattice.count);
  double sum = 0;
  for (auto& bubble : bubbles) {
    const double diameter = 1 + lattice.spread * std::clamp(random.normal(), -2.0, 2.0);
    bubble.volume = diameter * diameter * diameter;
    sum += bubble.volume;
  }
  const Domain domain = box.domain();
  const double spacing = lattice_spacing(lattice, box);
  for (auto& bubble : bubbles) {
    bubble.volume *= domain.volume() / sum;
    const double radius = 0.5 * std::cbrt(bubble.volume);
    bubble.weight = radius * radius;
  }
  scatter(bubbles, domain, spacing, random);
  spread_out(bubbles, box, spacing);
  return bubbles;
}

std::vector<LatticeBubble> make_crystal(const LatticeShape& lattice, const grid::Box& box) {
  const Vec3 cells = crystal_cells(lattice, box);
  const std::span<const Vec3> sites = sites_of(lattice.structure);
  const Vec3 off_grid = box.spacing() * Vec3{0.137, 0.211, 0.289};
  const Index3 n{static_cast<int>(std::lround(cells.x)), static_cast<int>(std::lround(cells.y)),
                 static_cast<int>(std::lround(cells.z))};
  const double edge = box.size().x / n.i;
  const double volume =
      box.domain().volume() / (static_cast<double>(n.i) * n.j * n.k * static_cast<double>(sites.size()));
  std::vector<LatticeBubble> bubbles;
  for (int k = 0; k < n.k; ++k)
    for (int j = 0; j < n.j; ++j)
      for (int i = 0; i < n.i; ++i)
        for (const Vec3& site : sites)
          bubbles.push_back(
              {box.lower + edge * (site + Vec3{1.0 * i, 1.0 * j, 1.0 * k}) + off_grid, 0, volume});
  return bubbles;
}

}  // namespace

Vec3 crystal_cells(const LatticeShape& lattice, const grid::Box& box) {
  const Vec3 size = box.size();
  return (lattice.cells / std::min({size.x, size.y, size.z})) * size;
}

int count_bubbles(const LatticeShape& lattice, const grid::Box& box) {
  if (lattice.structure == Structure::Random) return lattice.count;
  const Vec3 cells = crystal_cells(lattice, box);
  return static_cast<int>(std::lround(cells.x) * std::lround(cells.y) * std::lround(cells.z) *
                          static_cast<long>(sites_of(lattice.structure).size()));
}

double lattice_spacing(const LatticeShape& lattice, const grid::Box& box) {
  return std::cbrt(box.domain().volume() / count_bubbles(lattice, box));
}

std::vector<LatticeBubble> make_lattice(const LatticeShape& lattice, const grid::Box& box) {
  return lattice.structure == Structure::Random ? make_random(lattice, box) : make_crystal(lattice, box);
}

double lattice_potential(const LatticeBubble& bubble, const Vec3& x, const Domain& domain, double spacing) {
  return (bubble.weight - norm_squared(domain.step(bubble.center, x))) / spacing;
}

}  // namespace spume::simulation
