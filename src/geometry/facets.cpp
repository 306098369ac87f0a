#include "geometry/facets.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace geist {
namespace {

constexpr std::array<std::array<int, 4>, 6> facet_corners{
    {{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4}, {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}}};

std::array<std::int32_t, 4> nodes_of(const Mesh& mesh, std::size_t element, int face) {
  std::array<std::int32_t, 4> node;
  for (int a = 0; a < 4; ++a) node[a] = mesh.elements[element][facet_corners[face][a]];
  return node;
}

/// One face of an element under its lowest node: the other nodes in ascending order.
struct Face {
  std::array<std::int32_t, 3> others;
  std::int32_t element;
  std::int32_t number;
};

/// All faces of all elements, those with the same lowest node side by side: of node I they are
/// [begin[I], begin[I + 1]). They are few, and those that are equal are among them.
struct Faces {
  std::vector<std::size_t> begin;
  std::vector<Face> face;

  explicit Faces(const Mesh& mesh) : begin(mesh.nodes() + 2, 0), face(6 * mesh.elements.size()) {
    each(mesh, [this](std::int32_t lowest, const Face&) { ++begin[lowest + 2]; });
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    each(mesh, [this](std::int32_t lowest, const Face& f) { face[begin[lowest + 1]++] = f; });
  }

 private:
  template <class F>
  static void each(const Mesh& mesh, F f) {
    for (std::size_t e = 0; e < mesh.elements.size(); ++e)
      for (int number = 0; number < 6; ++number) {
        std::array<std::int32_t, 4> n = nodes_of(mesh, e, number);
        const auto order = [&n](int a, int b) {
          const auto [low, high] = std::minmax({n[a], n[b]});
          n[a] = low, n[b] = high;
        };
        order(0, 1), order(2, 3), order(0, 2), order(1, 3), order(1, 2);
        f(n[0], Face{{n[1], n[2], n[3]}, static_cast<std::int32_t>(e), number});
      }
  }
};

/// By element: bit f is set if another element has its face f too.
std::vector<std::uint8_t> shared_faces(const Mesh& mesh) {
  std::vector<std::uint8_t> shared(mesh.elements.size(), 0);
  const auto mark = [&shared](const Face& f) {
    shared[f.element] = static_cast<std::uint8_t>(shared[f.element] | 1u << f.number);
  };
  const Faces all(mesh);
  for (std::size_t i = 0; i < mesh.nodes(); ++i)
    for (std::size_t p = all.begin[i]; p < all.begin[i + 1]; ++p)
      for (std::size_t q = p + 1; q < all.begin[i + 1]; ++q)
        if (all.face[p].others == all.face[q].others) mark(all.face[p]), mark(all.face[q]);
  return shared;
}

}  // namespace

std::vector<Facet> exterior_facets(const Mesh& mesh) {
  const std::vector<std::uint8_t> shared = shared_faces(mesh);
  std::vector<Facet> exterior;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    for (int f = 0; f < 6; ++f)
      if (!(shared[e] >> f & 1)) exterior.push_back({static_cast<std::int32_t>(e), nodes_of(mesh, e, f)});
  return exterior;
}

std::array<double, 4> tributary_areas(const Mesh& mesh, const Facet& facet) {
  const double g = 1 / std::sqrt(3.0);
  std::array<double, 4> area{};
  for (const double s : {-g, g})
    for (const double t : {-g, g}) {
      const std::array<double, 4> N{(1 - s) * (1 - t) / 4, (1 + s) * (1 - t) / 4, (1 + s) * (1 + t) / 4,
                                    (1 - s) * (1 + t) / 4};
      const std::array<double, 4> Ns{-(1 - t) / 4, (1 - t) / 4, (1 + t) / 4, -(1 + t) / 4};
      const std::array<double, 4> Nt{-(1 - s) / 4, -(1 + s) / 4, (1 + s) / 4, (1 - s) / 4};
      Vec3 xs, xt;
      for (int a = 0; a < 4; ++a)
        xs += Ns[a] * mesh.points[facet.node[a]], xt += Nt[a] * mesh.points[facet.node[a]];
      const double dA = norm(cross(xs, xt));
      for (int a = 0; a < 4; ++a) area[a] += N[a] * dA;
    }
  return area;
}

}  // namespace geist
