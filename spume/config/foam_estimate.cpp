#include "spume/config/foam_estimate.hpp"

#include <algorithm>
#include <cmath>

#include "spume/simulation/cluster.hpp"
#include "spume/simulation/labels.hpp"

namespace spume::config {

namespace {

using simulation::BubbleShape;

/// The box with cells merged f × f × f, a little larger where f does not divide the number of cells.
grid::Box coarsened(const grid::Box& box) {
  constexpr double most_cells = 4e6;
  const double n_cells = static_cast<double>(box.cells.i) * box.cells.j * box.cells.k;
  const int f = std::max(1, static_cast<int>(std::ceil(std::cbrt(n_cells / most_cells))));
  grid::Box coarse = box;
  for (int axis = 0; axis < 3; ++axis) {
    coarse.cells[axis] = (box.cells[axis] + f - 1) / f;
    coarse.upper[axis] = box.lower[axis] + coarse.cells[axis] * f * box.spacing();
  }
  return coarse;
}

/// Cells of a box in the order i fastest.
struct CellOrder {
  Index3 n;
  std::size_t operator()(int i, int j, int k) const {
    return (static_cast<std::size_t>(k) * n.j + j) * n.i + i;
  }
  std::size_t size() const { return (*this)(0, 0, n.k); }
};

/// The bubble (1, 2, …) that each cell belongs to; 0 outside all.
std::vector<int> mark_bubbles(const std::vector<BubbleShape>& bubbles, const grid::Box& box) {
  const CellOrder order{box.cells};
  const double h = box.spacing();
  std::vector<int> label(order.size(), 0);
  std::vector<double> largest(order.size(), 0.0);
  for (std::size_t b = 0; b < bubbles.size(); ++b) {
    Index3 first, last;
    for (int axis = 0; axis < 3; ++axis) {
      const double from_lower = bubbles[b].center[axis] - box.lower[axis], reach = bubbles[b].semi_axes[axis];
      first[axis] = std::max(0, static_cast<int>(std::floor((from_lower - reach) / h)));
      last[axis] = std::min(box.cells[axis] - 1, static_cast<int>(std::floor((from_lower + reach) / h)));
    }
    for (int k = first.k; k <= last.k; ++k)
      for (int j = first.j; j <= last.j; ++j)
        for (int i = first.i; i <= last.i; ++i) {
          const Vec3 x = box.lower + h * Vec3{i + 0.5, j + 0.5, k + 0.5};
          const double potential = simulation::power_potential(bubbles[b], x, 1.0);
          const std::size_t cell = order(i, j, k);
          if (potential <= largest[cell]) continue;
          largest[cell] = potential;
          label[cell] = static_cast<int>(b) + 1;
        }
  }
  return label;
}

bool has_three_values(int a, int b, int c, int d) {
  int n_different = 1;
  n_different += b != a;
  n_different += c != a && c != b;
  n_different += d != a && d != b && d != c;
  return n_different >= 3;
}

/// Faces between cells of different labels, and edges around which three labels meet.
void count_films_and_borders(const std::vector<int>& label, const Index3& n, double h,
                             FoamEstimate& estimate) {
  constexpr double mean_crossings = 1.5;
  const CellOrder order{n};
  const std::array<std::size_t, 3> stride{order(1, 0, 0), order(0, 1, 0), order(0, 0, 1)};
  std::size_t n_faces = 0, n_edges = 0, n_inside = 0;
  for (int k = 0; k + 1 < n.k; ++k)
    for (int j = 0; j + 1 < n.j; ++j)
      for (int i = 0; i + 1 < n.i; ++i) {
        const std::size_t cell = order(i, j, k);
        n_inside += label[cell] != 0;
        for (int axis = 0; axis < 3; ++axis) {
          const std::size_t u = stride[(axis + 1) % 3], v = stride[(axis + 2) % 3];
          n_faces += label[cell] != label[cell + stride[axis]];
          n_edges += has_three_values(label[cell], label[cell + u], label[cell + v], label[cell + u + v]);
        }
      }
  estimate.film_area = static_cast<double>(n_faces) * h * h / mean_crossings;
  estimate.border_length = static_cast<double>(n_edges) * h / mean_crossings;
  estimate.gas_volume = static_cast<double>(n_inside) * h * h * h;
}

/// The connected parts of the marked cells.
std::vector<FoamEstimate::Pocket> connected_pockets(std::vector<char> marked, const grid::Box& box) {
  const CellOrder order{box.cells};
  const double h = box.spacing();
  std::vector<FoamEstimate::Pocket> pockets;
  std::vector<Index3> reached;
  const auto reach = [&](int i, int j, int k) {
    if (!marked[order(i, j, k)]) return;
    marked[order(i, j, k)] = 0;
    reached.push_back({i, j, k});
  };
  for (int k = 0; k < box.cells.k; ++k)
    for (int j = 0; j < box.cells.j; ++j)
      for (int i = 0; i < box.cells.i; ++i) {
        if (!marked[order(i, j, k)]) continue;
        reached.clear();
        reach(i, j, k);
        Vec3 sum;
        // No pocket touches the edge of the box, so every neighbour is a cell.
        for (std::size_t next = 0; next < reached.size(); ++next) {
          const Index3 c = reached[next];
          sum += box.lower + h * Vec3{c.i + 0.5, c.j + 0.5, c.k + 0.5};
          for (int dk = -1; dk <= 1; ++dk)
            for (int dj = -1; dj <= 1; ++dj)
              for (int di = -1; di <= 1; ++di) reach(c.i + di, c.j + dj, c.k + dk);
        }
        const double n_cells = static_cast<double>(reached.size());
        pockets.push_back({sum / n_cells, n_cells * h * h * h});
      }
  return pockets;
}

}  // namespace

FoamEstimate estimate_foam(const std::vector<BubbleShape>& bubbles, const grid::Box& box) {
  const grid::Box coarse = coarsened(box);
  FoamEstimate estimate;
  count_films_and_borders(mark_bubbles(bubbles, coarse), coarse.cells, coarse.spacing(), estimate);
  estimate.pockets = connected_pockets(simulation::enclosed_pockets(bubbles, coarse), coarse);
  return estimate;
}

FoamEstimate estimate_labels(const io::LabelledImage& image, const grid::Box& box) {
  const grid::Box coarse = coarsened(box);
  const double h = coarse.spacing();
  std::vector<int> label;
  for (int k = 0; k < coarse.cells.k; ++k)
    for (int j = 0; j < coarse.cells.j; ++j)
      for (int i = 0; i < coarse.cells.i; ++i)
        label.push_back(simulation::label_at(image, coarse.lower + h * Vec3{i + 0.5, j + 0.5, k + 0.5}));
  FoamEstimate estimate;
  count_films_and_borders(label, coarse.cells, h, estimate);
  return estimate;
}

FoamEstimate estimate_full_box(int n_bubbles, const grid::Box& box) {
  constexpr double area = 2.65, length = 5.35;
  FoamEstimate estimate;
  estimate.gas_volume = box.domain().volume();
  const double edge = std::cbrt(estimate.gas_volume / n_bubbles);
  estimate.film_area = area * n_bubbles * edge * edge;
  estimate.border_length = length * n_bubbles * edge;
  return estimate;
}

}  // namespace spume::config
