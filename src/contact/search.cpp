#include "contact/search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/parallel.hpp"
#include "geometry/shapes.hpp"

namespace geist::contact {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Gap between two boxes along the axis on which it is largest; negative if they overlap.
double gap(const Box& a, const Box& b) {
  double widest = -infinity;
  for (int c = 0; c < 3; ++c) widest = std::max({widest, a.low[c] - b.high[c], b.low[c] - a.high[c]});
  return widest;
}

/// Boxes sorted into the cells of a grid; found by a point in them.
class BoxGrid {
 public:
  /// number[i] belongs to box[i].
  BoxGrid(std::vector<Box> boxes, std::vector<std::int32_t> numbers)
      : boxes_(std::move(boxes)), numbers_(std::move(numbers)) {
    double sum = 0;
    for (const Box& b : boxes_) {
      const Vec3 edge = b.high - b.low;
      sum += std::max({edge.x, edge.y, edge.z});
    }
    if (!boxes_.empty()) width_ = sum / static_cast<double>(boxes_.size());
    for (std::size_t i = 0; i < boxes_.size(); ++i) insert(i);
    std::sort(entries_.begin(), entries_.end());
  }

  /// visit(number) for every box that holds p, in the order of insertion.
  template <class F>
  void visit(Vec3 p, F visit_number) const {
    const std::uint64_t k = key(cell(p));
    for (auto it = std::lower_bound(entries_.begin(), entries_.end(), Entry{k, 0});
         it != entries_.end() && it->key == k; ++it)
      if (contains(boxes_[it->box], p)) visit_number(numbers_[it->box]);
  }

 private:
  using Cell = std::array<std::int64_t, 3>;
  struct Entry {
    std::uint64_t key;
    std::uint32_t box;
    friend auto operator<=>(const Entry&, const Entry&) = default;
  };
  Cell cell(Vec3 p) const {
    return {static_cast<std::int64_t>(std::floor(p.x / width_)),
            static_cast<std::int64_t>(std::floor(p.y / width_)),
            static_cast<std::int64_t>(std::floor(p.z / width_))};
  }
  /// Distant cells may share a key: the boxes themselves decide.
  static std::uint64_t key(const Cell& c) {
    constexpr std::int64_t mask = (1 << 21) - 1;
    return static_cast<std::uint64_t>(c[0] & mask) << 42 | static_cast<std::uint64_t>(c[1] & mask) << 21 |
           static_cast<std::uint64_t>(c[2] & mask);
  }
  void insert(std::size_t i) {
    const Cell a = cell(boxes_[i].low), b = cell(boxes_[i].high);
    for (std::int64_t x = a[0]; x <= b[0]; ++x)
      for (std::int64_t y = a[1]; y <= b[1]; ++y)
        for (std::int64_t z = a[2]; z <= b[2]; ++z)
          entries_.push_back({key({x, y, z}), static_cast<std::uint32_t>(i)});
  }

  std::vector<Box> boxes_;
  std::vector<std::int32_t> numbers_;
  std::vector<Entry> entries_;
  double width_ = 1;
};

/// One search.
class Searcher {
 public:
  Searcher(const Model& model, const Surface& surface, const std::vector<Contactor>& contactors,
           const LawTable& laws, const Places& places, double skin)
      : model_(model),
        surface_(surface),
        contactors_(contactors),
        laws_(laws),
        places_(places),
        skin_(skin),
        boxes_(laws.regions(), nowhere()),
        near_(laws.regions() * laws.regions(), 0) {
    find_region_boxes();
    find_near_regions();
  }

  Candidates run() {
    Candidates found;
    found.clearances = clearances_;
    if (std::none_of(near_.begin(), near_.end(), [](char n) { return n; })) return found;
    const BoxGrid facets = facet_grid(), particles = particle_grid();
    constexpr std::size_t block = 512;
    std::vector<Candidates> parts((contactors_.size() + block - 1) / block);
    for_each(parts.size(), [&](std::size_t b) {
      for (std::size_t i = b * block; i < std::min(contactors_.size(), (b + 1) * block); ++i)
        if (is_near(contactors_[i])) find(static_cast<std::int32_t>(i), facets, particles, parts[b]);
    });
    for (const Candidates& part : parts) append(part, found);
    return found;
  }

 private:
  Vec3 position(const Contactor& c) const { return places_.x.vector(c.place); }
  bool near(std::int32_t a, std::int32_t b) const { return near_[a * laws_.regions() + b]; }

  /// Boxes of regions, each contactor's widened by its reach; facets lie in between.
  void find_region_boxes() {
    for (const Contactor& c : contactors_) {
      widen(boxes_[c.region], position(c), reach(c));
      largest_reach_ = std::max(largest_reach_, reach(c));
      if (c.radius > 0) largest_radius_ = std::max(largest_radius_, c.radius);
    }
  }

  void find_near_regions() {
    const auto n = static_cast<std::int32_t>(laws_.regions());
    for (std::int32_t a = 0; a < n; ++a)
      for (std::int32_t b = a; b < n; ++b) {
        if (laws_.at(a, b) < 0) continue;
        const double apart = a == b ? 0 : gap(boxes_[a], boxes_[b]);
        near_[a * n + b] = near_[b * n + a] = apart < skin_;
        clearances_.push_back({places_.cluster[a], places_.cluster[b], std::max(skin_, apart)});
      }
  }

  /// Whether the box of some region that may be touched comes near this place.
  bool is_near(const Contactor& c) const { return is_near(c.region, position(c), reach(c) + skin_); }
  bool is_near(std::int32_t region, Vec3 p, double margin) const {
    for (std::size_t other = 0; other < laws_.regions(); ++other)
      if (near(region, static_cast<std::int32_t>(other)) && contains(boxes_[other], p, margin)) return true;
    return false;
  }

  BoxGrid facet_grid() const {
    std::vector<Box> boxes;
    std::vector<std::int32_t> numbers;
    for (std::size_t f = 0; f < surface_.facets.size(); ++f) {
      const SurfaceFacet& facet = surface_.facets[f];
      const FacetPoints at = points_of(facet, places_.x);
      Box box = nowhere();
      for (const Vec3 p : at.corner) widen(box, p);
      const Vec3 diagonal = box.high - box.low;
      if (!is_near(facet.region, at.centre, norm(diagonal) + largest_reach_ + skin_)) continue;
      widen(box, box.low, largest_reach_ + skin_), widen(box, box.high, largest_reach_ + skin_);
      boxes.push_back(box), numbers.push_back(static_cast<std::int32_t>(f));
    }
    return {std::move(boxes), std::move(numbers)};
  }

  BoxGrid particle_grid() const {
    std::vector<Box> boxes;
    std::vector<std::int32_t> numbers;
    for (std::size_t i = 0; i < contactors_.size(); ++i) {
      const Contactor& c = contactors_[i];
      if (c.radius == 0 || !is_near(c)) continue;
      Box box = nowhere();
      widen(box, position(c), c.radius + largest_radius_ + skin_);
      boxes.push_back(box), numbers.push_back(static_cast<std::int32_t>(i));
    }
    return {std::move(boxes), std::move(numbers)};
  }

  void find(std::int32_t i, const BoxGrid& facets, const BoxGrid& particles, Candidates& found) const {
    const Contactor& c = contactors_[i];
    const Vec3 p = position(c);
    std::vector<std::pair<std::int32_t, std::int32_t>> by_body;  // −1 − body, facet
    std::optional<Vec3> outward;                                 // of a node, once a facet is near
    facets.visit(p, [&](std::int32_t f) {
      if (!may_touch(c, f, p)) return;
      if (c.radius == 0 && !outward) outward = area_vector(surface_, places_.x, c.place, c.region);
      if (c.radius > 0 || may_face(*outward, surface_.facets[f]))
        by_body.emplace_back(-1 - surface_.facets[f].body, f);
    });
    std::sort(by_body.begin(), by_body.end());
    for (const auto& [other, f] : by_body) {
      if (found.pairs.empty() || found.pairs.back().contactor != i || found.pairs.back().other != other)
        found.pairs.push_back({i, other, static_cast<std::int32_t>(found.facets.size()), 0});
      found.facets.push_back(f), ++found.pairs.back().count;
    }
    if (c.radius == 0) return;
    std::vector<std::int32_t> others;
    particles.visit(p, [&](std::int32_t j) {
      if (j > i && may_touch(c, contactors_[j])) others.push_back(j);
    });
    std::sort(others.begin(), others.end());
    for (const std::int32_t j : others) found.pairs.push_back({i, j});
  }

  bool may_touch(const Contactor& c, std::int32_t f, Vec3 p) const {
    const SurfaceFacet& facet = surface_.facets[f];
    if (laws_.at(c.region, facet.region) < 0) return false;
    Box box = nowhere();
    for (const std::int32_t corner : facet.corner) {
      if (corner == c.place) return false;
      widen(box, places_.x.vector(corner), reach(c) + skin_);
    }
    return contains(box, p);
  }

  bool may_face(Vec3 outward, const SurfaceFacet& facet) const {
    constexpr double own_way = 0.5;
    const Vec3 normal = facet_normal(points_of(facet, places_.x));
    return dot(normal, outward) <= own_way * norm(normal) * norm(outward);
  }

  bool may_touch(const Contactor& a, const Contactor& b) const {
    if (laws_.at(a.region, b.region) < 0 || bonded(places_.list[a.place], places_.list[b.place]))
      return false;
    return norm(position(a) - position(b)) < a.radius + b.radius + skin_;
  }

  bool bonded(Place a, Place b) const {
    if (a.lattice != b.lattice) return false;
    const Lattice& lattice = model_.lattices[a.lattice];
    const auto offset = static_cast<std::ptrdiff_t>(b.index) - static_cast<std::ptrdiff_t>(a.index);
    for (int d = 0; d < 18; ++d)
      if (lattice.word[a.index] >> d & 1 && lattice.grid.offset(d) == offset) return true;
    return false;
  }

  static void append(const Candidates& part, Candidates& found) {
    const auto before = static_cast<std::int32_t>(found.facets.size());
    for (Pair pair : part.pairs) {
      if (pair.is_body()) pair.first += before;
      found.pairs.push_back(pair);
    }
    found.facets.insert(found.facets.end(), part.facets.begin(), part.facets.end());
  }

  const Model& model_;
  const Surface& surface_;
  const std::vector<Contactor>& contactors_;
  const LawTable& laws_;
  const Places& places_;
  double skin_;
  std::vector<Box> boxes_;  ///< by region
  std::vector<char> near_;  ///< by pair of regions
  double largest_reach_ = 0, largest_radius_ = 0;
  std::vector<Clearance> clearances_;
};

}  // namespace

double reach(const Contactor& contactor) {
  return contactor.radius > 0 ? contactor.radius : 1.5 * contactor.depth;
}

bool outdated(const Candidates& candidates, const Places& places) {
  const auto moved_apart = [&places](const Clearance& c) {
    const Box &a = places.moved[c.a], &b = places.moved[c.b];
    if (a.low.x > a.high.x || b.low.x > b.high.x) return false;  // no contactor at all
    double squares = 0;
    for (int i = 0; i < 3; ++i) {
      const double most = std::max(a.high[i] - b.low[i], b.high[i] - a.low[i]);
      squares += most * most;
    }
    return squares > c.distance * c.distance;
  };
  return std::any_of(candidates.clearances.begin(), candidates.clearances.end(), moved_apart);
}

Candidates search(const Model& model, const Surface& surface, const std::vector<Contactor>& contactors,
                  const LawTable& laws, Places& places, double skin) {
  for (int c = 0; c < 3; ++c) std::copy(places.x[c], places.x[c] + places.x.size(), places.x_searched[c]);
  return Searcher(model, surface, contactors, laws, places, skin).run();
}

}  // namespace geist::contact
