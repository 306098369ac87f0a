// All contacts of small models: what mechanics demands of any force, and who gets it.
#include "contact/contacts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "contact/support.hpp"
#include "core/parallel.hpp"
#include "de/bonds.hpp"

namespace geist::contact {
namespace {

using namespace testing;

Vec3 position(const Model& model, Place p) {
  if (p.lattice < 0) return model.mesh.points[p.index] + model.mesh.u.vector(p.index);
  const Lattice& lattice = model.lattices[p.lattice];
  return lattice.grid.centre(p.index) + lattice.motion.vector(p.index);
}

struct Sums {
  Vec3 force, moment;
  double size = 0;
  int places = 0;
};
Sums sums(const Model& model, const Contacts& contacts) {
  Sums s;
  for (const TouchedPlace& t : contacts.touched()) {
    s.force += t.force, s.moment += cross(position(model, t.place), t.force) + t.moment;
    s.size += norm(t.force), ++s.places;
  }
  return s;
}

void expect_balanced(const Model& model, const Contacts& contacts) {
  const Sums s = sums(model, contacts);
  EXPECT_GT(s.places, 1);
  EXPECT_LE(norm(s.force), 1e-14 * s.size);
  EXPECT_LE(norm(s.moment), 1e-13 * s.size);
}

const Law rough{Law::Normal::hertz, 1, 0.5, 0.4}, rough_penalty{Law::Normal::penalty, 1, 0.5, 0.4};

/// Steps at random, in which everything must balance.
void wander(Model& model, Contacts& contacts, Random& random, double displacement) {
  int touching = 0;
  for (int i = 0; i < 20; ++i) {
    move_at_random(model, random, displacement, 0.01);
    contacts.find(model, 1e-3);
    if (sums(model, contacts).size == 0) continue;
    ++touching;
    expect_balanced(model, contacts);
  }
  EXPECT_GT(touching, 10);
}

TEST(Contacts, BetweenBlocksBalance) {
  Builder builder;
  builder.hexahedra({{0, 0, 0}, {1, 1, 1}}, {2, 3, 2})
      .hexahedra({{0.1, 0, 0.98}, {1.3, 1, 2}}, {3, 2, 2}, {}, soft);
  Model model = builder.made();
  Contacts contacts(model, one_law(2, 0, 1, rough_penalty));
  Random random(31);
  wander(model, contacts, random, 0.002);
}

TEST(Contacts, OfParticlesOnFacesEdgesAndCornersBalance) {
  for (const Law& law : {rough, rough_penalty})
    for (const Vec3 at : {Vec3{0.4, 0.4, 0.97}, Vec3{0.97, 0.3, 0.965}, Vec3{0.95, 0.95, 0.96}}) {
      Builder builder;
      builder.hexahedra({{0, 0, 0}, {1, 1, 1}}, {2, 2, 2})
          .particles({at, at + Vec3{0.4, 0.4, 0.4}}, 0.1, soft);
      Model model = builder.made();
      Contacts contacts(model, one_law(2, 0, 1, law));
      Random random(32);
      wander(model, contacts, random, 0.001);
    }
}

TEST(Contacts, OfAParticleInANotchBalance) {
  Builder builder;
  builder.hexahedra({{0, 0, 0}, {1, 1, 1}}, {4, 4, 4}, {{{0.5, -1, 0.5}, {2, 2, 2}}})
      .particles({{0.49, 0.3, 0.485}, {0.89, 0.7, 0.885}}, 0.2);
  Model model = builder.made();
  Contacts contacts(model, one_law(2, 0, 1, rough));
  Random random(33);
  wander(model, contacts, random, 0.001);
}

TEST(Contacts, BetweenParticlesBalance) {
  Builder builder;
  builder.particles({{0, 0, 0}, {0.6, 0.6, 0.6}}, 0.1)
      .particles({{0.05, 0.1, 0.58}, {0.65, 0.7, 1.18}}, 0.15, soft);
  Model model = builder.made();
  Contacts contacts(model, one_law(2, 0, 1, rough));
  Random random(34);
  wander(model, contacts, random, 0.002);
}

TEST(Contacts, PressedParticleInASlotStaysFinite) {
  Builder builder;  // a slot of width 0.3, and a sphere of diameter 0.4 in its middle
  builder.hexahedra({{0, 0, 0}, {0.9, 0.6, 0.9}}, {3, 2, 3}, {{{0.3, -1, 0.3}, {0.6, 2, 2}}})
      .particles({{0.25, 0.1, 0.5}, {0.65, 0.5, 0.9}}, 0.2);
  Model model = builder.made();
  Contacts contacts(model, one_law(2, 0, 1, rough));
  contacts.find(model, 1e-3);
  for (const TouchedPlace& t : contacts.touched()) EXPECT_TRUE(std::isfinite(norm(t.force)));
}

/// To the bit what is found after the drift; nodes have drifted before.
TEST(Contacts, AreFoundWhereParticlesWillHaveDriftedTo) {
  constexpr double dt = 1e-3;
  Builder builder;
  builder.hexahedra({{0, 0, 0}, {1, 1, 1}}, {2, 2, 2}).particles({{0.2, 0.2, 0.97}, {0.6, 0.6, 1.37}}, 0.1);
  Model ahead = builder.made(), drifted = builder.made();
  for (Model* model : {&ahead, &drifted}) {
    Random random(37);
    move_at_random(*model, random, 0.001, 5);
  }
  Contacts early(ahead, one_law(2, 0, 1, rough)), late(drifted, one_law(2, 0, 1, rough));
  early.find(ahead, dt, dt);
  de::drift(drifted.lattices[0], dt);
  late.find(drifted, dt);
  const auto &a = early.touched(), &b = late.touched();
  ASSERT_EQ(a.size(), b.size());
  EXPECT_GT(a.size(), 4u);
  for (std::size_t i = 0; i < a.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      EXPECT_EQ(a[i].force[c], b[i].force[c]);
      EXPECT_EQ(a[i].moment[c], b[i].moment[c]);
    }
}

TEST(Contacts, GiveNodesAndParticlesWhatTheyList) {
  for (const bool listed : {false, true}) {
    Builder builder;
    builder.hexahedra({{0, 0, 0}, {1, 1, 1}}, {2, 2, 2}).particles({{0.2, 0.2, 0.97}, {0.6, 0.6, 1.37}}, 0.1);
    if (listed) builder.list_all();
    Model model = builder.made();
    Contacts contacts(model, one_law(2, 0, 1, rough));
    Random random(35);
    move_at_random(model, random, 0.001, 1);
    contacts.find(model, 1e-3);
    Lattice& lattice = model.lattices[0];
    const double per_mass = 0.3, per_inertia = 0.7;
    double across = 0, after = 0;
    std::vector<Vec3> v, w;
    for (std::size_t s = 0; s < lattice.grid.size(); ++s)
      v.push_back(lattice.velocity.vector(s)), w.push_back(lattice.velocity.vector(s, 3));
    contacts.add_to_nodes(model.mesh);
    const auto change = contacts.kick_particles(0, lattice, per_mass, per_inertia);
    int particles = 0;
    for (const TouchedPlace& t : contacts.touched()) {
      if (t.place.lattice < 0) {
        EXPECT_EQ(model.mesh.f.vector(t.place.index), t.force);
        continue;
      }
      ++particles;
      const std::size_t s = t.place.index;
      EXPECT_EQ(t.velocity, v[s]);
      EXPECT_EQ(t.spin, w[s]);
      if (listed) {
        const auto slot = static_cast<std::size_t>(listed_slot(lattice, s));
        EXPECT_EQ(lattice.listed_force.vector(slot), t.force);
        EXPECT_EQ(lattice.listed_force.vector(slot, 3), t.moment);
        EXPECT_EQ(lattice.velocity.vector(s), v[s]);
      } else {
        const Vec3 v2 = lattice.velocity.vector(s), w2 = lattice.velocity.vector(s, 3);
        EXPECT_LE(norm(v2 - v[s] - per_mass * t.force), 1e-15 * (norm(v2) + norm(v[s])));
        EXPECT_LE(norm(w2 - w[s] - per_inertia * t.moment), 1e-15 * (norm(w2) + norm(w[s])));
        across += lattice.mass * dot(v[s], v2 - v[s]) + lattice.inertia * dot(w[s], w2 - w[s]);
        after += lattice.mass * (dot(v2, v2) - dot(v[s], v[s])) +
                 lattice.inertia * (dot(w2, w2) - dot(w[s], w[s]));
      }
    }
    EXPECT_EQ(particles, 4);
    EXPECT_NEAR(change.across, across, 1e-12);
    EXPECT_NEAR(change.after, after, 1e-12);
  }
}

/// Two blocks side by side with a gap, and a particle that touches both.
Builder bridge() {
  Builder builder;
  builder.hexahedra({{0, 0, 0}, {1, 1, 1}}, {2, 2, 2})
      .hexahedra({{1.05, 0, 0}, {2, 1, 1}}, {2, 2, 2})
      .particles({{0.825, 0.3, 0.985}, {1.225, 0.7, 1.385}}, 0.2);
  return builder;
}

LawTable bridge_laws() {
  LawTable laws(3);
  laws.set(0, 2, rough), laws.set(1, 2, rough);
  return laws;
}

TEST(Contacts, RememberFrictionAcrossASearch) {
  Model model = bridge().made();
  Contacts contacts(model, bridge_laws());
  Lattice& lattice = model.lattices[0];
  const auto drag = [&](int steps) {
    for (int i = 0; i < steps; ++i) {
      for (std::size_t s = 0; s < lattice.grid.size(); ++s)
        if (lattice.is(s, site::particle))
          lattice.velocity.set(s, {0, 0.01, 0}), lattice.motion.add(s, {0, 1e-5, 0});
      contacts.find(model, 1e-3);
    }
  };
  drag(30);
  const double dissipated = contacts.energies().friction;
  Vec3 force;
  for (const TouchedPlace& t : contacts.touched())
    if (t.place.lattice == 0) force = t.force;
  EXPECT_LT(force.y, -1e-6);
  // A far node of the first block moves, so that everything is searched again but nothing else changes.
  const long searches = contacts.searches();
  for (std::size_t i = 0; i < model.mesh.nodes(); ++i)
    if (model.mesh.points[i] == Vec3{0, 0, 0}) model.mesh.u.set(i, {-0.4, 0, 0});
  for (std::size_t s = 0; s < lattice.grid.size(); ++s) lattice.velocity.set(s, {});
  contacts.find(model, 1e-3);
  EXPECT_EQ(contacts.searches(), searches + 1);
  for (const TouchedPlace& t : contacts.touched())
    if (t.place.lattice == 0) {
      EXPECT_LE(norm(t.force - force), 0.02 * norm(force));
      EXPECT_NEAR(t.force.y, force.y, 1e-6 * std::abs(force.y));
    }
  EXPECT_NEAR(contacts.energies().friction, dissipated, 1e-9 * contacts.energies().stored);
}

TEST(Contacts, ReportDeepOnesOnceForEachPair) {
  Builder builder;
  builder.hexahedra({{0, 0, 0}, {1, 1, 1}}, {2, 2, 2}).hexahedra({{0, 0, 0.999}, {1, 1, 2}}, {3, 3, 2});
  Model model = builder.made();
  Contacts contacts(model, one_law(2, 0, 1, rough_penalty));
  contacts.find(model, 0);
  EXPECT_TRUE(contacts.take_deep_contacts().empty());
  for (std::size_t i = 0; i < model.mesh.nodes(); ++i)
    if (model.mesh.points[i].z > 0.998 && model.mesh.points[i].z < 1) model.mesh.u.add(i, {0, 0, -0.27});
  contacts.find(model, 0);
  const auto deep = contacts.take_deep_contacts();
  ASSERT_EQ(deep.size(), 1u);
  EXPECT_GT(deep[0].overlap, deep[0].allowed);
  EXPECT_EQ(deep[0].region + deep[0].other, 1);
  contacts.find(model, 0);
  EXPECT_TRUE(contacts.take_deep_contacts().empty());
}

TEST(Contacts, OfAThinPlateWithItselfAreNone) {
  Builder builder;
  builder.hexahedra({{0, 0, 0}, {2, 2, 0.1}}, {4, 4, 1});
  Model model = builder.made();
  Contacts contacts(model, one_law(1, 0, 0, rough_penalty));
  Random random(36);
  for (int i = 0; i < 10; ++i) {
    for (std::size_t n = 0; n < model.mesh.nodes(); ++n)
      model.mesh.u.set(n, -1e-3 * model.mesh.points[n] + random.vector(1e-5));
    contacts.find(model, 1e-3);
    EXPECT_TRUE(contacts.touched().empty());
  }
}

TEST(Contacts, CarryTheLoadOfFlushBlocks) {
  // Pressed by ε all over, every node of a matching interface that is not on its rim carries its area's
  // share.
  Builder builder;
  builder.hexahedra({{0, 0, 0}, {1, 1, 1}}, {4, 4, 2}).hexahedra({{0, 0, 1 - 1e-4}, {1, 1, 2}}, {4, 4, 2});
  Model model = builder.made();
  Contacts contacts(model, one_law(2, 0, 1, rough_penalty));
  contacts.find(model, 0);
  const double pressure = 1e-4 * layer_modulus(stone) / 0.5;  // two halves of 0.25 in series
  int nodes = 0, inner = 0;
  for (const TouchedPlace& t : contacts.touched()) {
    ++nodes;
    const Vec3 p = model.mesh.points[t.place.index];
    EXPECT_NEAR(norm(t.force), std::abs(t.force.z), 1e-12 * pressure);
    if (p.x < 0.1 || p.x > 0.9 || p.y < 0.1 || p.y > 0.9) continue;
    ++inner;
    EXPECT_NEAR(std::abs(t.force.z), pressure / 16, 1e-3 * pressure / 16) << p.x << ' ' << p.y;
  }
  EXPECT_EQ(nodes, 50);
  EXPECT_EQ(inner, 18);
}

TEST(Contacts, AreTheSameBitsOnAnyNumberOfThreads) {
  std::vector<std::vector<TouchedPlace>> found;
  for (const int n : {1, 2, 4}) {
    set_threads(n);
    Builder builder;
    builder.hexahedra({{0, 0, 0}, {1, 1, 1}}, {9, 9, 2}).particles({{0, 0, 0.99}, {1, 1, 1.49}}, 0.025);
    Model model = builder.made();
    Contacts contacts(model, one_law(2, 0, 1, rough));
    Random random(37);
    for (int i = 0; i < 5; ++i) move_at_random(model, random, 2e-3, 1), contacts.find(model, 1e-3);
    found.push_back(contacts.touched());
    EXPECT_GT(contacts.touched().size(), 300u);
  }
  set_threads(1);
  for (const auto& other : found) {
    ASSERT_EQ(other.size(), found[0].size());
    for (std::size_t i = 0; i < other.size(); ++i) {
      EXPECT_EQ(other[i].force, found[0][i].force);
      EXPECT_EQ(other[i].moment, found[0][i].moment);
    }
  }
}

TEST(Contacts, WithoutALawAreEmpty) {
  const Contacts none;
  EXPECT_TRUE(none.empty());
  Model model = bridge().made();
  const Contacts also(model, LawTable(3));
  EXPECT_TRUE(also.empty());
  for (const double charge : also.node_charges(model)) EXPECT_EQ(charge, 0);
}

}  // namespace
}  // namespace geist::contact
