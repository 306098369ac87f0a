// Contacts: where bodies touch, and with what force.
//
// A contactor (contactors.hpp) is a point with a radius: a node of a surface (radius 0) or a particle that
// lacks bonds. It touches bodies of hexahedra, whose surface is made of triangles, and other particles. Its
// overlap with a body is the shortest way out (touch.hpp), so faces, edges and corners need no cases of their
// own, nothing is counted twice and nothing jumps. Surfaces of hexahedra meet in two passes: the nodes of
// each against the facets of the other, with half of the stiffness each.
//
// One step: find() after the motion; add_to_nodes() when the nodes' forces are gathered, kick_particles()
// after the lattice's own kick. Forces are computed once for each pair and given to both sides.
#pragma once
#include <cstdint>
#include <vector>

#include "contact/contactors.hpp"
#include "contact/law.hpp"
#include "contact/response.hpp"
#include "contact/search.hpp"
#include "contact/surface.hpp"
#include "contact/touch.hpp"
#include "model/model.hpp"

namespace geist::contact {

/// Energy of all contacts: stored now, and taken out since the start.
struct Energies {
  double stored = 0;    ///< in normal and tangential springs
  double friction = 0;  ///< dissipated by sliding
  double damping = 0;   ///< dissipated by restitution < 1
};

/// The contact force on one node or particle, the moment on a particle, and its velocity before the kick.
struct TouchedPlace {
  Place place;
  Vec3 force, moment, velocity, spin;
};

/// A contactor that went further into another body than the law is made for: half an element, or a radius.
struct DeepContact {
  std::int32_t region, other;  ///< of the contactor, and what it went into
  Place place;
  Vec3 position;
  double overlap, allowed;  ///< lengths
};

/// Regions are numbered hexahedra first, then lattices, as everywhere in the output.
class Contacts {
 public:
  /// No contact at all.
  Contacts() = default;

  /// laws.at(a, b) says how regions a and b act on each other, if they do. The model must be finished:
  /// ghosts placed, bonds connected, masses lumped, held components known.
  Contacts(const Model& model, LawTable laws);

  bool empty() const { return laws_.empty(); }

  /// All contacts and their forces at the present positions. Friction follows the motion of the last `dt`; 0
  /// at the start. Lattices that have yet to drift over the time `ahead` are taken to be there.
  void find(const Model& model, double dt, double ahead = 0);

  /// mesh.f += the contact forces of the last find().
  void add_to_nodes(Mesh& mesh) const;

  /// Give the particles of lattice l their contact forces, after its own kick and before that of its listed
  /// sites: listed ones get them in listed_force, free ones the velocity per_mass · f and the spin
  /// per_inertia · m at once. Returns what this changes in Σ m v⁻·v⁺ and Σ m v⁺·v⁺, spins with their inertia.
  struct KickChange {
    double across = 0, after = 0;
  };
  KickChange kick_particles(std::int32_t l, Lattice& lattice, double per_mass, double per_inertia) const;

  /// Stored at the last find(); dissipated since the start.
  const Energies& energies() const { return energies_; }

  /// What was touched at the last find(): nodes in ascending order, then lattice by lattice in order of
  /// sites.
  const std::vector<TouchedPlace>& touched() const { return touched_; }

  /// The first contactor of each pair of regions that went too deep, if it is new since the last call.
  std::vector<DeepContact> take_deep_contacts();

  /// What contact may add to Σ ω² m of a node (by node of the mesh), and to ω² of the particles of a lattice.
  /// A spring k (n·(u_c − Σ N_I u_I))²/2 is at most k (u_c² + Σ N_I u_I²), so it charges its contactor and,
  /// by N_I, the nodes of the facet with 2 k. A node is charged once as contactor and by as many contactors
  /// as its share of the surface holds; one that stands for more presses with that share only.
  std::vector<double> node_charges(const Model& model) const;
  double particle_charge(const Model& model, std::int32_t lattice) const;

  // For people and benchmarks
  const LawTable& laws() const { return laws_; }
  /// Normal stiffness of a law's pair of regions: of a particle, or by area between the thinnest hexahedra.
  NormalStiffness stiffness(std::int32_t law) const;
  std::size_t contactors() const { return contactors_.size(); }
  std::size_t facets() const { return surface_.facets.size(); }
  std::size_t candidates() const { return candidates_.pairs.size(); }
  long searches() const { return searches_; }

 private:
  /// Of a pair in the last step; parted: it touched in the one before.
  enum class State : std::uint8_t { apart, parted, touching };

  /// A pair that touches: where, and the force on the contactor.
  struct Active {
    Touch touch;  ///< with a body; for two particles only the normal and one point
    Response response;
  };

  /// What a contactor meets: a particle, or (radius 0) a facet with half an element's thickness behind it.
  struct Opposite {
    std::int32_t region;
    double radius, depth;
  };

  /// What a contactor and the facets that it touches do at the contact.
  struct Under {
    Vec3 velocity;        ///< of the contactor relative to the facets
    double inverse_mass;  ///< 1/m*
    double area;          ///< of the facets' nodes: no facet gets more than its own share of stiffness
  };

  void find_thinnest();
  void search_again(const Model& model);
  void meet(const Model& model, std::size_t pair, double dt);
  bool meet_body(const Model& model, std::size_t pair, double dt);
  Under under_touch(const Model& model, const Contactor& c, const Touch& t) const;
  bool meet_particle(const Model& model, std::size_t pair, double dt);
  double largest_stiffness(const Contactor& c, std::int32_t other) const;
  NormalStiffness spring(const Contactor& c, double area, const Opposite& other) const;
  void collect(const Model& model);
  void push(const Pair& pair, const Active& active);
  void push_body(const Pair& pair, const Active& active);
  void act_on(std::int32_t place, Vec3 force, Vec3 moment = {});
  void note_depth(const Pair& pair, const Active& active);
  void list_touched(const Model& model);

  LawTable laws_;
  std::vector<PairLaw> pair_laws_;
  std::vector<double> layer_;  ///< λ + 2μ, by region
  Surface surface_;
  Places places_;
  std::vector<Contactor> contactors_;
  std::vector<Contactor> least_;  ///< by region: the thinnest one
  std::vector<double> thinnest_;  ///< by region: depth of its facets
  double skin_ = 0;

  Candidates candidates_;
  std::vector<Memory> memory_;  ///< by pair
  std::vector<State> state_;    ///< by pair
  std::vector<Active> active_;  ///< by pair; valid but where it is apart
  long searches_ = 0;

  Energies energies_;
  std::vector<Vec3> force_, moment_;       ///< by place; zero where not marked
  std::vector<std::uint8_t> marked_;       ///< by place
  std::vector<std::int32_t> marked_list_;  ///< places that something acts on
  std::vector<TouchedPlace> touched_;
  std::vector<DeepContact> deep_;
  std::vector<std::uint8_t> reported_;  ///< by pair of regions
};

}  // namespace geist::contact
