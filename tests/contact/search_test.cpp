// The search: against looking at every pair.
#include "contact/search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "contact/support.hpp"
#include "core/parallel.hpp"
#include "geometry/triangle.hpp"

namespace geist::contact {
namespace {

using namespace testing;

struct Scene {
  Model model;
  Surface surface;
  LawTable laws;
  Places places;
  std::vector<Contactor> contactors;
  double skin = 0.05;

  explicit Scene(const Builder& builder, Random& random)
      : model(builder.made()), surface(make_surface(model)) {
    const std::size_t regions = model.mesh.regions.size() + model.lattices.size();
    laws = LawTable(regions);
    for (std::size_t a = 0; a < regions; ++a)
      for (std::size_t b = a; b < regions; ++b)
        if (random.number() < 0.6) laws.set(static_cast<int>(a), static_cast<int>(b), {});
    contactors = make_contactors(model, surface, laws, places);
    places.follow(model);
  }

  double distance(const Contactor& c, const SurfaceFacet& facet) const {
    const FacetPoints at = points_of(facet, places.x);
    const Vec3 x = places.x.vector(c.place);
    double least = 1e300;
    for (int k = 0; k < 4; ++k)
      least = std::min(least, norm(x - nearest_point(x, at.corner[k], at.corner[(k + 1) % 4], at.centre).p));
    return least;
  }
  double distance(const Contactor& a, const Contactor& b) const {
    return norm(places.x.vector(a.place) - places.x.vector(b.place));
  }
  bool bonded(const Contactor& a, const Contactor& b) const {
    const Place p = places.list[a.place], q = places.list[b.place];
    if (p.lattice != q.lattice) return false;
    const Grid& grid = model.lattices[p.lattice].grid;
    return norm(grid.centre(p.index) - grid.centre(q.index)) < 1.5 * grid.pitch;
  }

  using Found = std::set<std::tuple<int, int, int>>;  // contactor, other, facet or −1
  static Found listed(const Candidates& c) {
    Found all;
    for (const Pair& p : c.pairs) {
      if (!p.is_body()) all.insert({p.contactor, p.other, -1});
      for (int i = 0; p.is_body() && i < p.count; ++i)
        all.insert({p.contactor, p.other, c.facets[static_cast<std::size_t>(p.first + i)]});
    }
    return all;
  }
  /// Every pair that is nearer than touching + margin.
  Found brute(double margin) const {
    Found all;
    for (std::size_t i = 0; i < contactors.size(); ++i) {
      const Contactor& c = contactors[i];
      for (std::size_t f = 0; f < surface.facets.size(); ++f) {
        const SurfaceFacet& facet = surface.facets[f];
        if (laws.at(c.region, facet.region) < 0) continue;
        if (std::count(facet.corner.begin(), facet.corner.end(), c.place)) continue;
        if (distance(c, facet) < reach(c) + margin)
          all.insert({static_cast<int>(i), -1 - facet.body, static_cast<int>(f)});
      }
      for (std::size_t j = i + 1; c.radius > 0 && j < contactors.size(); ++j) {
        const Contactor& b = contactors[j];
        if (b.radius == 0 || laws.at(c.region, b.region) < 0 || bonded(c, b)) continue;
        if (distance(c, b) < c.radius + b.radius + margin)
          all.insert({static_cast<int>(i), static_cast<int>(j), -1});
      }
    }
    return all;
  }
};

Builder heap(Random& random) {
  Builder builder;
  const auto around = [&](Vec3 size) {
    const Vec3 low = random.vector(0.7);
    return Box{low, low + size};
  };
  builder.hexahedra(around({1, 1, 1}), {2, 3, 1});
  builder.hexahedra(around({0.8, 0.3, 1}), {3, 1, 2}, {}, soft);
  builder.particles(around({0.4, 0.8, 0.4}), 0.1);
  builder.particles(around({0.6, 0.6, 0.6}), 0.15);
  return builder;
}

void expect_in(const Scene::Found& part, const Scene::Found& all) {
  EXPECT_TRUE(std::includes(all.begin(), all.end(), part.begin(), part.end()));
}

TEST(Search, FindsWhatLookingAtEveryPairFinds) {
  Random random(41);
  std::size_t pairs = 0;
  for (int round = 0; round < 12; ++round) {
    Scene scene(heap(random), random);
    const Candidates found =
        search(scene.model, scene.surface, scene.contactors, scene.laws, scene.places, scene.skin);
    const auto listed = Scene::listed(found);
    expect_in(scene.brute(scene.skin), listed);
    expect_in(listed, scene.brute(std::sqrt(3.0) * (scene.skin + 1)));
    pairs += listed.size();
    EXPECT_TRUE(std::is_sorted(found.pairs.begin(), found.pairs.end(), [](const Pair& a, const Pair& b) {
      return std::pair(a.contactor, a.other) < std::pair(b.contactor, b.other);
    }));
    for (const Pair& p : found.pairs)
      if (!p.is_body()) {
        EXPECT_LT(p.contactor, p.other);
        EXPECT_FALSE(scene.bonded(scene.contactors[p.contactor], scene.contactors[p.other]));
      }
  }
  EXPECT_GT(pairs, 1000u);
}

TEST(Search, MissesNothingWithinItsRoom) {
  Random random(42);
  for (int round = 0; round < 12; ++round) {
    Scene scene(heap(random), random);
    const Candidates found =
        search(scene.model, scene.surface, scene.contactors, scene.laws, scene.places, scene.skin);
    const auto listed = Scene::listed(found);
    if (!std::isfinite(found.room)) continue;
    for (int i = 0; i < 5; ++i) {
      for (std::size_t p = 0; p < scene.places.list.size(); ++p)
        scene.places.x.set(p, scene.places.x_searched.vector(p) + 0.999 * found.room * random.unit());
      expect_in(scene.brute(0), listed);
    }
  }
}

TEST(Search, OfDistantBodiesGivesRoomForTheirWay) {
  for (const double apart : {0.01, 0.3, 4.0}) {
    Builder builder;
    builder.hexahedra({{0, 0, 0}, {1, 1, 1}}, {2, 2, 2})
        .particles({{0, 0, 1 + apart}, {0.4, 0.4, 1.4 + apart}}, 0.1);
    Random random(43);
    Scene scene(builder, random);
    scene.laws = one_law(2, 0, 1, {});
    scene.places = {};
    scene.contactors = make_contactors(scene.model, scene.surface, scene.laws, scene.places);
    scene.places.follow(scene.model);
    const Candidates found =
        search(scene.model, scene.surface, scene.contactors, scene.laws, scene.places, scene.skin);
    EXPECT_GE(found.room, 0.5 * scene.skin);
    EXPECT_LE(found.room, 0.5 * std::max(scene.skin, apart) + 1e-12);
    if (apart > 1) {
      EXPECT_GT(found.room, 1);
    }
  }
}

TEST(Search, GivesTheSameListsOnAnyNumberOfThreads) {
  Builder builder;
  builder.hexahedra({{0, 0, 0}, {1, 1, 1}}, {12, 12, 2}).particles({{0, 0, 0.99}, {1, 1, 1.39}}, 0.02);
  std::vector<Candidates> all;
  for (const int n : {1, 2, 4}) {
    set_threads(n);
    Random random(44);
    Scene scene(builder, random);
    scene.laws = one_law(2, 0, 1, {});
    scene.places = {};
    scene.contactors = make_contactors(scene.model, scene.surface, scene.laws, scene.places);
    scene.places.follow(scene.model);
    all.push_back(search(scene.model, scene.surface, scene.contactors, scene.laws, scene.places, scene.skin));
  }
  set_threads(1);
  for (const Candidates& c : all) {
    EXPECT_EQ(c.facets, all[0].facets);
    EXPECT_EQ(Scene::listed(c), Scene::listed(all[0]));
    EXPECT_GT(c.pairs.size(), 600u);
  }
}

}  // namespace
}  // namespace geist::contact
