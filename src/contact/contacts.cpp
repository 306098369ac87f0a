#include "contact/contacts.hpp"

#include <algorithm>
#include <utility>

#include "core/parallel.hpp"

namespace geist::contact {
namespace {

struct Velocity {
  Vec3 linear, spin;
};

Velocity velocity_of(const Model& model, Place place) {
  if (place.lattice < 0) return {model.mesh.v.vector(place.index), {}};
  const Field<6>& v = model.lattices[place.lattice].velocity;
  return {v.vector(place.index), v.vector(place.index, 3)};
}

/// n·M⁻¹·n of a place.
double inverse_mass_along(Vec3 inverse, Vec3 n) {
  return inverse.x * n.x * n.x + inverse.y * n.y * n.y + inverse.z * n.z * n.z;
}

/// Forces on a facet's corners that add up to nothing and have this moment: c_a = ω × (x_a − x̄).
std::array<Vec3, 4> couple(const std::array<Vec3, 4>& x, Vec3 moment) {
  const Vec3 mean = 0.25 * (x[0] + x[1] + x[2] + x[3]);
  Mat3 inertia{};
  for (const Vec3 p : x) {
    const Vec3 r = p - mean;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) inertia[i][j] += (i == j ? dot(r, r) : 0) - r[i] * r[j];
  }
  const Vec3 omega = inverse(inertia) * moment;
  std::array<Vec3, 4> forces;
  for (int a = 0; a < 4; ++a) forces[a] = cross(omega, x[a] - mean);
  return forces;
}

/// Force on the contactor at point i of a touch.
Vec3 force_at(const Touch& touch, const Response& response, int i) {
  const TouchPoint& p = touch.point[i];
  return (response.normal * p.lambda / touch.overlap) * p.n +
         (p.lambda / touch.lambda_sum()) * response.tangent;
}

}  // namespace

Contacts::Contacts(const Model& model, LawTable laws) : laws_(std::move(laws)) {
  if (laws_.empty()) return;
  const auto regions = static_cast<std::int32_t>(laws_.regions());
  for (std::int32_t a = 0; a < regions; ++a) layer_.push_back(layer_modulus(region_material(model, a)));
  for (std::int32_t number = 0; number < laws_.count(); ++number) {
    const auto [a, b] = laws_.regions_of(number);
    pair_laws_.emplace_back(laws_.law(number), region_material(model, a), region_material(model, b));
  }
  surface_ = make_surface(model, laws_.touching());
  contactors_ = make_contactors(model, surface_, laws_, places_);
  find_thinnest();
  const std::size_t n = places_.list.size();
  force_.resize(n), moment_.resize(n), marked_.resize(n);
  reported_.resize(laws_.regions() * laws_.regions());
  places_.follow(model, 0);
  search_again(model);
}

/// The skin is short enough that a node one element away from an edge is not paired with the flank around it.
void Contacts::find_thinnest() {
  least_.resize(laws_.regions(), {-1, -1, 0, 0, 0});
  for (const Contactor& c : contactors_) {
    const double skin = reach(c) / (c.radius > 0 ? 2 : 4);
    skin_ = skin_ == 0 ? skin : std::min(skin_, skin);
    if (Contactor& least = least_[c.region]; least.region < 0 || c.depth < least.depth) least = c;
  }
  thinnest_.resize(laws_.regions(), 0);
  for (const SurfaceFacet& facet : surface_.facets)
    if (double& thinnest = thinnest_[facet.region]; thinnest == 0 || facet.depth < thinnest)
      thinnest = facet.depth;
}

void Contacts::find(const Model& model, double dt, double ahead) {
  places_.follow(model, ahead);
  if (outdated(candidates_, places_)) search_again(model);
  constexpr std::size_t worth_threads = 200;
  for_each(
      candidates_.pairs.size(), [this, &model, dt](std::size_t pair) { meet(model, pair, dt); },
      worth_threads);
  collect(model);
}

void Contacts::search_again(const Model& model) {
  Candidates next = search(model, surface_, contactors_, laws_, places_, skin_);
  const auto before = [](const Pair& a, const Pair& b) {
    return a.contactor != b.contactor ? a.contactor < b.contactor : a.other < b.other;
  };
  std::vector<Memory> memory(next.pairs.size());
  std::vector<State> state(next.pairs.size(), State::apart);
  for (std::size_t i = 0; i < candidates_.pairs.size(); ++i) {
    if (state_[i] != State::touching) continue;
    const auto it = std::lower_bound(next.pairs.begin(), next.pairs.end(), candidates_.pairs[i], before);
    if (it != next.pairs.end() && !before(candidates_.pairs[i], *it))
      memory[it - next.pairs.begin()] = memory_[i], state[it - next.pairs.begin()] = State::touching;
  }
  candidates_ = std::move(next), memory_ = std::move(memory), state_ = std::move(state);
  active_.assign(candidates_.pairs.size(), {});
  ++searches_;
}

void Contacts::meet(const Model& model, std::size_t pair, double dt) {
  const bool touches =
      candidates_.pairs[pair].is_body() ? meet_body(model, pair, dt) : meet_particle(model, pair, dt);
  const bool parts = !touches && state_[pair] == State::touching;
  if (parts) active_[pair].response = release(dt, memory_[pair]);
  state_[pair] = touches ? State::touching : parts ? State::parted : State::apart;
}

bool Contacts::meet_body(const Model& model, std::size_t number, double dt) {
  const Pair& pair = candidates_.pairs[number];
  const Contactor& c = contactors_[pair.contactor];
  const std::span<const std::int32_t> facets(candidates_.facets.data() + pair.first,
                                             static_cast<std::size_t>(pair.count));
  Probing probe{places_.x.vector(c.place), c.radius, reach(c), c.radius == 0 ? c.place : -1, {}};
  if (!may_touch(surface_, places_.x, facets, probe)) return false;
  if (c.radius == 0) probe.outward = area_vector(surface_, places_.x, c.place, c.region);
  Active& active = active_[number];
  active.touch = touch(surface_, places_.x, facets, probe);
  const Touch& t = active.touch;
  if (t.count == 0) return false;
  const SurfaceFacet& facet = surface_.facets[t.point[0].facet];
  const PairLaw& law = pair_laws_[laws_.at(c.region, facet.region)];
  const Under under = under_touch(model, c, t);
  const double seen = -dot(probe.outward, t.normal);  // of the node's area
  const NormalStiffness k = spring(c, std::min(under.area, seen), {facet.region, 0, facet.depth});
  active.response =
      respond(law, {k, t.overlap, t.lambda_sum() / t.overlap, t.normal, under.velocity, under.inverse_mass},
              dt, memory_[number]);
  return true;
}

Contacts::Under Contacts::under_touch(const Model& model, const Contactor& c, const Touch& t) const {
  const auto [v, spin] = velocity_of(model, places_.list[c.place]);
  Under under{v, inverse_mass_along(places_.inverse_mass.vector(c.place), t.normal), 0};
  const double lambda = t.lambda_sum();
  for (int i = 0; i < t.count; ++i) {
    const TouchPoint& p = t.point[i];
    const double share = p.lambda / lambda;
    under.velocity += share * cross(spin, p.p - places_.x.vector(c.place));
    for (int a = 0; a < 4; ++a) {
      const std::int32_t corner = surface_.facets[p.facet].corner[a];
      const double w = share * p.weight[a];
      under.velocity -= w * velocity_of(model, places_.list[corner]).linear;
      under.area += w * surface_.node_area[corner];
      under.inverse_mass +=
          w * p.weight[a] * inverse_mass_along(places_.inverse_mass.vector(corner), t.normal);
    }
  }
  return under;
}

bool Contacts::meet_particle(const Model& model, std::size_t number, double dt) {
  const Pair& pair = candidates_.pairs[number];
  const Contactor &a = contactors_[pair.contactor], &b = contactors_[pair.other];
  const Vec3 xa = places_.x.vector(a.place), xb = places_.x.vector(b.place);
  const double distance = norm(xa - xb), overlap = a.radius + b.radius - distance;
  if (overlap <= 0) return false;
  const Vec3 n = (1 / distance) * (xa - xb);
  const Vec3 p = xb + (b.radius - 0.5 * overlap) * n;
  active_[number].touch = {1, {TouchPoint{-1, {}, p, n, overlap, overlap}}, overlap, n};
  const auto [va, spin_a] = velocity_of(model, places_.list[a.place]);
  const auto [vb, spin_b] = velocity_of(model, places_.list[b.place]);
  const Vec3 velocity = va + cross(spin_a, p - xa) - vb - cross(spin_b, p - xb);
  const double inverse_mass = inverse_mass_along(places_.inverse_mass.vector(a.place), n) +
                              inverse_mass_along(places_.inverse_mass.vector(b.place), n);
  const PairLaw& law = pair_laws_[laws_.at(a.region, b.region)];
  const NormalStiffness k = spring(a, 0, {b.region, b.radius, 0});
  active_[number].response = respond(law, {k, overlap, 1, n, velocity, inverse_mass}, dt, memory_[number]);
  return true;
}

void Contacts::collect(const Model& model) {
  for (const std::int32_t place : marked_list_) force_[place] = moment_[place] = {}, marked_[place] = 0;
  marked_list_.clear();
  energies_.stored = 0;
  for (std::size_t i = 0; i < state_.size(); ++i) {
    if (state_[i] == State::apart) continue;
    const Response& response = active_[i].response;
    energies_.stored += response.stored;
    energies_.friction += response.friction, energies_.damping += response.damping;
    if (state_[i] == State::touching) push(candidates_.pairs[i], active_[i]);
  }
  list_touched(model);
}

void Contacts::push(const Pair& pair, const Active& active) {
  note_depth(pair, active);
  if (pair.is_body()) return push_body(pair, active);
  const std::int32_t a = contactors_[pair.contactor].place, b = contactors_[pair.other].place;
  const Vec3 p = active.touch.point[0].p, force = force_at(active.touch, active.response, 0);
  act_on(a, force, cross(p - places_.x.vector(a), force));
  act_on(b, -force, -cross(p - places_.x.vector(b), force));
}

/// A particle turns about its centre. A node cannot: what its force and the facet's miss in moment goes to
/// the facet as a couple.
void Contacts::push_body(const Pair& pair, const Active& active) {
  const Contactor& c = contactors_[pair.contactor];
  const Vec3 x = places_.x.vector(c.place);
  for (int i = 0; i < active.touch.count; ++i) {
    const TouchPoint& at = active.touch.point[i];
    const Vec3 force = force_at(active.touch, active.response, i), moment = cross(at.p - x, force);
    const auto& corner = surface_.facets[at.facet].corner;
    std::array<Vec3, 4> couple_force{};
    if (c.radius == 0) couple_force = couple(points_of(surface_.facets[at.facet], places_.x).corner, moment);
    act_on(c.place, force, c.radius > 0 ? moment : Vec3{});
    for (int a = 0; a < 4; ++a) act_on(corner[a], couple_force[a] - at.weight[a] * force);
  }
}

void Contacts::act_on(std::int32_t place, Vec3 force, Vec3 moment) {
  if (!marked_[place]) marked_[place] = 1, marked_list_.push_back(place);
  force_[place] += force, moment_[place] += moment;
}

void Contacts::note_depth(const Pair& pair, const Active& active) {
  const Contactor& c = contactors_[pair.contactor];
  if (active.touch.overlap <= c.depth) return;
  const std::int32_t other =
      pair.is_body() ? surface_.facets[active.touch.point[0].facet].region : contactors_[pair.other].region;
  const auto [low, high] = std::minmax(c.region, other);
  std::uint8_t& reported = reported_[low * laws_.regions() + high];
  if (reported) return;
  reported = 1;
  deep_.push_back(
      {c.region, other, places_.list[c.place], places_.x.vector(c.place), active.touch.overlap, c.depth});
}

void Contacts::list_touched(const Model& model) {
  std::sort(marked_list_.begin(), marked_list_.end());
  touched_.clear();
  for (const std::int32_t i : marked_list_) {
    const auto [v, spin] = velocity_of(model, places_.list[i]);
    touched_.push_back({places_.list[i], force_[i], moment_[i], v, spin});
  }
}

void Contacts::add_to_nodes(Mesh& mesh) const {
  for (const TouchedPlace& t : touched_)
    if (t.place.lattice < 0) mesh.f.add(t.place.index, t.force);
}

Contacts::KickChange Contacts::kick_particles(std::int32_t l, Lattice& lattice, double per_mass,
                                              double per_inertia) const {
  KickChange change;
  for (const TouchedPlace& t : touched_) {
    if (t.place.lattice != l) continue;
    const std::size_t s = t.place.index;
    if (!lattice.is(s, site::free)) {
      const auto slot = static_cast<std::size_t>(listed_slot(lattice, s));
      lattice.listed_force.add(slot, t.force), lattice.listed_force.add(slot, t.moment, 3);
      continue;
    }
    const Vec3 dv = per_mass * t.force, dw = per_inertia * t.moment;
    const Vec3 v = lattice.velocity.vector(s), w = lattice.velocity.vector(s, 3);
    change.across += lattice.mass * dot(t.velocity, dv) + lattice.inertia * dot(t.spin, dw);
    change.after += lattice.mass * dot(2 * v + dv, dv) + lattice.inertia * dot(2 * w + dw, dw);
    lattice.velocity.add(s, dv), lattice.velocity.add(s, dw, 3);
  }
  return change;
}

std::vector<DeepContact> Contacts::take_deep_contacts() { return std::exchange(deep_, {}); }

}  // namespace geist::contact
