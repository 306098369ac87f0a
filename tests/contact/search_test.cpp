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

  Scene(const Builder& builder, LawTable table)
      : model(builder.made()), surface(make_surface(model)), laws(std::move(table)) {
    contactors = make_contactors(model, surface, laws, places);
    places.follow(model, 0);
  }

  /// Of a node, from triangles whose normal is at a cosine less than `facing` to its own.
  double distance(const Contactor& c, const SurfaceFacet& facet, double cosine) const {
    const FacetPoints at = points_of(facet, places.x);
    const Vec3 x = places.x.vector(c.place);
    const Vec3 outward = c.radius > 0 ? Vec3{} : area_vector(surface, places.x, c.place, c.region);
    double least = 1e300;
    for (int k = 0; k < 4; ++k) {
      const Vec3 normal = triangle_normal(at, k);
      if (c.radius == 0 && dot(normal, outward) >= cosine * norm(normal) * norm(outward)) continue;
      least = std::min(least, norm(x - nearest_point(x, at.corner[k], at.corner[(k + 1) % 4], at.centre).p));
    }
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
  Found brute(double margin, double cosine = facing) const {
    Found all;
    for (std::size_t i = 0; i < contactors.size(); ++i) {
      const Contactor& c = contactors[i];
      for (std::size_t f = 0; f < surface.facets.size(); ++f) {
        const SurfaceFacet& facet = surface.facets[f];
        if (laws.at(c.region, facet.region) < 0) continue;
        if (std::count(facet.corner.begin(), facet.corner.end(), c.place)) continue;
        if (distance(c, facet, cosine) < reach(c) + margin)
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

/// Some of the pairs of regions.
LawTable some_laws(std::size_t regions, Random& random) {
  LawTable laws(regions);
  for (std::size_t a = 0; a < regions; ++a)
    for (std::size_t b = a; b < regions; ++b)
      if (random.number() < 0.6) laws.set(static_cast<int>(a), static_cast<int>(b), {});
  return laws;
}

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
    const Builder builder = heap(random);
    Scene scene(builder, some_laws(4, random));
    const Candidates found =
        search(scene.model, scene.surface, scene.contactors, scene.laws, scene.places, scene.skin);
    const auto listed = Scene::listed(found);
    expect_in(scene.brute(scene.skin), listed);
    expect_in(listed, scene.brute(std::sqrt(3.0) * (scene.skin + 1), 2));
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

TEST(Search, MissesNothingUntilItIsOutdated) {
  Random random(42);
  int checked = 0, outdated_ones = 0;
  for (int round = 0; round < 12; ++round) {
    const Builder builder = heap(random);
    Scene scene(builder, some_laws(4, random));
    const Candidates found =
        search(scene.model, scene.surface, scene.contactors, scene.laws, scene.places, scene.skin);
    const auto listed = Scene::listed(found);
    for (int i = 0; i < 20; ++i) {
      // All of it by any way, each region by a way of its own, and each place by a little.
      const Vec3 all = random.vector(100);
      Mesh& mesh = scene.model.mesh;
      for (const HexRegion& region : mesh.regions) {
        const Vec3 own = all + random.vector(0.015);
        for (std::size_t e = region.first; e < region.first + region.count; ++e)
          for (const std::int32_t node : mesh.elements[e]) mesh.u.set(node, own + random.vector(0.006));
      }
      for (Lattice& lattice : scene.model.lattices) {
        const Vec3 own = all + random.vector(0.015);
        for (std::size_t s = 0; s < lattice.grid.size(); ++s)
          lattice.motion.set(s, own + random.vector(0.006));
      }
      scene.places.follow(scene.model, 0);
      if (outdated(found, scene.places)) {
        ++outdated_ones;
        continue;
      }
      ++checked;
      expect_in(scene.brute(0), listed);
    }
  }
  EXPECT_GT(checked, 50);
  EXPECT_GT(outdated_ones, 10);
}

TEST(Search, OfDistantBodiesLastsForTheirWay) {
  for (const double apart : {0.3, 4.0}) {
    Builder builder;
    builder.hexahedra({{0, 0, 0}, {1, 1, 1}}, {2, 2, 2})
        .particles({{0, 0, 1 + apart}, {0.4, 0.4, 1.4 + apart}}, 0.1);
    Scene scene(builder, one_law(2, 0, 1, {}));
    const Candidates found =
        search(scene.model, scene.surface, scene.contactors, scene.laws, scene.places, scene.skin);
    Lattice& lattice = scene.model.lattices[0];
    const auto lower = [&](double z) {
      for (std::size_t s = 0; s < lattice.grid.size(); ++s) lattice.motion.set(s, {0, 0, -z});
      scene.places.follow(scene.model, 0);
      return outdated(found, scene.places);
    };
    EXPECT_TRUE(lower(apart));
    EXPECT_FALSE(lower(std::max(0.9 * scene.skin, apart - 0.8)));
  }
}

TEST(Search, GivesTheSameListsOnAnyNumberOfThreads) {
  Builder builder;
  builder.hexahedra({{0, 0, 0}, {1, 1, 1}}, {12, 12, 2}).particles({{0, 0, 0.99}, {1, 1, 1.39}}, 0.02);
  std::vector<Candidates> all;
  for (const int n : {1, 2, 4}) {
    set_threads(n);
    Scene scene(builder, one_law(2, 0, 1, {}));
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
