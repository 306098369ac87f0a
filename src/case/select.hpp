// Selections: which nodes and particles a `where` of the case file means.
#pragma once
#include <cstdint>
#include <vector>

#include "case/case.hpp"
#include "geometry/facets.hpp"
#include "solver/probes.hpp"

namespace geist {

struct Selection {
  std::vector<std::int32_t> nodes;
  std::vector<ParticleId> particles;
  bool empty() const { return nodes.empty() && particles.empty(); }
};

/// Finds nodes and particles of a model by position and region.
class Selector {
 public:
  explicit Selector(const Model& model);

  /// A plane selects the nodes on it and the particles whose cell touches it; an interval the nodes and the
  /// particles' centres within it.
  Selection select(const Where& where) const;

  /// The box around everything there is to select.
  const Box& bounds() const { return bounds_; }

  /// Shares of a total of 1, by place of `nodes` and `particles` in the selection.
  struct Shares {
    std::vector<double> nodes, particles;
    double total = 0;  ///< area, or mass, that the shares stand for
    bool by_area = false;
  };
  /// By tributary area of the exterior faces that lie on a plane of `where`; where there are none, by mass.
  Shares shares(const Where& where, const Selection& selection) const;

 private:
  bool node_in(const Where& where, std::int32_t node) const;
  bool particle_in(const Where& where, const Lattice& lattice, std::size_t s) const;
  double exposed_area(const Where& where, const ParticleId& particle) const;
  std::vector<double> node_areas(const Where& where) const;

  const Model& model_;
  std::vector<Facet> facets_;
  Box bounds_;
  std::vector<std::vector<bool>> node_in_region_;  ///< by region of hexahedra, by node
  double slack_ = 0;                               ///< a length that is nothing
};

}  // namespace geist
